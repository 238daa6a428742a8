"""Figs 1 to 4 and 7 of Erdman, Sandor and Oakberg, as far as their text determines them."""

from __future__ import annotations

import math

from ..bench import AtAngle
from .drawn_pieces import ACCENT, INK, SOFT, Point, View, label, middle, polar, sheet


def fig1_elements() -> str:
    """Cantilever, two-force member, beam on two supports with an end moment."""
    a, b, c = (View((70, y), 1.0) for y in (80, 200, 300))
    return sheet(
        460,
        355,
        "Models for elastic analysis",
        a.wall((0, -30), (0, 30)),
        a.line([(0, 0), (260, 0)], INK, 5),
        a.arrow((262, 0), (318, 0), ACCENT),
        a.text((334, 0), "f₁, d₁"),
        a.arrow((260, 2), (260, 46), ACCENT),
        a.text((292, 44), "f₂, d₂"),
        a.arc((260, 0), 26, -0.9, 0.9),
        a.text((300, -26), "f₃, d₃"),
        a.text((130, 0), "A, E, I, l", 0, 22),
        label((30, 30), "(a)", 14),
        b.line([(0, 0), (260, 0)], INK, 5),
        b.pin((0, 0)),
        b.pin((260, 0)),
        b.arrow((-8, 0), (-50, 0), ACCENT),
        b.arrow((268, 0), (318, 0), ACCENT),
        b.text((334, 0), "f₁, d₁"),
        b.text((130, 0), "A, E, l", 0, 22),
        label((30, 160), "(b)", 14),
        c.line([(0, 0), (260, 0)], INK, 5),
        c.hinge((0, 0)),
        c.hinge((260, 0)),
        c.arrow((268, 0), (318, 0), ACCENT),
        c.text((334, 0), "f₁, d₁"),
        c.arc((0, 0), 30, -0.7, 1.1),
        c.text((40, 32), "f₂, d₂"),
        c.text((130, 0), "A, E, I, l", 0, 22),
        label((30, 262), "(c)", 14),
    )


def fig2_elements() -> str:
    """Torsional member, and spatial link with a revolute and a spherical joint."""
    a, b = View((70, 80), 1.0), View((70, 200), 1.0)
    return sheet(
        460,
        250,
        "Models for elastic analysis: torsion, spatial link",
        a.wall((0, -30), (0, 30)),
        a.line([(0, 0), (260, 0)], INK, 9),
        a.arc((260, 0), 28, -1.1, 1.1),
        a.text((322, 0), "M, d₁"),
        a.text((130, 0), "G, J, l", 0, 24),
        label((30, 30), "(a)", 14),
        b.line([(0, 0), (260, 0)], INK, 5),
        b.hinge((0, 0)),
        b.dot((260, 0), 7),
        b.arrow((268, 0), (318, 0), ACCENT),
        b.text((336, 0), "f₁, d₁"),
        b.arrow((260, 6), (260, 48), ACCENT),
        b.text((292, 46), "f₂, d₂"),
        b.text((0, 0), "R", -20, -4),
        b.text((260, 0), "S", 0, 20),
        b.text((130, 0), "A, E, I, l", 0, 22),
        label((30, 150), "(b)", 14),
    )


def _points(at: AtAngle) -> tuple[View, dict[str, Point]]:
    """The path generator of the example, in crank lengths."""
    a = polar((0.0, 0.0), 4.0, at.phi)
    points = {
        "A0": (0.0, 0.0),
        "B0": (10.0, 0.0),
        "A": a,
        "B": polar(a, 10.0, at.coupler),
        "P": polar(a, 6.0, at.coupler + math.pi / 6),
    }
    return View((70, 330), 28), points


def _linkage(v: View, p: dict[str, Point]) -> list[str]:
    return [
        v.line([p["A0"], p["A"]], INK, 5),
        v.line([p["A"], p["B"]], INK, 5),
        v.line([p["A"], p["P"]], INK, 5),
        v.line([p["B0"], p["B"]], INK, 5),
        v.hinge(p["A0"]),
        v.hinge(p["B0"]),
        v.pin(p["A"]),
        v.pin(p["B"]),
    ]


