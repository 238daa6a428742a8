"""Backspin: a disc is thrown along a floor with backspin; it slips, and rolls on, or comes back if it spins enough.

Source: closed form; it rolls from (v + r omega)/(3 mu g) on, with the speed (2 v - r omega)/3, any book on mechanics.
"""

from mechanism_fmu.model import (
    GROUND,
    CamFlatFollower,
    Marker,
    Mechanism,
    Model,
    Output,
    Parameter,
    circle,
    disc,
    energy_outputs,
    length_parameter,
    settings_parameters,
    speed_output,
    speed_parameter,
)


def mechanism(values):
    """The disc on the floor, moving to the right and turning counter-clockwise; rolling would be clockwise."""
    r, start = values.radius, {"velocity": (values.thrown, 0), "speed": values.backspin}
    wheel = disc("wheel", at=(0, r), radius=r, mass="1.5 kg", **start)
    face = GROUND.line((0, 0), (1, 0))
    round_rim = {"profile_i": circle(r), "unilateral": True, "friction": values.friction}
    floor = CamFlatFollower("floor", wheel.at(0, 0), face, **round_rim)
    outputs = (Output("x", wheel.x, "Of its centre", "m"), Output("velocity", "wheel.x_rate", "Of its centre", "m/s"))
    outputs += (speed_output("speed", wheel.speed, "Wheel"),)
    outputs += (Output("slip", "floor.slip_speed", "At the floor", "m/s"), Output("rolls", "floor.sticks", "", "1"))
    outputs += (Output("drag", "floor.friction_force", "On the wheel", "N"),)
    outputs += energy_outputs("Kinetic", "Of springs", "Of drives", "By friction")
    parts = {"outputs": outputs, "markers": (Marker("rim", wheel.at(0.8 * r, 0)),), "gravity": (0.0, -9.81)}
    return Mechanism((wheel,), contacts=(floor,), **parts)


PARAMETERS = (
    length_parameter("radius", "100 mm", "Of the wheel"),
    Parameter("thrown", 2.0, "Speed of its centre at the start", "m/s", -100.0, 100.0),
    speed_parameter("backspin", 60.0, "At the start"),
    Parameter("friction", 0.25, "On the floor", "1", 0.0, 10.0),
)
PARAMETERS += settings_parameters()
MODEL = Model("Backspin", "Disc that is thrown with backspin", PARAMETERS, mechanism, stop_time=2.5)
