"""Design limits of a turn, the lightest design within them, flywheel, and joint friction."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ...errors import UsageError
from ...fmu.description import Description, Variable
from ...fmu.values import parse_value
from ...run.checks import Check
from .judged_by import JudgedBy

if TYPE_CHECKING:
    from .solution import Bent, Solution

#: More speeds than any curve shows.
_MOST_SPEEDS = 1000
#: A reference that no variable of an FMU has.
_NO_REFERENCE = -1


@dataclass(frozen=True)
class Limits:
    """What deviation and stress may be at most; None: anything.

    Attributes:
        deviation: of the path point from its rigid path [m].
        stress: in every member [Pa].
        judged_by: which solution must keep to them.
    """

    deviation: float | None = None
    stress: float | None = None
    judged_by: JudgedBy = JudgedBy.ELASTODYNAMIC

    def of(self, found: Solution) -> Bent:
        """The solution that must keep to them."""
        return found.static if self.judged_by is JudgedBy.QUASI_STATIC else found.dynamic

    def checks(self, found: Solution) -> tuple[Check, ...]:
        """Whether a turn keeps to those that there are."""
        bent, checks = self.of(found), []
        if self.deviation is not None:
            claim = f"The {self.judged_by} deviation stays within its limit"
            at = math.degrees(bent.largest_at)
            evidence = f"{1e3 * bent.largest_deviation:.5g} mm at {at:.2f} deg; limit {1e3 * self.deviation:g} mm"
            checks.append(Check(claim, bent.largest_deviation <= self.deviation, evidence))
        if self.stress is not None:
            claim = f"The {self.judged_by} stress stays within its limit in all members"
            worst = int(bent.largest_stress.argmax())
            stress = float(bent.largest_stress[worst])
            evidence = f"{1e-6 * stress:.5g} MPa in {found.members[worst]}; limit {1e-6 * self.stress:g} MPa"
            checks.append(Check(claim, stress <= self.stress, evidence))
        return tuple(checks)


@dataclass(frozen=True)
class Asked:
    """What is asked for.

    Attributes:
        limits: to be kept.
        synthesise: whether to look for the lightest design within them.
        vary: parameters and bounds as the user writes them, "NAME=LEAST..LARGEST"; the depths of the members if empty.
        fluctuation: coefficient of fluctuation that a flywheel is to keep to; None: no flywheel.
        friction: coefficient of friction of all joints; None: that of the mechanism.
        pin_radius: of all pins [m]; None: not given.
        speeds: of the crank at which the largest deviation is looked at [rad/s]; None: some around its own.
    """

    limits: Limits = field(default_factory=Limits)
    synthesise: bool = False
    vary: tuple[str, ...] = ()
    fluctuation: float | None = None
    friction: float | None = None
    pin_radius: float | None = None
    speeds: tuple[float, ...] | None = None


def asked(
    limit_deviation: str | None = None,
    limit_stress: str | None = None,
    judged_by: JudgedBy = JudgedBy.ELASTODYNAMIC,
    synthesise: bool = False,
    vary: Sequence[str] = (),
    fluctuation: float | None = None,
    friction: float | None = None,
    pin_radius: str | None = None,
    speeds: tuple[str, str, int] | None = None,
) -> Asked:
    """The options of the command line, understood.

    Raises:
        UsageError: one cannot be, or lacks another one.
    """
    limits = Limits(
        _positive("--limit-deviation", limit_deviation, "m", "1 mm"),
        _positive("--limit-stress", limit_stress, "Pa", "60 MPa"),
        judged_by,
    )
    if synthesise and (limits.deviation is None or limits.stress is None):
        lacks = [
            f"{option} '{example}'"
            for option, value, example in (
                ("--limit-deviation", limits.deviation, "1 mm"),
                ("--limit-stress", limits.stress, "60 MPa"),
            )
            if value is None
        ]
        raise UsageError(f"--synthesise looks for the lightest design within limits; add {' and '.join(lacks)}.")
    if vary and not synthesise:
        raise UsageError("--vary says what --synthesise may change; add --synthesise, or set the value with --set.")
    if fluctuation is not None and not 0.0 < fluctuation < 2.0:
        raise UsageError(
            f"--fluctuation {fluctuation:g} cannot be: it is (largest - least speed) / mean speed; give one above 0 "
            "and below 2, e.g. 0.02 for 2 %."
        )
    if friction is not None and not 0.0 <= friction < math.inf:
        raise UsageError(f"--friction {friction:g} cannot be; give a coefficient from 0 on, e.g. 0.1.")
    if pin_radius is not None and friction is None:
        raise UsageError("--pin-radius is where friction acts in pins; add its coefficient, e.g. --friction 0.1.")
    radius = _positive("--pin-radius", pin_radius, "m", "5 mm")
    return Asked(limits, synthesise, tuple(vary), fluctuation, friction, radius, _speeds(speeds))


def _speeds(asked_for: tuple[str, str, int] | None) -> tuple[float, ...] | None:
    """Even speeds from one to another [rad/s]."""
    if asked_for is None:
        return None
    *ends, count = asked_for
    unit = Description("", "", "", {})
    slowest, fastest = (quantity("--speeds", str(end), "rad/s", unit, "rpm") for end in ends)
    if not 0.0 < slowest < fastest < math.inf:
        raise UsageError(
            f"--speeds {' '.join(map(str, asked_for))}: give a positive speed, a larger one, and how many, "
            'e.g. "200 rpm" "800 rpm" 61.'
        )
    if not 2 <= count <= _MOST_SPEEDS:
        raise UsageError(f"--speeds: {count} of them cannot be; give 2 to {_MOST_SPEEDS}, both ends among them.")
    return tuple(np.linspace(slowest, fastest, count).tolist())


def quantity(name: str, text: str, unit: str, description: Description, display_unit: str = "") -> float:
    """A number with a unit, in `unit`; in that unit without one.

    Raises:
        UsageError: it is no number, or its unit is of another quantity.
    """
    variable = Variable(name, _NO_REFERENCE, "Real", "parameter", unit=unit, display_unit=display_unit)
    alone = Description(description.model, "", "", {name: variable}, description.units)
    return float(parse_value(text, variable, alone))


def _positive(option: str, text: str | None, unit: str, example: str) -> float | None:
    if text is None:
        return None
    value = quantity(option, text, unit, Description("", "", "", {}))
    if value <= 0.0:
        raise UsageError(f"{option} is {value:g} {unit}; give more than 0, e.g. '{example}'.")
    return value
