import math
from dataclasses import replace

import pytest

from mechanism_fmu.model import (
    GROUND,
    AngleLock,
    AngleStop,
    Body,
    Brake,
    Calculated,
    CircularPattern,
    CompliantShaft,
    Damper,
    DCMotor,
    Input,
    LogicalFunction,
    Marker,
    Mechanism,
    MechanismError,
    NonlinearSpring,
    Output,
    PointForce,
    PointLineContact,
    Revolute,
    Settings,
    SpringDamper,
    Torque,
    TorsionSpring,
    Translational,
)
from mechanism_fmu.model.compile import compile_mechanism

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
TEETH = CircularPattern("teeth", "arm", (0.5, 0.0), "slider", 0.3, (1.0, 0.0), (0.0, 1.0))
LATCH = AngleStop("latch", "arm", "slider", 0.1, 0.5)
LOCK = AngleLock("lock", "arm", GROUND, 0.0, 0.5, "low")
LOW = LogicalFunction("low", "arm.angle", 1.0)
HINGE_ENDS = ARM.at(-0.5, 0.0), GROUND.at(0.0, 0.0)
SHAFT = CompliantShaft("shaft", "arm", stiffness=1.0, damping=1.0)
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
    "teeth of no length": (
        {"bodies": (replace(ARM, tooth_length=0.0), SLIDER)},
        ["'arm'", "tooth_length = 0 m", "positive", "None"],
    ),
    "negative stiffness": ({"forces": (DRIVE, replace(SPRING, stiffness=-3.0))}, ["'spring'", "-3 N.m/rad"]),
    "infinite stiffness": ({"forces": (DRIVE, replace(SPRING, stiffness=math.inf))}, ["'spring'", "not finite"]),
    "joint point not finite": ({"joints": (replace(HINGE, point_i=(math.nan, 0.0)), GUIDE)}, ["'hinge'", "finite"]),
    "axis of length zero": (
        {"joints": (HINGE, replace(GUIDE, axis_j=(0.0, 0.0)))},
        ["'guide'", "axis_j = (0, 0)", "not zero"],
    ),
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
    "negative friction of a contact": ({"contacts": (replace(STOP, friction=-0.1),)}, ["'stop'", "friction = -0.1"]),
    "infinite friction of a contact": ({"contacts": (replace(STOP, friction=math.inf),)}, ["'stop'", "friction = inf"]),
    "unknown pattern": (
        {"contacts": (replace(STOP, pattern="cogs"),), "patterns": (TEETH,)},
        ["'stop'", "pattern 'cogs'", "does not exist", "patterns: teeth"],
    ),
    "a pattern where there is none": ({"contacts": (replace(STOP, pattern="cogs"),)}, ["'cogs'", "patterns: none"]),
    "pattern of another body": (
        {"contacts": (replace(STOP, pattern="teeth"),), "patterns": (replace(TEETH, body_j=GROUND),)},
        ["Contact 'stop' lies on 'slider'", "repeats around 'ground'"],
    ),
    "pattern on nothing": (
        {"patterns": (replace(TEETH, body_i="pawl"),)},
        ["CircularPattern 'teeth'", "unknown body 'pawl'"],
    ),
    "pattern of one body": ({"patterns": (replace(TEETH, body_i="slider"),)}, ["'teeth'", "'slider' to itself"]),
    "boundary normal too short": (
        {"patterns": (replace(TEETH, boundary_normal=(0.6, 0.0)),)},
        ["'teeth'", "boundary normal has length 0.6", "unit vector"],
    ),
    "pattern without pitch": ({"patterns": (replace(TEETH, pitch=0.0),)}, ["'teeth'", "pitch = 0 rad", "not zero"]),
    "pitch not a number": ({"patterns": (replace(TEETH, pitch=math.nan),)}, ["'teeth'", "pitch = nan", "finite"]),
    "boundary not finite": (
        {"patterns": (replace(TEETH, boundary_point=(math.inf, 0.0)),)},
        ["CircularPattern 'teeth'", "not finite"],
    ),
    "pattern named like a contact": ({"patterns": (replace(TEETH, name="stop"),)}, ["CircularPattern 'stop'", "own"]),
    "stop with pitch zero": ({"contacts": (replace(LATCH, pitch=0.0),)}, ["'latch'", "pitch = 0 rad", "positive"]),
    "stop with pitch backwards": ({"contacts": (replace(LATCH, pitch=-0.5),)}, ["'latch'", "pitch = -0.5 rad"]),
    "lock with pitch zero": (
        {"contacts": (replace(LOCK, pitch=0.0),), "functions": (LOW,)},
        ["'lock'", "pitch = 0 rad", "positive"],
    ),
    "stop at no angle": ({"contacts": (replace(LATCH, angle=math.nan),)}, ["AngleStop 'latch'", "not finite"]),
    "stop bouncing too much": ({"contacts": (replace(LATCH, restitution=1.5),)}, ["'latch'", "1.5", "0..1"]),
    "unknown logical function": (
        {"contacts": (replace(STOP, closed_while="not high"),), "functions": (LOW,)},
        ["'stop'", "closed while 'not high'", "functions: low"],
    ),
    "a function where there is none": ({"contacts": (LOCK,)}, ["'lock'", "closed while 'low'", "functions: none"]),
    "function of an unknown quantity": (
        {"functions": (replace(LOW, of="arm.speed"),)},
        ["'low'", "'arm.speed'", "stop.along, arm.angle, slider.angle"],
    ),
    "function of an unknown part": ({"functions": (replace(LOW, of="leg.angle"),)}, ["'low'", "'leg.angle'"]),
    "function along a stop": (
        {"contacts": (STOP, LATCH), "functions": (replace(LOW, of="latch.along"),)},
        ["'low'", "'latch.along'", "choose among stop.along, arm.angle"],
    ),
    "function with no limit": ({"functions": (replace(LOW, below=math.nan),)}, ["'low'", "limit nan", "not finite"]),
    "function named like a body": ({"functions": (replace(LOW, name="arm"),)}, ["LogicalFunction 'arm'", "(Body)"]),
    "negative damper": (
        {"forces": (DRIVE, SPRING, Damper("oil", "arm", damping=-2.0))},
        ["Damper 'oil'", "damping = -2 N.m.s/rad", "not be negative"],
    ),
    "negative stiffness of a shaft": (
        {"forces": (DRIVE, SPRING, replace(SHAFT, stiffness=-3.0))},
        ["CompliantShaft 'shaft'", "stiffness = -3 N.m/rad"],
    ),
    "negative damping of a shaft": (
        {"forces": (DRIVE, SPRING, replace(SHAFT, damping=-4.0))},
        ["CompliantShaft 'shaft'", "damping = -4 N.m.s/rad"],
    ),
    "brake that holds less than nothing": (
        {"forces": (DRIVE, SPRING, Brake("brake", "arm", limit=-1.0))},
        ["Brake 'brake'", "limit = -1 N.m", "not be negative"],
    ),
    "motor without inductance": (
        {"forces": (DRIVE, SPRING, DCMotor("motor", "arm", inductance=0.0))},
        ["DCMotor 'motor'", "inductance = 0 H", "must be positive"],
    ),
    "negative resistance": (
        {"forces": (DRIVE, SPRING, DCMotor("motor", "arm", resistance=-2.0))},
        ["DCMotor 'motor'", "resistance = -2 ohm", "not be negative"],
    ),
    "negative gain of a motor": (
        {"forces": (DRIVE, SPRING, DCMotor("motor", "arm", integral_gain=-2.0))},
        ["DCMotor 'motor'", "integral_gain = -2 V/rad", "not be negative"],
    ),
    "negative pin friction": ({"joints": (replace(HINGE, friction_radius=-0.01), GUIDE)}, ["'hinge'", "-0.01"]),
    "infinite slider friction": ({"joints": (HINGE, replace(GUIDE, friction=math.inf))}, ["'guide'", "inf", "finite"]),
    "output named time": ({"outputs": (replace(ANGLE, name="time"),)}, ["Output 'time'", "column of time"]),
    "input named time": (
        {"inputs": tuple(replace(port, name="time") for port in GOOD.inputs)},
        ["Input 'time'", "column of time", "choose another"],
    ),
    "marker on the ground": (
        {"markers": (Marker("pen", GROUND.at(0.1, 0.0)),)},
        ["Marker 'pen' stands on 'ground', which does not move; attach it to a body."],
    ),
    "force on the ground": (
        {"forces": (DRIVE, SPRING, PointForce("push", GROUND.at(0.0, 0.0)))},
        ["PointForce 'push' stands on 'ground'"],
    ),
    "spring within a pin": (
        {"forces": (DRIVE, SPRING, SpringDamper("rope", HINGE_ENDS[1], HINGE_ENDS[0], preload=500.0))},
        ["SpringDamper 'rope' acts between two points that Revolute 'hinge' keeps together", "no direction"],
    ),
    "law within a pin": (
        {"forces": (DRIVE, SPRING, NonlinearSpring("rope", *HINGE_ENDS, law=lambda x, v: x))},
        ["NonlinearSpring 'rope' acts between two points"],
    ),
    "infinite gain": ({"settings": Settings(baumgarte_beta=math.inf)}, ["baumgarte_beta = inf", "finite"]),
}


