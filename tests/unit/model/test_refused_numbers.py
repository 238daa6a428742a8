"""Every number of every part: what cannot be is refused, by part, argument, value and limit; what can be is not."""

import math
from dataclasses import fields, replace
from typing import Any

import pytest

from mechanism_fmu import model
from mechanism_fmu.model import (
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
    Curve,
    Damper,
    DCMotor,
    Distance,
    DistanceDriver,
    Force,
    Gears,
    InternalGears,
    LogicalFunction,
    LumpedMass,
    Marker,
    Mechanism,
    MechanismError,
    Member,
    Model,
    Move,
    NonlinearSpring,
    NonlinearTorsionSpring,
    Oscillation,
    Parameter,
    Piece,
    PointFollower,
    PointForce,
    PointLineContact,
    RackAndPinion,
    Revolute,
    RevoluteTranslational,
    Section,
    Settings,
    SlotClearanceJoint,
    SpringDamper,
    Term,
    Torque,
    TorsionSpring,
    TorsionSpringDamper,
    Translational,
    TranslationalDriver,
    XDriver,
    YDriver,
    characteristic,
    circle,
    compile_mechanism,
    motion_profile,
    polynomial_motion,
    slot,
    spline_profile,
    table_motion,
)

A, B = Body("a", 1.0, 1.0), Body("b", 1.0, 1.0, (1.0, 0.0, 0.0))
HERE, EAST = (0.0, 0.0), (1.0, 0.0)
RAMP = polynomial_motion(1.0, 2.0)
STEEL = {"section": Section(1e-4, 1e-9, 1e-2), "young": 2e11, "density": 7850.0}
LOCK = AngleLock("x", "a", "b", 0.1, 0.2, "f")
LIMIT = LogicalFunction("f", "b.angle", 0.1)
LINE = PointLineContact("c", "a", HERE, "b", HERE, EAST)

PLAY = {"pin_radius": 0.1, "clearance": 0.01}

#: A sound part of each kind, and the place of a mechanism that it stands in.
PARTS: list[tuple[Any, str]] = [
    (Body("x", 1.0, 1.0, tooth_length=0.1), "bodies"),
    (Revolute("x", "a", HERE, "b", HERE, 0.01), "joints"),
    (Translational("x", "a", HERE, EAST, "b", HERE, EAST, 0.1), "joints"),
    (RevoluteTranslational("x", "a", HERE, EAST, "b", HERE, 0.1), "joints"),
    (Distance("x", "a", HERE, "b", HERE, 0.5), "joints"),
    (Gears("x", "a", 0.1, 0.0, "b", 0.2, 0.0), "joints"),
    (InternalGears("x", "a", 0.3, 0.0, "b", 0.2, 0.0), "joints"),
    (RackAndPinion("x", "a", HERE, HERE, 0.0, "b", 0.2), "joints"),
    (AngleDriver("x", "a", RAMP), "joints"),
    (XDriver("x", "a", HERE, RAMP), "joints"),
    (YDriver("x", "a", HERE, RAMP), "joints"),
    (DistanceDriver("x", "a", HERE, polynomial_motion(1.0)), "joints"),
    (TranslationalDriver("x", "a", HERE, EAST, RAMP), "joints"),
    (replace(LINE, name="x"), "contacts"),
    (AngleStop("x", "a", "b", 0.0, 0.1), "contacts"),
    (LOCK, "contacts"),
    (CamFollower("x", "a", circle(0.1), "b", circle(0.2)), "contacts"),
    (PointFollower("x", "a", HERE, "b", circle(0.2)), "contacts"),
    (CamFlatFollower("x", "a", circle(0.1), "b", HERE, EAST), "contacts"),
    (ClearanceJoint("x", A.at(0, 0), B.at(-1, 0), pin_radius=0.1, clearance=0.01), "contacts"),
    (ClearanceJoint("x", A.at(0, 0), B.at(-1, 0), pin_radius=0.1, hole_radius=0.11), "contacts"),
    (SlotClearanceJoint("x", A.at(0, 0), B.line((-1, 0), (1, 0)), travel=0.1, **PLAY), "contacts"),
    (Torque("x", "a"), "forces"),
    (TorsionSpring("x", "a"), "forces"),
    (Damper("x", "a"), "forces"),
    (CompliantShaft("x", "a"), "forces"),
    (Force("x", "a"), "forces"),
    (Brake("x", "a"), "forces"),
    (DCMotor("x", "a"), "forces"),
    (SpringDamper("x", "a", HERE, "b", HERE), "forces"),
    (TorsionSpringDamper("x", "a"), "forces"),
    (PointForce("x", "a"), "forces"),
    (Marker("x", "a", HERE), "markers"),
    (Oscillation("x", "a"), "oscillations"),
    (Bushing("x", "a", HERE, "b", HERE), "forces"),
    (NonlinearSpring("x", "a", HERE, "b", HERE, law=lambda length, speed: length + speed), "forces"),
    (NonlinearTorsionSpring("x", "a", law=characteristic([(0.0, 0.0), (1.0, 2.0)])), "forces"),
    (Member("x", "a", HERE, EAST, **STEEL), "members"),
    (LumpedMass("x", "a", HERE, 1.0), "lumped_masses"),
    (CircularPattern("x", "a", HERE, "b", 0.5, HERE, EAST), "patterns"),
    (replace(LIMIT, name="x"), "functions"),
    (Settings(), "settings"),
]
#: What the docstrings allow besides "finite": of force elements their classes say it, else the argument's name.
POSITIVE = (
    "pin_radius",
    "hole_radius",
    "clearance",
    "travel",
    "mass",
    "inertia",
    "tooth_length",
    "distance",
    "radius_i",
    "radius_j",
    "young",
)
NOT_NEGATIVE = ("friction", "friction_radius", "wear_coefficient")
SWITCHES = ("enabled", "closed", "guided", "unilateral")
DIRECTIONS = ("axis_i", "axis_j", "direction_j", "normal", "boundary_normal")
#: Arguments that a message calls otherwise.
WORDS = {"boundary_normal": "boundary normal", "start": "start|from", "end": "to ", "below": "its limit"}


