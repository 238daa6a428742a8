"""What makes a design better than another."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ..assignments import parse_value
from ..description import Description, Variable
from ..errors import UsageError
from ..toml_file import TomlFile, is_number
from ..toml_values import as_text
from .quantities import UnknownQuantityError, column
from .task import Quantity, Result, Task

#: Merits of designs that miss a limit lie between this and twice this; of those that give no number, above.
_MISSED = 1e4
#: Merits of designs that keep all limits are not larger: asinh of the largest number is 710.
_LARGEST = 1e3


@dataclass(frozen=True)
class Constraint:
    """A limit of a quantity.

    Attributes:
        quantity: that is limited.
        at_least, at_most: in its unit; None where there is none.
    """

    quantity: Quantity
    at_least: float | None
    at_most: float | None

    def violation(self, value: float) -> float:
        """By how much a value misses, as a part of the limit (in its unit, where the limit is 0); 0 if it does not."""
        below = 0.0 if self.at_least is None else (self.at_least - value) / (abs(self.at_least) or 1.0)
        above = 0.0 if self.at_most is None else (value - self.at_most) / (abs(self.at_most) or 1.0)
        return max(below, above, 0.0)


@dataclass(frozen=True)
class Goal:
    """What is sought.

    Attributes:
        objective: what is to be small or large.
        largest: whether it is to be large.
        constraints: what has to hold.
    """

    objective: Quantity
    largest: bool
    constraints: tuple[Constraint, ...]

    @property
    def quantities(self) -> list[Quantity]:
        """All that it looks at, each once."""
        return list(dict.fromkeys([self.objective, *(constraint.quantity for constraint in self.constraints)]))

    def value(self, result: Result, task: Task) -> float | None:
        """The objective; None where there is none."""
        return _values(result, task).get(self.objective.column)

    def violation(self, result: Result, task: Task) -> float | None:
        """The sum of what misses; None when something cannot be said, because there is no number."""
        values = _values(result, task)
        if any(quantity.column not in values for quantity in self.quantities):
            return None
        return sum(constraint.violation(values[constraint.quantity.column]) for constraint in self.constraints)

    def merit(self, result: Result, task: Task) -> float:
        """A number that is the smaller, the better; only comparisons of merits mean anything.

        First come designs that keep all limits, by their objective; then those that miss some, by how much; and last
        those that failed (K. Deb, Comput. Methods Appl. Mech. Eng. 186 (2000)).
        """
        violation, value = self.violation(result, task), self.value(result, task)
        if violation is None or value is None:
            return 4.0 * _MISSED
        if violation > 0.0:
            return _MISSED * (2.0 - 1.0 / (1.0 + violation))
        # lives reach 1e70, and safety factors infinity: asinh keeps their order, far below what misses
        return min(max(math.asinh(-value if self.largest else value), -_LARGEST), _LARGEST)


def _values(result: Result, task: Task) -> dict[str, float]:
    pairs = zip(task.quantities, result.values, strict=True)
    return {
        quantity.column: float(value) for quantity, value in pairs if value is not None and not math.isnan(float(value))
    }


def read_goal(file: TomlFile, description: Description) -> Goal | None:
    """What [optimise] says of the objective, and the tables [constraint.COLUMN]; None where they are wrong."""
    section = file.section("optimise", needed=False)
    smallest, largest = section.text("minimise"), section.text("maximise")
    objective = None
    if (smallest is None) == (largest is None):
        section.wrong("minimise", 'either minimise or maximise must be given, as in minimise = "end.wheel_angle"')
    else:
        name = "minimise" if largest is None else "maximise"
        objective = _quantity(file, ("optimise", name), smallest or largest or "", description)
    constraints = [_constraint(file, name, description) for name in file.section("constraint", needed=False).table]
    if objective is None or None in constraints:
        return None
    return Goal(objective, largest is not None, tuple(c for c in constraints if c is not None))


def _constraint(file: TomlFile, name: str, description: Description) -> Constraint | None:
    section = file.section("constraint", name)
    limits = {key: section.take(key) for key in ("at_least", "at_most")}
    unit = section.text("unit")
    section.done()
    if all(limit is None for limit in limits.values()):
        section.wrong("at_least", "is missing; give at_least, at_most, or both")
    quantity = _quantity(file, section.key, name, description)
    if quantity is None:
        return None
    found = {
        key: _limit(file, (*section.key, key), given, unit, quantity, description) for key, given in limits.items()
    }
    least, most = limits["at_least"], limits["at_most"]
    if is_number(least) and is_number(most) and least > most:
        section.wrong("at_least", f"= {least} is above at_most = {most}; nothing can keep both")
    return Constraint(quantity, found["at_least"], found["at_most"])


def _limit(
    file: TomlFile, key: tuple[str, ...], given: object, unit: str | None, quantity: Quantity, description: Description
) -> float | None:
    if given is None:
        return None
    if isinstance(given, str | bool):
        file.wrong(key, f"is {as_text(given)}, but must be a number; its unit has a key of its own")
        return None
    try:
        variable = Variable(quantity.name, reference=-1, type="Real", causality="local", unit=quantity.unit)
        return float(parse_value(as_text(given) if unit is None else f"{as_text(given)} {unit}", variable, description))
    except UsageError as error:
        file.wrong(key, str(error))
        return None


def _quantity(file: TomlFile, key: tuple[str, ...], name: str, description: Description) -> Quantity | None:
    try:
        return column(name, description)
    except UnknownQuantityError as error:
        file.wrong(key, str(error))
        return None


def with_goal(recorded: Sequence[Quantity], goal: Goal) -> tuple[Quantity, ...]:
    """What is recorded, and what the goal looks at besides."""
    return tuple(dict.fromkeys([*goal.quantities, *recorded]))
