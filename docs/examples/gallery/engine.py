"""Slider-crank engine with a flywheel: a gas that is compressed, burns in the dead centre, and drives the piston back.

The gas obeys p V^n = constant, with a higher constant on the way out, as of an Otto cycle without valves. Source: one
degree of freedom, so the speed at any crank angle follows from the gas work in closed form; the slider-crank is that of
any book on mechanisms, e.g. Norton, Design of Machinery.
"""

from mechanism_fmu.model import (
    GROUND,
    Mechanism,
    Model,
    NonlinearSpring,
    Output,
    Parameter,
    Revolute,
    Torque,
    Translational,
    angle_output,
    bar,
    length_parameter,
    rigid_body,
    settings_parameters,
    speed_output,
    torque_parameter,
)
from mechanism_fmu.model.functions import power, where

AREA, ATMOSPHERE, EXPONENT = 5e-3, 1e5, 1.35  # of the piston [m2]; outside [Pa]; of the gas


def mechanism(values):
    """The engine in its lower dead centre; x points from the crank to the head."""
    crank, rod, clearance = values.crank, values.rod, values.clearance

    def gas(length, rate):
        part = power((2 * crank + clearance) / length, EXPONENT)  # of the pressure in the lower dead centre
        return -AREA * ATMOSPHERE * (where(rate > 0.0, values.burnt, 1.0) * part - 1.0)

    throw = bar("crank", (0, 0), (-crank, 0), mass="2 kg", centre=(0, 0), inertia="0.5 kg.m2", speed="300 rpm")
    conrod = bar("rod", (-crank, 0), (rod - crank, 0), mass="0.6 kg")
    piston = rigid_body("piston", (rod - crank, 0), mass="0.5 kg", inertia=1e-4)
    joints = (
        Revolute("bearing", throw.a, GROUND),
        Revolute("crank_pin", conrod.a, throw.b),
        Revolute("piston_pin", conrod.b, piston),
        Translational("cylinder", GROUND.line((0, 0), (1, 0)), piston.line((0, 0), (1, 0))),
    )
    head = GROUND.at(crank + rod + clearance, 0)
    forces = (NonlinearSpring("gas", piston, head, law=gas), Torque("load", throw, torque=-values.load))
    outputs = (angle_output("angle", throw.angle, "Crank"), speed_output("speed", throw.speed, "Crank"))
    outputs += (Output("gas_force", "gas.force", "Of the gas, negative when it pushes", "N"),)
    return Mechanism((throw, conrod, piston), joints, forces, outputs=outputs, held=(throw.angle,))


SIZES = (("crank", "40 mm"), ("rod", "150 mm"), ("clearance", "10 mm"))
LENGTHS = tuple(length_parameter(name, size, f"Length of the {name}") for name, size in SIZES)
BURNT = Parameter("burnt", 2.5, "Pressure after burning over that before", "1", 1.0, 10.0)
PARAMETERS = (*LENGTHS, BURNT, torque_parameter("load", 5.0, "Torque against the crank"), *settings_parameters())
MODEL = Model("Engine", "Slider-crank engine with flywheel", PARAMETERS, mechanism, stop_time=1.0)
