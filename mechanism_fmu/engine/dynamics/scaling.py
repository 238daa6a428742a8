"""How large a mechanism is, and how fast: the scales are written when the motion begins, the present rate at events.

A mechanism whose masses are 4^k times those of another, or whose lengths are 4^k and whose times 2^k times, moves as
the other one does, to the last digit: nothing here rounds powers of two.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.method import METHOD
from ...tables.motion import Course, LinearSystem, Loads, Rows, Stages
from ...tables.parts import Bodies, Contacts, Outlines
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.kinematics import place_bodies
from ..constraints.rows import active_rows
from ..profiles.curves import curve, sample
from ..scales import rate_scale
from ..vectors import clear
from .forces import apply_forces, set_time
from .islands import leader_of
from .own_states import winding_rate

_LAST = METHOD.last
#: What has scale 1 [m, 1/s, kg]: the ratchet of the paper, to the last digit, so that its steps are those of the
#: paper's model; the numbers of `tolerances` are for its size.
LENGTH, RATE, _MASS = 0.1, 0.9578262852211513, 3.2794799999999995
#: This part of the distance from the origin is a length at least: the noise of a gap is then 10 times its rounding.
_FAR = 2.0**-12
#: A row that acts so near to the middle of a body, in parts of its radius of gyration, acts there: that arm is no size.
_IN_MIDDLE = 2.0**-17
#: From one event to the next, what acts is taken to fall to this part at most: what is left at rest is rounding.
_FALLS = 2.0**-10
#: What moves so many times more slowly than the scale of rates says has a slower one.
_FAR_MORE_SLOWLY = 32.0
#: A rate below this is none: the fifth power of its time is no number.
_NOTHING = 2.0**-200


@jit
def note_sizes(block: Array) -> None:
    """Write the scales of length and mass, from the bodies' start, and from the arms of the rows that are active.

    The length of a body is the largest of its radius of gyration, of its arms, of the radius of its outlines and
    profiles, and of a part of how far it is away. Of what is pinned in its middle the inertia counts in place of the
    mass.
    """
    keep_apart()
    _note_arms(block)
    inverse = Bodies(block).inverse_mass
    own = Course(block).body_scales
    arms = Loads(block).body_length
    widest = Loads(block).body_rate
    clear(widest)
    for b in range(Sizes(block).bodies):
        leader = leader_of(LinearSystem(block), b)
        widest[leader] = max(widest[leader], arms[b])
    mass = length = 0.0
    for b in range(Sizes(block).bodies):
        k = 3 * b
        far = max(abs(Course(block).y_end[k]), abs(Course(block).y_end[k + 1]))
        gyration = math.sqrt(inverse[k] / inverse[k + 2])
        arm = arms[b] if arms[b] > 0.0 else widest[leader_of(LinearSystem(block), b)]
        if arm > 0.0:
            gyration = min(gyration, max(arm, far))  # the inertia of what shall not turn is no size
        long = max(gyration, arms[b], _FAR * far)
        turns_only = own[b, codes.ISLAND_RATE] > 1.0
        mass = max(mass, 1.0 / (inverse[k + 2] * long * long) if turns_only else 1.0 / inverse[k])
        own[b, codes.BODY_LENGTH] = long / LENGTH
        own[b, codes.ISLAND_LENGTH] = own[b, codes.ISLAND_RATE] = 0.0
        length = max(length, own[b, codes.BODY_LENGTH])
    clear(arms)
    clear(widest)
    for b in range(Sizes(block).bodies):
        join_scales(block, leader_of(LinearSystem(block), b), b)
    for b in range(Sizes(block).bodies):
        take_scales(block, leader_of(LinearSystem(block), b), b)
    scales = Course(block).scales
    scales[codes.SCALE_LENGTH] = length
    scales[codes.SCALE_MASS] = mass / _MASS
    scales[codes.SCALE_RATE] = 0.0
    scales[codes.SCALE_PRESENT] = 0.0


@jit
def _note_arms(block: Array) -> None:
    """Let `loads.body_length` be the largest arm of each body's rows, points and shapes; and join bodies by rows.

    And the bodies' scale of rates, until it is one, the number of rows that hold their middle on the ground.
    """
    n = Sizes(block).coordinates
    arms = Loads(block).body_length
    clear(arms)
    leader = LinearSystem(block).leader
    own = Course(block).body_scales
    inverse = Bodies(block).inverse_mass
    for b in range(Sizes(block).bodies):
        leader[b] = b
        own[b, codes.ISLAND_RATE] = 0.0
    for r in range(active_rows(block, place_bodies(block, Course(block).y_end))):
        entry = Rows(block).jacobian[r]
        i, j = Rows(block).body[r, 0], Rows(block).body[r, 1]
        for b in (i, j):
            across = math.sqrt(entry[3 * b] * entry[3 * b] + entry[3 * b + 1] * entry[3 * b + 1])
            if 3 * b < n and across > 0.0:
                arm = abs(entry[3 * b + 2]) / across
                if arm * arm * inverse[3 * b + 2] > _IN_MIDDLE * _IN_MIDDLE * inverse[3 * b]:
                    arms[b] = max(arms[b], arm)
                elif 3 * (i + j - b) >= n:
                    own[b, codes.ISLAND_RATE] += 1.0
        if 3 * i < n and 3 * j < n:
            one, other = leader_of(LinearSystem(block), i), leader_of(LinearSystem(block), j)
            leader[max(one, other)] = min(one, other)
    table = Contacts(block)
    for c in range(Sizes(block).contacts):
        for outline, b in ((table.outline_i[c], table.body_i[c]), (table.outline_j[c], table.body_j[c])):
            if outline != codes.NONE and 3 * b < n:
                arms[b] = max(arms[b], Outlines(block).data[outline, codes.OUTLINE_RADIUS])
        for profile, b in ((table.curve_i[c], table.body_i[c]), (table.curve_j[c], table.body_j[c])):
            if profile != codes.NONE and 3 * b < n:
                arms[b] = max(arms[b], curve(block, profile, sample(block, profile, 0, 1))[0])
        if table.kind[c] == codes.POINT_LINE:
            for point, b in ((table.data[c], table.body_i[c]), (table.line[c], table.body_j[c])):
                if 3 * b < n:
                    arms[b] = max(arms[b], math.sqrt(point[0] * point[0] + point[1] * point[1]))


@jit
def join_scales(block: Array, leader: int, body: int) -> None:
    """Let what a body has by itself count for all bodies behind this leader: in `body_rate` and `body_length`."""
    load = Loads(block)
    own = Course(block).body_scales[body]
    load.body_rate[leader] = max(load.body_rate[leader], max(load.body_rate[body], _FALLS * own[codes.ISLAND_RATE]))
    load.body_length[leader] = max(load.body_length[leader], own[codes.BODY_LENGTH])


@jit
def take_scales(block: Array, leader: int, body: int) -> None:
    """Let a body have the scales that have been joined behind this leader."""
    Course(block).body_scales[body, codes.ISLAND_LENGTH] = Loads(block).body_length[leader]
    Course(block).body_scales[body, codes.ISLAND_RATE] = Loads(block).body_rate[leader]


@jit
def note_rate(block: Array, least: float) -> None:
    """Write the scale of the present rate from what acts and moves at y_end, and that of all rates, where none is yet.

    It is `least` [1/s] or more, and that of a motor's winding where that is faster by orders. What nothing acts on and
    nothing moves in goes by 1/s, until something does. The rate of each body by itself becomes `loads.body_rate`.
    """
    keep_apart()
    rate = max(_note_body_rates(block), _in_scale(least))
    winding = winding_rate(block) / RATE
    if rate < _FALLS * winding:
        rate = winding
    _raise_rate(block, rate)
    scales = Course(block).scales
    scales[codes.SCALE_PRESENT] = max(rate, _FALLS * scales[codes.SCALE_PRESENT])


@jit
def moving_rate(block: Array) -> float:
    """The scale of rates, or less where the mechanism moves far more slowly by now: so it is where forces hold others.

    By the rates and accelerations at both ends of the step last tried.
    """
    s = Stages(block)
    most = max(_squared_rate(block, s.y_start, s.derivatives[0]), _squared_rate(block, s.y_new, s.derivatives[_LAST]))
    rate = rate_scale(block)
    return min(rate, max(_FAR_MORE_SLOWLY / RATE * math.sqrt(most), _FALLS * rate))


@jit
def _squared_rate(block: Array, y: Array, dy: Array) -> float:
    """The largest of speeds over lengths, squared, of accelerations over lengths, and the same of angles [1/s2]."""
    n = Sizes(block).coordinates
    own = Course(block).body_scales
    most = 0.0
    for k in range(0, n, 3):
        length = LENGTH * own[k // 3, codes.ISLAND_LENGTH]
        speed = max(max(abs(y[n + k]), abs(y[n + k + 1])) / length, abs(y[n + k + 2]))
        pull = max(max(abs(dy[n + k]), abs(dy[n + k + 1])) / length, abs(dy[n + k + 2]))
        most = max(most, max(speed * speed, pull))
    return most


@jit
def note_slopes(block: Array) -> None:
    """Raise the scale of rates where what acts at the end of the inputs' slopes is faster by orders."""
    set_time(block, Course(block).clock[codes.RAMP_END])
    _raise_rate(block, _note_body_rates(block))


