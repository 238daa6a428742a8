"""A ratchet feed: a lever swings to and fro, and its pawl pushes a braked wheel on by one tooth each time.

The wheel has twelve teeth and turns forwards counter-clockwise; thick oil brakes it, and a spring presses the pawl into
its teeth. Back, the pawl slides over the next tooth and falls behind it.
"""

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    CircularCopies,
    Damper,
    Mechanism,
    Model,
    Outline,
    OutlineContact,
    Parameter,
    Revolute,
    Torque,
    deg,
    harmonic_motion,
    mm,
    rigid_body,
    settings_parameters,
)
from mechanism_fmu.model.functions import cos, sin


def polar(radius, angle):
    """A point at a distance [mm] and angle [deg]."""
    return mm(radius) * cos(deg(angle)), mm(radius) * sin(deg(angle))


def mechanism(values):
    """All turn about the origin but the pawl, whose hinge is on the lever, behind its tip."""
    count = 12
    lever = rigid_body("lever", mass="0.5 kg", inertia=5e-4)
    wheel = rigid_body("wheel", mass="2 kg", inertia=values.wheel_inertia, angle=deg(20))
    hinge, arm = polar(24, -40), (mm(20), 0.0)
    pawl = rigid_body("pawl", hinge, mass="10 g", inertia=5e-7, centre=(mm(8), 0.0), angle=deg(65))
    corners = polar(34, 360 / count), polar(30, 0), polar(37, 0), polar(37, 360 / count)
    tooth = Outline.polygon(corners, (0.0, mm(0.5), 0.0, 0.0))
    tip, copies = Outline.circle(mm(1.5), arm), CircularCopies(count)
    contact = OutlineContact("tooth", pawl, wheel, outline_i=tip, outline_j=tooth, copies=copies)
    joints = (
        Revolute("axle", lever.at(0, 0), GROUND),
        Revolute("bearing", wheel.at(0, 0), GROUND),
        Revolute("hinge", pawl.at(0, 0), lever.at(*hinge)),
        AngleDriver("swing", lever, motion=harmonic_motion(0.0, values.swing, deg(360), values.phase)),
    )
    forces = (Torque("spring", pawl, lever, torque=-2e-3), Damper("oil", wheel, damping=values.damping))
    return Mechanism((lever, wheel, pawl), joints, forces, (contact,))


PARAMETERS = (
    Parameter("swing", "20 deg", "Of the lever, to either side", "rad", 0.0, 1.0),
    Parameter("phase", "211.5 deg", "Of the lever at the start: on its way back", "rad", -7.0, 7.0),
    Parameter("wheel_inertia", 2e-3, "Of the wheel", "kg.m2", 1e-6, 1.0),
    Parameter("damping", 2e-2, "Of the oil on the wheel", "N.m.s/rad", 0.0, 10.0),
)
PARAMETERS += settings_parameters()
MODEL = Model("FeedRatchet", "Ratchet feed by a lever that swings", PARAMETERS, mechanism, stop_time=5.0)
