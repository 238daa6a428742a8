import math
from dataclasses import replace

import pytest

from mechanism_fmu.model import (
    GROUND,
    Body,
    Calculated,
    Input,
    Mechanism,
    MechanismError,
    Output,
    PointLineContact,
    Revolute,
    Settings,
    Torque,
    TorsionSpring,
    Translational,
)

GOOD = Mechanism(
    bodies=(Body("arm", 1.0, 0.1), Body("slider", 2.0, 0.2)),
    joints=(
        Revolute("hinge", "arm", (-0.5, 0.0), GROUND, (0.0, 0.0)),
        Translational("guide", "slider", (0.0, 0.0), (1.0, 0.0), GROUND, (0.0, 0.0), (1.0, 0.0)),
    ),
    forces=(Torque("drive", "arm"), TorsionSpring("spring", "arm", stiffness=3.0)),
    contacts=(PointLineContact("stop", "arm", (0.5, 0.0), "slider", (0.0, 0.0), (0.0, 1.0)),),
    inputs=(Input("torque", "drive.torque", 0.0, "Torque", "N.m"),),
    outputs=(Output("angle", "arm.angle", "Angle", "rad"),),
    calculated=(Calculated("size", 1.0, "Size", "m"),),
    held=("arm.angle",),
)
ARM, SLIDER = GOOD.bodies
HINGE, GUIDE = GOOD.joints
DRIVE, SPRING = GOOD.forces
STOP = GOOD.contacts[0]
TORQUE, ANGLE = GOOD.inputs[0], GOOD.outputs[0]

