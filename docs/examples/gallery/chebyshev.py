"""Chebyshev's straight line: the middle of the coupler of a crossed four-bar moves nearly along a straight line.

Lengths are as 4 (frame) to 5 (cranks) to 2 (coupler). The middle is as high as the frame is long in the middle of
the line and at its ends, and elsewhere higher by less than 0.3 % of that. Source: any book on mechanisms, e.g. Norton,
Design of Machinery; the path follows in closed form from the angle of the coupler.
"""

from mechanism_fmu.model import (
    GROUND,
    Marker,
    Mechanism,
    Model,
    Output,
    Revolute,
    XDriver,
    angle_output,
    bar,
    deg,
    harmonic_motion,
    length_parameter,
)


def mechanism(values):
    """The linkage at the right end of the line, where the right crank is upright and the coupler in line with it."""
    unit = values.frame / 4
    a, b, c, d = (-2 * unit, 0), (2 * unit, 3 * unit), (2 * unit, 5 * unit), (2 * unit, 0)
    left, right = bar("left", a, b, mass="1 kg"), bar("right", d, c, mass="1 kg")
    coupler = bar("coupler", b, c, mass="0.5 kg")
    middle = coupler.at(unit, 0)
    joints = (
        Revolute("A", left.a, GROUND.at(*a)),
        Revolute("B", left.b, coupler.a),
        Revolute("C", coupler.b, right.b),
        Revolute("D", right.a, GROUND.at(*d)),
        XDriver("along", middle, motion=harmonic_motion(0.0, 2 * unit, 3.0, deg(90))),
    )
    pen = Marker("middle", middle)
    outputs = (Output("x", pen.x, "Middle of the coupler", "m"), Output("y", pen.y, "Its height", "m"))
    outputs += (angle_output("angle", coupler.angle, "Coupler"),)
    return Mechanism((left, coupler, right), joints, markers=(pen,), outputs=outputs)


FRAME = length_parameter("frame", "400 mm", "Distance of the fixed pins")
MODEL = Model("Chebyshev", "Chebyshev's straight line", (FRAME,), mechanism, stop_time=4.0)
