"""FMUs with numbers baked in: parameters and gains that other tools leave out (docs/decisions/029-baked-machines.md).

Parameters become start values. What a connection does to a signal, its gain and offset and the conversion of units,
is done by the FMU that gets it. FMUs of others stay as they are: a component of gains stands before them.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace

from mechanism_fmu.fmu.parts.fmi_units import UnitError, parse_unit as own_unit

from ...fmu.description import Description, Variable
from ..connection import Connection, Link, linked, own_of, part_of
from ..file.machine_plan import ComponentPlan, Plan, Source
from ..structure import structure_of

#: Of the component that does what FMUs of others cannot.
GAINS = "gains_of_connections"


@dataclass(frozen=True)
class Numbers:
    """What a component's FMU gets as its own.

    Attributes:
        starts: start values of parameters and free inputs, by name, in their units.
        inputs: factor, offset and unit of what an input is given; its own unit where that is None.
    """

    starts: Mapping[str, float] = field(default_factory=dict)
    inputs: Mapping[str, tuple[float, float, str | None]] = field(default_factory=dict)


@dataclass(frozen=True)
class Baking:
    """A machine for tools that apply neither parameters nor transformations.

    Attributes:
        plan: what is left for them to do; its components' own numbers, and bonds, are not in it.
        numbers: by component, of those whose FMU is copied.
        gains: what the component `GAINS` does, channel by channel; it is in the plan if there are any.
        notes: what they still leave out, or do otherwise.
    """

    plan: Plan
    numbers: Mapping[str, Numbers]
    gains: tuple[Link, ...]
    notes: tuple[str, ...]


def baking(plan: Plan, descriptions: Mapping[str, Description], own: Collection[str]) -> Baking:
    """What to put where.

    Args:
        plan: the machine.
        descriptions: of its components' FMUs.
        own: names of the components whose FMUs can be copied with other numbers.
    """
    machine = structure_of(descriptions).description
    inputs: dict[str, dict[str, tuple[float, float, str | None]]] = {name: {} for name in own}
    connections: list[Connection] = []
    gains: list[Link] = []
    notes: list[str] = []
    for connection in plan.connections:
        link = linked(connection, machine)
        part, name = part_of(link.target), own_of(link.target)
        source, target = machine.variables[link.source], machine.variables[link.target]
        plain = Connection(link.source, link.target, rate=connection.rate, convert=connection.convert)
        if (link.factor, link.offset) == (1.0, 0.0):
            connections.append(plain)
        elif part in own:
            inputs[part][name] = (link.factor, link.offset, _unit(source, target, machine))
            connections.append(plain)
        else:
            gains.append(link)
            channel = len(gains)
            connections.append(replace(plain, target=f"{GAINS}.in[{channel}]", rate=""))
            connections.append(Connection(f"{GAINS}.out[{channel}]", link.target))
            notes.append(
                f"{link.target} gets {link.factor:g} times {link.source}"
                f"{f' + {link.offset:g}' if link.offset else ''} from the component {GAINS}, because the FMU of {part} "
                "is not of this project: this delays the signal by one step."
            )
        if source.type != target.type:
            notes.append(f"{connection} converts {source.type} to {target.type}, which other tools may refuse.")
    numbers = {
        component.name: Numbers(
            {name: float(value) for name, value in component.values.items()}, inputs[component.name]
        )
        for component in plan.components
        if component.name in own and (component.values or inputs[component.name])
    }
    for component in plan.components:
        if component.values and component.name not in own:
            notes.append(
                f"The FMU of {component.name} is not of this project, so its parameters stay in a file beside it: "
                f"{', '.join(component.values)}. Tools that apply none need them to be set by hand."
            )
    components = [replace(c, values={}) if c.name in numbers else c for c in plan.components]
    if gains:
        components.append(ComponentPlan(GAINS, Source()))
    left = replace(plan, components=tuple(components), connections=tuple(connections), bonds=())
    return Baking(left, numbers, tuple(gains), tuple(notes))


def _unit(source: Variable, target: Variable, machine: Description) -> str | None:
    """The unit that the input of a copy has: that of what it is given, as far as this project knows it."""
    if not source.unit or source.unit == target.unit:
        return None
    meaning = machine.units.meaning(source.unit)
    try:
        known = own_unit(source.unit)
    except UnitError:
        return "1"
    if meaning is None or meaning.offset or (known.factor, known.exponents) != (meaning.factor, meaning.exponents):
        return "1"  # whatever it is: one without a unit is taken to have that of the other end
    return source.unit
