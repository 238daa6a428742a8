"""Which connected inputs follow each other at once: their order, and loops without any delay."""

from __future__ import annotations

from collections.abc import Sequence

from ..description import Description
from .connection import Link
from .names import own_of, part_of
from .order import dependency_order


def loops(links: Sequence[Link], machine: Description) -> list[list[str]]:
    """The connected inputs of each loop, named as in the machine.

    Args:
        links: the machine's connections.
        machine: description of its parts' variables; an output that tells no dependencies may follow any input.
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
