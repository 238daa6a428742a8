"""Parts attached by ends: what they become, that the old form still makes the same, and what is refused."""

import inspect
import math
import warnings
from dataclasses import fields, replace
from typing import Any

import pytest

from mechanism_fmu import model
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    AngleLock,
    AngleStop,
    Body,
    Brake,
    Bushing,
    CamFlatFollower,
    CamFollower,
    CircularPattern,
    ClearanceJoint,
    CompliantShaft,
    Damper,
    DCMotor,
    Distance,
    DistanceDriver,
    End,
    Force,
    Gears,
    InternalGears,
    LumpedMass,
    Marker,
    MechanismError,
    Member,
    NonlinearSpring,
    NonlinearTorsionSpring,
    Oscillation,
    Outline,
    OutlineContact,
    PointFollower,
    PointForce,
    PointLineContact,
    RackAndPinion,
    Revolute,
    RevoluteTranslational,
    Section,
    SlotClearanceJoint,
    SpringDamper,
    Torque,
    TorsionSpring,
    TorsionSpringDamper,
    Translational,
    TranslationalDriver,
    XDriver,
    YDriver,
    polynomial_motion,
)
from mechanism_fmu.model.attached import Attached
from mechanism_fmu.model.body import Frame
from tests.unit.model.test_joint_specs import EGG, ROUND

#: The frame of `rod` stands 0.1 m beside its centre of mass; that of `crank` in it.
ROD = Body("rod", 1.0, 1.0, centre=(0.1, 0.0))
CRANK = Body("crank", 1.0, 1.0)
DRIVE = polynomial_motion(0.0, 1.0)
SECTION = Section.rectangle(0.01, 0.02)

