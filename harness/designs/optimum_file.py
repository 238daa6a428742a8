"""Optimisation file: variables, objective, limits (constraints) and method, checked as a whole."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..errors import UsageError
from ..fmu.description import Description, Variable
from ..fmu.values import parse_value
from ..toml_file import TomlFile, as_text, is_number
from .gradient import events_of
from .task import MOST_DESIGNS, Design, Quantity, Result, Task, UnknownQuantityError, column, recorded, with_slenderness
from .variation import Axis, axes, shared

# What makes a design better than another.

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
        """Violation of the constraint by a value, as a part of the limit (in its unit, where that is 0), or 0."""
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
        """Constraint violation: the sum over all constraints; None when there is no number for one of them."""
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
        # lives reach 1e70, and safety factors infinity: asinh keeps their order, far below a constraint violation
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


TABLES = ("title", "fmu", "run", "set", "optimise", "vary", "constraint", "sensitivity", "record")

#: By name; `search` has what they do.
CONTINUOUS, MIXED = "differential_evolution", "tpe"


@dataclass(frozen=True)
class Around:
    """How the neighbourhood of the optimum is looked at.

    Attributes:
        count: base points, a power of 2.
        width: of the neighbourhood, as a part of each variable's range.
    """

    count: int
    width: float

    def designs(self, variables: int) -> int:
        """How many designs it takes, for so many variables that have a neighbourhood."""
        return self.count * (variables + 2)


@dataclass(frozen=True)
class Optimum:
    """What a file asks for.

    Attributes:
        title: for people.
        task: what is done with each design.
        axes: what is free.
        goal: what is sought.
        method: `CONTINUOUS` or `MIXED`.
        count: designs that the search may run.
        seed: of whatever is random.
        gradient: whether what is found is refined along gradients.
        events: what is recorded besides to tell which designs have the same events.
        around: how the sensitivity of the optimum is found; None if it is not asked for.
    """

    title: str
    task: Task
    axes: tuple[Axis, ...]
    goal: Goal
    method: str
    count: int
    seed: int
    gradient: bool
    events: tuple[Quantity, ...]
    around: Around | None

    @property
    def total(self) -> int:
        """Designs at most."""
        return self.count + (0 if self.around is None else self.around.designs(len(near(self.axes))))

    @property
    def designs(self) -> tuple[Design, ...]:
        """Those that are known from the beginning: none."""
        return ()

    @property
    def how(self) -> tuple[str, Mapping[str, Any]]:
        """What besides the designs decides which designs there are, for the `identity`."""
        limits = {c.quantity.column: [c.at_least, c.at_most] for c in self.goal.constraints}
        around = None if self.around is None else [self.around.count, self.around.width]
        return "optimise", {
            "objective": self.goal.objective.column,
            "largest": self.goal.largest,
            "constraints": limits,
            "method": self.method,
            "count": self.count,
            "seed": self.seed,
            "sensitivity": around,
            **({"gradient": True} if self.gradient else {}),  # results of files without it stay what they are
        }


def near(free: tuple[Axis, ...]) -> list[Axis]:
    """The variables that have a neighbourhood: not those with a list of values."""
    return [axis for axis in free if axis.values is None]


def read_optimum(file: TomlFile, description: Description) -> Optimum:
    """The optimum of a file for an FMU.

    Raises:
        UsageError: mistakes in the file, all of them.
    """
    title, running, fixed = shared(file, TABLES, description, ("sweep", "a sweep"))
    section = file.section("optimise", why='write [optimise] and below it e.g. minimise = "largest_impact.stress_max"')
    for name in ("minimise", "maximise"):
        section.take(name)
    method = section.choice("method", (CONTINUOUS, MIXED))
    count = section.whole(
        "count", least=1, most=MOST_DESIGNS, needed="write how many designs may be run, as in count = 200"
    )
    seed = section.whole("seed", least=0)
    by_gradient = section.flag("gradient")
    section.done()
    goal = read_goal(file, description) if section.given else None
    free = tuple(axes(file, description, running.inputs, list(fixed), grid=False))
    smooth = all(axis.values is None and axis.variable.type == "Real" for axis in free)
    if method == CONTINUOUS and not smooth:
        section.wrong("method", f"'{CONTINUOUS}' is for Real variables with from and to; with others, take '{MIXED}'")
    if by_gradient and not any(axis.values is None and axis.variable.type == "Real" for axis in free):
        section.wrong("gradient", "is for Real variables with from and to, of which there is none")
    around = _around(file)
    if around is not None and len(near(free)) < 2:
        file.wrong(("sensitivity",), "compares variables with from and to, of which there must be two or more")
    quantities = recorded(file.section("record", needed=False), description)
    file.check()
    assert running.grid is not None  # otherwise there were mistakes
    assert goal is not None
    assert count is not None
    looked_at = with_slenderness(with_goal(quantities, goal), description)
    events = events_of(goal.quantities, description) if by_gradient else ()
    events = tuple(one for one in events if one not in looked_at)
    task = Task(running.grid, fixed, running.inputs, (*looked_at, *events), running.material)
    chosen = method or (CONTINUOUS if smooth else MIXED)
    return Optimum(title, task, free, goal, chosen, count, seed or 0, by_gradient, events, around)


def _around(file: TomlFile) -> Around | None:
    section = file.section("sensitivity", needed=False)
    count = section.whole("count", least=2, most=MOST_DESIGNS, needed="write a power of 2, as in count = 64")
    width = section.take("width")
    section.done()
    if count is not None and count & (count - 1):
        section.wrong("count", f"is {count}, but must be a power of 2, for which alone Sobol points are balanced")
    width = 0.1 if width is None else width
    if isinstance(width, bool) or not isinstance(width, int | float) or not 0.0 < width <= 1.0:
        section.wrong("width", f"is {width}, but must be a number above 0, up to 1: a part of each variable's range")
        return None
    return None if count is None else Around(count, float(width))