@jit
def _raise_rate(block: Array, rate: float) -> None:
    """Let this be the scale of rates where that is still smaller by orders, or none."""
    scales = Course(block).scales
    if scales[codes.SCALE_RATE] < _FALLS * rate:
        scales[codes.SCALE_RATE] = rate


@jit
def _note_body_rates(block: Array) -> float:
    """Let `loads.body_rate` be the rate of what acts on each body and moves at y_end, by inputs of now; the largest."""
    keep_small()
    y = Course(block).y_end
    n = Sizes(block).coordinates
    apply_forces(block, place_bodies(block, y), y, Stages(block).dy_at)
    inverse = Bodies(block).inverse_mass
    size = Loads(block).size
    rates = Loads(block).body_rate
    clear(Loads(block).body_length)
    largest = 0.0
    for k in range(0, n, 3):
        length = LENGTH * Course(block).body_scales[k // 3, codes.ISLAND_LENGTH]
        moves = max(max(abs(y[n + k]), abs(y[n + k + 1])) / length, abs(y[n + k + 2]))
        acts = max(size[k], size[k + 1]) * inverse[k] / length
        acts = max(acts, size[k + 2] / (1.0 / inverse[k + 2] + length * length / inverse[k]))
        rates[k // 3] = _in_scale(max(moves, math.sqrt(acts)))
        largest = max(largest, rates[k // 3])
    return largest


@jit
def _in_scale(rate: float) -> float:
    """Rate in scale; 0 of what is no number, as no step comes of that either, or so small that powers overflow."""
    scaled = rate / RATE
    return scaled if _NOTHING < scaled < math.inf else 0.0
