"""Stick and slip: a block on a belt, held by a spring, is carried along until the spring tears it off, and slips back.

It holds more while it sticks than while it slips. Source: piecewise closed form of a mass on a spring.
"""

from mechanism_fmu.model import (
    GROUND,
    Marker,
    Mechanism,
    Model,
    Output,
    Parameter,
    SpringDamper,
    Translational,
    TranslationalDriver,
    plate,
    polynomial_motion,
    settings_parameters,
)


def mechanism(values):
    """The block begins on the belt with its speed; the spring is free there."""
    a, belt_speed = 0.06, values.belt_speed
    belt = plate("belt", ((-1.0, -0.02), (0.35, -0.02), (0.35, 0), (-1.0, 0)), mass="5 kg", at=(0, -a))
    sides = ((-a, -a), (a, -a), (a, a), (-a, a))
    block = plate("block", sides, mass=values.mass, velocity=(belt_speed, 0))
    ground, top = GROUND.line((0, -a), (1, 0)), belt.line((0, 0), (1, 0))
    mu = {"friction": values.slipping, "friction_static": values.sticking}
    joints = (
        Translational("rollers", ground, top),
        TranslationalDriver("drive", belt.at(0, 0), ground, motion=polynomial_motion(0.0, belt_speed)),
        Translational("touch", top, block.line((0, -a), (1, 0)), **mu),
    )
    spring = SpringDamper("spring", block, GROUND.at(-0.3, 0), stiffness=values.stiffness, free_length=0.3)
    outputs = (
        Output("x", block.x, "Place of the block", "m"),
        Output("slip", "touch.slip_speed", "Of the block on the belt", "m/s"),
        Output("friction", "touch.friction_force", "On the block", "N"),
        Output("sticks", "touch.sticks", "Whether the belt carries it", "1"),
    )
    parts = {"outputs": outputs, "markers": (Marker("middle", block),), "gravity": (0.0, -9.81)}
    return Mechanism((belt, block), joints, (spring,), **parts)


BELT = Parameter("belt_speed", 0.1, "Speed of the belt", "m/s", 0.0, 10.0)
BLOCK = (Parameter("mass", 2.0, "Block", "kg", 1e-3, 1e3), Parameter("stiffness", 50.0, "Spring", "N/m", 1.0, 1e6))
TOUCH = (Parameter("slipping", 0.3, "Friction while it slips", "1", 0.0, 10.0),)
TOUCH += (Parameter("sticking", 0.5, "Friction while it sticks", "1", 0.0, 10.0),)
PARAMETERS = (BELT, *BLOCK, *TOUCH, *settings_parameters())
MODEL = Model("StickSlip", "Block on a belt that sticks and slips", PARAMETERS, mechanism, stop_time=8.0)
