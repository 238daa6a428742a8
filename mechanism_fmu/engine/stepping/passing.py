"""Through a singular configuration along the smooth branch, where `Mechanism.through_singularities` says so.

Rows that depend on each other determine no acceleration, but where branches cross with different tangents, the motion
along one of them is smooth. So it is not integrated there: a polynomial through points of the motion before, with their
derivatives (Hermite), leads as far beyond the instant of dependence as the step has begun before it, where the rows are
as independent again, and is put right there. The points are those of the motion itself, found by true steps backward in
time; nothing is assumed of energy. A polynomial of fewer points estimates the error, by the tolerance of all steps;
where it is too large, the step ends nearer to that instant, and the next one tries again. A motion that is not smooth
there (a toggle position, where forces grow without limit) comes ever nearer without success, and is refused as without
the option.
"""

from __future__ import annotations

import math

from ... import codes
from ...tables.declare import Array
from ...tables.method import CUBIC_ROWS, METHOD
from ...tables.motion import BEHIND, Course, LinearSystem, Rubs, Stages
from ...tables.parts import Bodies, Contacts, Options
from ...tables.sizes import Sizes
from ..compiler.subset import jit, keep_small
from ..constraints.friction_rows import rubs
from ..dynamics.acceleration import close_rows, derivative
from ..dynamics.forces import set_time
from ..interpolation import interpolate
from ..profiles.curves import within_motions
from ..vectors import clear, copy
from .events import first_event
from .runge_kutta import ABSOLUTE_FRACTION, try_step
from .singular import SINGULAR_BELOW, independence, least_independence
from .stage import note_drift, note_pushes
from .step_size import scale_of_step, smallest_step, within_ramp

_LAST = METHOD.last
_BEFORE_LAST = METHOD.interior[-1]
_ROWS = METHOD.dense_rows

#: Whether it is passed, may be passed from nearer, or not at all.
PASSED = 1
NEARER = 2
REFUSED = 3
#: An instant of dependence so far ahead, in parts of the step that was wanted, is met: the next step would begin in it,
#: or with errors that forbid all but ever smaller steps. Below such a sine, where these begin, it is met in any case.
_MET_WITHIN, _MET_BELOW = 1.5, 0.015
#: Within a step it is sought from so much of a step before it on: it may be where it begins.
_BACK = 0.5
#: Nearer than this sine, rounding is most of what rows say about velocities along the other branch.
_LEAST_SINE = 1.5e-5
#: It is never read on by less than to where the sine is this: nearer points would carry rounding on.
_SPACED_BY = 3e-3
#: And this, where drivers lead all that moves: rounding of the rows, over the square of the sine, is all that there is.
_LED_BY = 1e-3
#: Points are so many times as far apart as the dependence is away, and the polynomial is read on by 2/3 of a spacing:
#: what rounding has left on them counts 40 times. By two spacings of that distance itself, it would 3000 times.
_SPACING = 3.0
#: Steps from one point to the next: beside the dependence, off the rows, accelerations change in proportion to 1 over
#: the distance from it, so that steps must be short beside that.
_PARTS = 18
#: Nearer than this sine, rounding is most of the error, which may be more than the tolerance, but not than this.
_ROUNDING_BELOW, _ROUNDING = 3e-3, 1e-8
#: And nearer than this one, rows are not closed: what they are off, over the sine, is motion along the other branch.
_CLOSED_ABOVE = 1e-3
#: So much nearer it is tried where nothing says how much.
_HALF = 0.5


@jit
def passes(block: Array) -> bool:
    """Whether singular configurations are to be passed."""
    wanted: bool = Options(block).settings[codes.THROUGH_SINGULARITIES] > 0.5
    # by explicit steps: what decays fast grows as fast on the way back
    return wanted and bool(Course(block).counters[codes.IMPLICIT] == 0)


