"""Stephenson six-bar: a point of the coupler of a four-bar moves a second rocker through a rod.

Its two links with three joints, the frame and the coupler, have no pin in common. Source: any book on
mechanisms, e.g. Norton, Design of Machinery; all angles by circles that meet.
"""

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Marker,
    Mechanism,
    Model,
    Revolute,
    angle_output,
    bar,
    deg,
    dyad,
    four_bar_points,
    length_parameter,
    plate,
    polynomial_motion,
    speed_parameter,
)


def mechanism(values):
    """The linkage at a crank angle of 90 degrees; all other angles follow from lengths."""
    far = (0.15, -0.2)
    a, b, c, d = four_bar_points((0, 0), (0.4, 0), crank=values.crank, coupler=0.35, rocker=0.3, angle=deg(90))
    e = dyad(b, c, from_a=0.2, from_b=0.25)
    f = dyad(e, far, from_a=0.45, from_b=0.25)
    crank = bar("crank", a, b, mass="0.5 kg", speed=values.speed)
    coupler, rocker = plate("coupler", (b, c, e), mass="2 kg"), bar("rocker", d, c, mass="1 kg")
    rod, lever = bar("rod", e, f, mass="1 kg"), bar("lever", far, f, mass="1 kg")
    pins = (("A", crank.a, GROUND.at(*a)), ("B", crank.b, coupler.corners[0]), ("C", coupler.corners[1], rocker.b))
    pins += (("D", rocker.a, GROUND.at(*d)), ("E", coupler.corners[2], rod.a), ("F", rod.b, lever.b))
    pins += (("G", lever.a, GROUND.at(*far)),)
    drive = AngleDriver("drive", crank, motion=polynomial_motion(deg(90), values.speed))
    joints = (*(Revolute(*pin) for pin in pins), drive)
    outputs = tuple(angle_output(b.name, b.angle, f"Angle of the {b.name}") for b in (rocker, lever))
    bodies, point = (crank, coupler, rocker, rod, lever), Marker("path", rod.a)
    return Mechanism(bodies, joints, markers=(point,), outputs=outputs, held=(crank.angle,))


PARAMETERS = (
    length_parameter("crank", "100 mm", "Length of the crank"),
    speed_parameter("speed", "60 rpm", "Its speed"),
)
MODEL = Model("Stephenson", "Stephenson six-bar linkage", PARAMETERS, mechanism, stop_time=2.0)
