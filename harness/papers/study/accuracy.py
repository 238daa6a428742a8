"""Accuracy of the paper's tooth, against finite elements and against its own first mode, as the paper states it.

Source of the claims: Pennestrì, Valentini, Vita, section 5.1.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from mechanism_fmu.stress import STEEL, maximum_stress, ritz_modes

from ...run.checks import Finding, Verdict, verdict_of
from .wheels import Wheel

# The paper's teeth by finite elements: harness/papers/study/plane_teeth.csv, made by `python -m
# benchmarks.plane_teeth`.

FILE = Path(__file__).with_name("plane_teeth.csv")

#: x / l where the stresses are compared: the paper's place of the maximum.
PLACE = 0.4


def _larger(stress: str) -> property:
    """The larger one of both flanks, of a stress [-]."""
    return property(lambda tooth: max(getattr(tooth, f"{stress}_{flank}") for flank in ("face", "slope")))


@dataclass(frozen=True)
class PlaneTooth:
    """A tooth as a plate (plane stress, Poisson's ratio 0.3) beside the paper's beam; all ratios [-].

    `wedge` is the paper's right-angled triangle as a plate, `tooth` the triangle of root, apex and next root.

    Attributes:
        tooth_count: nt.
        slope_angle_deg: beta_0 [deg].
        slenderness: l over the height of the wedge's root, 1 / tan(alpha).
        beam_to_wedge_frequency, beam_to_tooth_frequency: eq (15) over the plate's first frequency.
        static_wedge_face, static_wedge_slope, static_tooth_face, static_tooth_slope: stress along the flank at
            x / l = 0.4, plate over beam, under the inertia of an angular acceleration about the root.
        impact_wedge_face, impact_wedge_slope, impact_tooth_face, impact_tooth_slope: the same of the first mode alone,
            for one velocity v_I.
    """

    tooth_count: int
    slope_angle_deg: int
    slenderness: float
    beam_to_wedge_frequency: float
    beam_to_tooth_frequency: float
    static_wedge_face: float
    static_wedge_slope: float
    static_tooth_face: float
    static_tooth_slope: float
    impact_wedge_face: float
    impact_wedge_slope: float
    impact_tooth_face: float
    impact_tooth_slope: float

    @property
    def left_out(self) -> float:
        """How much lower the first frequency of the whole tooth lies than that of the wedge [-]."""
        return 1.0 - self.beam_to_wedge_frequency / self.beam_to_tooth_frequency

    static_wedge = _larger("static_wedge")
    static_tooth = _larger("static_tooth")
    impact_wedge = _larger("impact_wedge")
    impact_tooth = _larger("impact_tooth")


def plane_teeth() -> tuple[PlaneTooth, ...]:
    """The teeth of the paper's 20 wheels."""
    rows = pd.read_csv(FILE, comment="#").to_dict("records")
    return tuple(PlaneTooth(**{str(name): value for name, value in row.items()}) for row in rows)


#: Heading of these findings.
ACCURACY = "What the paper says of its accuracy"

#: What passes for a small error of a frequency or a stress: a choice of this project, for the paper gives no number;
#: row C-small of `reproduce` shows the verdicts by other limits.
SMALL = 0.15
#: And of a place along the tooth, x / l; "about 40 %" is met as well as that.
_SMALL_SHIFT = 0.02
#: Teeth of this shape are those of the finite elements.
_SAME_SHAPE = 1e-6


def accuracy_findings(wheels: Sequence[Wheel], small: float = SMALL) -> tuple[Finding, ...]:
    """The paper's claims about its wedge, its beam and its modes.

    The first two come from a file made by finite elements for the paper's teeth (harness/papers/study/plane_teeth.csv);
    they are left out when none of the wheels has such teeth.

    Args:
        wheels: of the study, one or more.
        small: what passes for a small error of a frequency or a stress, in parts of it.
    """
    teeth = [tooth for tooth in plane_teeth() if any(_alike(tooth, wheel) for wheel in wheels)]
    return (*((_wedge(teeth, small), _beam(teeth)) if teeth else ()), _second_mode(wheels[0], small))


def _alike(tooth: PlaneTooth, wheel: Wheel) -> bool:
    numbers = (tooth.tooth_count, tooth.slope_angle_deg) == (wheel.tooth_count, wheel.slope_angle_deg)
    return numbers and math.isclose(tooth.slenderness, wheel.slenderness, rel_tol=_SAME_SHAPE)


def _wedge(teeth: Sequence[PlaneTooth], small: float) -> Finding:
    frequency = [-tooth.left_out for tooth in teeth]
    static = [tooth.static_tooth / tooth.static_wedge - 1.0 for tooth in teeth]
    impact = [tooth.impact_tooth / tooth.impact_wedge - 1.0 for tooth in teeth]
    return Finding(
        'A right-angled triangle stands for the tooth "without accuracy loss": what it leaves out "can be regarded as '
        'rigid without introducing a great error"',
        verdict_of([_within(small, errors) for errors in (frequency, static, impact)]),
        f"finite elements (plane stress) of the teeth of {len(teeth)} wheels, whole tooth against wedge: first "
        f"frequency {_percent(frequency)}; stress at x/l = {PLACE:g} {_percent(static)} under a given load, "
        f"{_percent(impact)} after an impact (first mode); up to {small:.0%} counts as small",
    )


def _beam(teeth: Sequence[PlaneTooth]) -> Finding:
    stubby = sum(tooth.slenderness < 1.0 for tooth in teeth)
    most = max(teeth, key=lambda tooth: tooth.beam_to_tooth_frequency)
    return Finding(
        'What beam theory costs: the tooth "has been modelled as a cantilever beam", which "may not seem appropriate"',
        Verdict.TAKEN_OVER,
        f"eq (15) is {_range(tooth.beam_to_wedge_frequency for tooth in teeth)} times the first frequency of the same "
        f"wedge in plane stress, {_range(tooth.beam_to_tooth_frequency for tooth in teeth)} times that of the whole "
        f"tooth (most at nt = {most.tooth_count}, beta_0 = {most.slope_angle_deg} deg); stress at x/l = {PLACE:g}, "
        f"wedge in plane stress over beam: {_range(tooth.static_wedge for tooth in teeth)} under a given load, "
        f"{_range(tooth.impact_wedge for tooth in teeth)} after an impact (first mode); length over root height "
        f"{_range(tooth.slenderness for tooth in teeth)}, below 1 for {stubby} of {len(teeth)}",
    )


def _second_mode(wheel: Wheel, small: float) -> Finding:
    modes = ritz_modes(wheel.tooth, STEEL)
    one, two = (maximum_stress(wheel.tooth, STEEL, 1.0, modes[:number]) for number in (1, 2))
    more, shift = two.stress / one.stress - 1.0, two.position - one.position
    return Finding(
        'The second mode "has a little effect"',
        verdict_of([_within(small, [more]), abs(shift) <= _SMALL_SHIFT]),
        f"it changes sigma_max by {more:+.1%}, and moves its place from x/l = {one.position:.3f} to {two.position:.3f}"
        '; the paper says "about 40 %"',
    )


def _within(small: float, errors: Iterable[float]) -> bool:
    return all(abs(error) <= small for error in errors)


def _percent(changes: Sequence[float]) -> str:
    return f"{min(changes):+.1%} to {max(changes):+.1%}"


def _range(values: Iterable[float]) -> str:
    known = tuple(values)
    return f"{min(known):.2f} to {max(known):.2f}"