#: The new form, then the old one: both say the same part.
PAIRS: list[tuple[Any, Any]] = [
    (
        Revolute("x", ROD.at(0.0, 0.0), CRANK.at(0.05, 0.0), friction_radius=0.1),
        Revolute("x", "rod", (-0.1, 0.0), "crank", (0.05, 0.0), 0.1),
    ),
    (
        Translational("x", GROUND.line((0.0, 1.0), (1.0, 0.0)), ROD.line((0.1, 0.0), (0.0, 1.0)), friction=0.2),
        Translational("x", GROUND, (0.0, 1.0), (1.0, 0.0), "rod", (0.0, 0.0), (0.0, 1.0), 0.2),
    ),
    (Distance("x", ROD, GROUND.at(2.0, 1.0), distance=0.3), Distance("x", "rod", (-0.1, 0.0), GROUND, (2.0, 1.0), 0.3)),
    (
        RevoluteTranslational("x", GROUND.line((0.0, 1.0), (1.0, 0.0)), ROD.at(0.1, 0.0)),
        RevoluteTranslational("x", GROUND, (0.0, 1.0), (1.0, 0.0), "rod", (0.0, 0.0)),
    ),
    (
        Gears("x", ROD.at(0.1, 0.0), CRANK, radius_i=1.0, angle_i=0.1, radius_j=2.0, angle_j=0.2),
        Gears("x", "rod", 1.0, 0.1, "crank", 2.0, 0.2),
    ),
    (
        RackAndPinion("x", GROUND.line((0.0, 1.0), (0.0, 3.0)), CRANK, GROUND.at(0.0, 2.0), radius_j=0.5),
        RackAndPinion("x", GROUND, (0.0, 1.0), (0.0, 2.0), math.pi / 2, "crank", 0.5),
    ),
    (XDriver("x", ROD.at(0.1, 0.0), motion=DRIVE), XDriver("x", "rod", (0.0, 0.0), DRIVE)),
    (
        DistanceDriver("x", ROD.at(0.1, 0.0), CRANK.at(0.0, 0.2), motion=DRIVE),
        DistanceDriver("x", "rod", (0.0, 0.0), DRIVE, "crank", (0.0, 0.2)),
    ),
    (AngleDriver("x", CRANK, ROD, motion=DRIVE), AngleDriver("x", "crank", DRIVE, "rod")),
    (
        TranslationalDriver("x", CRANK, ROD.line((0.1, 0.0), (1.0, 1.0)), motion=DRIVE),
        TranslationalDriver("x", "crank", (0.0, 0.0), (1.0, 1.0), DRIVE, "rod", (0.0, 0.0)),
    ),
    (
        CamFollower("x", ROD, CRANK, profile_i=EGG, profile_j=ROUND, unilateral=True),
        CamFollower("x", "rod", EGG, "crank", ROUND, (-0.1, 0.0), (0.0, 0.0), True),
    ),
    (
        CamFlatFollower("x", ROD, CRANK.line((0.0, 0.5), (1.0, 0.0)), profile_i=EGG),
        CamFlatFollower("x", "rod", EGG, "crank", (0.0, 0.5), (1.0, 0.0), (-0.1, 0.0)),
    ),
    (
        PointFollower("x", ROD.at(0.0, 0.0), CRANK.at(0.1, 0.2), profile_j=EGG),
        PointFollower("x", "rod", (-0.1, 0.0), "crank", EGG, (0.1, 0.2)),
    ),
    (
        PointLineContact("x", ROD.at(0.0, 0.0), GROUND.line((0.0, 1.0), (2.0, 0.0)), restitution=0.5),
        PointLineContact("x", "rod", (-0.1, 0.0), GROUND, (0.0, 1.0), (0.0, 1.0), False, 0.5),
    ),
    (AngleStop("x", ROD, GROUND, angle=0.1), AngleStop("x", "rod", GROUND, 0.1)),
    (
        OutlineContact("x", ROD, CRANK, outline_i=Outline.circle(0.1), outline_j=Outline.circle(0.2)),
        OutlineContact("x", "rod", "crank", outline_i=Outline.circle(0.1).moved(-0.1), outline_j=Outline.circle(0.2)),
    ),
    (
        ClearanceJoint("x", ROD, CRANK.at(0.1, 0.2), pin_radius=0.1, clearance=0.01),
        ClearanceJoint("x", "rod", "crank", point_i=(-0.1, 0.0), point_j=(0.1, 0.2), pin_radius=0.1, clearance=0.01),
    ),
    (
        SlotClearanceJoint(
            "x", ROD, CRANK.line((0.1, 0.2), (1.0, 0.0)), travel=0.3, pin_radius=0.1, hole_radius="110 mm"
        ),
        SlotClearanceJoint(
            "x",
            "rod",
            "crank",
            point_i=(-0.1, 0.0),
            point_j=(0.1, 0.2),
            axis_j=(1.0, 0.0),
            travel=0.3,
            pin_radius=0.1,
            hole_radius=0.11,
        ),
    ),
    (AngleLock("x", ROD, CRANK, angle=0.1, pitch=0.2, closed_while="f"), AngleLock("x", "rod", "crank", 0.1, 0.2, "f")),
    (
        CircularPattern("x", ROD, CRANK.line((0.0, 0.0), (0.0, -1.0)), pitch=0.5),
        CircularPattern("x", "rod", (-0.1, 0.0), "crank", 0.5, (0.0, 0.0), (1.0, 0.0)),
    ),
    (Torque("x", CRANK, ROD, torque=2.0), Torque("x", "crank", "rod", 2.0)),
    (TorsionSpring("x", CRANK, stiffness=2.0), TorsionSpring("x", "crank", GROUND, 2.0)),
    (TorsionSpringDamper("x", CRANK, stiffness=2.0), TorsionSpringDamper("x", "crank", GROUND, 2.0)),
    (Damper("x", CRANK, damping=2.0), Damper("x", "crank", GROUND, 2.0)),
    (CompliantShaft("x", CRANK, stiffness=2.0), CompliantShaft("x", "crank", GROUND, 2.0)),
    (Brake("x", CRANK, limit=2.0), Brake("x", "crank", GROUND, 2.0)),
    (DCMotor("x", CRANK, constant=2.0), DCMotor("x", "crank", GROUND, 2.0)),
    (Force("x", CRANK, force=(1.0, 2.0)), Force("x", "crank", (1.0, 2.0))),
    (Marker("x", ROD.at(0.0, 0.2)), Marker("x", "rod", (-0.1, 0.2))),
    (Oscillation("x", ROD, middle=0.1), Oscillation("x", "rod", 0.1)),
    (
        PointForce("x", ROD.at(0.0, 0.2), force=(1.0, 2.0), frame="body"),
        PointForce("x", "rod", (-0.1, 0.2), (1.0, 2.0), "body"),
    ),
    (
        SpringDamper("x", ROD, GROUND.at(1.0, 2.0), stiffness=3.0),
        SpringDamper("x", "rod", (-0.1, 0.0), GROUND, (1.0, 2.0), 3.0),
    ),
    (Bushing("x", ROD, CRANK, stiffness_x=3.0), Bushing("x", "rod", (-0.1, 0.0), "crank", (0.0, 0.0), 3.0)),
    (
        NonlinearSpring("x", ROD, CRANK, law=DRIVE),
        NonlinearSpring("x", "rod", (-0.1, 0.0), "crank", (0.0, 0.0), law=DRIVE),
    ),
    (NonlinearTorsionSpring("x", ROD, CRANK, law=DRIVE), NonlinearTorsionSpring("x", "rod", "crank", law=DRIVE)),
    (
        Member("x", ROD.at(0.0, 0.0), ROD.at(0.2, 0.0), section=SECTION, young=1e9, density=1e3),
        Member("x", "rod", (-0.1, 0.0), (0.1, 0.0), SECTION, 1e9, 1e3),
    ),
    (LumpedMass("x", ROD.at(0.0, 0.0), mass=1.0), LumpedMass("x", "rod", (-0.1, 0.0), 1.0)),
]


