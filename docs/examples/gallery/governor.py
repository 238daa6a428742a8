"""Centrifugal governor: two balls swing out as the shaft turns faster, and lift a sleeve.

It is drawn in the plane that turns with the shaft; there, what drives the balls apart is a law of their distance, mass
omega^2 r. Links from the balls to the sleeve are as long as the arms. Source: at rest in that plane, cos(theta) =
(1 + sleeve mass/ball mass) g/(omega^2 l), any book on machines (Porter governor).
"""

from mechanism_fmu.model import (
    GROUND,
    Distance,
    Mechanism,
    Model,
    NonlinearSpring,
    Output,
    Parameter,
    Revolute,
    SpringDamper,
    Translational,
    angle_output,
    angle_parameter,
    bar,
    mass_parameter,
    rigid_body,
    speed_output,
    speed_parameter,
)
from mechanism_fmu.model.functions import cos, sin


def mechanism(values):
    """The governor, its arms at the start angle from the shaft, which points up."""
    length, theta, ball = 0.3, values.start, values.ball
    x, y = length * sin(theta), -length * cos(theta)
    arm = {"mass": ball, "centre": (length, 0), "inertia": 1e-9, "length": length}
    left, right = bar("left", (0, 0), (-x, y), **arm), bar("right", (0, 0), (x, y), **arm)
    sleeve = rigid_body("sleeve", (0, 2 * y), mass=values.sleeve, inertia=1e-3)
    joints = (
        Revolute("left_hinge", left.a, GROUND),
        Revolute("right_hinge", right.a, GROUND),
        Distance("left_link", left.b, sleeve, distance=length),
        Distance("right_link", right.b, sleeve, distance=length),
        Translational("shaft", GROUND.line((0, 0), (0, 1)), sleeve.line((0, 0), (0, 1))),
    )

    def centrifugal(distance, rate):
        return -ball * values.speed * values.speed * distance / 2

    apart = NonlinearSpring("apart", left.b, right.b, law=centrifugal)
    oil = SpringDamper("oil", sleeve, GROUND, damping=values.damping)
    outputs = (angle_output("angle", right.angle, "Right arm"), speed_output("rate", right.speed, "Right arm"))
    outputs += (Output("height", sleeve.y, "Of the sleeve", "m"),)
    bodies, gravity = (left, right, sleeve), (0.0, -9.81)
    return Mechanism(bodies, joints, (apart, oil), gravity=gravity, outputs=outputs, held=(right.angle,))


PARAMETERS = (
    *(mass_parameter("ball", "1 kg", "Mass of each ball"), mass_parameter("sleeve", "2 kg", "Mass of the sleeve")),
    *(speed_parameter("speed", "150 rpm", "Of the shaft"), angle_parameter("start", "30 deg", "Arms at the start")),
    Parameter("damping", 40.0, "Of the sleeve", "N.s/m", 0.0, 1e4),
)
MODEL = Model("Governor", "Centrifugal governor", PARAMETERS, mechanism, stop_time=4.0)
