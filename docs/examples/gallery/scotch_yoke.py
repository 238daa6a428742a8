"""Scotch yoke with end stops: a pin in the slot of a slide, which bounces between two stops within its stroke.

Nothing drives it: the crank, with a flywheel, goes on with the speed that it has. Source: one degree of freedom, so
energy between impacts and an elliptic integral for their times.
"""

from mechanism_fmu.model import (
    GROUND,
    Mechanism,
    Model,
    Output,
    PointLineContact,
    Revolute,
    RevoluteTranslational,
    Translational,
    angle_output,
    bar,
    deg,
    fraction_parameter,
    impact_outputs,
    length_parameter,
    rigid_body,
    speed_parameter,
)


def mechanism(values):
    """The yoke in the middle of its stroke, moving left."""
    crank = bar("crank", (0, 0), length=values.crank, angle=deg(90), mass="2 kg", inertia=0.02, speed=values.speed)
    yoke = rigid_body(
        "yoke", mass="3 kg", inertia=0.01, outline=((-0.2, -0.02), (0.2, -0.02), (0.2, 0.02), (-0.2, 0.02))
    )
    bounce, stop = values.bounce, 0.2 + values.stop
    joints = (
        Revolute("hinge", crank.a, GROUND),
        Translational("guide", GROUND.line((0, 0), (1, 0)), yoke.line((0, 0), (1, 0))),
        RevoluteTranslational("slot", yoke.line((0, 0), (0, 1)), crank.b),
    )
    left = PointLineContact("left", yoke.at(-0.2, 0), GROUND.line((-stop, 0), (0, -1)), restitution=bounce)
    right = PointLineContact("right", yoke.at(0.2, 0), GROUND.line((stop, 0), (0, 1)), restitution=bounce)
    impacts = impact_outputs("Impacts on the stops", (Output("closing_speed", "closing_speed", "{impact}", "m/s"),))
    outputs = (Output("x", yoke.x, "Place of the yoke", "m"), angle_output("angle", crank.angle, "Crank"), *impacts)
    return Mechanism((crank, yoke), joints, contacts=(left, right), outputs=outputs, held=(crank.angle,))


SIZES = (
    length_parameter("crank", "100 mm", "Crank"),
    length_parameter("stop", "80 mm", "From the middle to each stop"),
)
REST = (speed_parameter("speed", "60 rpm", "Crank"), fraction_parameter("bounce", 0.8, "Speed that a stop gives back"))
MODEL = Model("ScotchYoke", "Scotch yoke with end stops", (*SIZES, *REST), mechanism, stop_time=2.0)
