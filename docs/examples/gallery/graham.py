"""Graham's dead-beat escapement: a pendulum's anchor lets a tooth pass at each swing, and takes a push from it.

Between the pushes a tooth rests on an arc about the anchor's arbor and turns it neither way: so the rate hardly depends
on the torque. Thirty teeth with round tips are copies of one; both pallets are ready outlines.
"""

from mechanism_fmu.model import (
    GROUND,
    CircularCopies,
    Damper,
    Mechanism,
    Model,
    OutlineContact,
    Output,
    Parameter,
    Revolute,
    Torque,
    angle_output,
    angle_parameter,
    deadbeat_pallet,
    deg,
    impact_outputs,
    pin_tooth,
    rigid_body,
    settings_parameters,
    speed_output,
)
from mechanism_fmu.model.functions import cos


def mechanism(values):
    """The wheel turns about the origin, clockwise; the line from the arbor to either pallet touches its circle."""
    radius, count, weight = 0.030, 30, 9.75  # the pendulum's in N, at 1 m from the arbor
    arbor, arm = (0.0, radius / cos(deg(45))), weight / 9.81
    wheel = rigid_body("wheel", mass="50 g", inertia=2e-5, angle=deg(135) + 1.7e-3 / radius)
    inertia = values.inertia - arm * arm
    anchor = rigid_body("anchor", arbor, mass="1 kg", inertia=inertia, centre=(0.0, -arm), angle=values.start)
    inner, outer = radius - 1.3e-3, radius + 1.3e-3
    pallets = {  # corners of the impulse face on the inner and the outer arc, and the far end
        "entry": deadbeat_pallet(inner, outer, deg(226.5), deg(224.5), deg(216.5)),
        "exit": deadbeat_pallet(inner, outer, deg(315.5), deg(313.5), deg(323.5)),
    }
    tooth, copies = pin_tooth(count, radius, "0.2 mm"), CircularCopies(count)
    contacts = tuple(
        OutlineContact(name, anchor, wheel, outline_i=pallet, outline_j=tooth, copies=copies)
        for name, pallet in pallets.items()
    )
    joints = (Revolute("pivot", wheel.at(0, 0), GROUND), Revolute("arbor", anchor.at(0, 0), GROUND.at(*arbor)))
    forces = (Torque("weight", wheel, torque=-1.0 * values.torque), Damper("air", anchor, damping=values.damping))
    outputs = (angle_output("wheel", wheel.angle, "Wheel"), angle_output("anchor", anchor.angle, "Anchor"))
    outputs += (speed_output("anchor_rate", anchor.speed, "Anchor"),)
    outputs += impact_outputs("Ticks", (Output("closing_speed", "closing_speed", "{impact}", "m/s"),))
    return Mechanism((wheel, anchor), joints, forces, contacts, outputs=outputs, gravity=(0.0, -9.81))


PARAMETERS = (
    Parameter("torque", "12 N.mm", "Of the weight on the wheel", "N.m", 0.0, 0.1, usual=("8 N.mm", "20 N.mm")),
    Parameter("inertia", 0.988, "Of the pendulum about its arbor", "kg.m2", 0.9879, 2.0),
    Parameter("damping", 0.1, "Of the pendulum", "N.m.s/rad", 0.0, 1.0),
    angle_parameter("start", "3 deg", "Anchor at the start"),
)
PARAMETERS += settings_parameters()
MODEL = Model("Graham", "Graham's dead-beat escapement with a pendulum", PARAMETERS, mechanism, stop_time=10.0)
