"""Outputs at the current time, and their derivatives: what each kind of output reads stands once, in `READINGS`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from .. import codes
from ..tables.declare import Array
from ..tables.members import Structure
from ..tables.motion import Course, LinearSystem, Pose, Stages
from ..tables.parts import Bodies, Contacts, Patterns, Ports
from ..tables.sizes import Sizes
from .compiler.by_kind import by_kind
from .compiler.subset import entry, jit, keep_small
from .constraints.kinematics import place_bodies, set_instant
from .contacts.friction_readings import friction_force, gap_acceleration, slip_acceleration, slip_speed, sticks_now
from .contacts.guards import shown_gap
from .contacts.play_readings import contact_angle, eccentricity, sliding_power, sliding_work
from .dynamics.acceleration import derivative
from .dynamics.forces import (
    feed,
    force_reading,
    force_reading_rate,
    kinetic_energy,
    kinetic_power,
    stored_energy,
    stored_power,
)
from .elastic.readings import beam_reading, elastic_reading
from .elastic.structure import bend
from .stepping.stepper import state_at_time


class Reading(NamedTuple):
    """What a kind of output (`codes`) reads at poses and rates `at` of the unknowns `stages.y_at`.

    Attributes:
        value: (block, at, index, slot, value) -> the value, with `ports.output_index`, `output_slot`, `output_value`.
        rate: (block, at, index, slot, value) -> its derivative with respect to time, with `stages.dy_at`; None: not a
            number, of what jumps only, and of what follows accelerations, whose derivatives depend on those of inputs.
        solves: whether it reads multipliers or accelerations (of a contact: only while that is closed).
    """

    value: Callable[..., Any]
    rate: Callable[..., Any] | None = None
    solves: bool = False


@jit
def _constant(_block: Array, _at: Pose, _index: int, _slot: int, value: float) -> float:
    return value


@jit
def _rests(_block: Array, _at: Pose, _index: int, _slot: int, _value: float) -> float:
    return 0.0


@jit
def _unknown(block: Array, _at: Pose, index: int, _slot: int, _value: float) -> float:
    return float(Stages(block).y_at[index])


@jit
def _unknown_rate(block: Array, _at: Pose, index: int, _slot: int, _value: float) -> float:
    return float(Stages(block).dy_at[index])


@jit
def _contact_force(block: Array, _at: Pose, index: int, _slot: int, value: float) -> float:
    contact = Contacts(block)
    if contact.mode[index] == codes.CLOSED:
        value = LinearSystem(block).multiplier[contact.row[index]]
    return value


@jit
def _contact_gap(block: Array, at: Pose, index: int, _slot: int, value: float) -> float:
    if Contacts(block).mode[index] == codes.OPEN:
        value, _ = shown_gap(block, at, index)
    return value


@jit
def _contact_gap_rate(block: Array, at: Pose, index: int, _slot: int, _value: float) -> float:
    rate = 0.0  # closed
    if Contacts(block).mode[index] == codes.OPEN:
        _, rate = shown_gap(block, at, index)
    return rate


@jit
def _contact_closed(block: Array, _at: Pose, index: int, _slot: int, _value: float) -> float:
    return float(Contacts(block).mode[index])


@jit
def _stop_clicks(block: Array, _at: Pose, index: int, _slot: int, _value: float) -> float:
    return float(Contacts(block).clicks[index])


@jit
def _stop_reference(block: Array, _at: Pose, index: int, _slot: int, _value: float) -> float:
    return float(Contacts(block).line[index, 0])


@jit
def _pattern_index(block: Array, _at: Pose, index: int, _slot: int, _value: float) -> float:
    return float(Patterns(block).copy[index])


@jit
def _joint_force(block: Array, _at: Pose, index: int, _slot: int, value: float) -> float:
    return float(value * LinearSystem(block).multiplier[index])


@jit
def _force_element(block: Array, at: Pose, index: int, slot: int, _value: float) -> float:
    return force_reading(block, at, index, Stages(block).y_at, slot)


@jit
def _force_element_rate(block: Array, at: Pose, index: int, slot: int, _value: float) -> float:
    return force_reading_rate(block, at, index, Stages(block).dy_at, slot)


@jit
def _kinetic_energy(block: Array, _at: Pose, _index: int, _slot: int, _value: float) -> float:
    n = Sizes(block).coordinates
    return kinetic_energy(Bodies(block).inverse_mass, Stages(block).y_at[n:], n)


@jit
def _kinetic_power(block: Array, _at: Pose, _index: int, _slot: int, _value: float) -> float:
    n = Sizes(block).coordinates
    s = Stages(block)
    return kinetic_power(Bodies(block).inverse_mass, s.y_at[n:], s.dy_at[n:], n)


@jit
def _spring_energy(block: Array, at: Pose, _index: int, _slot: int, _value: float) -> float:
    return stored_energy(block, at, Stages(block).y_at)


@jit
def _spring_power(block: Array, at: Pose, _index: int, _slot: int, _value: float) -> float:
    return stored_power(block, at, Stages(block).y_at, Stages(block).dy_at)


@jit
def _energy_lost(block: Array, _at: Pose, _index: int, _slot: int, _value: float) -> float:
    return float(Course(block).ledger[codes.LEDGER_LOST] + Stages(block).y_at[Sizes(block).y_loss])


@jit
def _power_lost(block: Array, _at: Pose, _index: int, _slot: int, _value: float) -> float:
    return float(Stages(block).dy_at[Sizes(block).y_loss])


@jit
def _counter(block: Array, _at: Pose, index: int, _slot: int, _value: float) -> float:
    return float(Course(block).counters[index])


@jit
def _impact_flag(block: Array, _at: Pose, _index: int, _slot: int, _value: float) -> float:
    return float(min(Course(block).counters[codes.COUNT_IN_STEP], 1))


@jit
def _last_impact(block: Array, _at: Pose, index: int, _slot: int, _value: float) -> float:
    return float(Course(block).last_impact[index])


@jit
def _buffered_impact(block: Array, _at: Pose, index: int, slot: int, _value: float) -> float:
    now = Course(block)
    place = (now.counters[codes.FIRST_IMPACT] + slot) % now.impacts.shape[0]
    return float(now.impacts[place, index])


@jit
def _buffered_event(block: Array, _at: Pose, index: int, slot: int, _value: float) -> float:
    """A field of an event of the last communication step; in an empty slot time, guard and subject are -1."""
    now = Course(block)
    if slot < now.counters[codes.EVENTS_IN_STEP]:
        place = (now.counters[codes.FIRST_EVENT] + slot) % now.events.shape[0]
        value: float = now.events[place, index]
        return value
    if index <= codes.EVENT_SUBJECT:
        return -1.0
    return 0.0


@jit
def _member_force(block: Array, _at: Pose, index: int, _slot: int, value: float) -> float:
    value *= Structure(block).element_force[index]
    return value


#: Every kind of output but those of elastic members.
READINGS: dict[int, Reading] = {
    codes.CONSTANT: Reading(_constant, _rests),
    codes.UNKNOWN: Reading(_unknown, _unknown_rate),
    codes.COUNTER: Reading(_counter),
    codes.CONTACT_FORCE: Reading(_contact_force, solves=True),
    codes.CONTACT_GAP: Reading(_contact_gap, _contact_gap_rate),
    codes.KINETIC_ENERGY: Reading(_kinetic_energy, _kinetic_power),
    codes.SPRING_ENERGY: Reading(_spring_energy, _spring_power),
    codes.ENERGY_LOST: Reading(_energy_lost, _power_lost),
    codes.IMPACT_FLAG: Reading(_impact_flag),
    codes.LAST_IMPACT: Reading(_last_impact),
    codes.BUFFERED_IMPACT: Reading(_buffered_impact),
    codes.CONTACT_CLOSED: Reading(_contact_closed),
    codes.PATTERN_INDEX: Reading(_pattern_index),
    codes.STOP_CLICKS: Reading(_stop_clicks),
    codes.STOP_REFERENCE: Reading(_stop_reference, _rests),  # between clicks
    codes.FORCE_READING: Reading(_force_element, _force_element_rate),
    codes.JOINT_FORCE: Reading(_joint_force, solves=True),
    codes.BUFFERED_EVENT: Reading(_buffered_event),
    codes.MEMBER_FORCE: Reading(_member_force),
    codes.SLIP_SPEED: Reading(slip_speed),
    codes.FRICTION_FORCE: Reading(friction_force, solves=True),
    codes.STICKS_NOW: Reading(sticks_now, solves=True),
    codes.GAP_ACCELERATION: Reading(gap_acceleration, solves=True),
    codes.SLIP_ACCELERATION: Reading(slip_acceleration, solves=True),
    codes.ECCENTRICITY: Reading(eccentricity),
    codes.CONTACT_ANGLE: Reading(contact_angle),
    codes.SLIDING_WORK: Reading(sliding_work, sliding_power),
}


@jit
def _of_member(kind: int, block: Array, at: Pose, index: int, _slot: int, _value: float) -> float:
    if kind == codes.BEAM_DEFLECTION or kind == codes.BEAM_STRESS:
        return beam_reading(block, at, kind, index)
    return elastic_reading(block, at, kind, index)


@jit
def _yes(_kind: int) -> bool:
    return True


_ARGUMENTS = "block, at, index, slot, value"
_read = by_kind({kind: r.value for kind, r in READINGS.items()}, _ARGUMENTS, rest=_of_member)
_read_rate = by_kind({kind: r.rate for kind, r in READINGS.items() if r.rate}, _ARGUMENTS, "math.nan")
_SOLVING = (codes.BEAM_DEFLECTION, codes.BEAM_STRESS, *(kind for kind, reading in READINGS.items() if reading.solves))
_solves = by_kind(dict.fromkeys(_SOLVING, _yes), "of", "False")


@entry
def read_outputs(block: Array) -> None:
    """Write all output values, shape (outputs,), to the work field `outputs`; the motion is not touched."""
    table = Ports(block)
    s = Stages(block)
    state_at_time(block, s.y_at)
    set_instant(block, Course(block).clock[codes.TIME])
    feed(block, table.inputs)  # one that was set after the last step acts already
    at = place_bodies(block, s.y_at)
    bends = Sizes(block).nodes > 0
    if bends or _needs_multipliers(block):
        derivative(block, s.y_at, s.dy_at)
    if bends:
        bend(block, at)
    for o in range(table.outputs.shape[0]):
        slot, value = table.output_slot[o], table.output_value[o]
        table.outputs[o] = _read(table.output_kind[o], block, at, table.output_index[o], slot, value)
    feed(block, table.held_inputs)


@entry
def read_output_rates(block: Array) -> None:
    """Write dz/dt of every output z, shape (outputs,), to the work field `output_rates`; the motion is not touched.

    Jumps in impacts do not count.
    """
    keep_small()
    table = Ports(block)
    s = Stages(block)
    state_at_time(block, s.y_at)
    set_instant(block, Course(block).clock[codes.TIME])
    feed(block, table.inputs)  # one that was set after the last step acts already
    at = derivative(block, s.y_at, s.dy_at)
    for o in range(table.outputs.shape[0]):
        slot, value = table.output_slot[o], table.output_value[o]
        table.output_rates[o] = _read_rate(table.output_kind[o], block, at, table.output_index[o], slot, value)
    feed(block, table.held_inputs)


@jit
def _needs_multipliers(block: Array) -> bool:
    table = Ports(block)
    contact = Contacts(block)
    for o in range(table.outputs.shape[0]):
        kind = table.output_kind[o]
        if kind == codes.CONTACT_FORCE:
            if contact.mode[table.output_index[o]] == codes.CLOSED:
                return True
        elif _solves(kind, kind):
            return True
    return False
