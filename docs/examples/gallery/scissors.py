"""Scissors lifts: a hundred bars, crossed in pairs, raised and lowered by drives at their feet.

Five lifts of ten stages, each a fifth of a period behind the one beside it. Where a foot is, all bars above it are: 300
coordinates, 300 rows. Source: virtual work; any book on mechanisms.
"""

from mechanism_fmu.model import (
    GROUND,
    Marker,
    Mechanism,
    Model,
    Output,
    Parameter,
    Revolute,
    RevoluteTranslational,
    XDriver,
    bar,
    deg,
    harmonic_motion,
)
from mechanism_fmu.model.functions import cos, sin, sqrt

LIFTS, STAGES, LENGTH, APART = 5, 10, 0.5, 0.6


def mechanism(values):
    """All lifts; heights of the first two tops, and the force of the first drive."""
    lifts = [lift(number, values.angle, values.stroke) for number in range(LIFTS)]
    bodies, joints = (tuple(part for one in lifts for part in one[which]) for which in (0, 1))
    tops = tuple(top for _, _, top in lifts)
    outputs = (
        Output("height", tops[0].y, "Height of the first top", "m"),
        Output("next_height", tops[1].y, "Height of the second top", "m"),
        Output("force", "drive0.force", "Force of the first drive on its foot", "N"),
    )
    return Mechanism(bodies, joints, markers=tops, outputs=outputs, gravity=(0.0, -9.81))


def lift(number, angle, stroke):
    """Bars and joints of one lift, and its top: of each stage, one bar rises to the right and one to the left."""
    bodies, joints, x = [], [], APART * number
    phase, middle = deg(72) * number, LENGTH * cos(angle)
    wide = middle + stroke * sin(phase)
    high = sqrt(LENGTH * LENGTH - wide * wide)
    left, right = GROUND.at(x, 0), None
    for k in range(STAGES):
        rises = bar(f"right{number}_{k}", (x, k * high), (x + wide, (k + 1) * high), mass="0.2 kg")
        falls = bar(f"left{number}_{k}", (x + wide, k * high), (x, (k + 1) * high), mass="0.2 kg")
        joints.append(Revolute(f"middle{number}_{k}", rises.at(LENGTH / 2, 0), falls.at(LENGTH / 2, 0)))
        joints.append(Revolute(f"at_left{number}_{k}", rises.a, left))
        if right is None:
            joints.append(RevoluteTranslational(f"floor{number}", GROUND.line((0, 0), (1, 0)), falls.a))
            joints.append(XDriver(f"drive{number}", falls.a, motion=harmonic_motion(x + middle, stroke, 2.0, phase)))
        else:
            joints.append(Revolute(f"at_right{number}_{k}", falls.a, right))
        left, right = falls.b, rises.b
        bodies += [rises, falls]
    return bodies, joints, Marker(f"top{number}", right)


PARAMETERS = (
    Parameter("angle", deg(60), "Of the bars in the middle of the motion", "rad", deg(55), deg(70)),
    Parameter("stroke", 0.1, "Amplitude of the feet", "m", 0.0, 0.12),
)
MODEL = Model("Scissors", "Scissors lifts of a hundred bars", PARAMETERS, mechanism, stop_time=4.0)
