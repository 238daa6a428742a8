"""Woodpecker toy: a sleeve jams on a pole; the bird on its spring swings, frees it, pecks, and both fall a little.

The pole is beside the sleeve and the beak on one side, as in the source, which knows angles of first order only: so is
a toy many times as large with the same clearances. Source: Leine, Glocker, van Campen, Nonlinear dynamics of the
woodpecker toy, DETC2001/VIB-21608 (2001), with the data of Glocker 1995.
"""

from mechanism_fmu.model import (
    GROUND,
    Marker,
    Mechanism,
    Model,
    Output,
    Parameter,
    PointLineContact,
    Revolute,
    RevoluteTranslational,
    TorsionSpring,
    angle_output,
    angle_parameter,
    impact_outputs,
    rigid_body,
    settings_parameters,
    speed_output,
)
from mechanism_fmu.model.functions import cos, sin


def mechanism(values):
    """The toy at rest, its sleeve jammed at the bottom; its clearances at the pole are 0.6 mm and 2.4 mm."""
    n, turn, start = values.size, values.size * values.size, values.start / values.size
    pin, centre, high = 0.010 * n, 0.015 * n, 0.0058 * n
    sleeve = rigid_body("sleeve", (0, 0), mass="0.3 g", inertia=5e-9 * turn, angle=-0.1 / n)
    at = (pin + centre * cos(start), centre * sin(start))
    bird = rigid_body("bird", at, mass="4.5 g", inertia=7e-7 * turn, angle=start)
    joints = (
        Revolute("pin", sleeve.at(pin, 0), bird.at(-centre, 0)),
        RevoluteTranslational("guide", GROUND.line((0, 0), (0, 1)), sleeve),
    )
    spring = TorsionSpring("spring", bird, sleeve, stiffness=0.0056 * turn)
    pole = GROUND.line((0.0031 * n - 0.0006, 0), (0, -1))
    pecked = GROUND.line((0.0049 * n - 0.0024, 0), (0, -1))
    beak = {"restitution": values.restitution, "friction": values.friction}
    contacts = (
        PointLineContact("beak", bird.at(-0.0201 * n, 0.020 * n), pecked, **beak),
        PointLineContact("bottom", sleeve.at(0.0031 * n, -high), pole, closed=True, friction=values.friction),
        PointLineContact("top", sleeve.at(0.0031 * n, high), pole, friction=values.friction),
    )
    outputs = (Output("height", sleeve.y, "Of the sleeve", "m"), Output("fall", "sleeve.y_rate", "Its rate", "m/s"))
    outputs += (angle_output("sleeve", sleeve.angle, "Sleeve"), speed_output("sleeve_rate", sleeve.speed, "Sleeve"))
    outputs += (angle_output("bird", bird.angle, "Bird"), speed_output("bird_rate", bird.speed, "Bird"))
    outputs += (Output("jams", "bottom.sticks", "Whether the sleeve sticks at its bottom", "1"),)
    outputs += impact_outputs("Impacts on the pole", (Output("closing_speed", "closing_speed", "{impact}", "m/s"),))
    parts = {"outputs": outputs, "gravity": (0.0, -9.81), "held": (sleeve.y, bird.angle)}
    parts["markers"] = (Marker("middle", bird),)
    return Mechanism((sleeve, bird), joints, (spring,), contacts, **parts)


PARAMETERS = (
    angle_parameter("start", "-0.47795 rad", "Bird at the start, times size: its limit cycle"),
    Parameter("restitution", 0.5, "Of the beak", "1", 0.0, 1.0),
    Parameter("friction", 0.3, "Of beak and sleeve on the pole", "1", 0.0, 10.0),
    Parameter("size", 1.0, "Lengths over those of the toy, with its clearances", "1", 1.0, 1e5),
)
PARAMETERS += settings_parameters()
MODEL = Model("Woodpecker", "Woodpecker toy that pecks its way down a pole", PARAMETERS, mechanism, stop_time=0.4)
