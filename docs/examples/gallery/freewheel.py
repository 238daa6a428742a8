"""Freewheel, as in the hub of a bicycle: a pawl on the driver drives a ring with teeth inside, but lets it run ahead.

The ring coasts, and its teeth pass the pawl with clicks, until the driver has caught up; from there both go together.
The pawl's tip is round; what drives presses it into the root of its tooth.
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
    deg,
    impact_outputs,
    mm,
    rigid_body,
    settings_parameters,
    speed_output,
    speed_parameter,
)
from mechanism_fmu.model.functions import cos, sin


def polar(radius, angle):
    """A point at a distance [mm] and angle [deg]."""
    return mm(radius) * cos(deg(angle)), mm(radius) * sin(deg(angle))


def mechanism(values):
    """Both turn about the origin, forwards counter-clockwise; the pawl's hinge is on the driver, behind its tip."""
    count = 12
    driver = rigid_body("driver", mass="0.5 kg", inertia=values.driver_inertia, speed=values.driver_speed)
    ring = rigid_body("ring", mass="2 kg", inertia=values.ring_inertia, speed=values.ring_speed, angle=deg(20))
    hinge, arm = polar(24, -40), (mm(20), 0.0)
    moving = {
        "velocity": (-values.driver_speed * hinge[1], values.driver_speed * hinge[0]),
        "speed": values.driver_speed,
    }
    pawl = rigid_body("pawl", hinge, mass="10 g", inertia=5e-7, centre=(mm(8), 0.0), angle=deg(65), **moving)
    # of the ring: along a slope inwards to the tip, out along the face that is driven, and back outside
    corners = polar(34, 360 / count), polar(30, 0), polar(37, 0), polar(37, 360 / count)
    tooth = Outline.polygon(corners, (0.0, mm(0.5), 0.0, 0.0))
    tip, copies = Outline.circle(mm(1.5), arm), CircularCopies(count)
    contact = OutlineContact("tooth", pawl, ring, outline_i=tip, outline_j=tooth, copies=copies)
    joints = (
        Revolute("axle", driver.at(0, 0), GROUND),
        Revolute("bearing", ring.at(0, 0), GROUND),
        Revolute("hinge", pawl.at(0, 0), driver.at(*hinge)),
    )
    forces = (Torque("drive", driver, torque=values.torque), Torque("spring", pawl, driver, torque=-2e-3))
    shown = {"driver_rate": driver, "ring_rate": ring, "pawl_rate": pawl}
    outputs = tuple(speed_output(name, body.speed, body.name) for name, body in shown.items())
    outputs += (Output("force", "tooth.force", "Pushes the pawl", "N"),)
    outputs += impact_outputs("Clicks", (Output("closing_speed", "closing_speed", "{impact}", "m/s"),))
    return Mechanism((driver, ring, pawl), joints, forces, (contact,), outputs=outputs)


PARAMETERS = (
    Parameter("torque", "20 N.mm", "On the driver", "N.m", -10.0, 10.0, usual=("0 N.mm", "50 N.mm")),
    speed_parameter("driver_speed", 0.0, "Driver at the start"),
    speed_parameter("ring_speed", 20.0, "Ring at the start"),
    Parameter("driver_inertia", 5e-4, "Of the driver", "kg.m2", 1e-6, 1.0),
    Parameter("ring_inertia", 2e-3, "Of the ring", "kg.m2", 1e-6, 1.0),
)
PARAMETERS += settings_parameters()
MODEL = Model("Freewheel", "Freewheel with a pawl inside a toothed ring", PARAMETERS, mechanism, stop_time=1.0)
