"""Verge and foliot: a crown wheel of fifteen teeth, and a verge with two pallets that carries the foliot.

The crown wheel is seen from the side: its near teeth go one way, its far ones the other, as two racks that mesh with
it. Frame: the verge at the origin, the teeth's tips on a line below it. At the angle 0 both pallets point as far to
either side. Equations and sources: README.md beside this file.
"""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Finding,
    LinearCopies,
    Mechanism,
    Model,
    Outline,
    OutlineContact,
    Polyline,
    RackAndPinion,
    Revolute,
    Torque,
    deg,
    polynomial_motion,
    port_builders as ports,
    rigid_body,
)
from mechanism_fmu.model.findings import at_most
from mechanism_fmu.model.timekeeping import (
    beat,
    drive_input,
    nominal_period_parameter,
    polar,
    timekeeping_outputs,
)

#: Teeth of the wheel, radius of their tips' circle, and how far below the verge they go [m].
TEETH, RADIUS, DEPTH = 15, 0.020, 0.008
#: Pallets, plates without thickness, reach from this distance from the verge to that [m].
PALLET = (0.002, 0.010)
#: Angle of each from straight down, where that of the foliot is 0 [rad].
BESIDE = math.radians(30)
PITCH = 2.0 * math.pi * RADIUS / TEETH

INPUTS = (
    drive_input("0.534 N.mm", "weight", usual=("0.25 N.mm", "2 N.mm")),
    ports.load_torque_input("foliot", usual=(-2e-4, 2e-4)),
)
OUTPUTS = timekeeping_outputs("foliot", "theta", energy=1e-3, power=1e-3)

PARAMETERS = (
    ports.inertia_parameter("wheel_inertia", 2e-5, "Moment of inertia of the crown wheel with its teeth"),
    ports.inertia_parameter("foliot_inertia", 2e-5, "Moment of inertia of verge and foliot"),
    ports.length_parameter("tip_radius", "0.2 mm", "Radius of the teeth's tips", 1e-6, usual=(1e-4, 4e-4)),
    nominal_period_parameter(1.0),
    *ports.settings_parameters(),
)


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the wheel cannot turn: a tooth leaves at the end of one pallet, and the next one must still be free."""
    leaves = math.acos(DEPTH / PALLET[1])  # angle from straight down of a pallet whose end is as deep as the teeth
    other = 2.0 * BESIDE - leaves
    room = 0.5 * PITCH - DEPTH * (math.tan(leaves) - math.tan(other))
    most = room / (1.0 + 1.0 / math.cos(other))
    tip = values.tip_radius
    return (
        Finding(
            at_most(most, tip),
            "The verge jams: with tip_radius = {:.6g} m the drop of the wheel is {:.4g} deg, but it must be positive: "
            "a tooth cannot leave one pallet before another is on the other. Give less than {:.4g} m.",
            (tip, (room - tip * room / most) / RADIUS * (180.0 / math.pi), most),
        ),
    )


def mechanism(values: SimpleNamespace) -> Mechanism:
    """The escapement for parameter values that raise no objection."""
    # a quarter of the wheel's inertia goes with each rack's mass, which moves as fast as the rim
    wheel = rigid_body("wheel", mass="50 g", inertia=0.5 * values.wheel_inertia)
    foliot = rigid_body("foliot", mass="50 g", inertia=values.foliot_inertia)
    down = -0.5 * math.pi
    tooth, (near, far) = Outline.circle(values.tip_radius), PALLET
    pallets = {  # from one end of a plate to the other, which way its teeth move, how far ahead
        "upper": ((polar(near, down + BESIDE), polar(far, down + BESIDE)), 1.0, 0.0),
        "lower": ((polar(far, down - BESIDE), polar(near, down - BESIDE)), -1.0, 0.5 * PITCH),
    }
    racks, contacts = [], []
    joints: list[Revolute | AngleDriver | RackAndPinion] = [
        Revolute("arbor", wheel.at(0, 0), GROUND),
        Revolute("pivot", foliot.at(0, 0), GROUND),
    ]
    for name, (ends, way, ahead) in pallets.items():
        mass = 0.25 * values.wheel_inertia / RADIUS**2
        rack = rigid_body(f"{name}_teeth", (0.0, -DEPTH), mass=mass, inertia=1.0)
        at = DEPTH - way * RADIUS
        joints.append(AngleDriver(f"{name}_rim", rack, motion=polynomial_motion(0.0)))
        mesh = rack.line((0, at), (way, 0.0)), wheel.at(0, 0), rack.at(0, at)
        joints.append(RackAndPinion(f"{name}_mesh", *mesh, radius_j=RADIUS, angle_j=-way * deg(90)))
        sides = {"outline_i": Outline.chain(ends), "outline_j": tooth.moved(ahead)}
        contacts.append(OutlineContact(name, foliot, rack, **sides, copies=LinearCopies((PITCH, 0.0))))
        racks.append(rack)
    timed = (beat("foliot", values.nominal_period),)
    bodies, forces = (wheel, foliot, *racks), (Torque("drive", wheel), Torque("load", foliot))
    return Mechanism(bodies, tuple(joints), forces, tuple(contacts), oscillations=timed)


MODEL = Model(
    name="Verge",
    description="Verge and foliot: a crown wheel of fifteen teeth, a verge with two pallets, no spring and no pendulum",
    author="The mechanism_fmu team",
    license="MIT",
    inputs=INPUTS,
    outputs=OUTPUTS,
    parameters=PARAMETERS,
    mechanism=mechanism,
    objections=objections,
    stop_time=4.0,
    step_size=5e-3,
    drawing=(Polyline("bar", (0.0, 0.0), "foliot_angle", ((-0.035, 0.0), (0.035, 0.0))), ...),
)
