"""Wedge: under a load it holds by friction on both its faces, or is squeezed out; a push drives it in.

Without weight it locks itself where its angle is below twice the angle of friction, tan(phi) = mu; its weight helps it.
Source: equilibrium of load and wedge with both reactions inclined by phi, any book on statics.
"""

from mechanism_fmu.model import (
    GROUND,
    Input,
    Mechanism,
    Model,
    Output,
    Parameter,
    PointForce,
    PointLineContact,
    Translational,
    angle_parameter,
    mass_parameter,
    plate,
    settings_parameters,
)
from mechanism_fmu.model.functions import cos, sin


def mechanism(values):
    """The wedge on the floor with its thin end to the left, and the load on the middle of its slope."""
    length, angle = 0.4, values.angle
    rise = length * sin(angle) / cos(angle)
    wedge = plate("wedge", ((0, 0), (length, 0), (length, rise)), mass=values.wedge)
    foot, floor, up = (0.2, rise / 2), GROUND.line((0, 0), (1, 0)), (0, 1)
    sides = ((0, 0), (0.05, 0.04), (0.05, 0.2), (-0.05, 0.2), (-0.05, 0.04))
    load = plate("load", sides, mass=values.load, at=foot)
    joints = (
        Translational("floor", floor, wedge.line((0, 0), (1, 0)), friction=values.friction),
        Translational("guide", GROUND.line((0.2, 0), up), load.line((0, 0), up)),
    )
    slope = wedge.line((0, 0), (cos(angle), sin(angle)))
    slope = PointLineContact("slope", load.at(0, 0), slope, closed=True, friction=values.friction)
    push = PointForce("push", wedge.at(length, 0))
    outputs = (Output("x", wedge.x, "Of the wedge", "m"), Output("speed", "wedge.x_rate", "Of the wedge", "m/s"))
    outputs += (Output("height", load.y, "Of the load", "m"), Output("normal", "slope.force", "On the load", "N"))
    ports = {"inputs": (Input("push", "push.x", 0.0, "Outwards", "N", usual=(0.0, 300.0)),), "outputs": outputs}
    parts = {"contacts": (slope,), "gravity": (0.0, -9.81), "held": (wedge.x,), **ports}
    return Mechanism((wedge, load), joints, (push,), **parts)


PARAMETERS = (
    *(mass_parameter("wedge", "1 kg", "Of the wedge"), mass_parameter("load", "30 kg", "Of the load")),
    angle_parameter("angle", "20 deg", "Of the wedge", 0.01, 1.2),
    Parameter("friction", 0.15, "On both faces", "1", 0.0, 10.0),
)
PARAMETERS += settings_parameters()
MODEL = Model("Wedge", "Wedge under a load", PARAMETERS, mechanism, stop_time=0.5)