def bad_values(part: Any, name: str) -> list[float]:
    """Values that cannot be."""
    bad = [math.nan, math.inf, -math.inf]
    if name == "pitch":
        return [*bad, 0.0] if isinstance(part, CircularPattern) else [*bad, 0.0, -0.1]
    if name in NOT_NEGATIVE or name in getattr(part, "not_negative", ()):
        return [*bad, -1e-300, -5.0]
    if isinstance(part, LumpedMass) and name in ("mass", "inertia"):
        return [*bad, -1.0]
    if isinstance(part, RevoluteTranslational) and name == "distance":
        return bad
    if name in POSITIVE or name in getattr(part, "positive", ()):
        return [*bad, 0.0, -1.0]
    if name in SWITCHES:
        return [*bad, 0.5, -1.0, 2.0]
    special = {
        "restitution": [-0.1, 1.1],
        "density": [-1.0],
        "relative_tolerance": [0.0, 9e-14, 1.1e-3],
        "max_internal_steps": [9.0, 1.1e9],
        "baumgarte_alpha": [-1.0],
        "baumgarte_beta": [-1.0],
    }
    return bad + special.get(name, [])


CASES = [
    (part, place, field.name, bad)
    for part, place in PARTS
    for field in fields(part)
    if not isinstance(getattr(part, field.name), str | Curve | Section | None)
    and field.name != "outline"  # of drawings alone
    for bad in bad_values(part, field.name)
]


def said(part: Any, place: str) -> str:
    """What a mechanism with the part is refused for; "" if it is not."""
    around: dict[str, Any] = {"bodies": (A, B)}
    if place == "contacts" and isinstance(part, AngleLock):
        around["functions"] = (LIMIT,)
    if place == "functions":
        around["contacts"] = (replace(LOCK, name="l", closed_while="x"),)
    if place == "patterns":
        around["contacts"] = (replace(LINE, pattern="x"),)
    if place == "lumped_masses":
        around["members"] = (Member("m", "a", HERE, EAST, **STEEL),)
    around[place] = part if place == "settings" else (A, B, part) if place == "bodies" else (part,)
    try:
        compile_mechanism(Mechanism(**around))
    except MechanismError as error:
        return str(error)
    return ""


