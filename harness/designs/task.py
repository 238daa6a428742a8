"""Simulation of one design: experiment, recorded quantities, and the result or failure."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd

from mechanism_fmu.stress import STEEL_CARD, MaterialCard

from ..analysis.impacts import ImpactCollector
from ..analysis.stress import DAMAGE_UNITS, STRESS_UNITS, beam_of, damage_of_impacts, with_stress
from ..fmu.declared import NO_BEAM, Struck
from ..fmu.description import Description, Value, Variable, hint_at, not_in_step_mode
from ..run.inputs import InputSignals
from ..run.master import TimeGrid
from ..toml_file import Section

# What is done with every design, and what comes of one.

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
        events: whether results name the events.
    """

    grid: TimeGrid
    fixed: Mapping[str, Value]
    inputs: InputSignals | None
    quantities: tuple[Quantity, ...]
    material: MaterialCard = STEEL_CARD
    events: bool = False


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
        way: by which it ran (`workers.Backend.name`).
        values: of the task's quantities, in their order; None where there is none (no impact), or the design failed.
        failure: why it failed; None when it did not.
        warnings: what the FMU said besides; None when it said nothing.
        events: names of the events in their order, where the task asks for them and the FMU names them; else None.
    """

    number: int
    way: str
    values: tuple[Value | None, ...]
    failure: str | None = None
    warnings: str | None = None
    events: tuple[str, ...] | None = None

    @classmethod
    def failed(cls, design: Design, way: str, task: Task, why: str) -> Result:
        """The result of a design of which there is nothing but the reason."""
        return cls(design.number, way, (None,) * len(task.quantities), why)


# The quantities that a file asks for.

_NUMBERS = ("Real", "Integer", "Boolean")


class UnknownQuantityError(ValueError):
    """A quantity that cannot be had; the message says which can."""


def recorded(section: Section, description: Description) -> list[Quantity]:
    """The quantities of the table [record]: for each `When` a list of names."""
    found = []
    for when in When:
        for name in section.texts(when):
            try:
                found.append(quantity(when, name, description))
            except UnknownQuantityError as error:
                section.wrong(when, str(error))
    section.done()
    return found


def with_slenderness(quantities: Sequence[Quantity], description: Description) -> tuple[Quantity, ...]:
    """The quantities, and where stresses are among them the slenderness of the beam, if the FMU has it.

    It says of each design how far beam theory, and so its stress, may be trusted.
    """
    struck = description.analysis.struck
    known = None if struck is None else description.variables.get(struck.slenderness)
    if known is None or not any(asks_for_stress(one) for one in quantities):
        return tuple(quantities)
    slenderness = Quantity(When.PARAMETER, known.name, known.type, known.unit, known.display_unit)
    return tuple(dict.fromkeys([*quantities, slenderness]))


def asks_for_stress(quantity: Quantity) -> bool:
    """Whether a quantity is about what impacts do to a beam."""
    return quantity.when is When.ALL_IMPACTS or (quantity.when.of_impacts and quantity.name in STRESS_UNITS)


def quantity(when: When, name: str, description: Description) -> Quantity:
    """The quantity with this name.

    Raises:
        UnknownQuantityError: there is none.
    """
    variables = _variables(when, description)
    if name in variables:
        variable = variables[name]
        return Quantity(when, name, variable.type, variable.unit, variable.display_unit)
    raise UnknownQuantityError(_objection(when, name, description, variables))


def every_quantity(when: When, description: Description) -> list[Quantity]:
    """All that can be had at this time."""
    return [
        Quantity(when, variable.name, variable.type, variable.unit, variable.display_unit)
        for variable in _variables(when, description).values()
    ]


def column(text: str, description: Description) -> Quantity:
    """The quantity of a column, as "largest_impact.stress_max".

    Raises:
        UnknownQuantityError: there is none.
    """
    when, _, name = text.partition(".")
    if when not in list(When) or not name:
        raise UnknownQuantityError(
            f"'{text}' is no quantity; write when and what, as in \"end.wheel_angle\"; "
            f"when is one of {', '.join(When)}.{hint_at(when, list(When))}"
        )
    return quantity(When(when), name, description)


def _variables(when: When, description: Description) -> Mapping[str, Variable]:
    """What can be had at this time, by name."""
    if when.of_impacts:
        fields = ImpactCollector(description).fields
        if when is When.ALL_IMPACTS:
            return _stresses(description, fields, DAMAGE_UNITS)
        return {**fields, **_stresses(description, fields, STRESS_UNITS)}
    causalities = ("parameter", "calculatedParameter") if when is When.PARAMETER else ("input", "output")
    return {variable.name: variable for variable in description.of(*causalities) if variable.type in _NUMBERS}


def _stresses(
    description: Description, fields: Mapping[str, Variable], units: Mapping[str, str]
) -> dict[str, Variable]:
    """What impacts do to a beam, if the FMU declares one and reports the jump that makes it ring."""
    struck = description.analysis.struck
    if struck is None or struck.jump not in fields:
        return {}
    return {
        name: Variable(name, reference=-1, type="Real", causality="local", unit="" if unit == "1" else unit)
        for name, unit in units.items()
    }


def _objection(when: When, name: str, description: Description, variables: Mapping[str, Variable]) -> str:
    if when.of_impacts:
        if not ImpactCollector(description).fields:
            return f"{description.model} reports no impacts, so there is no '{name}' of one."
        if name in (DAMAGE_UNITS if when is When.ALL_IMPACTS else STRESS_UNITS) or not variables:
            return f"{description.model} gives no '{name}': {description.analysis.objection or NO_BEAM}"
        return f"an impact has no '{name}'.{_way_out(name, variables)}"
    if name in description.variables:
        variable = description.variable(name)
        if variable.in_event_mode_only:
            return f"{not_in_step_mode(variable)}.{hint_at(name, variables)}"
        why = "a text" if variable.type in ("String", "Binary") else f"a variable of causality {variable.causality}"
        others = [w for w in When if name in _variables(w, description)]
        hint = f" Write it at {' or '.join(others)}." if others else ""
        return f"'{name}' is {why}, which cannot be had {when.meaning()}.{hint}"
    known = "parameter" if when is When.PARAMETER else "input or output"
    return f"{description.model} has no {known} '{name}'.{_way_out(name, variables)}"


def _way_out(name: str, variables: Mapping[str, Variable]) -> str:
    plain = [known for known in variables if "[" not in known]
    return hint_at(name, variables) or f" There are: {', '.join(plain)}."


# What a task asks of the impacts of one design, whichever way it ran.

#: What makes an impact the largest, the first of them that there is.
_SIZES = ("stress_max", "velocity", "closing_speed", "impulse")

#: The impacts of one design: a column for each field, by name, of one length.
Impacts = Mapping[str, npt.NDArray[Any]]


def wants_stress(task: Task) -> bool:
    """Whether the task asks for what impacts do to a beam."""
    return any(asks_for_stress(quantity) for quantity in task.quantities)


def struck_in(task: Task, description: Description) -> Struck | None:
    """What impacts strike, if the task asks for what they do to it."""
    return description.analysis.struck if wants_stress(task) else None


def of_impacts(
    task: Task, impacts: Impacts, struck: Struck | None, values: Mapping[str, Value]
) -> dict[str, Value | None]:
    """What is asked of the impacts, by column; None where there was no impact, or no stress as the body was held.

    Args:
        task: of the design.
        impacts: a column for each field, as of `ImpactCollector.table`, with a value for each impact.
        struck: what impacts strike, if the FMU declares it and the task `wants_stress`.
        values: of its variables.

    Raises:
        FmuError: the FMU reports a beam that cannot be.
    """
    wanted = [quantity for quantity in task.quantities if quantity.when.of_impacts]
    if all(len(column) == 0 for column in impacts.values()):
        return {quantity.column: None for quantity in wanted}
    damage = None
    if struck is not None:
        beam = beam_of(struck, values)
        table = pd.DataFrame(impacts)
        if any(quantity.when is When.ALL_IMPACTS for quantity in wanted):
            damage = damage_of_impacts(table, struck, beam, task.material)
        impacts = columns_of(with_stress(table, struck, beam, task.material.material))
    rows = {When.FIRST_IMPACT: 0, When.LARGEST_IMPACT: _largest(impacts)}
    return {
        quantity.column: float(getattr(damage, quantity.name))
        if quantity.when is When.ALL_IMPACTS
        else _number(impacts[quantity.name][rows[quantity.when]].item())
        for quantity in wanted
    }


def columns_of(table: pd.DataFrame) -> Impacts:
    """The columns of a table of impacts, by name."""
    return {str(name): column.to_numpy() for name, column in table.items()}


def _number(value: Value) -> Value | None:
    """None for the stress of an impact in which the body is held."""
    return None if isinstance(value, float) and math.isnan(value) else value


def _largest(impacts: Impacts) -> int:
    """Where the largest impact stands; of equal ones the first."""
    for name in _SIZES:
        if name in impacts:
            sizes = np.abs(impacts[name].astype(np.float64))
            if not np.isnan(sizes).all():
                return int(np.nanargmax(sizes))
    return 0
