"""What is done with every design, and what comes of one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from mechanism_fmu.stress import STEEL_CARD, MaterialCard

from ..clock import TimeGrid
from ..description import Value
from ..inputs import InputSignals

#: More than these nobody waits for, and no table shows.
MOST_DESIGNS = 1_000_000


class When(StrEnum):
    """At which time of a run a quantity is taken."""

    END = "end"
    MAX = "max"
    MIN = "min"
    FIRST_IMPACT = "first_impact"
    LARGEST_IMPACT = "largest_impact"
    ALL_IMPACTS = "all_impacts"
    PARAMETER = "parameter"

    @property
    def of_impacts(self) -> bool:
        """Whether it is about impacts."""
        return self in (When.FIRST_IMPACT, When.LARGEST_IMPACT, When.ALL_IMPACTS)

    def meaning(self, struck: str = "beam") -> str:
        """In words; `struck` is what impacts strike."""
        return _MEANINGS[self].format(struck=struck)


_MEANINGS = {
    When.END: "at the end of the run",
    When.MAX: "the largest at all communication points",
    When.MIN: "the smallest at all communication points",
    When.FIRST_IMPACT: "of the first impact",
    When.LARGEST_IMPACT: "of the impact that leaves the largest stress (without a {struck}: the fastest)",
    When.ALL_IMPACTS: "of all impacts together, on a {struck} that still rings from those before",
    When.PARAMETER: "after the initialization",
}


@dataclass(frozen=True)
class Quantity:
    """One number that is kept of a run.

    Attributes:
        when: it is taken.
        name: of a variable, of a field of the impacts, or of a stress.
        type: "Real", "Integer" or "Boolean".
        unit: "" when it has none.
        display_unit: in which charts show it, "" for `unit`.
    """

    when: When
    name: str
    type: str
    unit: str
    display_unit: str = ""

    @property
    def column(self) -> str:
        """Its name in results, in objectives and constraints."""
        return f"{self.when}.{self.name}"


@dataclass(frozen=True)
class Task:
    """What is done with every design.

    Attributes:
        grid: communication points.
        fixed: start values that all designs share, in the units of the variables.
        inputs: signals that drive inputs; None leaves them at their start values.
        quantities: what is kept.
        material: of the beam that impacts strike.
    """

    grid: TimeGrid
    fixed: Mapping[str, Value]
    inputs: InputSignals | None
    quantities: tuple[Quantity, ...]
    material: MaterialCard = STEEL_CARD


@dataclass(frozen=True)
class Design:
    """One of many.

    Attributes:
        number: its place in the list, from 1; with the definition of the list, its identity.
        values: of what is varied, in the units of the variables.
    """

    number: int
    values: Mapping[str, Value]


@dataclass(frozen=True)
class Result:
    """What came of a design.

    Attributes:
        number: of the design.
        way: by which it ran (`ways.Way.name`).
        values: of the task's quantities, in their order; None where there is none (no impact), or the design failed.
        failure: why it failed; None when it did not.
        warnings: what the FMU said besides; None when it said nothing.
    """

    number: int
    way: str
    values: tuple[Value | None, ...]
    failure: str | None = None
    warnings: str | None = None

    @classmethod
    def failed(cls, design: Design, way: str, task: Task, why: str) -> Result:
        """The result of a design of which there is nothing but the reason."""
        return cls(design.number, way, (None,) * len(task.quantities), why)