@pytest.mark.parametrize(("part", "place"), PARTS, ids=lambda part: type(part).__name__)
def test_what_is_changed_was_sound(part: Any, place: str) -> None:
    assert said(part, place) == ""


def test_every_kind_of_part_is_there() -> None:
    """Whoever adds a part to the library adds it here."""
    parts = {type(part) for part, _ in PARTS}
    frozen = {kind for name in model.__all__ if hasattr(kind := getattr(model, name), "__dataclass_fields__")}
    others = {"Bar", "Calculated", "Curve", "Disc", "Finding", "Hinge", "Input", "LumpedBody", "Mechanism"}
    others |= {
        "MechanismTables",
        "Model",
        "Move",
        "Output",
        "Parameter",
        "Piece",
        "Section",
        "Striker",
        "Term",
        "Wheel",
    }
    others |= {"Link", "Polyline", "Rod", "Spring", "Trace"}
    # what is to be analysed is checked at the build: tests/unit/fmu/test_analysis_file.py
    # what makes parts: tests/unit/model/test_ends.py and test_solids.py
    others |= {"End", "Material"}
    others |= {"Outline"}  # tests/unit/model/test_outlines.py
    others |= {"OutlineContact", "CircularCopies", "LinearCopies"}  # tests/unit/model/test_outline_contacts.py
    others |= {"Case", "SineSignal", "TableSignal"}  # tests/unit/model/test_cases.py
    others |= {"Arm", "ImpactStress", "SawtoothWheel", "SeriesCompliance", "Strut"}
    others |= {"RectangularTooth", "TableBeam", "TrapezoidTooth", "WedgeTooth"}
    assert {kind.__name__ for kind in frozen if isinstance(kind, type)} - {kind.__name__ for kind in parts} == others
    assert len(CASES) > 400


@pytest.mark.parametrize(("part", "place", "name", "bad"), CASES)
def test_each_number_is_refused_by_name_value_and_limit(part: Any, place: str, name: str, bad: float) -> None:
    good = getattr(part, name)
    text = said(replace(part, **{name: (bad, *good[1:]) if isinstance(good, tuple) else bad}), place)
    if not isinstance(part, Settings):
        assert "'x'" in text
    assert any(word in text for word in WORDS.get(name, name).split("|"))
    unsigned = name in DIRECTIONS and ("normal" in name)  # of these, the length is told
    assert f"{abs(bad) if unsigned else bad:g}" in text
    assert any(limit in text for limit in LIMITS), text


#: Words for limits.
LIMITS = (
    "positive",
    "not be negative",
    "not negative",
    "not finite",
    "finite ends",
    "outside",
    "unit vector",
    "neither",
)
LIMITS += ("has no direction", "not zero")


@pytest.mark.parametrize("name", ["area", "second_moment", "depth"])
@pytest.mark.parametrize("bad", [math.nan, math.inf, 0.0, -1.0])
def test_a_section_is_refused(name: str, bad: float) -> None:
    section = replace(STEEL["section"], **{name: bad})
    text = said(Member("x", "a", HERE, EAST, **(STEEL | {"section": section})), "members")
    assert f"Member 'x': {name} of its section = {bad:g}" in text
    assert "must be positive and finite" in text


@pytest.mark.parametrize("axis", ["axis_i", "axis_j"])
def test_an_axis_of_no_length_is_refused(axis: str) -> None:
    text = said(replace(PARTS[2][0], **{axis: (0.0, 0.0)}), "joints")
    assert f"Translational 'x': {axis} = (0, 0) has no direction" in text


BAD = (math.nan, math.inf, -math.inf)
_GOOD_TERM = Term((1.0, 0.0, 0.0, 0.0, 0.0, 0.0), 0.5, 2.0, 0.1)
CURVES = {
    **{f"coefficient {k}": lambda bad, k=k: Curve((Piece(0.0, (Term((0.0,) * k + (bad,)),)),)) for k in range(6)},
    **{
        name: lambda bad, name=name: Curve((Piece(0.0, (replace(_GOOD_TERM, **{name: bad}),)),))
        for name in ("amplitude", "frequency", "phase")
    },
    "start of a piece": lambda bad: Curve((Piece(bad, (_GOOD_TERM,)),)),
    "start": lambda bad: replace(circle(0.1), start=bad),
    "span": lambda bad: replace(circle(0.1), span=bad),
    "radius": circle,
    "radius of a spline": lambda bad: spline_profile([1.0, bad, 1.0, 1.0]),
    "value of a table": lambda bad: table_motion([(0.0, 1.0), (1.0, bad), (2.0, 1.0)]),
    "radius of a slot": lambda bad: slot([(0.0, 1.0), (1.0, bad), (2.0, 1.0)]),
    "base radius": lambda bad: motion_profile(bad, [Move(0.0, 1.0)]),
    "lift": lambda bad: motion_profile(1.0, [Move(bad, 1.0)]),
}


