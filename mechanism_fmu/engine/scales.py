"""Scales of a mechanism, of which all thresholds of the engine are parts: length, rate, mass, and the present rate.

All are 1 for a mechanism of the size of a hand that moves within a second: there the numbers of `tolerances` hold as
they stand. Who writes them: `dynamics.scaling`.
"""

from __future__ import annotations

import math

from .. import codes
from ..tables.declare import Array
from ..tables.kinds import JOINTS
from ..tables.motion import Course, Rows, Stages
from ..tables.parts import Contacts, Forces, Functions, Joints
from ..tables.sizes import Sizes
from .compiler.subset import jit, keep_apart, keep_small

_REVOLUTE = JOINTS.number("revolute")


@jit
def length_scale(block: Array) -> float:
    """Length of the mechanism, in units of `dynamics.scaling`."""
    return float(Course(block).scales[codes.SCALE_LENGTH])


@jit
def rate_scale(block: Array) -> float:
    """One over the time in which the mechanism moves, as it is from its start."""
    rate: float = Course(block).scales[codes.SCALE_RATE]
    return rate if rate > 0.0 else 1.0


@jit
def present_rate(block: Array) -> float:
    """One over the time in which the mechanism moves, by what acts since the last event."""
    rate: float = Course(block).scales[codes.SCALE_PRESENT]
    return rate if rate > 0.0 else 1.0


@jit
def pair_rate(block: Array, i: int, j: int) -> float:
    """One over the time in which two bodies, and what they are joined to, move by what has acted since their event."""
    rate = _larger(block, i, j, codes.ISLAND_RATE)
    return rate if rate > 0.0 else rate_scale(block)


@jit
def pair_length(block: Array, i: int, j: int) -> float:
    """Length of two bodies, and of what they were joined to at their last event, in units of `dynamics.scaling`."""
    length = _larger(block, i, j, codes.ISLAND_LENGTH)
    return length if length > 0.0 else length_scale(block)


@jit
def _larger(block: Array, i: int, j: int, column: int) -> float:
    """The larger scale of two bodies, of which one may be the ground."""
    scales = Course(block).body_scales
    bodies = Sizes(block).bodies
    most = 0.0
    if i < bodies:
        most = scales[i, column]
    if j < bodies:
        most = max(most, scales[j, column])
    return most


@jit
def bodies_of(block: Array, rub: int) -> tuple[int, int]:
    """The two bodies of friction: of a contact, a joint, or a force element (see `friction_rows`)."""
    keep_apart()
    contacts = Sizes(block).contacts
    if rub < contacts:
        return Contacts(block).body_i[rub], Contacts(block).body_j[rub]
    rub -= contacts
    if rub < Sizes(block).joints:
        return Joints(block).body_i[rub], Joints(block).body_j[rub]
    rub -= Sizes(block).joints
    return Forces(block).body[rub], Forces(block).reaction[rub]


@jit
def force_scale(block: Array) -> float:
    """Force that moves the mechanism in its time."""
    mass: float = Course(block).scales[codes.SCALE_MASS]
    return mass * length_scale(block) * rate_scale(block) * rate_scale(block)


@jit
def contact_unit(block: Array, contact: int) -> float:
    """Scale of the gap of a contact: a length, of all bodies where outlines are searched; 1 of an angle."""
    table = Contacts(block)
    if table.kind[contact] == codes.ANGLE_STOP or table.kind[contact] == codes.ANGLE_LOCK:
        return 1.0
    if table.kind[contact] == codes.OUTLINE:
        return length_scale(block)
    return pair_length(block, table.body_i[contact], table.body_j[contact])


@jit
def contact_speed(block: Array, contact: int) -> float:
    """Scale of the rate at which the gap of a contact changes."""
    i, j = Contacts(block).body_i[contact], Contacts(block).body_j[contact]
    unit = pair_length(block, i, j) if Contacts(block).kind[contact] == codes.OUTLINE else contact_unit(block, contact)
    return unit * pair_rate(block, i, j)


@jit
def slip_scale(block: Array, rub: int) -> float:
    """Scale of the speed at which something with friction slips."""
    i, j = bodies_of(block, rub)
    return friction_unit(block, rub) * pair_rate(block, i, j)


@jit
def friction_unit(block: Array, rub: int) -> float:
    """Scale of the way that something with friction slips: a length; 1 of pins and brakes."""
    contacts = Sizes(block).contacts
    joints = Sizes(block).joints
    if rub < contacts or (rub < contacts + joints and Joints(block).kind[rub - contacts] != _REVOLUTE):
        i, j = bodies_of(block, rub)
        return pair_length(block, i, j)
    return 1.0


@jit
def row_unit(block: Array, row: int) -> float:
    """Scale of what a row may be off, whatever its unit: by how much it changes where its bodies move by theirs."""
    keep_apart()
    entry = Rows(block).jacobian[row]
    along = across = 0.0
    for end in range(2):
        first = 3 * Rows(block).body[row, end]
        if first < Sizes(block).coordinates:  # how far the place is from the origin says nothing
            across = max(across, abs(entry[first]), abs(entry[first + 1]))
            along = max(along, abs(entry[first + 2]))
    unit = max(along, across * pair_length(block, Rows(block).body[row, 0], Rows(block).body[row, 1]))
    return unit if unit > 0.0 else length_scale(block)


@jit
def guard_unit(block: Array, guard: int, subject: int) -> float:
    """Scale of what a guard looks at; of slips, of the way."""
    keep_small()
    if guard == codes.GUARD_GAP or guard == codes.GUARD_CLICK:
        return contact_unit(block, subject)
    if guard == codes.GUARD_STICK:
        return friction_unit(block, subject)
    if guard == codes.GUARD_FUNCTION and Functions(block).kind[subject] == codes.ANGLE:
        return 1.0
    return length_scale(block)


@jit
def largest_off(block: Array, values: Array, count: int) -> float:
    """Largest magnitude of what `count` rows, or their rates, are off, in scale; infinite when one is not a number."""
    keep_small()
    most = 0.0
    for r in range(count):
        if values[r] == 0.0:
            continue
        unit = row_unit(block, r)
        if not abs(values[r]) <= most * unit:
            most = abs(values[r]) / unit
        if not most < math.inf:
            return math.inf
    return most


@jit
def write_scales(block: Array, rate: float, step: float) -> None:
    """Write `stages.scale`: of every unknown, where the mechanism moves at a rate; 1 of own states, which have none.

    In a step [s] longer than the time of that rate, a speed counts that leads as far as what counts of places.
    """
    keep_apart()
    n = Sizes(block).coordinates
    own = Course(block).body_scales
    scale = Stages(block).scale
    speed = rate / max(1.0, step * rate)
    for k in range(0, n, 3):
        unit = own[k // 3, codes.ISLAND_LENGTH]
        scale[k] = scale[k + 1] = unit
        scale[k + 2] = 1.0
        scale[n + k] = scale[n + k + 1] = unit * speed
        scale[n + k + 2] = speed
    length = length_scale(block)
    mass = Course(block).scales[codes.SCALE_MASS]
    energy = mass * length * rate * rate * length
    for i in range(2 * n, Sizes(block).unknowns):
        scale[i] = energy if i < Sizes(block).y_alpha else 1.0
