"""The file of an optimum, checked as a whole."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..description import Description
from ..toml_file import TomlFile
from .goal import Goal, read_goal, with_goal
from .plan import shared
from .quantities import recorded, with_slenderness
from .task import MOST_DESIGNS, Task
from .variation import Axis, axes

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
        around: how the sensitivity of the optimum is found; None if it is not asked for.
    """

    title: str
    task: Task
    axes: tuple[Axis, ...]
    goal: Goal
    method: str
    count: int
    seed: int
    around: Around | None

    @property
    def total(self) -> int:
        """Designs at most."""
        return self.count + (0 if self.around is None else self.around.designs(len(near(self.axes))))

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
        }


def near(free: tuple[Axis, ...]) -> list[Axis]:
    """The variables that have a neighbourhood: not those with a list of values."""
    return [axis for axis in free if axis.values is None]


def read_optimum(file: TomlFile, description: Description) -> Optimum:
    """The optimum of a file for an FMU.

    Raises:
        UsageError: mistakes in the file, all of them.
    """
    if "sweep" in file.data:
        file.wrong(("sweep",), f"belongs to a sweep: mechanism-fmu sweep {file.path}")
        file.check()
    title, running, fixed = shared(file, TABLES, description)
    section = file.section("optimise", why='write [optimise] and below it e.g. minimise = "largest_impact.stress_max"')
    for name in ("minimise", "maximise"):
        section.take(name)
    method = section.choice("method", (CONTINUOUS, MIXED))
    count = section.whole(
        "count", least=1, most=MOST_DESIGNS, needed="write how many designs may be run, as in count = 200"
    )
    seed = section.whole("seed", least=0)
    section.done()
    goal = read_goal(file, description) if section.given else None
    free = tuple(axes(file, description, running.inputs, list(fixed), grid=False))
    smooth = all(axis.values is None and axis.variable.type == "Real" for axis in free)
    if method == CONTINUOUS and not smooth:
        section.wrong("method", f"'{CONTINUOUS}' is for Real variables with from and to; with others, take '{MIXED}'")
    around = _around(file)
    if around is not None and len(near(free)) < 2:
        file.wrong(("sensitivity",), "compares variables with from and to, of which there must be two or more")
    quantities = recorded(file.section("record", needed=False), description)
    file.check()
    assert running.grid is not None  # otherwise there were mistakes
    assert goal is not None
    assert count is not None
    task = Task(
        running.grid,
        fixed,
        running.inputs,
        with_slenderness(with_goal(quantities, goal), description),
        running.material,
    )
    return Optimum(title, task, free, goal, method or (CONTINUOUS if smooth else MIXED), count, seed or 0, around)


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
