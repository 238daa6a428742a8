"""Roberts' straight line: the apex of an isosceles coupler moves nearly along the line through the fixed pins.

Both cranks and the legs of the coupler are equally long, and the coupler is half as wide as the frame. The apex is
exactly on the line in the middle and at the fixed pins. Source: any book on mechanisms, e.g. Norton, Design of
Machinery; the path follows in closed form from the angle of the coupler.
"""

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Marker,
    Mechanism,
    Model,
    Output,
    Revolute,
    angle_output,
    bar,
    dyad,
    harmonic_motion,
    length_parameter,
    plate,
)
from mechanism_fmu.model.functions import atan2


def mechanism(values):
    """The linkage in its middle position, with the apex on the line through the pins."""
    half, leg = values.frame / 2, values.leg
    a, d, apex = (-half, 0), (half, 0), (0, 0)
    b, c = dyad(a, apex, from_a=leg, from_b=leg), dyad(apex, d, from_a=leg, from_b=leg)
    left, right = bar("left", a, b, mass="1 kg", speed=0.9), bar("right", d, c, mass="1 kg")
    coupler = plate("coupler", (b, apex, c), mass="1 kg")
    joints = (
        Revolute("A", left.a, GROUND.at(*a)),
        Revolute("B", left.b, coupler.corners[0]),
        Revolute("C", coupler.corners[2], right.b),
        Revolute("D", right.a, GROUND.at(*d)),
        AngleDriver("swing", left, motion=harmonic_motion(atan2(b[1] - a[1], b[0] - a[0]), 0.3, 3.0)),
    )
    pen = Marker("apex", coupler.corners[1])
    outputs = (Output("x", pen.x, "Place of the apex", "m"), Output("off", pen.y, "From the line", "m"))
    outputs += (angle_output("angle", coupler.angle, "Coupler"),)
    return Mechanism((left, coupler, right), joints, markers=(pen,), outputs=outputs, held=(left.angle,))


SIZES = (length_parameter("frame", "400 mm", "Between the fixed pins"), length_parameter("leg", "240 mm", "Cranks"))
MODEL = Model("Roberts", "Roberts' straight line", SIZES, mechanism, stop_time=4.0)
