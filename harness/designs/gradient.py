"""Derivatives of quantities of a design by its variables, along one order of events."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from mechanism_fmu.differences import Sample, slopes

from ..errors import UsageError
from ..fmu.description import Description, Value, Variable
from .task import Quantity, Result, When, every_quantity

Array = npt.NDArray[np.float64]

#: From values of designs, by name, to their results, in the order of the designs.
Running = Callable[[Sequence[Mapping[str, Value]]], Sequence[Result]]

#: Variables of the integration: what they change is its error.
_OF_INTEGRATION = ("baumgarte_alpha", "baumgarte_beta", "relative_tolerance")
#: What steps of a variable are shares of where that is 0, in its unit, and of one without a unit [1].
_OF_ZERO, _OF_NO_UNIT = 1e-2, 1.0


class NoDerivativesError(UsageError):
    """A design has none, because it fails or has not the quantity."""


@dataclass(frozen=True)
class Gradient:
    """Derivatives of some quantities by some variables.

    Attributes:
        quantities: whose they are.
        names: of the variables.
        values: of the variables, shape (variables,) [their units].
        middle: the quantities there, shape (quantities,) [their units].
        matrix: d quantity / d variable, shape (quantities, variables) [their units]; not a number where there is none.
        errors: estimated from the extrapolation, the same shape.
        changes: of each variable, why there is none, or "".
        within: of each variable, how little it was moved at last [its unit].
    """

    quantities: tuple[Quantity, ...]
    names: tuple[str, ...]
    values: Array
    middle: Array
    matrix: Array
    errors: Array
    changes: tuple[str, ...]
    within: Array

    @property
    def relative(self) -> Array:
        """Change of a quantity over itself for one of a variable over itself [1], shape (quantities, variables)."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(self.matrix * self.values[None, :] / self.middle[:, None])


@dataclass(frozen=True)
class Free:
    """A variable that is moved.

    Attributes:
        name: of the variable.
        value: where, in its unit.
        low, high: its limits.
        scale: what steps are shares of.
    """

    name: str
    value: float
    low: float
    high: float
    scale: float

    @classmethod
    def of(cls, variable: Variable, value: float) -> Free:
        """The variable of an FMU.

        Args:
            variable: it is.
            value: where, in its unit.
        """
        low = -np.inf if variable.minimum is None else float(variable.minimum)
        high = np.inf if variable.maximum is None else float(variable.maximum)
        of_zero = _OF_NO_UNIT if variable.unit in ("", "1") else _OF_ZERO
        return cls(variable.name, value, low, high, abs(value) or of_zero)


def smooth(description: Description) -> list[Variable]:
    """The parameters and inputs by which there may be derivatives: Real ones, not those of the integration."""
    return [
        variable
        for variable in description.of("input", "parameter")
        if variable.type == "Real" and variable.name not in _OF_INTEGRATION
    ]


def events_of(quantities: Sequence[Quantity], description: Description) -> tuple[Quantity, ...]:
    """What tells whether two designs have the same events: all that is counted or switched, of the end and of impacts.

    Args:
        quantities: that are asked for.
        description: of the FMU.
    """
    times = dict.fromkeys([When.END, *(one.when for one in quantities if one.when.of_impacts)])
    return tuple(
        one for when in times for one in every_quantity(when, description) if one.type != "Real" and "[" not in one.name
    )


def gradient(
    quantities: Sequence[Quantity],
    recorded: Sequence[Quantity],
    free: Sequence[Free],
    fixed: Mapping[str, Value],
    run: Running,
    levels: int = 6,
) -> Gradient:
    """Derivatives of quantities by variables, by differences of designs with the same events.

    Args:
        quantities: whose derivatives are asked for, Real ones.
        recorded: all that results hold, in their order; those that are not Real tell which events there were.
        free: the variables.
        fixed: values of others, by name.
        run: runs designs.
        levels: how many steps are extrapolated.

    Raises:
        NoDerivativesError: the design itself fails, or has no such quantity, or an infinite one.
    """
    x = np.array([one.value for one in free])

    def design(point: Array) -> dict[str, Value]:
        return {**fixed, **{one.name: float(value) for one, value in zip(free, point, strict=True)}}

    (here,) = run([design(x)])
    if here.failure is not None:
        raise NoDerivativesError(f"The design has no derivatives, because it fails: {here.failure}")
    places = [recorded.index(one) for one in quantities]
    middle = _numbers(here, places)
    if middle is None:
        raise NoDerivativesError(f"The design has {_missing(here, recorded, places)}, and so no derivative of it.")

    def sample(points: Sequence[Array]) -> list[Sample]:
        results = run(list(map(design, points)))
        return [Sample(_numbers(result, places), _change(here, result, recorded, places)) for result in results]

    low, high = (np.array([getattr(one, name) for one in free]) for name in ("low", "high"))
    found = slopes(sample, middle, x, np.array([one.scale for one in free]), low=low, high=high, levels=levels)
    names = tuple(one.name for one in free)
    return Gradient(tuple(quantities), names, x, middle, found.matrix, found.errors, found.changes, found.within)


def _numbers(result: Result, places: Sequence[int]) -> Array | None:
    values = [result.values[place] for place in places]
    numbers = np.array([math.nan if value is None else float(value) for value in values])
    return numbers if np.isfinite(numbers).all() else None


def _missing(result: Result, recorded: Sequence[Quantity], places: Sequence[int]) -> str:
    """What of some quantities a design has not, in words; "" where it has all."""
    for place in places:
        value, name = result.values[place], recorded[place].column
        if value is None:
            return f"no {name}, as where there is no impact"
        if not math.isfinite(float(value)):
            return f"a {name} that is not finite ({value})"
    return ""


def _other_event(here: Sequence[str], beside: Sequence[str]) -> str:
    """The first event that is another, in words."""
    place = next((k for k, (a, b) in enumerate(zip(here, beside, strict=False)) if a != b), min(len(here), len(beside)))
    one, other = (events[place] if place < len(events) else "the end" for events in (here, beside))
    return f"{one} comes next, but beside it {other}"


def _change(here: Result, beside: Result, recorded: Sequence[Quantity], places: Sequence[int]) -> str:
    """In which count, switch or contact a design beside differs, or what it has not, in words; "" if in nothing."""
    if beside.failure is not None:
        return f"on one side it fails: {beside.failure}"
    if here.events is not None and beside.events is not None and here.events != beside.events:
        return _other_event(here.events, beside.events)
    for one, value, other in zip(recorded, here.values, beside.values, strict=True):
        if one.type != "Real" and value != other:
            return f"{one.column} is {value}, but beside it {other}"
    missing = _missing(beside, recorded, places)
    return missing and f"beside it there is {missing}"
