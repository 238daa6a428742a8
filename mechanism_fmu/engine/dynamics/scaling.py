"""How large a mechanism is, and how fast: the scales are written when the motion begins, the present rate at events.

A mechanism whose masses are 4^k times those of another, or whose lengths are 4^k and whose times 2^k times, moves as
the other one does, to the last digit: nothing here rounds powers of two.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, Loads, Rows
from ...tables.parts import Bodies, Outlines
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart
from ..constraints.kinematics import place_bodies
from ..constraints.rows import active_rows
from .forces import apply_forces
from .own_states import winding_rate

#: What has scale 1 [m, 1/s, kg]: the ratchet of the paper, to the last digit, so that its steps are those of the
#: paper's model; the numbers of `tolerances` are for its size.
_LENGTH, _RATE, _MASS = 0.07634615877076063, 1.2190829483452197, 5.6264
#: This part of the distance from the origin is a length at least: the noise of a gap is then 10 times its rounding.
_FAR = 2.0**-12
#: A radius of gyration counts up to so many times all other lengths: the inertia of what shall not turn is no size.
_GYRATION = 64.0
#: From one event to the next, what acts is taken to fall to this part at most: what is left at rest is rounding.
_FALLS = 2.0**-10


@jit
def note_sizes(block: Array) -> None:
    """Write the scales of length and mass, from the bodies' start, and from the arms of the rows that are active."""
    keep_apart()
    inverse = Bodies(block).inverse_mass
    scales = Course(block).scales
    n = Sizes(block).coordinates
    mass = gyration = far = reach = 0.0
    for k in range(0, n, 3):
        mass = max(mass, 1.0 / inverse[k])
        gyration = max(gyration, math.sqrt(inverse[k] / inverse[k + 2]))
        far = max(far, abs(Course(block).y_end[k]), abs(Course(block).y_end[k + 1]))
    count = active_rows(block, place_bodies(block, Course(block).y_end))
    for r in range(count):
        for end in range(2):
            first = 3 * Rows(block).body[r, end]
            entry = Rows(block).jacobian[r]
            across = math.sqrt(entry[first] * entry[first] + entry[first + 1] * entry[first + 1])
            if first < n and across > 0.0:
                reach = max(reach, abs(entry[first + 2]) / across)
    for k in range(Sizes(block).outlines):
        reach = max(reach, Outlines(block).data[k, codes.OUTLINE_RADIUS])
    if reach > 0.0:
        gyration = min(gyration, _GYRATION * max(reach, far))
    scales[codes.SCALE_LENGTH] = max(gyration, reach, _FAR * far) / _LENGTH
    scales[codes.SCALE_MASS] = mass / _MASS
    scales[codes.SCALE_RATE] = 0.0
    scales[codes.SCALE_PRESENT] = 0.0


@jit
def note_rate(block: Array, least: float) -> None:
    """Write the scale of the present rate from what acts and moves at y_end, and that of all rates, where none is yet.

    It is `least` [1/s] or more. What nothing acts on and nothing moves in goes by 1/s, until something does.
    """
    keep_apart()
    scales = Course(block).scales
    y = Course(block).y_end
    n = Sizes(block).coordinates
    apply_forces(block, place_bodies(block, y), y, Course(block).dy_end)
    length = _LENGTH * scales[codes.SCALE_LENGTH]
    inverse = Bodies(block).inverse_mass
    size = Loads(block).size
    moves, acts = least, 0.0
    for k in range(0, n, 3):
        speed = max(abs(y[n + k]), abs(y[n + k + 1])) / length
        moves = max(moves, speed, abs(y[n + k + 2]))
        acts = max(acts, max(size[k], size[k + 1]) * inverse[k] / length)
        acts = max(acts, size[k + 2] / (1.0 / inverse[k + 2] + length * length / inverse[k]))
    rate = max(moves, math.sqrt(acts)) / _RATE
    if not rate < math.inf:  # of what is no number, no step comes either
        rate = 0.0
    if rate == 0.0:
        rate = winding_rate(block) / _RATE
    known = scales[codes.SCALE_PRESENT]
    if scales[codes.SCALE_RATE] == 0.0:
        scales[codes.SCALE_RATE] = rate
    scales[codes.SCALE_PRESENT] = max(rate, _FALLS * known)
