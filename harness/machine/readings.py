"""Reading variables of a machine that are numbers, component by component."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..description import Variable
from .component import Component, Reals
from .machine import Machine
from .names import own_of, part_of


@dataclass(frozen=True)
class Reading:
    """Signals of one component.

    Attributes:
        names: in the machine, in the order of what is read.
    """

    names: tuple[str, ...]
    component: Component
    reals: Reals | None
    others: tuple[str, ...]

    def read(self) -> list[float]:
        """What they are now."""
        values: list[float] = []
        if self.reals is not None:
            self.reals.read()
            values += self.reals.values
        if self.others:
            values += map(float, self.component.get(self.others))
        return values


def readings(machine: Machine, variables: Sequence[Variable]) -> list[Reading]:
    """What to read, and how: a reading for each part that has some of the variables, bound before the run."""
    groups = []
    for part in machine.parts:
        own = [variable for variable in variables if part_of(variable.name) == part]
        reals = [variable.name for variable in own if variable.type == "Real"]
        others = [variable.name for variable in own if variable.type != "Real"]
        if own:
            component = machine.parts[part].component
            bound = component.reals([own_of(name) for name in reals]) if reals else None
            groups.append(Reading((*reals, *others), component, bound, tuple(map(own_of, others))))
    return groups
