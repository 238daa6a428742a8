"""Watt six-bar: a four-bar whose rocker, a plate with three pins, moves a second rocker through a rod.

Its two links with three joints, the frame and the plate, have a pin in common. Both loops are closed one after the
other by circles that meet. Source: any book on mechanisms, e.g. Norton, Design of Machinery.
"""

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
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
    """The linkage at a crank angle of 60 degrees; all other angles follow from lengths."""
    far = (0.65, 0.1)
    a, b, c, d = four_bar_points((0, 0), (0.4, 0), crank=values.crank, coupler=0.35, rocker=0.3, angle=deg(60))
    e = dyad(d, c, from_a=0.25, from_b=0.15, side="right")
    f = dyad(e, far, from_a=0.3, from_b=0.25)
    crank = bar("crank", a, b, mass="0.5 kg", speed=values.speed)
    coupler, rocker = bar("coupler", b, c, mass="1 kg"), plate("rocker", (d, c, e), mass="2 kg")
    rod, lever = bar("rod", e, f, mass="1 kg"), bar("lever", far, f, mass="1 kg")
    pins = (("A", crank.a, GROUND.at(*a)), ("B", crank.b, coupler.a), ("C", coupler.b, rocker.corners[1]))
    pins += (("D", rocker.corners[0], GROUND.at(*d)), ("E", rocker.corners[2], rod.a), ("F", rod.b, lever.b))
    pins += (("G", lever.a, GROUND.at(*far)),)
    drive = AngleDriver("drive", crank, motion=polynomial_motion(deg(60), values.speed))
    joints = (*(Revolute(*pin) for pin in pins), drive)
    outputs = tuple(angle_output(b.name, b.angle, f"Angle of the {b.name}") for b in (rocker, lever))
    return Mechanism((crank, coupler, rocker, rod, lever), joints, outputs=outputs, held=(crank.angle,))


PARAMETERS = (
    length_parameter("crank", "100 mm", "Length of the crank"),
    speed_parameter("speed", "60 rpm", "Its speed"),
)
MODEL = Model("Watt", "Watt six-bar linkage", PARAMETERS, mechanism, stop_time=2.0)
