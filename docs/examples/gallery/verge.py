"""Verge and foliot, the oldest escapement of clocks: no spring, no pendulum, only the wheel's torque swings it.

The crown wheel is seen from the side: its near teeth go to the right, its far ones to the left, as two racks that mesh
with it. Two pallets on the verge meet them in turn. Four times the torque makes it twice as fast, by the same angles.
"""

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    LinearCopies,
    Mechanism,
    Model,
    Outline,
    OutlineContact,
    Output,
    Parameter,
    RackAndPinion,
    Revolute,
    Torque,
    angle_output,
    deg,
    impact_outputs,
    polynomial_motion,
    rigid_body,
    settings_parameters,
    speed_output,
)
from mechanism_fmu.model.functions import cos, sin


def polar(radius, angle):
    """A point at a distance [m] and angle [rad]."""
    return radius * cos(angle), radius * sin(angle)


def mechanism(values):
    """The verge turns about the origin, with a pallet on either side below; teeth move 8 mm below it."""
    radius, depth, teeth = 0.020, -0.008, 15
    pitch = 2.0 * deg(180) * radius / teeth
    wheel = rigid_body("wheel", mass="50 g", inertia=0.5 * values.wheel_inertia)
    verge = rigid_body("verge", mass="50 g", inertia=values.inertia)
    tooth = Outline.circle("0.2 mm")
    pallets = {  # from one end of a plate without thickness to the other, which way its teeth move, how far ahead
        "upper": ((polar(0.002, deg(-60)), polar(0.010, deg(-60))), 1.0, 0.0),
        "lower": ((polar(0.010, deg(-120)), polar(0.002, deg(-120))), -1.0, 0.5 * pitch),
    }
    racks, contacts = [], []
    joints = [Revolute("arbor", wheel.at(0, 0), GROUND), Revolute("pivot", verge.at(0, 0), GROUND)]
    for name, (ends, way, ahead) in pallets.items():
        rack = rigid_body(f"{name}_teeth", (0.0, depth), mass=0.25 * values.wheel_inertia / radius**2, inertia=1.0)
        at = -depth - way * radius
        joints.append(AngleDriver(f"{name}_rim", rack, motion=polynomial_motion(0.0)))
        mesh = rack.line((0, at), (way, 0.0)), wheel.at(0, 0), rack.at(0, at)
        joints.append(RackAndPinion(f"{name}_mesh", *mesh, radius_j=radius, angle_j=-way * deg(90)))
        sides = {"outline_i": Outline.chain(ends), "outline_j": tooth.moved(ahead)}
        contacts.append(OutlineContact(name, verge, rack, **sides, copies=LinearCopies((pitch, 0.0))))
        racks.append(rack)
    outputs = (angle_output("wheel", wheel.angle, "Wheel"), angle_output("verge", verge.angle, "Verge"))
    outputs += (speed_output("verge_rate", verge.speed, "Verge"),)
    outputs += impact_outputs("Ticks", (Output("closing_speed", "closing_speed", "{impact}", "m/s"),))
    bodies, drive = (wheel, verge, *racks), Torque("weight", wheel, torque=values.torque)
    return Mechanism(bodies, tuple(joints), (drive,), tuple(contacts), outputs=outputs)


PARAMETERS = (
    Parameter("torque", "1 N.mm", "Of the weight on the wheel", "N.m", 0.0, 1.0, usual=("0.5 N.mm", "4 N.mm")),
    Parameter("wheel_inertia", 2e-5, "Of the wheel with its teeth", "kg.m2", 1e-7, 1.0),
    Parameter("inertia", 2e-5, "Of verge and foliot", "kg.m2", 1e-7, 1.0),
)
PARAMETERS += settings_parameters()
MODEL = Model("Verge", "Verge and foliot", PARAMETERS, mechanism, stop_time=4.0)
