"""The order in which bodies are eliminated from the equations of motion, so that few entries arise."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from heapq import heapify, heappop, heappush


def elimination_order(bodies: Sequence[int], pairs: Iterable[tuple[int, int]]) -> list[int]:
    """The place of each body in the order of minimum degree: next comes one with the fewest neighbours, ties as given.

    Eliminating a body makes all its neighbours neighbours of each other.

    Args:
        bodies: their numbers, 0 ... ; any other number is the ground.
        pairs: bodies that a joint or contact connects.

    Returns:
        A place for each body, 0 ... .

    Source: Tinney, Walker, Proc. IEEE 55 (1967) 1801, scheme 2.
    """
    near: dict[int, set[int]] = {body: set() for body in bodies}
    for first, second in pairs:
        if first in near and second in near and first != second:
            near[first].add(second)
            near[second].add(first)
    waiting = [(len(others), body) for body, others in near.items()]
    heapify(waiting)
    places: dict[int, int] = {}
    while waiting:
        degree, body = heappop(waiting)
        if body in places or degree != len(near[body]):
            continue  # it has another degree meanwhile, with which it waits, too
        places[body] = len(places)
        around = near.pop(body)
        for other in around:
            near[other] |= around
            near[other] -= {body, other}
            heappush(waiting, (len(near[other]), other))
    return [places[body] for body in bodies]
