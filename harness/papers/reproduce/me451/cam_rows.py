"""Cams and slots of the ME451 slides beside the five steps: tangents, assumptions, g_j."""

from __future__ import annotations

import cmath
import math

import numpy as np

from mechanism_fmu.kinematics import profile_report
from mechanism_fmu.kinematics.equations import Equations
from mechanism_fmu.slides import (
    CAM,
    cam_tangent,
    roller_tangent,
    tangents_of_the_rows,
)

from ..bench import Bench, FloatArray, first_derivative, off_by
from ..figures.all_figures import redrawn_joint
from ..row import Found, Row, Verdict, judged, within
from .gear_rows import SLIDES
from .joint_rows import PARTS, egg_tangent, two_bodies

PROFILES = ("mechanism_fmu/kinematics/profiles.py",)


def _tangents(_bench: Bench) -> Found:
    angles = {degrees: math.radians(degrees) for degrees in (0, 15, 30, 60, 110, 200)}
    found = {degrees: (cam_tangent(alpha), roller_tangent(alpha)) for degrees, alpha in angles.items()}
    rows = [tangents_of_the_rows(alpha, alpha) for alpha in angles.values()]
    return within(
        float(np.abs(np.subtract(rows, list(found.values()))).max()),
        1e-12,
        "g₁ = ρ' e + ρ R e with ρ' = ¾ sin 3α up to 2π/3, 0 beyond; g₂ = ¼ R e; the rows of CamFollower have the same",
        *(
            f"α = {degrees}°: g₁ = ({g1[0]:.6f}, {g1[1]:.6f}), g₂ = ({g2[0]:.6f}, {g2[1]:.6f})"
            for degrees, (g1, g2) in found.items()
        ),
        verdict=Verdict.ANSWERED,
    )


def _point_of_cam(alpha: float) -> FloatArray:
    """Of the slides' cam, where its radius is a cosine [m]."""
    return (1.25 - 0.25 * math.cos(3 * alpha)) * np.array([math.cos(alpha), math.sin(alpha)])


def _boundary(_bench: Bench) -> Found:
    angles = np.linspace(0.05, 2.0, 14)
    return within(
        max(float(np.abs(first_derivative(_point_of_cam, a, 1e-3) - cam_tangent(float(a))).max()) for a in angles),
        1e-9,
        "r^P = r + A (s + ρ e) and g = ∂r^P/∂α, by differences along the slides' cam",
        verdict=Verdict.ANSWERED,
    )


def _coordinates(_bench: Bench) -> Found:
    cam, point = (Equations(two_bodies(PARTS[kind]), 0.0).coordinates[6:] for kind in ("cam", "point"))
    return judged(
        (len(cam), len(point)) == (2, 1),
        f"cam–follower: {', '.join(c.split('.')[1] for c in cam)}; point–follower: {point[0].split('.')[1]}, without "
        "mass; the engine eliminates them exactly (docs/decisions/009-contact-coordinates.md)",
    )


def _convex(_bench: Bench) -> Found:
    report = profile_report(CAM)
    widest = math.degrees(report.hollows[0][1] - report.hollows[0][0])
    return judged(
        not report.convex,
        f"one α for each point, as they say, but the slides' own cam is not convex: hollow over {widest:.2f}° beside "
        "each join (assumption X-cam)",
        f"curvature {-1 / report.hollow_radius:.4f} in the hollow, {1 / report.tip_radius:.4f} at the nose",
        "convexity is not needed: α stays single-valued while ρ > 0; a roller smaller than 0.8 fits, a flat face "
        "bridges the hollow",
        verdict=Verdict.HOLDS_IN_PART,
    )


def _slot(_bench: Bench) -> Found:
    """The columns of alpha in Phi_q are -g_j: against differences of points of the slot, as it is turned."""
    equations = Equations(two_bodies(PARTS["point"]), 0.0)
    q = equations.start
    g, wanted = -equations.at(q, 0.0).jacobian[:, 6], egg_tangent(q[6]) * cmath.rect(1.0, q[5])
    return within(
        off_by(g, [wanted.real, wanted.imag]),
        1e-9,
        f"the tangent of the slot by differences of its points is −Φ_α of this project: g_j = ({g[0]:.6f}, "
        f"{g[1]:.6f}) m; without it α_j would be free",
        "g_j = A_j (ρ' e + ρ R e); the slides say so of the book (p. 85), which is not at hand",
        verdict=Verdict.HOLDS,
    )


ROWS = (
    Row("S-boundary", "Boundary of a convex body", "Place and tangent over α.", "r^P(α), g(α)", (SLIDES,), _boundary),
    Row("S-convex", "Boundary of a convex body", "Assumption: the bodies are convex.", "in words", PROFILES, _convex),
    Row(
        "S-coordinates",
        "Cam–follower, point–follower",
        "One more coordinate α for each curved profile.",
        "(α_i, α_j), (α_j)",
        ("mechanism_fmu/engine/constraints/textbook.py",),
        _coordinates,
    ),
    Row(
        "S-chatter",
        "Cam–follower pair",
        "Assumption: no chattering.",
        "in words",
        ("mechanism_fmu/model/joints/cams.py",),
        Found("unilateral pairs open and strike here; the slides' pair is `unilateral=False`", Verdict.TAKEN_OVER),
    ),
    Row(
        "S-tangents",
        "Example (cam)",
        "The tangents g₁ and g₂.",
        "asked, not answered",
        (SLIDES, "docs/joints/cam_follower.md"),
        _tangents,
    ),
    Row(
        "S-figcam",
        "Example (cam)",
        "The cam with its roller.",
        "drawing lost",
        ("docs/joints/slides_cam.svg",),
        lambda _bench: redrawn_joint("slides_cam.svg"),
    ),
    Row(
        "S-fig3.4.10",
        "Figs 3.4.10, 3.4.12",
        "Flat-faced follower, pin in a slot.",
        "drawings lost",
        ("docs/joints/cam_flat_follower.svg", "docs/joints/point_follower.svg"),
        lambda _bench: redrawn_joint("cam_flat_follower.svg", "point_follower.svg"),
    ),
    Row(
        "S-fig3.4.11",
        "Fig. 3.4.11",
        "Flat-faced follower in an engine.",
        "drawing lost",
        ("docs/joints/cam_flat_follower.md",),
        Found("no sizes of the engine are in the text; not drawn", Verdict.NOT_DETERMINED),
    ),
    Row(
        "S-gj",
        "Point–follower",
        "The book forgot g_j in its eq (3.4.32).",
        "the tangent of the slot",
        ("mechanism_fmu/model/joints/cams.py",),
        _slot,
    ),
)
