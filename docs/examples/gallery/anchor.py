"""Recoil anchor escapement, as in old wall clocks: the pendulum's swing pushes the wheel back after each tick.

A tooth is on one of two slanting pallets at all times and pushes it outwards: so the pendulum comes back the sooner the
stronger the weight is, which Graham's escapement avoids. Thirty teeth with round tips are copies of one.
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
    deg,
    impact_outputs,
    pin_tooth,
    recoil_pallet,
    rigid_body,
    settings_parameters,
    speed_output,
)
from mechanism_fmu.model.functions import cos, sin


def polar(radius, angle):
    """A point at a distance [m] and angle [rad]."""
    return radius * cos(angle), radius * sin(angle)


def mechanism(values):
    """The wheel turns about the origin, clockwise; the line from the arbor to either pallet touches its circle."""
    radius, count, weight = 0.030, 30, 9.75  # the pendulum's in N, at 1 m from the arbor
    arbor, arm = (0.0, radius / cos(deg(45))), weight / 9.81
    wheel = rigid_body("wheel", mass="50 g", inertia=2e-5, angle=deg(135) + 3e-3 / radius)
    inertia = values.inertia - arm * arm
    anchor = rigid_body("anchor", arbor, mass="1 kg", inertia=inertia, centre=(0.0, -arm), angle=values.start)
    # a tooth is let go 3 deg from the middle, and the next one falls 3 deg on the other side; there the face goes on
    near, far, lift, beyond = radius - 1.1e-3, radius + 1.1e-3, deg(3), deg(4)
    slope = (far - near) / (2 * lift)
    deep = polar(far + slope * beyond, deg(225) - lift - beyond), polar(near - slope * beyond, deg(315) + lift + beyond)
    pallets = {
        "entry": recoil_pallet(deep[0], polar(near, deg(225) + lift), "2 mm", relief_angle=deg(55)),
        "exit": recoil_pallet(deep[1], polar(far, deg(315) - lift), "2 mm", relief_angle=deg(55)),
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
    Parameter("damping", 0.03, "Of the pendulum", "N.m.s/rad", 0.0, 1.0),
    angle_parameter("start", "4 deg", "Anchor at the start"),
)
PARAMETERS += settings_parameters()
MODEL = Model("Anchor", "Recoil anchor escapement with a pendulum", PARAMETERS, mechanism, stop_time=10.0)
