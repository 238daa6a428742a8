"""Pantograph: four bars copy what a tracer draws, twice as large.

The fixed pivot, the tracer and the pen stay in one line, and the pen is `scale` times as far from the pivot. Two
drivers lead the tracer along a Lissajous figure. Source: similar triangles; any book on mechanisms.
"""

from mechanism_fmu.model import (
    GROUND,
    Marker,
    Mechanism,
    Model,
    Output,
    Parameter,
    Revolute,
    XDriver,
    YDriver,
    bar,
    deg,
    dyad,
    harmonic_motion,
    toward,
)


def mechanism(values):
    """The linkage; all four bars follow from where pivot and tracer are."""
    arm, scale = 0.4, values.scale
    pivot, tracer = (0, 0), (0.3, 0.2)
    pen = (scale * tracer[0], scale * tracer[1])
    elbow = dyad(pivot, pen, from_a=scale * arm, from_b=scale * arm)
    first, second = toward(pivot, elbow, arm), toward(elbow, pen, arm)
    long, pencil = bar("long", pivot, elbow, mass="0.4 kg"), bar("pencil", elbow, pen, mass="0.4 kg")
    one, two = bar("one", first, tracer, mass="0.2 kg"), bar("two", second, tracer, mass="0.2 kg")
    pins = (("pivot", long.a, GROUND), ("elbow", long.b, pencil.a), ("tracer", one.b, two.b))
    pins += (("first", one.a, long.at(arm, 0)), ("second", two.a, pencil.at(arm, 0)))
    across = XDriver("across", one.b, motion=harmonic_motion(0.2, 0.1, 2.0, deg(90)))
    along = YDriver("along", one.b, motion=harmonic_motion(0.15, 0.05, 3.0, deg(90)))
    original, copy = Marker("original", one.b), Marker("copy", pencil.b)
    outputs = (Output("x", copy.x, "Place of the pen", "m"), Output("y", copy.y, "Place of the pen", "m"))
    bodies, joints = (long, pencil, one, two), (*(Revolute(*pin) for pin in pins), across, along)
    return Mechanism(bodies, joints, markers=(original, copy), outputs=outputs)


SCALE = Parameter("scale", 2.0, "Size of the copy over that of the original", "1", 1.2, 5.0)
MODEL = Model("Pantograph", "Pantograph", (SCALE,), mechanism, stop_time=4.0)
