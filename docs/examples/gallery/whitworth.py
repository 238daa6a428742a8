"""Whitworth quick return: the ram of a shaping machine cuts slowly and returns fast.

The crank's pin slides in a slotted lever, whose pivot lies within the circle of the pin, so that it turns fully; the
far end of the lever moves the ram through a rod. Source: any book on mechanisms, e.g. Norton, Design of Machinery,
section 2.15 (Whitworth or crank-shaper quick-return mechanism).
"""

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Mechanism,
    Model,
    Output,
    Revolute,
    RevoluteTranslational,
    Translational,
    bar,
    length_parameter,
    polynomial_motion,
    rigid_body,
    speed_parameter,
    toward,
)


def mechanism(values):
    """The linkage; its sketch need not fit exactly: assembly finds the nearest position that does."""
    pivot, pin = (0.0, -values.offset), (values.crank, 0.0)
    end = toward(pivot, pin, -values.arm)
    crank = bar("crank", (0, 0), pin, mass="1 kg", speed=values.speed)
    lever = bar("lever", pivot, pin, length=values.crank + values.offset, mass="2 kg")
    rod = bar("rod", end, length=values.rod, angle=0.0, mass="1 kg")
    ram = rigid_body("ram", at=(end[0] + values.rod, pivot[1]), mass="10 kg", inertia=0.1)
    joints = (
        Revolute("crank_hinge", crank.a, GROUND),
        RevoluteTranslational("slot", lever.line((0, 0), (1, 0)), crank.b),
        Revolute("lever_hinge", lever.a, GROUND.at(*pivot)),
        Revolute("lever_pin", rod.a, lever.at(-values.arm, 0)),
        Revolute("ram_pin", rod.b, ram),
        Translational("guide", GROUND.line(pivot, (1, 0)), ram.line((0, 0), (1, 0))),
        AngleDriver("drive", crank, motion=polynomial_motion(0.0, values.speed)),
    )
    return Mechanism((crank, lever, rod, ram), joints, held=(crank.angle,))


SIZES = (("crank", "100 mm"), ("offset", "50 mm"), ("arm", "80 mm"), ("rod", "400 mm"))
LENGTHS = tuple(length_parameter(name, size, f"Length of the {name}") for name, size in SIZES)
SPEED = speed_parameter("speed", "60 rpm", "Speed of the crank")
OUTPUTS = (Output("ram", "ram.x", "Place of the ram", "m"), Output("lever", "lever.angle", "Its angle", "rad", "deg"))
MODEL = Model("Whitworth", "Whitworth quick return", (*LENGTHS, SPEED), mechanism, outputs=OUTPUTS, stop_time=2.0)
