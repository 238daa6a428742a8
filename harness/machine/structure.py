"""How the parts of a machine hang together, as far as their descriptions tell."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from ..description import Description, Variable
from ..errors import UsageError
from ..terminals import Terminal
from .connection import Connection, Link, linked
from .loops import loops
from .names import part_of
from .order import dependency_order
from .part_units import units_of_parts


@dataclass(frozen=True)
class Structure:
    """Of a machine, whether its components are there or not.

    Attributes:
        description: of it, as if it were one FMU; a connected input is an output, since nobody else may set it.
        links: its connections.
        order: names of its parts, each behind those that it follows.
        cycles: groups of parts that follow each other.
        loops: groups of connected inputs that follow each other without any delay (`loops.loops`).
    """

    description: Description
    links: Sequence[Link]
    order: Sequence[str]
    cycles: Sequence[Sequence[str]]
    loops: Sequence[Sequence[str]]

    @property
    def groups(self) -> list[tuple[str, ...]]:
        """The parts in their order, those of a cycle together."""
        together = {name: tuple(cycle) for cycle in self.cycles for name in cycle}
        return list(dict.fromkeys(together.get(name, (name,)) for name in self.order))


def structure_of(
    descriptions: Mapping[str, Description], connections: Sequence[Connection] = (), model: str = "Machine"
) -> Structure:
    """The structure of a machine.

    Args:
        descriptions: of its components, by the names of the parts.
        connections: between them.
        model: name of the machine.

    Raises:
        UsageError: a connection that cannot be; the message says which and why.
    """
    variables = {v.name: v for name, description in descriptions.items() for v in _variables(name, description)}
    units = units_of_parts({name: description.units for name, description in descriptions.items()})
    terminals = {t.name: t for name, description in descriptions.items() for t in _terminals(name, description)}
    whole = Description(model, model, "", variables, units, terminals=terminals)
    links = [linked(connection, whole) for connection in connections]
    for link in links:
        if variables[link.target].causality != "input":
            raise UsageError(f"{link.target} has two connections; an input can have only one.")
        variables[link.target] = replace(variables[link.target], causality="output")
    edges = [(part_of(link.source), part_of(link.target)) for link in links]
    order, cycles = dependency_order(list(descriptions), edges)
    return Structure(whole, links, order, cycles, loops([link for link in links if not link.ticks], whole))


def _terminals(part: str, description: Description) -> Iterator[Terminal]:
    for terminal in description.terminals.values():
        members = tuple(replace(member, variable=f"{part}.{member.variable}") for member in terminal.members)
        yield replace(terminal, name=f"{part}.{terminal.name}", members=members)


def _variables(part: str, description: Description) -> Iterator[Variable]:
    for variable in description.variables.values():
        clocks = tuple(f"{part}.{clock}" for clock in variable.clocks)
        yield replace(variable, name=f"{part}.{variable.name}", clocks=clocks)
