"""Derivatives of outputs with respect to time, at the current time."""

from __future__ import annotations

import math

from .. import codes
from ..tables.declare import Array
from ..tables.motion import Course, Pose, Stages
from ..tables.parts import Bodies, Contacts, Ports
from ..tables.sizes import Sizes
from .compiler.subset import entry, jit
from .contacts.guards import gap
from .dynamics.acceleration import derivative
from .dynamics.forces import force_reading_rate, kinetic_power, stored_power
from .dynamics.inputs import feed
from .stepping.stepper import state_at_time


@entry
def read_output_rates(block: Array) -> None:
    """Write dz/dt of every output z, shape (outputs,), to the work field `output_rates`; the motion is not touched.

    Jumps in impacts do not count. Not a number: what jumps only, and what follows accelerations (forces of contacts,
    torques of shafts, voltages), whose derivatives depend on those of inputs.
    """
    table = Ports(block)
    s = Stages(block)
    state_at_time(block, s.y_at)
    Pose(block).instant[0] = Course(block).clock[codes.TIME]
    feed(block, table.inputs)  # one that was set after the last step acts already
    at = derivative(block, s.y_at, s.dy_at)
    for o in range(table.outputs.shape[0]):
        table.output_rates[o] = _rate(block, at, table.output_kind[o], table.output_index[o], table.output_slot[o])
    feed(block, table.held_inputs)


@jit
def _rate(block: Array, at: Pose, kind: int, index: int, slot: int) -> float:
    """The derivative of one output; `index` and `slot` as in `ports`."""
    n = Sizes(block).coordinates
    s = Stages(block)
    rate = math.nan
    if kind == codes.CONSTANT or kind == codes.STOP_REFERENCE:
        rate = 0.0  # the latter between clicks
    elif kind == codes.COORDINATE:
        rate = s.dy_at[index]
    elif kind == codes.RATE:
        rate = s.dy_at[n + index]
    elif kind == codes.CONTACT_GAP:
        rate = 0.0  # closed
        if Contacts(block).mode[index] == codes.OPEN:
            _, rate = gap(block, at, index)
    elif kind == codes.KINETIC_ENERGY:
        rate = kinetic_power(Bodies(block).inverse_mass, s.y_at[n:], s.dy_at[n:], n)
    elif kind == codes.SPRING_ENERGY:
        rate = stored_power(block, at, s.y_at, s.dy_at)
    elif kind == codes.WORK_DONE:
        rate = s.dy_at[Sizes(block).y_work]
    elif kind == codes.ENERGY_LOST:
        rate = s.dy_at[Sizes(block).y_loss]
    elif kind == codes.CONTACT_POINT:
        rate = s.dy_at[Sizes(block).y_alpha + index]
    elif kind == codes.FORCE_READING:
        rate = force_reading_rate(block, at, index, s.dy_at, slot)
    return rate