@pytest.mark.parametrize(("new", "old"), PAIRS, ids=lambda part: type(part).__name__)
def test_both_forms_make_the_same_part(new: Attached, old: Attached) -> None:
    assert new == old
    assert hash(new) == hash(old)
    assert replace(new) == old  # which gives all fields by keyword
    assert repr(new) == repr(old)


def test_every_part_with_ends_is_there_and_made_in_the_one_way() -> None:
    """A part whose decorator leaves out init=False would have a constructor of its own."""
    kinds = {kind for name in model.__all__ if isinstance(kind := getattr(model, name), type)}
    attached = {kind for kind in kinds if issubclass(kind, Attached)}
    assert attached - {type(new) for new, _ in PAIRS} == {InternalGears, YDriver}  # like others
    for kind in attached:
        assert kind.__init__ is Attached.__init__
        assert set(kind.units) <= {field.name for field in fields(kind)}


def test_the_signature_has_the_ends_and_the_rest_by_keyword() -> None:
    assert str(inspect.signature(Revolute)) == "(name, body_i, body_j, *, friction_radius=0.0, friction_static=None)"
    assert str(inspect.signature(Torque)) == "(name, body, reaction='ground', *, torque=0.0)"
    for kind in {type(new) for new, _ in PAIRS}:
        first, *others = inspect.signature(kind).parameters.values()
        assert first.name == "name"
        ends = [each.name for each in others if each.kind is inspect.Parameter.POSITIONAL_OR_KEYWORD]
        assert ends == [slot.argument for slot in kind.slots]


def test_ends_may_be_given_by_keyword() -> None:
    assert Torque("x", body=CRANK, reaction=ROD) == Torque("x", CRANK, ROD)
    assert Revolute(name="x", body_i=CRANK.at(1, 2), body_j=GROUND) == Revolute("x", CRANK.at(1, 2), GROUND.at(0, 0))


def test_the_ground_is_a_text_still() -> None:
    assert GROUND == "ground"
    assert isinstance(GROUND, str)
    assert repr(GROUND) == "'ground'"
    assert {GROUND: 1}["ground"] == 1
    assert GROUND.at("5 mm", 1.0) == End("ground", (0.005, 1.0))


def test_a_line_has_a_direction_or_an_angle() -> None:
    x, y = GROUND.line((0, 0), angle="30 deg").direction
    assert (x, y) == pytest.approx((math.sqrt(3) / 2, 0.5), rel=1e-15)
    with pytest.raises(MechanismError, match=r"a direction .* or an angle, one of the two"):
        GROUND.line((0, 0))
    with pytest.raises(MechanismError, match=r"a direction .* or an angle, one of the two"):
        GROUND.line((0, 0), (1, 0), angle=0.0)


def test_numbers_may_be_texts_with_units() -> None:
    assert Torque("x", CRANK, torque="5 N.cm").torque == pytest.approx(0.05, rel=1e-15)
    assert AngleStop("x", ROD, CRANK, angle="30 deg", pitch="10 deg").angle == math.radians(30)
    spring = SpringDamper("x", ROD, CRANK, stiffness="2 N/mm", free_length="5 cm", damping="3 N.s/m", preload="1 kN")
    assert (spring.stiffness, spring.free_length, spring.damping, spring.preload) == (2000.0, 0.05, 3.0, 1000.0)
    assert Force("x", CRANK, force=("5 N", "1 kN")).force == (5.0, 1000.0)
    assert PointForce("x", CRANK, force=(0.5, "2 N")).force == (0.5, 2.0)


