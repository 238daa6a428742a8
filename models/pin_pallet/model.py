"""The pin-pallet escapement: an escape wheel of fifteen teeth, and a balance that carries two pins.

Frame: the wheel's axis at the origin, the balance's staff above it; the wheel turns counter-clockwise. At the angle 0
of the balance both pins are as far from the line of centres. Equations and sources: README.md beside this file.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    CircularCopies,
    Damper,
    Finding,
    Mechanism,
    Model,
    Outline,
    OutlineContact,
    Parameter,
    Revolute,
    Torque,
    TorsionSpring,
    deg,
    port_builders as ports,
    rigid_body,
)
from mechanism_fmu.model.timekeeping import (
    anchor_shape,
    beat,
    drive_input,
    drop_finding,
    nominal_period_parameter,
    polar,
    timekeeping_outputs,
)

#: Teeth of the wheel; the radius to a pin and the line of centres are so far apart [rad].
TEETH, SPAN = 15, math.radians(42)
#: Lines from the staff to the pins touch a circle of this radius [m].
RADIUS = 0.030
STAFF = (0.0, RADIUS / math.cos(SPAN))
#: Radii [m] and angles [deg] of a tooth's corners, and the angle that it takes at the pins [rad].
CORNERS = ((0.0250, -2.6), (0.0304, -4.6), (0.0290, 4.6), (0.0250, 4.6))
WIDTH = math.radians(9.2)
#: Distance of the pins from the wheel's axis [m]: so deep are they among the teeth.
DEPTH = 0.0298


INPUTS = (
    drive_input("0.45 N.mm", "mainspring", usual=("0.25 N.mm", "1.8 N.mm")),
    ports.load_torque_input("balance", usual=(-2e-4, 2e-4)),
)
OUTPUTS = timekeeping_outputs("balance", "theta", energy=1e-4, power=1e-4)

PARAMETERS = (
    ports.inertia_parameter("wheel_inertia", 2e-6, "Moment of inertia of the escape wheel about its axis"),
    ports.inertia_parameter("balance_inertia", 2e-4, "Moment of inertia of balance and pins about the staff"),
    Parameter("frequency", 2.53, "Frequency of balance and hairspring alone", "Hz", 0.1, 100.0, usual=(1.0, 5.0)),
    Parameter("quality", 10.0, "Quality factor of balance and hairspring alone", "1", 1.0, 1e5, usual=(5.0, 300.0)),
    ports.length_parameter("pin_radius", "0.4 mm", "Radius of the pins", 1e-5, usual=(2e-4, 7e-4)),
    ports.angle_parameter("balance_angle_start", "-4.9 deg", "Angle of the balance at the start", -0.6, 0.6),
    nominal_period_parameter(0.4),
    *ports.settings_parameters(),
)


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the wheel cannot turn: a tooth with a pin on either side fills half a pitch."""
    room = math.pi / TEETH - WIDTH
    drop = room - 2.0 * values.pin_radius / DEPTH
    return (
        drop_finding(
            drop, 0.5 * room * DEPTH, WIDTH * DEPTH, values.pin_radius, "thickness of the teeth", "pin_radius"
        ),
    )


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The escapement for parameter values that raise no objection."""
    wheel = rigid_body("wheel", mass="5 g", inertia=values.wheel_inertia, angle=deg(41.9))
    balance = rigid_body(
        "balance", STAFF, mass="50 g", inertia=values.balance_inertia, angle=values.balance_angle_start
    )
    tooth = Outline.chain([polar(radius, deg(angle)) for radius, angle in CORNERS])
    contacts = []
    for name, side in (("entry", 0.5 * math.pi - SPAN), ("exit", 0.5 * math.pi + SPAN)):
        x, y = polar(DEPTH, side)
        pin = Outline.circle(values.pin_radius, (x, y - STAFF[1]))
        copies = CircularCopies(TEETH)
        contacts.append(OutlineContact(name, balance, wheel, outline_i=pin, outline_j=tooth, copies=copies))
    swing = 2.0 * math.pi * values.frequency
    damping = values.balance_inertia * swing / values.quality
    forces = (
        Torque("drive", wheel),
        Torque("load", balance),
        TorsionSpring("hairspring", balance, stiffness=values.balance_inertia * swing * swing),
        Damper("air", balance, damping=damping),
    )
    joints = (Revolute("arbor", wheel.at(0, 0), GROUND), Revolute("staff", balance.at(0, 0), GROUND.at(*STAFF)))
    timed = (beat("balance", values.nominal_period),)
    return Mechanism((wheel, balance), joints, forces, tuple(contacts), oscillations=timed)


MODEL = Model(
    name="PinPallet",
    description="Pin-pallet escapement (Roskopf): a wheel of fifteen teeth, a balance with two pins and a hairspring",
    author="The mechanism_fmu team",
    license="MIT",
    inputs=INPUTS,
    outputs=OUTPUTS,
    parameters=PARAMETERS,
    mechanism=mechanism,
    objections=objections,
    stop_time=4.0,
    step_size=5e-3,
    drawing=(anchor_shape("balance", STAFF, RADIUS * math.tan(SPAN), 0.5 * math.pi - SPAN), ...),
)