@pytest.mark.parametrize(("change", "fragments"), REFUSALS.values(), ids=REFUSALS)
def test_refusal_names_the_part_and_the_limit(change, fragments):
    with pytest.raises(MechanismError) as refusal:
        compile_mechanism(replace(GOOD, **change))
    for fragment in fragments:
        assert fragment in str(refusal.value)


UNKNOWN_SOURCES = [
    "angle",
    "leg.angle",
    "arm.phi",
    "stop.gab",
    "stop.clicks",
    "stop.latched",
    "drive.torque",
    "arm.index",
    "event.number",
    "energy.heat",
    "impact.speed",
    "impact.speed:leg",
    "impact.impulse:arm",
    "impacts[0].time",
    "impacts[1001].time",
    "impacts[1].count",
]


@pytest.mark.parametrize("source", UNKNOWN_SOURCES)
def test_unknown_output_source_is_refused_with_the_choices(source):
    with pytest.raises(MechanismError) as refusal:
        compile_mechanism(replace(GOOD, outputs=(replace(ANGLE, source=source),)))
    for fragment in ("Output 'angle'", repr(source), "arm, slider", "stop", "energy.kinetic"):
        assert fragment in str(refusal.value)


def test_all_problems_are_told_at_once():
    bad = replace(GOOD, bodies=(replace(ARM, mass=-1.0), SLIDER), held=("arm.phi",))
    with pytest.raises(MechanismError, match=r"mass = -1 kg.*arm\.phi"):
        compile_mechanism(bad)


def test_a_good_mechanism_passes():
    assert compile_mechanism(GOOD).joint_rows == 4


def test_a_good_mechanism_with_all_kinds_of_contacts_passes():
    latch, lock = replace(LATCH, pitch=None), replace(LOCK, closed_while="not low")
    good = replace(
        GOOD,
        contacts=(replace(STOP, pattern="teeth", friction=0.3), latch, lock),
        patterns=(replace(TEETH, pitch=-0.3),),
        functions=(LOW, LogicalFunction("near", "stop.along", 0.0)),
        forces=(*GOOD.forces, SHAFT, Damper("oil", "arm", damping=0.0)),
        outputs=(
            Output("clicks", "latch.clicks", "x"),
            Output("index", "teeth.index", "x"),
            Output("twist", "shaft.torque", "x"),
        ),
    )
    assert len(compile_mechanism(good).contact_kind) == 3


def test_fifty_contacts_are_not_too_many():
    contacts = tuple(replace(STOP, name=f"stop{k}") for k in range(50))
    assert len(compile_mechanism(replace(GOOD, contacts=contacts)).contact_kind) == 50
