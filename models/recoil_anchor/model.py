"""The recoil anchor escapement: an escape wheel of thirty teeth, and an anchor with a pendulum.

Frame: the wheel's axis at the origin, the anchor's arbor above it; the wheel turns counter-clockwise, the pendulum
hangs straight down at its angle 0. Equations and sources: README.md beside this file.
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
    OutlineContact,
    Revolute,
    Torque,
    pin_tooth,
    port_builders as ports,
    recoil_pallet,
    rigid_body,
)
from mechanism_fmu.model.findings import size
from mechanism_fmu.model.timekeeping import (
    anchor_drop,
    anchor_room,
    anchor_shape,
    beat,
    drive_input,
    drop_finding,
    nominal_period_parameter,
    pendulum_parameters,
    polar,
    timekeeping_outputs,
    wheel_shape,
)

#: Teeth of the wheel; the radius to a pallet and the line of centres are so far apart [rad].
TEETH, SPAN = 30, math.radians(45)
#: Radius of the circle of the teeth's tips [m], and from the arbor to the pallets.
RADIUS = 0.030
ARM = RADIUS * math.tan(SPAN)
ARBOR = (0.0, RADIUS / math.cos(SPAN))
#: The same between the line of centres and the line from the arbor to the pallet, which is at a right angle to it.
ASIDE = 0.5 * math.pi - SPAN
#: Beyond the lift faces go on [rad]; sides of a pallet lean back [rad], and it is so thick behind its face [m].
BEYOND, RELIEF, BEHIND = math.radians(8), math.radians(55), 2e-3
#: So far stands a tooth from its pallet at the start, at least [m].
FREE = 5e-4

INPUTS = (
    drive_input("16 N.mm", "weight", usual=("8 N.mm", "64 N.mm")),
    ports.load_torque_input("pendulum", usual=(-5e-3, 5e-3)),
)
OUTPUTS = timekeeping_outputs("pendulum", "theta", energy=1e-2, power=1e-3)

PARAMETERS = (
    ports.inertia_parameter("wheel_inertia", 2e-5, "Moment of inertia of the escape wheel about its axis"),
    ports.length_parameter("tip_radius", "0.2 mm", "Radius of the tips", 1e-6, usual=(5e-5, 4e-4)),
    ports.length_parameter(
        "pallet_thickness", "2.2 mm", "Between circles about the arbor at which teeth leave", 1e-6, usual=(2e-3, 2.7e-3)
    ),
    ports.angle_parameter("lift_angle", "6 deg", "Of the anchor from where a tooth is let go to the next", 1e-3, 0.3),
    *pendulum_parameters(1.0038, damping=0.03, start="-5.4 deg"),
    nominal_period_parameter(2.0),
    *ports.settings_parameters(),
)


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the wheel cannot turn."""
    thick, tip = values.pallet_thickness, values.tip_radius
    drop, most = anchor_drop(TEETH, RADIUS, SPAN, thick, tip), anchor_room(TEETH, RADIUS, SPAN) - 0.5 * thick
    return (drop_finding(drop, most, thick, tip),)


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The escapement for parameter values that raise no objection."""
    half, lift = 0.5 * values.pallet_thickness, 0.5 * values.lift_angle
    # a tooth is let go where the anchor is half the lift from the middle, and the next one falls there on the other
    # side; from there the face goes on
    near, far, further = ARM - half, ARM + half, (lift + BEYOND) * half / lift
    entry, exit_ = 1.5 * math.pi + ASIDE, 1.5 * math.pi - ASIDE
    pallets = {
        "entry": recoil_pallet(
            polar(near, entry - lift), polar(ARM + further, entry + lift + BEYOND), BEHIND, relief_angle=-RELIEF
        ),
        "exit": recoil_pallet(
            polar(far, exit_ + lift), polar(ARM - further, exit_ - lift - BEYOND), BEHIND, relief_angle=-RELIEF
        ),
    }
    # where the face of the entry pallet is at the start, seen along the way of the teeth
    face = half * size(values.pendulum_angle_start) / lift
    behind = (face + 1.5 * values.tip_radius + FREE) / RADIUS
    wheel = rigid_body("wheel", mass="50 g", inertia=values.wheel_inertia, angle=0.5 * math.pi - SPAN - behind)
    pendulum = rigid_body(
        "pendulum",
        ARBOR,
        mass=values.pendulum_mass,
        inertia=values.pendulum_inertia,
        centre=(0.0, -values.pendulum_length),
        angle=values.pendulum_angle_start,
    )
    tooth, copies = pin_tooth(TEETH, RADIUS, values.tip_radius), CircularCopies(TEETH)
    contacts = tuple(
        OutlineContact(name, pendulum, wheel, outline_i=pallet, outline_j=tooth, copies=copies, points=2)
        for name, pallet in pallets.items()
    )
    joints = (Revolute("axis", wheel.at(0, 0), GROUND), Revolute("arbor", pendulum.at(0, 0), GROUND.at(*ARBOR)))
    forces = (
        Torque("drive", wheel),
        Torque("load", pendulum),
        Damper("air", pendulum, damping=values.pendulum_damping),
    )
    timed, down = (beat("pendulum", values.nominal_period),), (0.0, -values.gravity)
    return Mechanism((wheel, pendulum), joints, forces, contacts, gravity=down, oscillations=timed)


MODEL = Model(
    name="RecoilAnchor",
    description="Recoil anchor escapement: a wheel of thirty teeth, an anchor with slanting pallets, a pendulum",
    author="The mechanism_fmu team",
    license="MIT",
    inputs=INPUTS,
    outputs=OUTPUTS,
    parameters=PARAMETERS,
    mechanism=mechanism,
    objections=objections,
    stop_time=10.0,
    step_size=1e-2,
    drawing=(wheel_shape(TEETH, RADIUS), anchor_shape("pendulum", ARBOR, ARM, ASIDE), ...),
)
