"""Command: `python -m benchmarks.plane_teeth`, from the repository's root: writes harness/papers/study/plane_teeth.csv.

The paper's 20 teeth as plates of finite elements, whole and as the right-angled triangle that the paper makes of them,
beside its beam. It shows how far the meshes agree, and takes a minute. Needs scikit-fem (extra `test`).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import astuple, dataclass, fields

import numpy as np

from harness.papers.study.accuracy import FILE, PLACE, PlaneTooth
from harness.papers.study.wheels import SLOPE_ANGLES_DEG, TOOTH_COUNTS
from mechanism_fmu.stress import Material, ModeScaling, WedgeTooth, natural_modes, ritz_modes, wedge_of_sawtooth

from .plane_tooth import FloatArray, Plate, PlateSolution, solve, wedge_plate, whole_plate

#: As in `plane_tooth`; the damping plays no part.
_UNIT = Material(youngs_modulus=1.0, density=1.0, damping_ratio=0.03)
#: L over h, the paper's c_prop.
_SLOPE_RATIO = 1.115
#: Terms of the polynomials of the beam's first mode: converged.
_TERMS = 20

#: Of the meshes: two that show the convergence, and the one that counts.
REFINEMENTS = (0, 1, 2)
#: Places along the flanks that the command shows for one tooth.
_PROFILE = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8)

HEADER = """\
# The teeth of the paper's 20 wheels as plates of finite elements in plane stress, Poisson's ratio 0.3, clamped at the
# root, beside its beam. Ratios of equal teeth, so that they hold for every size, Young's modulus and density.
# Made by `python -m benchmarks.plane_teeth` (scikit-fem, triangles of degree 4, graded towards the root's corners).
# wedge: the paper's right-angled triangle. tooth: root, apex, next root, clamped on the chord between the roots.
# beam_to_*: first frequency by eq (15) over that of the plate.
# static_*, impact_*: stress along the flank at x/l = 0.4, plate over beam. static: body force ~ x across the tooth, of
# an angular acceleration about the root. impact: first mode alone, started by the velocity v_I x/l.
"""


@dataclass(frozen=True)
class Shape:
    """One tooth of a wheel with chord 1.

    Attributes:
        beam: the paper's wedge.
        wedge, tooth: as plates.
    """

    beam: WedgeTooth
    wedge: Plate
    tooth: Plate


def shape(tooth_count: int, slope_angle_deg: float) -> Shape:
    """The tooth of one of the paper's wheels."""
    pitch = 2 * math.pi / tooth_count
    chord_angle = math.radians(slope_angle_deg) - math.pi / 2 + pitch / 2
    beam = wedge_of_sawtooth(1.0, _SLOPE_RATIO, chord_angle, thickness=1.0)
    face = math.hypot(_SLOPE_RATIO - math.cos(chord_angle), math.sin(chord_angle))
    return Shape(beam, wedge_plate(beam), whole_plate(beam, face, _SLOPE_RATIO))


def beam_frequency(beam: WedgeTooth) -> float:
    """Eq (15), the first one, with E = rho = 1 [rad/s]."""
    return ritz_modes(beam, _UNIT)[0].natural_frequency


def beam_static(beam: WedgeTooth, places: Sequence[float]) -> FloatArray:
    """Outer fibre stress M / W of the wedge under the body force x / l: l (1 - (x/l)^2) / (2 tan(alpha)) [Pa].

    From M = b tan(alpha) times the integral of (l - s) (s / l) (s - x) over s from x to l, and the paper's
    W = b/6 (l - x)^2 tan(alpha)^2.
    """
    return np.asarray(0.5 * beam.length * (1.0 - np.square(places)) / math.tan(beam.apex_angle))


def beam_impact(beam: WedgeTooth, places: Sequence[float]) -> FloatArray:
    """Outer fibre stress of the first mode at its largest, undamped, after the velocity x / l [Pa]."""
    mode = natural_modes(beam, _UNIT, _TERMS, scaling=ModeScaling.PROJECTION)[0]
    xi = np.asarray(places, dtype=float)
    curvature = mode.shape(xi, 2) / beam.length**2 / mode.natural_frequency
    return np.abs(curvature) * 0.5 * beam.length * (1.0 - xi) * math.tan(beam.apex_angle)


def compare(tooth_count: int, slope_angle_deg: int, refinement: int = REFINEMENTS[-1]) -> PlaneTooth:
    """One row of the file."""
    of = shape(tooth_count, slope_angle_deg)
    wedge, tooth = (solve(plate, refinement, (PLACE,)) for plate in (of.wedge, of.tooth))
    frequency = beam_frequency(of.beam)
    static, impact = (function(of.beam, (PLACE,))[0] for function in (beam_static, beam_impact))
    return PlaneTooth(
        tooth_count,
        slope_angle_deg,
        1.0 / math.tan(of.beam.apex_angle),
        frequency / wedge.frequency,
        frequency / tooth.frequency,
        *(float(abs(value)) for plate in (wedge, tooth) for value in plate.static[:, 0] / static),
        *(float(abs(value)) for plate in (wedge, tooth) for value in plate.impact[:, 0] / impact),
    )


def file_text(teeth: Sequence[PlaneTooth]) -> str:
    """The file, with as many digits as the meshes agree in, and one more."""
    names = [field.name for field in fields(PlaneTooth)]
    lines = [
        f"{count},{angle},{slenderness:.8f},{wedge:.5f},{tooth:.5f}," + ",".join(f"{value:.4f}" for value in stresses)
        for count, angle, slenderness, wedge, tooth, *stresses in map(astuple, teeth)
    ]
    return HEADER + "\n".join([",".join(names), *lines]) + "\n"


def order(values: Sequence[float]) -> float:
    """Observed order of convergence of three meshes, each with elements half as long."""
    coarse, middle, fine = values
    return math.log2((middle - coarse) / (fine - middle))


def _convergence(tooth_count: int, slope_angle_deg: int) -> Iterator[str]:
    of = shape(tooth_count, slope_angle_deg)
    for name, plate in (("wedge", of.wedge), ("tooth", of.tooth)):
        found = [solve(plate, refinement, _PROFILE) for refinement in REFINEMENTS]
        ratios = [beam_frequency(of.beam) / solution.frequency for solution in found]
        unknowns = ", ".join(f"{solution.unknowns}" for solution in found)
        yield (
            f"nt = {tooth_count}, beta_0 = {slope_angle_deg} deg, {name}: {unknowns} unknowns, "
            f"beam/plate {', '.join(f'{ratio:.6f}' for ratio in ratios)}, order {order(ratios):.1f}"
        )
        yield from _profile(found, beam_static(of.beam, _PROFILE))


def _profile(found: Sequence[PlateSolution], beam: FloatArray) -> Iterator[str]:
    for flank, side in enumerate(("face", "slope")):
        for solution in found[1:]:
            values = ", ".join(f"{value:.4f}" for value in np.abs(solution.static[flank] / beam))
            yield f"    static stress, plate/beam at x/l = {_PROFILE[0]:g} ... {_PROFILE[-1]:g}, {side}: {values}"


def run() -> None:
    """Show the convergence of four teeth, and write the file."""
    for case in ((10, 85), (10, 90), (10, 105), (25, 95)):
        for line in _convergence(*case):
            print(line)
    teeth = [compare(*case) for case in itertools.product(TOOTH_COUNTS, SLOPE_ANGLES_DEG)]
    FILE.write_text(file_text(teeth), encoding="utf-8")
    print(f"Written to {FILE}")


if __name__ == "__main__":
    run()
