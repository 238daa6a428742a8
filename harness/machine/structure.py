"""Dependency graph of a machine: order of its components, cycles, and algebraic loops."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from ..errors import UsageError
from ..fmu.description import Description, Variable
from ..fmu.terminals import Terminal
from .connection import Connection, Link, linked, own_of, part_of, units_of_parts

# In which order parts depend on each other.


def dependency_order(nodes: Sequence[str], edges: Iterable[tuple[str, str]]) -> tuple[list[str], list[list[str]]]:
    """Nodes such that each comes behind those that it follows, but in cycles, and the cycles.

    By strongly connected components (R. Tarjan, SIAM J. Comput. 1 (1972)); within a cycle, and among nodes that do not
    depend on each other, the given order stays.

    Args:
        nodes: all of them.
        edges: pairs (from, to): `to` follows `from`.
    """
    pairs = set(edges)
    follows = {node: [other for other in nodes if (other, node) in pairs] for node in nodes}
    groups = _Groups(follows).found
    order = [node for group in groups for node in sorted(group, key=list(nodes).index)]
    cycles = [sorted(g, key=list(nodes).index) for g in groups if len(g) > 1 or (g[0], g[0]) in pairs]
    return order, cycles


class _Groups:
    """Strongly connected components; each comes behind those that it follows."""

    def __init__(self, follows: Mapping[str, Sequence[str]]) -> None:
        self.found: list[list[str]] = []
        self._follows = follows
        self._number: dict[str, int] = {}
        self._lowest: dict[str, int] = {}
        self._stack: list[str] = []
        for node in follows:
            if node not in self._number:
                self._visit(node)

    def _visit(self, node: str) -> None:
        self._number[node] = self._lowest[node] = len(self._number)
        self._stack.append(node)
        for other in self._follows[node]:
            if other not in self._number:
                self._visit(other)
                self._lowest[node] = min(self._lowest[node], self._lowest[other])
            elif other in self._stack:
                self._lowest[node] = min(self._lowest[node], self._number[other])
        if self._lowest[node] == self._number[node]:
            place = self._stack.index(node)
            self.found.append(self._stack[place:])
            del self._stack[place:]


# Which connected inputs follow each other at once: their order, and loops without any delay.


def loops(links: Sequence[Link], machine: Description) -> list[list[str]]:
    """The connected inputs of each loop, named as in the machine.

    Args:
        links: the machine's connections.
        machine: description of its parts' variables; an output that declares no dependencies may follow any input.
    """
    return _dependencies(links, machine)[1]


def in_order(links: Sequence[Link], machine: Description) -> list[Link]:
    """Links such that each comes behind those that its source follows at once; loops without delay stay as they are.

    Args:
        links: the machine's connections.
        machine: as for `loops`.
    """
    by_target = {link.target: link for link in links}
    return [by_target[target] for target in _dependencies(links, machine)[0]]


def _dependencies(links: Sequence[Link], machine: Description) -> tuple[list[str], list[list[str]]]:
    targets = [link.target for link in links]
    edges = [(before, link.target) for link in links for before in targets if _follows(link.source, before, machine)]
    return dependency_order(targets, edges)


def _follows(output: str, target: str, machine: Description) -> bool:
    known = machine.variables[output].depends_on
    return part_of(output) == part_of(target) and (known is None or own_of(target) in known)


@dataclass(frozen=True)
class Structure:
    """Of a machine, whether its components are there or not.

    Attributes:
        description: of it, as if it were one FMU; a connected input is an output, since nothing else may set it.
        links: its connections.
        order: names of its parts, each behind those that it follows.
        cycles: groups of parts that follow each other.
        loops: groups of connected inputs that follow each other without any delay (`loops`).
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
