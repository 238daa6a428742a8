"""Ports of a mechanism: parameters, inputs and outputs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from .errors import MechanismError
from .functions import Number
from .quantities import quantity

#: The FMI type of a variable.
VariableType = Literal["Real", "Integer", "Boolean"]


#: Least and greatest value that people try.
Range = tuple[float, float]


class _OfTexts:
    """A port whose start value, limits and usual range may be texts with units, which become numbers."""

    name: str
    unit: str
    start: float
    minimum: float | None
    maximum: float | None
    usual: Range | None

    def __post_init__(self) -> None:
        """Make numbers of the texts, and refuse a usual range that is none."""
        for what in ("start", "minimum", "maximum"):
            value = getattr(self, what)
            if isinstance(value, str):
                object.__setattr__(self, what, quantity(value, self.unit, f"{self.name}: {what}"))
        if self.usual is not None:
            object.__setattr__(self, "usual", self._range(self.usual))

    def _range(self, usual: Range) -> Range:
        ends = tuple(usual) if isinstance(usual, tuple | list) else ()
        low, high = ends if len(ends) == 2 else (None, None)
        low, high = (quantity(end, self.unit, f"{self.name}: usual") for end in (low, high))
        if not isinstance(low, int | float) or not isinstance(high, int | float):
            text = f"{self.name}: usual = {usual!r}, but it must be two numbers (low, high), e.g. (0.0, 2.0)."
            raise MechanismError(text)
        unit = "" if self.unit == "1" else f" {self.unit}"
        said = f"{self.name}: its usual range is {low:g} to {high:g}{unit}"
        least = -math.inf if self.minimum is None else self.minimum
        most = math.inf if self.maximum is None else self.maximum
        if not -math.inf < low < high < math.inf:
            raise MechanismError(f"{said}; give two finite numbers, the lower one first.")
        if not least <= low < high <= most:
            raise MechanismError(f"{said}, beyond the limits {least:g} to {most:g}{unit}; give a part of them.")
        if not low <= self.start <= high:
            raise MechanismError(f"{said}, without the start value {self.start:g}{unit}; give one that holds it.")
        return float(low), float(high)


@dataclass(frozen=True)
class Parameter(_OfTexts):
    """A number that is fixed before initialization.

    Attributes:
        name: FMI name.
        start: default value, in `unit`; it and the limits may be texts with another unit of the kind, "200 mm".
        unit: SI unit, e.g. "m", "rad", "kg.m2", "1".
        minimum, maximum: inclusive limits, in `unit`; a value outside is refused.
        type: FMI type.
        description: one line for the user.
        display_unit: e.g. "deg"; None for the SI unit itself.
        usual: least and greatest value that people try, in `unit`: the range of a page's slider, no limit of validity.
            It lies within the limits and holds the start; None for a guess.

    Raises:
        MechanismError: a text is no number with a unit of this kind, or the usual range is none.
    """

    name: str
    start: float
    description: str
    unit: str = "1"
    minimum: float | None = None
    maximum: float | None = None
    type: VariableType = "Real"
    display_unit: str | None = None
    usual: Range | None = None


@dataclass(frozen=True)
class Input(_OfTexts):
    """A number that the outside may change at every communication point; it is held in between.

    Attributes:
        name: FMI name.
        target: the table entry it writes, "<force>.<column>", e.g. "drive.torque" or "spring.preload".
        start, unit, minimum, maximum, display_unit, description: as of `Parameter`.
        factor, offset: the entry gets factor * value + offset, in SI units; the factor is not 0.
        usual: as of `Parameter`.
    """

    name: str
    target: str
    start: float
    description: str
    unit: str = "1"
    minimum: float | None = None
    maximum: float | None = None
    display_unit: str | None = None
    factor: float = 1.0
    offset: float = 0.0
    usual: Range | None = None


@dataclass(frozen=True)
class Output:
    """A number that the outside may read.

    Attributes:
        name: FMI name.
        source: what it reads. "<body>.x|y|angle" and "<body>.x_rate|y_rate|speed"; "<contact>.force" (multiplier,
            positive when it pushes), "<contact>.gap" and "<contact>.closed"; of joints with play
            "<joint>.eccentricity|contact_angle|sliding_work|wear_volume"; "<stop>.clicks" and "<stop>.latched" [rad]
            of a stop with memory; "<pair of profiles>.alpha_i|alpha_j" [rad]; "<joint>.force|force_x|force_y|
            normal_force|torque" of the joints that have them (see `efforts`); "<pattern>.index"; "<shaft>.torque";
            of elastic members
            "<member>.start|end.x|y|x_bent|y_bent|x_deflection|y_deflection|rotation|deviation",
            "<member>.axial_force|start_moment|end_moment|stress" (see `structure`) and
            "<member>.tip_deflection|bending_stress" (see `beams`);
            "event.count|in_step"; "events[k].<field>" of
            the k-th event of the last communication step, with field one of time, guard and subject (codes;
            -1 in an empty slot), old_mode, new_mode (sum of 2^c over closed contacts c), impulse;
            "energy.kinetic|spring|work|lost";
            "impact.count|in_step|lost|any|by_poisson"; "impact.<field>" of the last impact and "impacts[k].<field>" of
            the k-th of the last communication step, with field one of time, contact, tooth, closing_speed, impulse,
            "impulse:<contact>", and, shared by all impacts of one instant: instant (a counter from 1), velocity (v_I of
            the body with teeth [m/s]), energy_lost [J], "speed_before:<body>", "speed:<body>" (after). The largest k
            says how many impacts, or events, of a step are kept (the last ones), up to 1000, and at
            least 8 impacts and 16 events.
        description: one line for the user.
        unit, display_unit, type: as of `Parameter`.
        nominal: typical magnitude in `unit`, or None.
        feedthrough: names of the inputs on which the value depends at the same instant.
    """

    name: str
    source: str
    description: str
    unit: str = "1"
    display_unit: str | None = None
    type: VariableType = "Real"
    nominal: float | None = None
    feedthrough: tuple[str, ...] = ()


@dataclass(frozen=True)
class Calculated:
    """A number that follows from the parameters alone (FMI: calculatedParameter).

    Attributes:
        name: FMI name.
        value: in `unit`.
        description, unit, display_unit: as of `Parameter`.
    """

    name: str
    value: Number
    description: str
    unit: str = "1"
    display_unit: str | None = None
