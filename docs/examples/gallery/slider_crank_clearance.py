"""Slider-crank with play: the slider's pin flies, strikes, rolls and slides in its hole in the rod, and wears it.

Crank and rod are those of Flores, Leine and Glocker (doi 10.1007/s11044-009-9178-y), with a pin of 10 mm; the pin is in
the middle of its hole at first. Source: impacts calculated elsewhere, in two ways; wear by Archard's law.
"""

from mechanism_fmu.model import (
    GROUND,
    ClearanceJoint,
    Mechanism,
    Model,
    Output,
    Parameter,
    Revolute,
    Translational,
    angle_output,
    impact_outputs,
    length_parameter,
    rigid_body,
    settings_parameters,
)

CRANK, ROD, PIN = 0.153, 0.306, 0.010


def mechanism(values):
    """The crank turns about the origin, and stretches the rod along x at first."""
    speed = values.speed
    crank = rigid_body(
        "crank", (CRANK / 2, 0), mass=0.038, inertia=7.4e-5, velocity=(0, speed * CRANK / 2), speed=speed
    )
    middle = (CRANK + ROD / 2, 0)
    rod = rigid_body("rod", middle, mass=0.038, inertia=5.9e-4, velocity=(0, speed * CRANK / 2), speed=-speed / 2)
    slider = rigid_body("slider", (CRANK + ROD, 0), mass=0.076, inertia=2.7e-6)
    joints = (
        Revolute("main", crank.at(-CRANK / 2, 0), GROUND),
        Revolute("crank_pin", rod.at(-ROD / 2, 0), crank.at(CRANK / 2, 0)),
        Translational("guide", slider.line((0, 0), (1, 0)), GROUND.line((0, 0), (1, 0))),
    )
    numbers = {name: getattr(values, name) for name in ("clearance", "restitution", "friction", "wear_coefficient")}
    joint = ClearanceJoint("pin", slider, rod.at(ROD / 2, 0), pin_radius=PIN, **numbers)
    outputs = [angle_output("angle", crank.angle, "Crank"), Output("slider", slider.x, "Slider", "m")]
    for name, unit in (("force", "N"), ("eccentricity", "1"), ("contact_angle", "rad"), ("wear_volume", "m3")):
        outputs.append(Output(name, f"pin.{name}", f"{name} of the pin in its hole".replace("_", " "), unit))
    outputs += impact_outputs("Impacts", (Output("closing_speed", "closing_speed", "{impact}", "m/s"),))
    return Mechanism((crank, rod, slider), joints, (), (joint,), outputs=tuple(outputs), gravity=(0, -9.81))


PARAMETERS = (
    length_parameter("clearance", "0.5 mm", "Radial clearance of the slider's pin"),
    Parameter("restitution", 0.4, "Of pin and hole", "1", 0.0, 1.0),
    Parameter("friction", 0.0, "Coefficient of friction between pin and hole", "1", 0.0, 1.0),
    Parameter("wear_coefficient", 1e-15, "Volume worn off per work of sliding", "1/Pa", 0.0, 1e-9),
    Parameter("speed", 150.0, "Of the crank at the start", "rad/s", -1000.0, 1000.0),
)
PARAMETERS += settings_parameters()
MODEL = Model("SliderCrankClearance", "Slider-crank with a pin that has play", PARAMETERS, mechanism, stop_time=0.5)
