"""Door closer: a spring closes the door, and a damper that acts only while it closes keeps it from slamming.

The door is pushed open and let go. Source: a swing without damping on the way out, an overdamped one on the way back,
both in closed form.
"""

from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    Mechanism,
    Model,
    NonlinearTorsionSpring,
    Output,
    Parameter,
    Revolute,
    angle_output,
    bar,
    impact_outputs,
    speed_output,
    speed_parameter,
    stiffness_parameter,
)
from mechanism_fmu.model.functions import minimum


def mechanism(values):
    """The door from above, closed; its frame is a stop."""

    def closer(angle, rate):
        return values.stiffness * (angle + values.preload) + values.damping * minimum(rate, 0.0)

    door = bar("door", (0, 0), (0.9, 0), mass="30 kg", speed=values.push)
    hinge = Revolute("hinge", door.a, GROUND)
    frame = AngleStop("frame", door, GROUND, angle=0.0)
    spring = NonlinearTorsionSpring("closer", door, GROUND, law=closer)
    outputs = (angle_output("angle", door.angle, "Door"), speed_output("speed", door.speed, "Door"))
    outputs += impact_outputs("Impacts on the frame", (Output("closing_speed", "closing_speed", "{impact}", "rad/s"),))
    return Mechanism((door,), (hinge,), (spring,), (frame,), outputs=outputs, held=(door.angle,))


PARAMETERS = (
    stiffness_parameter("stiffness", 12.0, "Of the spring"),
    Parameter("preload", 0.4, "Angle by which the spring is wound up when the door is closed", "rad", 0.0, 10.0),
    Parameter("damping", 40.0, "Of the damper", "N.m.s/rad", 0.0, 1e4),
    speed_parameter("push", 2.0, "Speed at which the door begins to open"),
)
MODEL = Model("DoorCloser", "Door closer", PARAMETERS, mechanism, stop_time=12.0)
