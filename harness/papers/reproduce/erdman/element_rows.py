"""Erdman, Sandor and Oakberg, “Analysis of elastic systems”: eqs (1) to (9)."""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.linalg import block_diag

from mechanism_fmu.elastodynamics import (
    GearTooth,
    bent_coupler,
    cantilever,
    spatial_link,
    supported_beam,
    torsion_shaft,
    two_force_member,
)
from mechanism_fmu.elastodynamics.elements import FloatArray
from mechanism_fmu.model import Section

from ....run.checks import Verdict
from ..bench import Bench, each_off_by, off_by_scale
from ..row import Found, Row, judged, within

ELEMENTS = "mechanism_fmu/elastodynamics/elements.py"

#: A steel bar of 0.25 m, 6 mm by 12 mm, as an example; its A and E I from its sizes.
_L, _S, _E = 0.25, Section.rectangle(0.006, 0.012), 2.07e11
_AREA, _BENDING = 0.006 * 0.012, _E * 0.006 * 0.012**3 / 12


def _by_unit_loads(support: str, length: float = _L) -> FloatArray:
    """Bending flexibilities by virtual work: integrals of M m / EI, of unit loads."""
    moments = {
        "cantilever": (lambda x: length - x, lambda x: 1.0),
        "supported": (lambda x: 1.0 - x / length,),
    }[support]
    return np.array(
        [[quad(lambda x, m=m, n=n: m(x) * n(x) / _BENDING, 0, length)[0] for n in moments] for m in moments]
    )


def _cantilever(_bench: Bench) -> Found:
    found = cantilever(_L, _S, _E)
    return within(
        max(each_off_by(found[1:, 1:], _by_unit_loads("cantilever")), abs(found[0, 0] * _AREA * _E / _L - 1)),
        1e-12,
        "F of (2) = integrals of unit loads (virtual work), all four entries of bending",
        _numbers(found),
    )


def _numbers(matrix: FloatArray) -> str:
    rows = "; ".join(", ".join(f"{value:.4e}" for value in row) for row in np.atleast_2d(matrix))
    return f"steel bar of 250 mm, 6 × 12 mm: [{rows}] in m/N, rad/N, rad/(N m)"


def _eq1(_bench: Bench) -> Found:
    force = np.array([100.0, -20.0, 1.5])
    d = cantilever(_L, _S, _E) @ force

    def slope(x: float, y: FloatArray) -> list[float]:
        """Of u, v, theta along the beam."""
        return [force[0] / (_E * _AREA), y[2], (force[1] * (_L - x) + force[2]) / _BENDING]

    return within(
        each_off_by(d, solve_ivp(slope, (0.0, _L), np.zeros(3), "DOP853", rtol=1e-12, atol=1e-16).y[:, -1]),
        1e-9,
        f"100 N, −20 N, 1.5 N m make {1e6 * d[0]:.3f} µm, {1e3 * d[1]:.4f} mm, {1e3 * d[2]:.4f} mrad: F f = the "
        "elastic line integrated along the beam",
    )


def _two_force(_bench: Bench) -> Found:
    f = float(two_force_member(_L, _S, _E)[0, 0])
    return within(
        abs(f * _AREA * _E / _L - 1), 1e-13, f"l/AE = {f:.4e} m/N; 1 kN stretches it by {1e6 * 1e3 * f:.3f} µm"
    )


def _torsion(_bench: Bench) -> Found:
    polar = math.pi / 32 * 0.02**4
    f = float(torsion_shaft(_L, polar, 7.95e10)[0, 0])
    return within(
        abs(f * polar * 7.95e10 / _L - 1),
        1e-13,
        f"l/GJ = {f:.4e} rad/(N m) of a steel shaft of 20 mm; 10 N m twist it by {math.degrees(10 * f):.4f}°",
    )


def _supported(_bench: Bench) -> Found:
    found = supported_beam(_L, _S, _E)
    off = each_off_by(found[1, 1], _by_unit_loads("supported")[0, 0])
    return within(off, 1e-12, "l/3EI by a unit moment at one end; axial l/AE", _numbers(found))


def _spatial(_bench: Bench) -> Found:
    found = spatial_link(_L, _S, _E)
    return within(
        off_by_scale(found, np.diag([_L / (_E * _AREA), _by_unit_loads("cantilever")[0, 0]])),
        1e-12,
        "diag(l/AE, l³/3EI) = integrals of unit loads; an element only, there is no spatial mechanism here",
        _numbers(found),
    )


def _bent(_bench: Bench) -> Found:
    arm = 0.15
    found = bent_coupler(arm, _L, _S, _E)
    blocks = (arm / (_E * _AREA), _by_unit_loads("cantilever", arm), _L / (_E * _AREA), _by_unit_loads("supported"))
    return within(
        off_by_scale(found, block_diag(*blocks)),
        1e-12,
        "an arm of 150 mm as (2) and a bar of 250 mm as (7) along the diagonal of 5 × 5 = integrals of unit loads, "
        "part by part; the fixed angle is in B",
        f"l/AE, l³/3EI, l²/2EI, l/EI: {found[0, 0]:.4e}, {found[1, 1]:.4e}, {found[1, 2]:.4e}, {found[2, 2]:.4e}; "
        f"l/AE, l/3EI: {found[3, 3]:.4e}, {found[4, 4]:.4e}",
    )


def _gear_tooth(_bench: Bench) -> Found:
    """A tooth of even thickness: bending, and the rest of it is shear."""
    length, h, b, young, nu = 0.012, 0.012, 0.03, 2.07e11, 0.3
    across = float(GearTooth(length, h, h, b, young, nu).flexibility()[1, 1])
    bending = length**3 / (3 * young * b * h**3 / 12)
    shear = (across - bending) / (2 * (1 + nu) * length / (young * b * h))
    return judged(
        abs(shear - 1.2) < 0.05,
        f"even tooth of 12 × 12 × 30 mm: bending {1e9 * bending:.4f} nm/N and shear {shear:.3f} l/GA = "
        f"{1e9 * (across - bending):.4f} nm/N; formulas are this project's; compression at the contact is not compared",
        verdict=Verdict.HOLDS_IN_PART,
    )


ROWS = (
    Row("E-eq1", "eq (1)", "Deformations from forces.", "d = F f", (ELEMENTS,), _eq1),
    Row("E-eq2", "eq (2)", "Cantilever.", "l/AE, l³/3EI, l²/2EI, l/EI", (ELEMENTS,), _cantilever),
    Row("E-eq3", "eqs (3), (4)", "Two-force member.", "F = l/AE, d = F f", (ELEMENTS,), _two_force),
    Row("E-eq5", "eqs (5), (6)", "Torsion.", "F = l/GJ, d = F M", (ELEMENTS,), _torsion),
    Row("E-eq7", "eq (7)", "Beam on two supports with an end moment.", "diag(l/AE, l/3EI)", (ELEMENTS,), _supported),
    Row("E-eq8", "eqs (8), (9)", "Spatial revolute–spherical link.", "diag(l/AE, l³/3EI)", (ELEMENTS,), _spatial),
    Row("E-bent", "Fig. 3", "Coupler of two parts at a fixed angle.", "(2) and (7) together", (ELEMENTS,), _bent),
    Row(
        "E-tooth",
        "Analysis of elastic systems",
        "Gear teeth as cantilevers: compression, bending, shear.",
        "in words",
        ("mechanism_fmu/elastodynamics/gear_tooth.py",),
        _gear_tooth,
    ),
)
