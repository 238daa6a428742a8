"""Ratchet wheel with two pawls half a pitch apart: it is held every half pitch, as if it had twice as many teeth.

The wheel is thrown forwards against a torque, clicks on, comes back, and rests on one of the pawls. Their tips are
round and slide over the tips of the teeth.
"""

from mechanism_fmu.model import (
    GROUND,
    CircularCopies,
    Mechanism,
    Model,
    Outline,
    OutlineContact,
    Output,
    Parameter,
    Revolute,
    Torque,
    angle_output,
    deg,
    impact_outputs,
    ratchet_tooth,
    rigid_body,
    settings_parameters,
    speed_output,
    speed_parameter,
)
from mechanism_fmu.model.functions import cos, sin


def mechanism(values):
    """The wheel turns about the origin, forwards counter-clockwise; the second pawl is the first, turned about it."""
    count, half_pitch = 12, deg(15)
    wheel = rigid_body("wheel", mass="2 kg", inertia=values.inertia, angle=deg(83), speed=values.speed)
    tooth = ratchet_tooth(count, deg(90), "100 mm", 1.1, tip_radius="1 mm", root_fillet="1 mm")
    tip, copies = Outline.circle("2 mm", ("100 mm", 0.0)), CircularCopies(count)
    bodies, contacts, joints = [wheel], [], [Revolute("arbor", wheel.at(0, 0), GROUND)]
    forces = [Torque("load", wheel, torque=-1.0 * values.load)]
    for name, turn in (("first", 0.0), ("second", deg(90) + half_pitch)):
        c, s = cos(turn), sin(turn)
        hinge = 0.09 * c - 0.15 * s, 0.09 * s + 0.15 * c
        pawl = rigid_body(
            f"{name}_pawl", hinge, mass="0.1 kg", inertia=1e-4, centre=("50 mm", 0.0), angle=deg(192) + turn
        )
        bodies.append(pawl)
        joints.append(Revolute(f"{name}_hinge", pawl.at(0, 0), GROUND.at(*hinge)))
        forces.append(Torque(f"{name}_spring", pawl, torque=0.3))
        contacts.append(OutlineContact(name, pawl, wheel, outline_i=tip, outline_j=tooth, copies=copies))
    outputs = (angle_output("wheel", wheel.angle, "Wheel"), speed_output("wheel_rate", wheel.speed, "Wheel"))
    for name in ("first", "second"):
        outputs += (Output(f"{name}_force", f"{name}.force", "Pushes the pawl", "N"),)
    outputs += impact_outputs("Clicks", (Output("closing_speed", "closing_speed", "{impact}", "m/s"),))
    return Mechanism(tuple(bodies), tuple(joints), tuple(forces), tuple(contacts), outputs=outputs)


PARAMETERS = (
    speed_parameter("speed", 12.0, "Wheel at the start"),
    Parameter("load", 1.0, "Turns the wheel back", "N.m", 0.0, 10.0),
    Parameter("inertia", 0.02, "Of the wheel", "kg.m2", 1e-4, 1.0),
)
PARAMETERS += settings_parameters()
MODEL = Model("TwoPawls", "Ratchet wheel with two pawls half a pitch apart", PARAMETERS, mechanism, stop_time=1.0)
