"""Pin-pallet escapement, as in Roskopf's watch: two pins on the lever of a balance let a tooth pass at each swing.

The wheel's torque pushes each pin along the sloping end of a tooth and so keeps the balance swinging; between the
pushes a tooth rests on a pin. Teeth and pins are outlines; the fifteen teeth are copies of one.
"""

from mechanism_fmu.model import (
    GROUND,
    CircularCopies,
    Damper,
    Mechanism,
    Model,
    Outline,
    OutlineContact,
    Output,
    Parameter,
    Revolute,
    Torque,
    TorsionSpring,
    angle_output,
    angle_parameter,
    deg,
    impact_outputs,
    rigid_body,
    settings_parameters,
    speed_output,
)
from mechanism_fmu.model.functions import cos, sin


def polar(radius, angle):
    """A point at a distance [m] and angle [rad]."""
    return radius * cos(angle), radius * sin(angle)


def mechanism(values):
    """The wheel turns about the origin, clockwise; the pins are 42 deg beside the line to the lever's hinge."""
    hinge = (0.0, 0.030 / cos(deg(42)))
    wheel = rigid_body("wheel", mass="5 g", inertia=2e-6, angle=deg(138.1))
    lever = rigid_body("lever", hinge, mass="50 g", inertia=values.inertia, angle=values.start)
    corners = (0.0250, -4.6), (0.0290, -4.6), (0.0304, 4.6), (0.0250, 2.6)
    tooth = Outline.chain([polar(radius, deg(angle)) for radius, angle in corners])
    contacts = []
    for name, side in (("entry", deg(132)), ("exit", deg(48))):
        x, y = polar(0.0298, side)
        pin = Outline.circle("0.4 mm", (x, y - hinge[1]))
        contacts.append(OutlineContact(name, lever, wheel, outline_i=pin, outline_j=tooth, copies=CircularCopies(15)))
    joints = (Revolute("arbor", wheel.at(0, 0), GROUND), Revolute("staff", lever.at(0, 0), GROUND.at(*hinge)))
    swing = values.frequency * 2.0 * deg(180)
    stiffness, damping = values.inertia * swing * swing, values.inertia * swing / values.quality
    forces = (
        Torque("mainspring", wheel, torque=-1.0 * values.torque),
        TorsionSpring("hairspring", lever, stiffness=stiffness),
        Damper("air", lever, damping=damping),
    )
    outputs = (angle_output("wheel", wheel.angle, "Wheel"), angle_output("lever", lever.angle, "Lever"))
    outputs += (speed_output("lever_rate", lever.speed, "Lever"),)
    outputs += impact_outputs("Ticks", (Output("closing_speed", "closing_speed", "{impact}", "m/s"),))
    return Mechanism((wheel, lever), joints, forces, tuple(contacts), outputs=outputs)


PARAMETERS = (
    Parameter("torque", "0.6 N.mm", "Of the mainspring on the wheel", "N.m", 0.0, 1.0, usual=("0.4 N.mm", "1 N.mm")),
    Parameter("inertia", 2e-4, "Of lever and balance", "kg.m2", 1e-6, 1.0),
    Parameter("frequency", 2.5, "Of the balance alone", "Hz", 0.1, 100.0),
    Parameter("quality", 10.0, "Factor of the balance", "1", 1.0, 1e4),
    angle_parameter("start", "6 deg", "Lever at the start"),
)
PARAMETERS += settings_parameters()
MODEL = Model("PinPallet", "Pin-pallet escapement with fifteen teeth", PARAMETERS, mechanism, stop_time=4.0)