REFUSALS = {
    "no body": ({"bodies": ()}, ["no body", "at least one"]),
    "zero mass": ({"bodies": (replace(ARM, mass=0.0), SLIDER)}, ["'arm'", "mass = 0 kg", "positive"]),
    "negative inertia": ({"bodies": (ARM, replace(SLIDER, inertia=-2.5))}, ["'slider'", "inertia = -2.5 kg.m2"]),
    "infinite mass": ({"bodies": (replace(ARM, mass=math.inf), SLIDER)}, ["'arm'", "mass = inf", "finite"]),
    "start not finite": ({"bodies": (replace(ARM, start=(0.0, math.nan, 0.0)), SLIDER)}, ["'arm'", "not finite"]),
    "same name twice": ({"bodies": (ARM, replace(SLIDER, name="arm"))}, ["'arm'", "name of its own"]),
    "name of another kind": ({"forces": (DRIVE, replace(SPRING, name="arm"))}, ["TorsionSpring 'arm'", "(Body)"]),
    "name of the ground": ({"bodies": (ARM, SLIDER, Body(GROUND, 1.0, 1.0))}, ["'ground'", "the fixed frame"]),
    "empty name": ({"forces": (DRIVE, SPRING, Torque("", "arm"))}, ["Torque ''", "must not be empty"]),
    "name with a dot": ({"forces": (DRIVE, SPRING, Torque("a.b", "arm"))}, ["'a.b'", "'.'"]),
    "joint to nowhere": (
        {"joints": (replace(HINGE, body_j="wall"), GUIDE)},
        ["Revolute 'hinge'", "unknown body 'wall'", "arm, slider", "'ground'"],
    ),
    "force on nothing": ({"forces": (replace(DRIVE, body="crank"), SPRING)}, ["Torque 'drive'", "'crank'"]),
    "contact with nothing": ({"contacts": (replace(STOP, body_j="rail"),)}, ["PointLineContact 'stop'", "'rail'"]),
    "joint to itself": ({"joints": (replace(HINGE, body_j="arm"), GUIDE)}, ["'hinge'", "itself", "two different"]),
    "normal too long": ({"contacts": (replace(STOP, normal=(1.0, 1.0)),)}, ["'stop'", "1.41421", "unit vector"]),
    "restitution above one": ({"contacts": (replace(STOP, restitution=1.5),)}, ["'stop'", "1.5", "0..1"]),
    "restitution not a number": ({"contacts": (replace(STOP, restitution=math.nan),)}, ["'stop'", "nan", "0..1"]),
    "negative beam": ({"contacts": (replace(STOP, beam_length=-0.1),)}, ["'stop'", "beam_length = -0.1 m"]),
    "negative stiffness": ({"forces": (DRIVE, replace(SPRING, stiffness=-3.0))}, ["'spring'", "-3 N.m/rad"]),
    "infinite stiffness": ({"forces": (DRIVE, replace(SPRING, stiffness=math.inf))}, ["'spring'", "not finite"]),
    "joint point not finite": ({"joints": (replace(HINGE, point_i=(math.nan, 0.0)), GUIDE)}, ["'hinge'", "finite"]),
    "axis of length zero": ({"joints": (HINGE, replace(GUIDE, axis_j=(0.0, 0.0)))}, ["'guide'", "length zero"]),
    "input to unknown force": (
        {"inputs": (replace(TORQUE, target="motor.torque"),)},
        ["'torque'", "'motor.torque'", "drive.torque or spring.preload"],
    ),
    "input to unknown entry": ({"inputs": (replace(TORQUE, target="drive.speed"),)}, ["'drive.speed'"]),
    "input start not finite": ({"inputs": (replace(TORQUE, start=math.inf),)}, ["'torque'", "start = inf"]),
    "two inputs, one target": (
        {"inputs": (TORQUE, replace(TORQUE, name="again"))},
        ["Input 'again'", "'drive.torque'", "'torque' does"],
    ),
    "port name twice": ({"outputs": (ANGLE, replace(ANGLE, name="torque"))}, ["Output 'torque'", "twice"]),
    "calculated like an output": ({"calculated": (Calculated("angle", 1.0, "x"),)}, ["Calculated 'angle'"]),
    "unknown feedthrough": ({"outputs": (replace(ANGLE, feedthrough=("force",)),)}, ["'angle'", "input 'force'"]),
    "unknown held coordinate": ({"held": ("arm.phi",)}, ["'arm.phi'", "arm.x, arm.y, arm.angle, slider.x"]),
    "tolerance too small": ({"settings": Settings(relative_tolerance=1e-16)}, ["1e-16", "1e-13..1e-3"]),
    "tolerance not a number": ({"settings": Settings(relative_tolerance=math.nan)}, ["relative_tolerance = nan"]),
    "negative gain": ({"settings": Settings(baumgarte_alpha=-1.0)}, ["baumgarte_alpha = -1", "not negative"]),
    "infinite gain": ({"settings": Settings(baumgarte_beta=math.inf)}, ["baumgarte_beta = inf", "finite"]),
}


@pytest.mark.parametrize(("change", "fragments"), REFUSALS.values(), ids=REFUSALS)
def test_refusal_names_the_part_and_the_limit(change, fragments):
    with pytest.raises(MechanismError) as refusal:
        replace(GOOD, **change).compile()
    for fragment in fragments:
        assert fragment in str(refusal.value)


UNKNOWN_SOURCES = [
    "angle",
    "leg.angle",
    "arm.phi",
    "stop.gab",
    "energy.heat",
    "impact.speed",
    "impact.speed:leg",
    "impact.impulse:arm",
    "impacts[0].time",
    "impacts[9].time",
    "impacts[1].count",
]


@pytest.mark.parametrize("source", UNKNOWN_SOURCES)
def test_unknown_output_source_is_refused_with_the_choices(source):
    with pytest.raises(MechanismError) as refusal:
        replace(GOOD, outputs=(replace(ANGLE, source=source),)).compile()
    for fragment in ("Output 'angle'", repr(source), "arm, slider", "stop", "energy.kinetic"):
        assert fragment in str(refusal.value)


def test_all_problems_are_told_at_once():
    bad = replace(GOOD, bodies=(replace(ARM, mass=-1.0), SLIDER), held=("arm.phi",))
    with pytest.raises(MechanismError, match=r"mass = -1 kg.*arm\.phi"):
        bad.compile()


def test_a_good_mechanism_passes():
    assert GOOD.compile().joint_rows == 4
