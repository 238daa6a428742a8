"""Toggle press: a crank pushes a knee nearly straight, where a small force on it presses the ram down with a large one.

The die is a spring that only pushes. Source: the place of the ram follows from circles that meet, the force on the
die from that, and the torque of a slow crank by virtual work.
"""

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Mechanism,
    Model,
    Output,
    Revolute,
    SpringDamper,
    Translational,
    bar,
    dyad,
    length_parameter,
    polynomial_motion,
    rigid_body,
    speed_parameter,
)


def mechanism(values):
    """The press with its crank level; the ram moves on the y axis below the upper pin."""
    top, centre = (0, 0), (-0.5, -0.25)
    pin = (centre[0] + values.crank, centre[1])
    knee = dyad(top, pin, from_a=0.3, from_b=0.4)
    low = (0, 2 * knee[1])
    crank = bar("crank", centre, pin, mass="2 kg", speed=values.speed)
    pitman, upper = bar("pitman", pin, knee, mass="2 kg"), bar("upper", top, knee, mass="2 kg")
    lower, ram = bar("lower", knee, low, mass="2 kg"), rigid_body("ram", low, mass="20 kg", inertia=0.1)
    pins = (("A", crank.a, GROUND.at(*centre)), ("B", crank.b, pitman.a), ("C", pitman.b, upper.b))
    pins += (("top", upper.a, GROUND), ("knee", upper.b, lower.a), ("ram_pin", lower.b, ram))
    joints = (
        *(Revolute(*pin) for pin in pins),
        Translational("guide", GROUND.line((0, 0), (0, 1)), ram.line((0, 0), (0, 1))),
        AngleDriver("drive", crank, motion=polynomial_motion(0.0, values.speed)),
    )
    die = SpringDamper(
        "die", ram, GROUND.at(0, -0.8), stiffness="20 kN/mm", free_length="205 mm", one_sided="compressed"
    )
    outputs = (Output("ram", ram.y, "Place of the ram", "m"), Output("die_force", "die.force", "On the die", "N"))
    outputs += (Output("torque", "drive.torque", "Of the drive", "N.m"),)
    bodies = (crank, pitman, upper, lower, ram)
    return Mechanism(bodies, joints, (die,), outputs=outputs, held=(crank.angle,))


SIZES = (length_parameter("crank", "80 mm", "Length of the crank"), speed_parameter("speed", "30 rpm", "Its speed"))
MODEL = Model("TogglePress", "Toggle press", SIZES, mechanism, stop_time=4.0)