@pytest.mark.parametrize("bad", BAD)
@pytest.mark.parametrize("what", CURVES)
def test_numbers_of_curves_are_refused_with_the_part_that_owns_it(what: str, bad: float) -> None:
    text = said(PointFollower("x", "a", HERE, "b", CURVES[what](bad)), "contacts")
    assert "The curve of 'x'" in text
    assert f"{bad:g}" in text
    assert "not finite" in text


@pytest.mark.parametrize("bad", [0.0, -1.0])
def test_a_period_that_is_none_is_refused(bad: float) -> None:
    text = said(PointFollower("x", "a", HERE, "b", replace(circle(0.1), span=bad)), "contacts")
    assert f"The curve of 'x' repeats itself after span = {bad:g}, which must be positive" in text


@pytest.mark.parametrize("bad", [*BAD, 1.0])
@pytest.mark.parametrize("make", [table_motion, slot])
def test_places_that_do_not_increase_are_refused(make: Any, bad: float) -> None:
    with pytest.raises(MechanismError, match=rf"increasing places.*{bad:g}"):
        make([(0.0, 1.0), (1.0, 2.0), (bad, 1.0), (3.0, 1.0)])


@pytest.mark.parametrize(
    ("bad", "said"), [(-0.1, r"width = -0.1 rad; it must not be neg"), (math.nan, "width = nan"), (7.0, "take 7 rad")]
)
def test_a_move_of_no_width_is_refused(bad: float, said: str) -> None:
    with pytest.raises(MechanismError, match=said):
        motion_profile(1.0, [Move(0.1, bad)])


@pytest.mark.parametrize("degree", [0, 2, 4, 6])
def test_a_degree_that_is_not_made_is_refused(degree: int) -> None:
    with pytest.raises(MechanismError, match=rf"degree {degree} is not made here; take 3 \(C2\) or 5"):
        spline_profile([1.0, 1.0, 1.0, 1.0], degree=degree)


@pytest.mark.parametrize(
    ("bad", "limit"),
    [(math.nan, "not a finite"), (math.inf, "not a finite"), (0.5, "at least 1 m"), (2.5, "at most 2 m")],
)
def test_a_parameter_is_refused(bad: float, limit: str) -> None:
    made = Model("M", "", (Parameter("size", 1.5, "", "m", 1.0, 2.0),), lambda _: Mechanism((A,)))
    for values in (
        lambda: made.values(size=bad),
        replace(made, parameters=(replace(made.parameters[0], start=bad),)).values,
    ):
        with pytest.raises(MechanismError, match=f"size = {bad:g}.*{limit}"):
            values()


@pytest.mark.parametrize(
    ("kind", "bad", "said"), [("Integer", 1.5, "not a whole number"), ("Boolean", 2.0, "neither true")]
)
def test_a_parameter_of_another_type_is_refused(kind: Any, bad: float, said: str) -> None:
    made = Model("M", "", (Parameter("size", 1.0, "", type=kind),), lambda _: Mechanism((A,)))
    with pytest.raises(MechanismError, match=f"size = {bad:g} is {said}"):
        made.values(size=bad)


@pytest.mark.parametrize("name", ["stop_time", "step_size"])
@pytest.mark.parametrize("bad", [*BAD, 0.0, -1.0])
def test_a_default_experiment_that_cannot_be_is_refused(name: str, bad: float) -> None:
    with pytest.raises(MechanismError, match=f"M: {name} = {bad:g} s, but it must be positive and finite"):
        Model("M", "", (), lambda _: Mechanism((A,)), **{name: bad})
