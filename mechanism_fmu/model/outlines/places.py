"""Count of the places at which two outlines can touch at once, from their shapes.

An outline falls into runs between the corners and arcs where it is hollow; two convex runs touch at one point or along
one line, which has two ends. Along the outlines of two bodies that touch, the places of one follow each other in the
order opposite to those of the other. So pairs of runs come in a sequence in which each step goes on along one of the
two: as many as both have together, or, where one outline is convex, as many as the other has.
"""

from __future__ import annotations

import math
from itertools import pairwise

from ..body import Point
from ..functions import Number, nominal
from .features import around
from .outline import Outline

#: Two convex runs that lie flat on each other touch at the two ends of what they have in common.
_ENDS = 2
#: No more are counted: where a body lies on a thousand teeth, each place would cost time and memory in every solution.
MOST_PLACES = 20
#: The way turns into a hollow by at least this angle, as for the engine (`outlines.features`) [rad].
_SMOOTH = 1e-9


def places_at_once(one: Outline, other: Outline, step: tuple[Number, Number, Number] | None, count: int) -> int:
    """The greatest number of places where two outlines touch at once, from 2 to `MOST_PLACES`.

    Numbers that follow from parameters count with the values at which these start.

    Args:
        one: outline i.
        other: outline j.
        step: from one copy of outline j to the next: an angle [rad], and lengths in x and y [m]; None: it has none.
        count: copies of outline j.
    """
    first, second = _plain(one), _plain(other)
    runs, others = _run_count(first, True), _run_count(second, step is None or second.closed)
    if step is not None:
        others *= min(count, _copies_within(first, second, tuple(nominal(x) for x in step)))
    pairs = runs + others if min(runs, others) > 1 else max(runs, others)
    places = pairs if _is_disc(first) or _is_disc(second) else _ENDS * pairs
    return min(max(places, _ENDS), MOST_PLACES)


def _plain(outline: Outline) -> Outline:
    vertices = tuple((nominal(x), nominal(y), nominal(bulge)) for x, y, bulge in outline.vertices)
    return Outline(vertices, closed=outline.closed, hole=outline.hole)


def _turns(outline: Outline) -> list[float]:
    """The angles by which the way turns where elements meet, to the left [rad]."""
    tangents = [element.tangents() for element in outline.elements]
    if outline.closed:
        tangents.append(tangents[0])
    return [_angle(before[1], behind[0]) for before, behind in pairwise(tangents)]


def _angle(a: Point, b: Point) -> float:
    return math.atan2(float(a[0] * b[1] - a[1] * b[0]), float(a[0] * b[0] + a[1] * b[1]))


def _run_count(outline: Outline, is_alone: bool) -> int:
    """The number of runs of an outline between places where it becomes hollow, or ceases to be so.

    One that turns by more than half a turn counts twice: a convex body may touch it near both of its ends, as of a comb
    the first tooth and the last.
    """
    turns, elements = _turns(outline), outline.elements
    hollow = [element.bulge < 0 for element in (*elements, elements[0])]
    ends = [
        turn < -_SMOOTH or before != behind for turn, (before, behind) in zip(turns, pairwise(hollow), strict=False)
    ]
    first = 0
    if outline.closed:
        if not any(ends):
            return 1
        first = ends.index(True) + 1
    bends = [float(elements[first % len(elements)].sweep)]  # of each run [rad]
    for k in range(first, first + len(elements) - 1):
        here, behind = k % len(elements), (k + 1) % len(elements)
        bend = float(elements[behind].sweep)
        if ends[here]:
            bends.append(bend)
        else:
            bends[-1] += turns[here] + bend
    return len(bends) + (sum(bend > math.pi for bend in bends) if is_alone else 0)


def _is_disc(outline: Outline) -> bool:
    """Return whether an outline has no side and no corner on which it could lie flat."""
    return all(element.bulge > 0 for element in outline.elements) and all(turn <= _SMOOTH for turn in _turns(outline))


def _copies_within(one: Outline, other: Outline, step: tuple[float, ...]) -> int:
    """The number of copies of an outline beside which another one may stand: of the pitches that its width covers."""
    angle, dx, dy = step
    x, y, _ = around(other)
    pitch = math.hypot(dx, dy) if angle == 0.0 else 2.0 * math.hypot(x, y) * abs(math.sin(0.5 * angle))
    width = 2.0 * float(around(one)[2])
    return _ENDS + (int(width / pitch) if pitch * MOST_PLACES > width else MOST_PLACES)
