"""An optimum's objective and constraints as smooth functions of where its Real variables lie between their limits."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ..fmu.description import Value
from .gradient import Free, Gradient, NoDerivativesError, Running, gradient
from .optimum_file import Constraint, Optimum
from .task import Result
from .variation import Axis

Array = npt.NDArray[np.float64]

#: How many steps a derivative is extrapolated from: one would do to go downhill, the second says how good it is.
_LEVELS = 2
#: Constraints are kept by this part of their limit, so that rounding does not miss them.
_KEPT_BY = 1e-9
#: A design that misses a constraint on a count is worse than any near it, over the objective at the beginning.
_WORSE = 1e3


class NoGradientError(Exception):
    """The events of designs change however near they are to each other, or a design fails."""


class Landscape:
    """Objective and constraints, over fractions in [0, 1] of the way between the limits of each Real variable.

    Whatever is not Real stays as it is in the design from which the way begins.
    """

    def __init__(self, optimum: Optimum, real: Sequence[Axis], start: Mapping[str, Value], run: Running) -> None:
        """Look at the design at the beginning; `run` runs designs."""
        self._optimum, self._real, self._start, self._run = optimum, real, start, run
        self._low: Array = np.array([axis.real(axis.low) for axis in real])
        self._high: Array = np.array([axis.real(axis.high) for axis in real])
        self._places = {one: place for place, one in enumerate(optimum.task.quantities)}
        self._last: tuple[bytes, Result] | None = None  # objective and each constraint ask for the same one
        goal = optimum.goal
        self._smooth = [one for one in goal.quantities if one.type == "Real"]
        self._sign = -1.0 if goal.largest else 1.0
        fractions = np.array([axis.fraction(float(start[axis.name])) for axis in real])
        self._size = abs(self._value(self._result(fractions), goal.objective)) or 1.0
        self._known: tuple[bytes, Gradient] | None = None

    def objective(self, fractions: Array) -> float:
        """The objective over its size at the beginning, less where more is wanted."""
        result = self._result(fractions)
        worse = 0.0
        for constraint in self._optimum.goal.constraints:
            if constraint.quantity.type != "Real":
                worse += _WORSE * (constraint.violation(self._value(result, constraint.quantity)) > 0.0)
        return self._sign * self._value(result, self._optimum.goal.objective) / self._size + worse

    def objective_slopes(self, fractions: Array) -> Array:
        """Its derivatives, shape (variables,)."""
        found: Array = self._slopes(fractions, self._optimum.goal.objective)
        return np.asarray(self._sign * found / self._size)

    def constraints(self) -> list[dict[str, Any]]:
        """Those on Real quantities, as scipy wants them: not negative where they are kept."""
        return [
            {"type": "ineq", "fun": value, "jac": derivative}
            for constraint in self._optimum.goal.constraints
            if constraint.quantity.type == "Real"
            for value, derivative in self._limits(constraint)
        ]

    def _limits(self, constraint: Constraint) -> list[tuple[Callable[[Array], float], Callable[[Array], Array]]]:
        quantity = constraint.quantity

        def side(limit: float, sign: float) -> tuple[Callable[[Array], float], Callable[[Array], Array]]:
            size = abs(limit) or 1.0
            return (
                lambda x: sign * (self._value(self._result(x), quantity) - limit) / size - _KEPT_BY,
                lambda x: sign * self._slopes(x, quantity) / size,
            )

        found = [] if constraint.at_least is None else [side(constraint.at_least, 1.0)]
        return found + ([] if constraint.at_most is None else [side(constraint.at_most, -1.0)])

    def _values(self, fractions: Array) -> Array:
        inside: Array = self._low + np.clip(fractions, 0.0, 1.0) * (self._high - self._low)
        return np.minimum(np.maximum(inside, self._low), self._high)

    def _result(self, fractions: Array) -> Result:
        key = fractions.tobytes()
        if self._last is None or self._last[0] != key:
            values = self._values(fractions)
            moved = {axis.name: float(value) for axis, value in zip(self._real, values, strict=True)}
            (result,) = self._run([{**self._start, **moved}])
            self._last = key, result
        return self._last[1]

    def _value(self, result: Result, quantity: Any) -> float:
        value = result.values[self._places[quantity]]
        if value is None or not math.isfinite(float(value)):
            raise NoGradientError
        return float(value)

    def _slopes(self, fractions: Array, quantity: Any) -> Array:
        """Derivatives of a quantity by the fractions, shape (variables,)."""
        key = fractions.tobytes()
        if self._known is None or self._known[0] != key:
            self._known = key, self._gradient(fractions)
        matrix: Array = self._known[1].matrix
        return np.asarray(matrix[self._smooth.index(quantity)] * (self._high - self._low))

    def _gradient(self, fractions: Array) -> Gradient:
        free = [
            Free(axis.name, float(value), float(low), float(high), float(high - low))
            for axis, value, low, high in zip(self._real, self._values(fractions), self._low, self._high, strict=True)
        ]
        try:
            found = gradient(self._smooth, self._optimum.task.quantities, free, self._start, self._run, _LEVELS)
        except NoDerivativesError:
            raise NoGradientError from None
        if any(found.changes):
            raise NoGradientError
        return found
