"""Loops without any delay: inputs that outputs follow at once, all the way round."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..description import Description
from .connection import Link
from .order import dependency_order


def loops(links: Sequence[Link], descriptions: Mapping[str, Description]) -> list[list[str]]:
    """The connected inputs of each loop, named as in the machine.

    Args:
        links: the machine's connections.
        descriptions: of its parts, by name; an output that tells no dependencies may follow any input.
    """
    targets = [link.target for link in links]
    edges = [
        (before, link.target) for link in links for before in targets if _follows(link.source, before, descriptions)
    ]
    _, cycles = dependency_order(targets, edges)
    return cycles


def _follows(output: str, target: str, descriptions: Mapping[str, Description]) -> bool:
    part, _, own = output.partition(".")
    other, _, name = target.partition(".")
    known = descriptions[part].variables[own].depends_on
    return part == other and (known is None or name in known)
