"""Bodies that take part in an event: those of its guard, and all that joints and touching contacts join to them.

The ground joins nothing. Neither the impulses of an event nor its new choice of modes reach what shares no island with
its guard, which therefore takes no part: in a crowd every body moves as it does alone.
"""

from __future__ import annotations

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Course, LinearSystem, Pose, Strikes
from ...tables.parts import Bodies, Contacts, Forces, Joints, Patterns
from ...tables.sizes import Sizes
from ...tolerances import PILED, RESTS_BELOW, ROOT_TOLERANCE, TOUCHES_WITHIN
from ..compiler.subset import jit, keep_apart, keep_small
from ..constraints.friction_rows import BRAKE, rubs
from ..dynamics.islands import leader_of
from ..dynamics.scaling import join_scales, take_scales
from ..outlines.nearest import FREE, look_no_deeper, nearest
from ..scales import bodies_of, contact_speed, contact_unit, length_scale, rate_scale
from .binding import free_place, is_free, let_loose, take_found
from .guards import gap


@jit
def find_participants(block: Array, at: Pose, guard: int, subject: int) -> int:
    """Write the island of each body that takes part in an event (`strikes.island`); return the number of these bodies.

    Without friction, contacts of other islands that close at the same instant join in: their impulses do not meet.
    """
    keep_apart()
    table = Contacts(block)
    approached = Strikes(block).approached
    leader = LinearSystem(block).leader
    ground = Sizes(block).bodies
    for b in range(ground + 1):
        leader[b] = b
        approached[b] = codes.NONE
    for k in range(Joints(block).kind.shape[0]):
        _join(block, Joints(block).body_i[k], Joints(block).body_j[k])
    if rubs(block):
        for k in range(Forces(block).kind.shape[0]):
            if Forces(block).kind[k] == BRAKE:
                _join(block, Forces(block).body[k], Forces(block).reaction[k])
    for c in range(table.mode.shape[0]):
        i, j = table.body_i[c], table.body_j[c]
        if i != ground and j != ground and _touches(block, at, c):
            _join(block, i, j)
    if guard == codes.GUARD_BEGIN or guard == codes.GUARD_INPUT or guard == codes.GUARD_SHOCK:
        for b in range(ground):
            approached[leader_of(LinearSystem(block), b)] = 0
    else:
        _let_guard_take_part(block, guard, subject)
    if guard == codes.GUARD_GAP and not rubs(block) and Course(block).counters[codes.PILE] < PILED:
        look_no_deeper(block, 0.0)
        for c in range(table.mode.shape[0]):
            if _closes_now(block, at, c):
                _let_take_part(block, table.body_i[c], table.body_j[c])
    count = 0
    for b in range(ground + 1):
        leading = leader_of(LinearSystem(block), b)
        Strikes(block).island[b] = codes.NONE
        if b != ground and approached[leading] == 0:
            Strikes(block).island[b] = leading
            count += 1
    return count


@jit
def share_scales(block: Array) -> None:
    """Let the bodies of an island that takes part have the time of its fastest one and the length of its largest."""
    keep_small()
    for b in range(Sizes(block).bodies):
        if Strikes(block).island[b] != codes.NONE:
            join_scales(block, Strikes(block).island[b], b)
    for b in range(Sizes(block).bodies):
        if Strikes(block).island[b] != codes.NONE:
            take_scales(block, Strikes(block).island[b], b)


@jit
def _join(block: Array, i: int, j: int) -> None:
    """Join the islands of two bodies, neither of which is the ground."""
    ground = Sizes(block).bodies
    if i != ground and j != ground:
        one, other = leader_of(LinearSystem(block), i), leader_of(LinearSystem(block), j)
        LinearSystem(block).leader[max(one, other)] = min(one, other)


@jit
def _let_take_part(block: Array, i: int, j: int) -> None:
    """Let two bodies take part, as one island."""
    _join(block, i, j)
    for b in (i, j):
        if b != Sizes(block).bodies:
            Strikes(block).approached[leader_of(LinearSystem(block), b)] = 0


@jit
def _let_guard_take_part(block: Array, guard: int, subject: int) -> None:
    """Let the islands take part whose bodies a guard looks at, or whose contacts it switches."""
    keep_small()
    table = Contacts(block)
    if guard == codes.GUARD_NEXT or guard == codes.GUARD_PREVIOUS:
        _let_take_part(block, Patterns(block).body_i[subject], Patterns(block).body_j[subject])
    elif guard == codes.GUARD_FUNCTION:
        for c in range(table.mode.shape[0]):
            if table.function[c] == subject:
                _let_take_part(block, table.body_i[c], table.body_j[c])
    else:  # of a contact, or of friction, whose numbers begin with those of contacts
        i, j = bodies_of(block, subject)
        _let_take_part(block, i, j)


@jit
def _exists_open(block: Array, contact: int) -> bool:
    """Return whether a contact is open, enabled, one-sided, and bound to what it may strike."""
    table = Contacts(block)
    exists = table.mode[contact] == codes.OPEN and table.value[contact, codes.ENABLED] > 0.5
    return bool(exists and table.function[contact] == codes.NONE and not is_free(block, contact))


@jit
def _touches(block: Array, at: Pose, contact: int) -> bool:
    keep_small()
    if Contacts(block).mode[contact] == codes.CLOSED:
        return True
    return _exists_open(block, contact) and gap(block, at, contact)[0] <= TOUCHES_WITHIN * contact_unit(block, contact)


@jit
def _closes_now(block: Array, at: Pose, contact: int) -> bool:
    """Return whether an open contact closes at this instant, as closely as instants of events are found."""
    keep_small()
    searched = is_free(block, contact) and Contacts(block).value[contact, codes.ENABLED] > 0.5
    searched = searched and free_place(block, Contacts(block).group[contact]) == contact
    if searched:
        if nearest(block, at, contact, FREE) > TOUCHES_WITHIN * length_scale(block):
            return False
        take_found(block, contact)
    closes = False
    if _exists_open(block, contact):
        distance, rate = gap(block, at, contact)
        closes = distance <= -ROOT_TOLERANCE / rate_scale(block) * rate
        closes = closes and rate < -RESTS_BELOW * contact_speed(block, contact)
    if searched:
        let_loose(block, contact)
    return closes


@jit
def island_of(block: Array, rub: int) -> int:
    """The island in which a contact, or what else has friction, takes part in the event; `codes.NONE`: in none."""
    i, j = bodies_of(block, rub)
    island = Strikes(block).island
    if i == Sizes(block).bodies:
        i = j
    found: int = island[i]
    return found


@jit
def participants_energy(block: Array) -> float:
    """Kinetic energy of all that takes part in the event, at y_end [J]; that of others has its own rounding."""
    keep_small()
    rate = Course(block).y_end[Sizes(block).coordinates :]
    inverse_mass = Bodies(block).inverse_mass
    energy = 0.0
    for k in range(Sizes(block).coordinates):
        if Strikes(block).island[k // 3] != codes.NONE:
            energy += 0.5 * rate[k] * rate[k] / inverse_mass[k]
    return energy