REFUSED: dict[str, tuple[Any, type[Exception], str]] = {
    "a number behind the ends": (
        lambda: Revolute("x", ROD, CRANK, 0.1),
        TypeError,
        "takes name, body_i, body_j by position, but 4 were given; give what is behind the ends by keyword",
    ),
    "a name where a point is wanted": (
        lambda: Revolute("x", "rod", CRANK),
        MechanismError,
        r"Revolute 'x' takes a point of 'rod'; write body_i.at\(x, y\)",
    ),
    "a point where a line is wanted": (
        lambda: Translational("x", GROUND.at(0, 0), CRANK),
        MechanismError,
        r"takes a line of 'ground'; write body_i.line\(\(x, y\), \(dx, dy\)\)",
    ),
    "a line where a point is wanted": (
        lambda: Revolute("x", ROD, GROUND.line((0, 0), (1, 0))),
        MechanismError,
        "at 'ground' it takes a point, not a line",
    ),
    "a point where the whole body is meant": (
        lambda: Torque("x", CRANK.at(0.1, 0.0)),
        MechanismError,
        "attached to 'crank' as a whole, not to a point of it; give the body itself",
    ),
    "a point twice": (
        lambda: Revolute("x", CRANK.at(0.1, 0.0), ROD, point_i=(1.0, 0.0)),
        MechanismError,
        "point_i is given twice",
    ),
    "a member from one body to another": (
        lambda: Member("x", ROD.at(0, 0), CRANK.at(0, 0), section=SECTION, young=1.0, density=1.0),
        MechanismError,
        "attached to 'rod' and 'crank'; give ends of one body",
    ),
    "a misspelt word": (lambda: Torque("x", CRANK, torgue=1.0), TypeError, "unexpected keyword argument 'torgue'"),
    "an end twice": (lambda: Torque("x", CRANK, body=ROD), TypeError, "multiple values for argument 'body'"),
    "nothing of what is needed": (lambda: Distance("x", ROD, CRANK), TypeError, "missing 1 required .*: 'distance'"),
    "a number of another kind": (
        lambda: Torque("x", CRANK, torque="5 kg"),
        MechanismError,
        "Torque 'x': torque wants N.m, got '5 kg'; give e.g. 0.5, or with a unit, '0.5 N.m'",
    ),
    "an angle in place of a direction": (
        lambda: CRANK.line((0, 0), "30 deg"),
        MechanismError,
        r"line: direction \(of an angle, write angle=...\) is '30 deg', but it must be a vector \(x, y\)",
    ),
    "a number in place of a direction": (
        lambda: GROUND.line((0, -1), 30),
        MechanismError,
        r"write angle=...\) is 30, but it must be a vector",
    ),
    "a number in place of a point of a line": (
        lambda: GROUND.line(0.1, (1, 0)),
        MechanismError,
        "line: point is 0.1, but it must be a point",
    ),
    "a force of another kind": (
        lambda: Force("x", CRANK, force=("5 kg", 0)),
        MechanismError,
        "Force 'x': force wants N, got '5 kg'",
    ),
    "an end of what is no bar": (lambda: CRANK.b, MechanismError, "Body 'crank' has no end b"),
    "a point of another kind": (lambda: CRANK.at("5 kg", 0), MechanismError, "at: x wants m, got '5 kg'"),
}


@pytest.mark.parametrize("what", REFUSED)
def test_what_is_refused_says_what_to_write(what: str) -> None:
    make, kind, said = REFUSED[what]
    with pytest.raises(kind, match=said):
        make()


def test_the_old_form_is_said_to_go_at_the_line_that_has_it() -> None:
    with pytest.warns(PendingDeprecationWarning) as said:
        Revolute("pin", "rod", (0.0, 0.0), "crank", (0.0, 0.0))
    assert said[0].filename == __file__
    text = str(said[0].message)
    assert text.startswith("Revolute 'pin' is written in the old form")
    assert text.endswith("write Revolute(name, body_i.at(x, y), body_j.at(x, y), ...=...).")


def test_names_in_place_of_whole_bodies_are_no_old_form() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert Torque("x", "crank", "rod") == Torque("x", CRANK, ROD)
        assert AngleStop("x", "crank", GROUND, angle=0.0) == AngleStop("x", CRANK, GROUND, angle=0.0)


def test_a_frame_must_say_where_its_points_are() -> None:
    """What forgets it is refused where it is made, not when the first part is attached."""

    class Floating(Frame):
        pass

    with pytest.raises(TypeError, match="abstract"):
        Floating()