@jit
def passed_in_step(block: Array) -> bool:
    """Whether the engine's own step has passed a singular configuration: only its dense output leads through."""
    clock = Course(block).clock
    passed: bool = clock[codes.STEP_START] < clock[codes.PASSED_AT] < clock[codes.STEP_END]
    return passed


@jit
def ahead(block: Array, singular: bool, wanted: float) -> float:
    """How long after the start of the step last tried the rows depend on each other [s]; infinite where they do not.

    Where the step is `singular`, that is within it. Otherwise it may be soon after its end: the sine falls to zero
    nearly straight. `wanted` is the size [s] that was tried first.
    """
    keep_small()
    s = Stages(block)
    h: float = s.tried[1]
    if singular:
        return least_independence(block, -_BACK)[1] * h
    last = math.sqrt(s.independence[_LAST])
    first = math.sqrt(s.independence[0])
    if not first > last:
        return math.inf
    apart = first / (first - last) * h
    return apart if apart <= _MET_WITHIN * max(h, wanted) or first < _MET_BELOW else math.inf


@jit
def pass_over(block: Array, start: float, apart: float, singular: bool) -> tuple[int, float]:
    """Try to pass the dependence that is `apart` [s] after y_start at `start` [s].

    Returns:
        `PASSED` and the size of the step [s], which is as one tried and accurate; `NEARER` and how far before the
        dependence it may be tried again [s]; or `REFUSED` and 0. In the last two cases the stages are lost.
    """
    keep_small()
    sine = math.sqrt(Course(block).independence_end[0])
    if not (sine > _LEAST_SINE and apart > smallest_step(block, start)):
        return REFUSED, 0.0
    beyond = apart * _spread(block, sine)
    spacing = _SPACING * beyond
    size = within_motions(block, start, within_ramp(block, start, apart + beyond))
    size = (start + size) - start
    if not (size > apart and _look_back(block, start, spacing, _is_off(block, sine))):
        return REFUSED, 0.0
    nearest = apart * _LEAST_SINE / sine
    most = 1.0
    if sine < _ROUNDING_BELOW:
        most = max(1.0, _ROUNDING / Options(block).settings[codes.RELATIVE_TOLERANCE])
    error = _read_on(block, size, spacing)
    if not error <= most:
        return _nearer(apart * min(scale_of_step(error, 1.0), _HALF), nearest)
    if not _put_right(block, start, size) <= most:
        return _nearer(apart * _HALF, nearest)
    _write_dense(block, start, size, spacing)
    if not _is_as_before(block):
        return _nearer(apart * _HALF, nearest)
    least, fraction = least_independence(block, 0.0)
    if least >= SINGULAR_BELOW:
        if singular:
            return _nearer(apart * _HALF, nearest)
        return REFUSED, 0.0  # it is only neared
    _prepare_looks(block, start + size)
    if first_event(block)[0] != codes.GUARD_NONE:  # what happens before is found in the step that comes nearer
        return _nearer(apart * _HALF, nearest)
    Course(block).clock[codes.PASSED_AT] = start + fraction * size
    Course(block).counters[codes.COUNT_PASSED] += 1
    return PASSED, size


@jit
def read_passed(block: Array) -> None:
    """Bring y_end to TIME, within the engine's own step that has passed one, by its polynomial made anew.

    The step's dense output is of lower degree: it is off the rows by 1e-11, which over a small sine is motion along the
    other branch. It asks for the inputs that were held.
    """
    keep_small()
    s = Stages(block)
    now = Course(block)
    start = now.clock[codes.STEP_START]
    copy(now.dense[0], s.y_start)
    set_time(block, start)
    derivative(block, s.y_start, s.derivatives[0])
    sine = math.sqrt(independence(block))
    spacing = _SPACING * (now.clock[codes.PASSED_AT] - start) * _spread(block, sine)
    _look_back(block, start, spacing, _is_off(block, sine))
    _hermite(block, (now.clock[codes.TIME] - start) / spacing, spacing, BEHIND, now.y_end)


@jit
def _nearer(apart: float, nearest: float) -> tuple[int, float]:
    if apart > nearest:
        return NEARER, apart
    return REFUSED, 0.0


