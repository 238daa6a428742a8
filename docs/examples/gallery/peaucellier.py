"""Peaucellier-Lipkin linkage: seven bars move a point along an exact straight line.

A rhombus on two equal arms keeps OP OD = arm^2 - side^2, and P moves on a circle through O, so D moves on a straight
line at (arm^2 - side^2)/(2 crank) from O. Source: inversion in a circle;
any book on mechanisms, e.g. Norton, Design of Machinery.
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
)


def mechanism(values):
    """The linkage, stretched along the x axis."""
    arm, side, crank = values.arm, values.side, values.crank
    o, q, p = (0, 0), (crank, 0), (2 * crank, 0)
    a, b = (dyad(o, p, from_a=arm, from_b=side, side=where) for where in ("left", "right"))
    d = dyad(a, b, from_a=side, from_b=side)
    links = (("crank", q, p), ("OA", o, a), ("OB", o, b), ("PA", p, a), ("PB", p, b), ("DA", d, a), ("DB", d, b))
    bodies = tuple(bar(name, begin, end, mass="0.1 kg", speed=6.0 * (name == "crank")) for name, begin, end in links)
    k, oa, ob, pa, pb, da, db = bodies
    pins = (("O", oa.a, GROUND), ("O2", ob.a, GROUND), ("Q", k.a, GROUND.at(*q)), ("P", k.b, pa.a), ("P2", k.b, pb.a))
    pins += (("A", oa.b, pa.b), ("A2", oa.b, da.b), ("B", ob.b, pb.b), ("B2", ob.b, db.b), ("D", da.a, db.a))
    swing = AngleDriver("swing", k, motion=harmonic_motion(0.0, 1.0, 6.0))
    pen = Marker("path", da.a)
    outputs = (Output("x", pen.x, "Place of D, along which it does not move", "m"), Output("y", pen.y, "Of D", "m"))
    outputs += (angle_output("turn", k.angle, "Crank"),)
    joints = (*(Revolute(*pin) for pin in pins), swing)
    return Mechanism(bodies, joints, markers=(pen,), outputs=outputs, held=(k.angle,))


SIZES = (("arm", "250 mm"), ("side", "100 mm"), ("crank", "100 mm"))
LENGTHS = tuple(length_parameter(name, size, f"Length of {name}") for name, size in SIZES)
MODEL = Model("Peaucellier", "Peaucellier-Lipkin straight line", LENGTHS, mechanism, stop_time=2.0)
