"""The order in which bodies are eliminated from the equations of motion, so that few entries arise."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


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
    places = dict.fromkeys(bodies, 0)
    left = set(bodies)
    for place in range(len(bodies)):
        body = min(left, key=lambda b: (len(near[b]), b))
        left.remove(body)
        places[body] = place
        around = near.pop(body)
        for other in around:
            near[other] = (near[other] | around) - {body, other}
    return [places[body] for body in bodies]
