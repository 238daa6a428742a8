"""In which order connections are passed on."""

from __future__ import annotations

from collections.abc import Sequence

from ...description import Description
from ..connection import Link
from ..order import dependency_order


def in_order(links: Sequence[Link], machine: Description) -> list[Link]:
    """Links such that each comes behind those that its source follows at once; loops without delay stay as they are."""
    by_target = {link.target: link for link in links}
    edges = [(target, link.target) for link in links for target in by_target if _follows(link.source, target, machine)]
    order, _ = dependency_order(list(by_target), edges)
    return [by_target[target] for target in order]


def _follows(output: str, entry: str, machine: Description) -> bool:
    """Whether an output follows an input at once."""
    (part, _, _), (other, _, name) = output.partition("."), entry.partition(".")
    depends_on = machine.variables[output].depends_on
    return part == other and (depends_on is None or name in depends_on)