def fig3_generator(at: AtAngle) -> str:
    """The four-bar path generator with its disk."""
    v, p = _points(at)
    parts = [
        *_linkage(v, p),
        v.dot(p["P"], 13, "#7b8794"),
        v.text(p["P"], "P", 22, -8),
        v.text(middle(p["A"], p["P"]), "1", -12, -12),
        v.text(middle(p["A"], p["B"]), "2", 8, 18),
        v.text(middle(p["A0"], p["A"]), "3", -16, 0),
        v.text(middle(p["B0"], p["B"]), "4", 18, 0),
        v.arc(p["A"], 2.2, at.coupler, at.coupler + math.pi / 6, "α", 12),
        v.line([p["A0"], (2.2, 0.0)], SOFT, 0.8, "5 3"),
        v.arc(p["A0"], 1.4, 0.0, at.phi, "φ", 12),
        label((230, 395), "Case I: disk mass at P; elements 1 to 4 are elastic, 3 is the input", 13),
    ]
    return sheet(470, 420, "Four-bar path generator", *parts)


def fig4_case1(at: AtAngle) -> str:
    """Element coordinates x1 to x8 and system forces P1 to P3."""
    v, p = _points(at)
    parts = [
        *_linkage(v, p),
        *_at_path_point(v, p["P"]),
        *_along(v, p["A"], p["P"], at.coupler + math.pi / 6, "x₁, x₂, x₃", 22, True),
        *_along(v, p["A0"], p["A"], at.phi, "x₄, x₅", 12, True),
        *_along(v, p["A"], p["B"], at.coupler, "x₆, x₇", 8),
        *_along(v, p["B0"], p["B"], at.psi, "x₈", 0),
        label((230, 385), "x₁, x₄, x₇, x₈ axial; x₂, x₅ transverse; x₃, x₆ rotations", 13),
        label((230, 405), "order of this project; the document's arrows are lost", 13),
    ]
    return sheet(470, 425, "Case 1: element coordinates and system forces", *parts)


def fig7_case2(at: AtAngle) -> str:
    """System forces P1 to P8."""
    v, p = _points(at)
    parts = [
        *_linkage(v, p),
        v.dot(p["P"], 11, "#7b8794"),
        v.dot(p["A"], 8, "#7b8794"),
        v.dot(p["B"], 8, "#7b8794"),
        *_at_path_point(v, p["P"]),
        *_force(v, p["A"], at.phi, "P₄", (22, 4)),
        *_force(v, p["A"], at.phi + math.pi / 2, "P₅", (-12, -6)),
        v.arc(p["A"], 0.8, -2.6, -0.6),
        v.text(p["A"], "P₆", 22, 26),
        *_force(v, p["B"], at.coupler, "P₇", (14, -6)),
        *_force(v, p["B"], at.psi, "P₈", (0, -12)),
        label((230, 395), "P₁ to P₈ in the directions of the element coordinates", 13),
    ]
    return sheet(470, 420, "Case 2: system forces", *parts)


def _at_path_point(v: View, at: Point) -> list[str]:
    """P1 to P3."""
    forces = *_force(v, at, 0.0, "P₁", (24, 0)), *_force(v, at, math.pi / 2, "P₂", (0, -12))
    return [*forces, v.arc(at, 0.8, -2.4, -0.4), v.text(at, "P₃", 14, 30)]


def _force(v: View, at: Point, angle: float, text: str, shift: Point) -> list[str]:
    end = polar(at, 1.7, angle)
    return [v.arrow(polar(at, 0.45, angle), end, ACCENT), v.text(end, text, *shift)]


def _along(v: View, start: Point, end: Point, angle: float, text: str, dx: float, across: bool = False) -> list[str]:
    """Arrows of an element's coordinates beside its middle, the name on the other side."""
    half = middle(start, end)
    base = polar(half, 0.4, angle + math.pi / 2)
    more = [v.arrow(base, polar(base, 1.1, angle + math.pi / 2), ACCENT)] if across else []
    named = polar(half, 0.75, angle - math.pi / 2)
    return [v.arrow(base, polar(base, 1.3, angle), ACCENT), *more, v.text(named, text, dx, 0)]