@jit
def _is_off(block: Array, sine: float) -> bool:
    """Whether rows are left off so near, because closing them would lead along the other branch."""
    return _is_free(block) and sine < _CLOSED_ABOVE


@jit
def _is_free(block: Array) -> bool:
    """Whether anything is free to move: where drivers lead all of it, closing the rows says all about a point."""
    free: bool = Course(block).counters[codes.RANK] < Sizes(block).coordinates
    return free


@jit
def _spread(block: Array, sine: float) -> float:
    """By how much points are farther apart than in proportion to the distance from the dependence."""
    return max(1.0, (_SPACED_BY if _is_free(block) else _LED_BY) / sine)


@jit
def _look_back(block: Array, start: float, spacing: float, near: bool) -> bool:
    """Write the points behind y_start, `spacing` [s] apart, with derivatives; whether the rows are as now there.

    Where y_start is `near` the dependence, rows are closed from the next point on only: what they are off there, 1e-12
    on a dense output, the small sine would turn into a thousand or more of it along the other branch.
    """
    keep_small()
    s = Stages(block)
    copy(s.y_start, s.y_new)
    is_same = True
    short = spacing / _PARTS
    for part in range((BEHIND - 1) * _PARTS + 1):
        time = start - part * short
        if part > 0:
            try_step(block, time + short, -short)
        set_time(block, time)
        if not near or part >= _PARTS:
            close_rows(block, s.y_new, 0.0, 0.0, 0.0)
        derivative(block, s.y_new, s.derivatives[_LAST])
        is_same = is_same and LinearSystem(block).rank[0] == Course(block).counters[codes.RANK]
        if part % _PARTS == 0:
            copy(s.y_new, s.behind[part // _PARTS])
            copy(s.derivatives[_LAST], s.behind_rates[part // _PARTS])
        copy(s.y_new, s.y_start)
        copy(s.derivatives[_LAST], s.derivatives[0])
    return is_same


@jit
def _read_on(block: Array, size: float, spacing: float) -> float:
    """Read the polynomial `size` [s] after y_start into y_new; return the error norm, by one of a point less."""
    keep_small()
    s = Stages(block)
    _hermite(block, size / spacing, spacing, BEHIND - 1, s.y_at)
    _hermite(block, size / spacing, spacing, BEHIND, s.y_new)
    return _distance(block, s.y_new, s.y_at)


@jit
def _hermite(block: Array, place: float, spacing: float, count: int, y: Array) -> None:
    """Y at `place` (in spacings after the last point) by the polynomial through the last `count` points.

    Its values and derivatives there are theirs: Hermite's, by Lagrange's polynomials l of the points,
    y = sum (1 - 2 l'(x_k) (x - x_k)) l(x)^2 y_k + (x - x_k) l(x)^2 y'_k.
    """
    keep_small()
    s = Stages(block)
    clear(y)
    for k in range(count):
        away = place + k  # the points are at 0, -1, -2 ...
        lagrange = 1.0
        slope = 0.0
        for j in range(count):
            if j != k:
                lagrange *= (place + j) / (j - k)
                slope += 1.0 / (j - k)
        square = lagrange * lagrange
        for i in range(y.shape[0]):
            y[i] += square * ((1.0 - 2.0 * slope * away) * s.behind[k, i] + away * spacing * s.behind_rates[k, i])


@jit
def _distance(block: Array, y: Array, other: Array) -> float:
    """A difference over its tolerance: the most of that of positions, of rates, and of each other unknown.

    Positions and rates are measured together, in the metric of the masses: of the branches that cross, one may be that
    of a body that does not turn, whose angle, 0, would be held to the absolute tolerance, finer than rounding there.
    """
    keep_small()
    n = Sizes(block).coordinates
    relative = Options(block).settings[codes.RELATIVE_TOLERANCE]
    most: float = max(_by_mass(block, y[:n], other[:n]), _by_mass(block, y[n:], other[n:]))
    least = _square(block, y[n:])
    for i in range(2 * n, Sizes(block).y_wear):
        if i >= Sizes(block).y_alpha:
            least = ABSOLUTE_FRACTION
        most = max(most, abs(y[i] - other[i]) / (least + abs(y[i])))
    error: float = most / relative
    return error


@jit
def _by_mass(block: Array, values: Array, others: Array) -> float:
    """A difference of positions or rates over their size, in the metric of the masses."""
    keep_small()
    inverse = Bodies(block).inverse_mass
    difference = 0.0
    for k in range(Sizes(block).coordinates):
        difference += (values[k] - others[k]) * (values[k] - others[k]) / inverse[k]
    if difference == 0.0:
        return 0.0
    return math.sqrt(difference / _square(block, values))


@jit
def _square(block: Array, values: Array) -> float:
    """The square of positions or rates in the metric of the masses: of rates, twice the kinetic energy [J]."""
    inverse = Bodies(block).inverse_mass
    total = 0.0
    for k in range(Sizes(block).coordinates):
        total += values[k] * values[k] / inverse[k]
    return total


@jit
def _put_right(block: Array, start: float, size: float) -> float:
    """Close the rows at y_new, with the derivative there; return by how much it moves, over the tolerance."""
    keep_small()
    s = Stages(block)
    copy(s.y_new, s.y_at)
    set_time(block, start + size)
    close_rows(block, s.y_new, 0.0, 0.0, 0.0)
    derivative(block, s.y_new, s.derivatives[_LAST])
    note_drift(block)
    return _distance(block, s.y_new, s.y_at)


@jit
def _is_as_before(block: Array) -> bool:
    """After the acceleration at y_new: whether rows are as independent, and friction agrees as it has."""
    keep_small()
    now = Course(block)
    if rubs(block) and Rubs(block).sense[0] != now.counters[codes.SENSE]:
        return False
    s = Stages(block)
    s.independence[_BEFORE_LAST] = 0.0
    s.independence[_LAST] = independence(block)
    same_rank: bool = LinearSystem(block).rank[0] == now.counters[codes.RANK]
    return same_rank and math.sqrt(s.independence[_LAST]) > _LEAST_SINE


@jit
def _write_dense(block: Array, start: float, size: float, spacing: float) -> None:
    """The cubic through both ends, and the row beyond it so that it goes through the polynomial's middle."""
    keep_small()
    s = Stages(block)
    s.tried[0] = start
    s.tried[1] = size
    copy(Course(block).y_end, s.y_start)
    copy(Course(block).dy_end, s.derivatives[0])
    _hermite(block, 0.5 * size / spacing, spacing, BEHIND, s.y_stage)
    dense = s.new_dense
    for i in range(s.y_new.shape[0]):
        change = s.y_new[i] - s.y_start[i]
        bend = size * s.derivatives[0, i] - change
        dense[0, i] = s.y_start[i]
        dense[1, i] = change
        dense[2, i] = bend
        dense[3, i] = change - size * s.derivatives[_LAST, i] - bend
        for row in range(CUBIC_ROWS, _ROWS):
            dense[row, i] = 0.0
    if _ROWS > CUBIC_ROWS:
        interpolate(dense, 0.5, s.y_at)
        for i in range(s.y_new.shape[0]):
            dense[CUBIC_ROWS, i] = 16.0 * (s.y_stage[i] - s.y_at[i])  # it counts by t^2 (1 - t)^2


@jit
def _prepare_looks(block: Array, end: float) -> None:
    """Forces of contacts and friction as the search for events looks at them: those at y_new, at the time `end` [s]."""
    keep_small()
    s = Stages(block)
    clear(Contacts(block).least_push)
    clear(Contacts(block).most_push)
    if rubs(block):
        clear(Rubs(block).least_hold)
    set_time(block, end)
    derivative(block, s.y_new, s.derivatives[_LAST])
    note_pushes(block)
