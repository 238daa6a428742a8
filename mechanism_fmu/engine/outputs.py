"""Outputs at the current time."""

from __future__ import annotations

from .. import codes
from ..tables.declare import Array
from ..tables.members import Structure
from ..tables.motion import Course, LinearSystem, Pose, Stages
from ..tables.parts import Bodies, Contacts, Patterns, Ports
from ..tables.sizes import Sizes
from .compiler.subset import entry, jit
from .constraints.kinematics import place_bodies
from .contacts.guards import gap
from .dynamics.acceleration import derivative
from .dynamics.forces import force_reading, kinetic_energy, stored_energy
from .dynamics.inputs import feed
from .elastic.beam import beam_reading
from .elastic.readings import elastic_reading
from .elastic.structure import bend
from .stepping.stepper import state_at_time


@entry
def read_outputs(block: Array) -> None:
    """Write all output values, shape (outputs,), to the work field `outputs`; the motion is not touched."""
    n = Sizes(block).coordinates
    table = Ports(block)
    now = Course(block)
    s = Stages(block)
    contact = Contacts(block)
    state_at_time(block, s.y_at)
    Pose(block).instant[0] = now.clock[codes.TIME]
    feed(block, table.inputs)  # one that was set after the last step acts already
    at = place_bodies(block, s.y_at)
    bends = Sizes(block).nodes > 0
    if bends or _needs_multipliers(block):
        derivative(block, s.y_at, s.dy_at)
    if bends:
        bend(block, at)
    for o in range(table.outputs.shape[0]):
        kind = table.output_kind[o]
        index = table.output_index[o]
        value = table.output_value[o]
        if kind == codes.COORDINATE:
            value = s.y_at[index]
        elif kind == codes.RATE:
            value = s.y_at[n + index]
        elif kind == codes.CONTACT_FORCE:
            if contact.mode[index] == codes.CLOSED:
                value = LinearSystem(block).multiplier[contact.row[index]]
        elif kind == codes.CONTACT_GAP:
            if contact.mode[index] == codes.OPEN:
                value, _ = gap(block, at, index)
        elif kind == codes.KINETIC_ENERGY:
            value = kinetic_energy(Bodies(block).inverse_mass, s.y_at[n:], n)
        elif kind == codes.SPRING_ENERGY:
            value = stored_energy(block, at, s.y_at)
        elif kind == codes.WORK_DONE:
            value = s.y_at[Sizes(block).y_work]
        elif kind == codes.ENERGY_LOST:
            value = now.ledger[codes.LEDGER_LOST] + s.y_at[Sizes(block).y_loss]
        elif kind == codes.IMPACT_COUNT:
            value = float(now.counters[codes.COUNT_IMPACTS])
        elif kind == codes.IMPACTS_IN_STEP:
            value = float(now.counters[codes.COUNT_IN_STEP])
        elif kind == codes.IMPACTS_LOST:
            value = float(now.counters[codes.COUNT_LOST])
        elif kind == codes.IMPACT_FLAG:
            value = float(min(now.counters[codes.COUNT_IN_STEP], 1))
        elif kind == codes.LAST_IMPACT:
            value = now.last_impact[index]
        elif kind == codes.BUFFERED_IMPACT:
            value = now.impacts[table.output_slot[o], index]
        elif kind == codes.CONTACT_CLOSED:
            value = float(contact.mode[index])
        elif kind == codes.PATTERN_INDEX:
            value = float(Patterns(block).copy[index])
        elif kind == codes.STOP_CLICKS:
            value = float(contact.clicks[index])
        elif kind == codes.STOP_REFERENCE:
            value = contact.line[index, 0]
        elif kind == codes.FORCE_READING:
            value = force_reading(block, at, index, s.y_at, table.output_slot[o])
        elif kind == codes.EVENT_COUNT:
            value = float(now.counters[codes.COUNT_EVENTS])
        elif kind == codes.EVENTS_IN_STEP_OUT:
            value = float(now.counters[codes.EVENTS_IN_STEP])
        elif kind == codes.JOINT_FORCE:
            value *= LinearSystem(block).multiplier[index]
        elif kind == codes.CONTACT_POINT:
            value = s.y_at[Sizes(block).y_alpha + index]
        elif kind == codes.BUFFERED_EVENT:
            value = _buffered_event(block, table.output_slot[o], index)
        elif kind == codes.BEAM_DEFLECTION or kind == codes.BEAM_STRESS:
            value = beam_reading(block, at, kind, index)
        elif kind == codes.MEMBER_FORCE:
            value *= Structure(block).element_force[index]
        elif kind != codes.CONSTANT:
            value = elastic_reading(block, at, kind, index)
        table.outputs[o] = value
    feed(block, table.held_inputs)


@jit
def _buffered_event(block: Array, slot: int, column: int) -> float:
    """A field of an event of the last communication step; in an empty slot time, guard and subject are -1."""
    now = Course(block)
    if slot < now.counters[codes.EVENTS_IN_STEP]:
        value: float = now.events[slot, column]
        return value
    if column <= codes.EVENT_SUBJECT:
        return -1.0
    return 0.0


@jit
def _needs_multipliers(block: Array) -> bool:
    table = Ports(block)
    contact = Contacts(block)
    for o in range(table.outputs.shape[0]):
        kind = table.output_kind[o]
        if kind == codes.JOINT_FORCE or kind == codes.BEAM_DEFLECTION or kind == codes.BEAM_STRESS:
            return True
        if kind == codes.CONTACT_FORCE and contact.mode[table.output_index[o]] == codes.CLOSED:
            return True
    return False
