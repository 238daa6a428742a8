"""The drawing that a model gets that gives none: its shapes, and the variables that they need."""

import cmath
import json
import math
from dataclasses import replace
from types import SimpleNamespace

import pytest

import models
from mechanism_fmu.fmu.parts.resources import DRAWING, drawing
from mechanism_fmu.model import (
    GROUND,
    Body,
    CamFollower,
    CircularCopies,
    Disc,
    Distance,
    Gears,
    Hinge,
    LinearCopies,
    Link,
    Marker,
    Mechanism,
    Model,
    Move,
    NonlinearSpring,
    Outline,
    OutlineContact,
    Output,
    Parameter,
    PointLineContact,
    Polyline,
    Revolute,
    RevoluteTranslational,
    Rod,
    Spring,
    SpringDamper,
    Striker,
    TorsionSpring,
    Trace,
    Wheel,
    bar,
    circle,
    compile_mechanism,
    disc,
    motion_profile,
    plate,
)
from mechanism_fmu.model.trace import trace

LENGTH = (Parameter("length", 0.4, "Length", "m", 0.1, 1.0),)
ANGLE = Output("angle", "rod.angle", "", "rad")


def pendulum(values: SimpleNamespace) -> Mechanism:
    half = values.length / 2
    return Mechanism(
        (Body("rod", 1.0, 0.02, (half, 0.0, 0.0)),),
        (Revolute("pin", "rod", (-half, 0.0), GROUND, (0.1, 0.0)),),
        forces=(SpringDamper("spring", "rod", (half, 0.0), GROUND, (0.3, -0.5), 10.0, 0.3),),
        outputs=(ANGLE,),
        held=("rod.angle",),
    )


MODEL = Model("Pendulum", "", LENGTH, pendulum)


def test_a_body_is_drawn_by_its_joints_and_springs_and_poses_become_outputs() -> None:
    assert MODEL.shapes == (
        Link("rod", ("rod_x", "rod_y"), "angle", (("drawing_rod_0_x", 0.0), ("drawing_rod_1_x", 0.0))),
        Spring("spring", "rod.1", (0.3, -0.5)),
        Hinge((0.1, 0.0)),
    )
    mechanism = MODEL.build(MODEL.values(length=0.6))
    assert [(o.name, o.source) for o in mechanism.outputs] == [
        ("angle", "rod.angle"),
        ("rod_x", "rod.x"),
        ("rod_y", "rod.y"),
    ]
    assert [(c.name, c.value) for c in mechanism.calculated] == [("drawing_rod_0_x", -0.3), ("drawing_rod_1_x", 0.3)]


def test_the_file_in_the_fmu_has_it_and_it_can_be_traced() -> None:
    assert b'"kind":"link","name":"rod"' in drawing(MODEL)[DRAWING]
    assert trace(MODEL).evaluate(MODEL.values(length=0.7)).output_value[-2] == pytest.approx(-0.35)


def test_a_model_that_cannot_be_traced_is_drawn_all_the_same() -> None:
    def branching(values: SimpleNamespace) -> Mechanism:
        return pendulum(values) if values.length > 0.2 else pendulum(SimpleNamespace(length=0.2))

    model = Model("Pendulum", "", LENGTH, branching)
    assert model.shapes[0].points[0][0] == "drawing_rod_0_x"
    found = {c.name: c.value for c in model.build(model.values(length=0.15)).calculated}
    assert found["drawing_rod_0_x"] == -0.1
    assert found["drawing_pin_x"] == 0.1


def test_shapes_are_added_to_it_or_replace_it() -> None:
    trace_of_the_end = Trace("end", "rod.1")
    assert replace(MODEL, drawing=(..., trace_of_the_end)).shapes == (*MODEL.shapes, trace_of_the_end)
    replaced = replace(MODEL, drawing=(Hinge((0.0, 0.0)),))
    assert replaced.shapes == (Hinge((0.0, 0.0)),)
    assert replaced.build(replaced.values()).outputs == (ANGLE,)
    assert replace(MODEL, drawing=()).shapes == ()


def test_other_parts_and_names_that_are_taken() -> None:
    block = Body("block", 1.0, 0.1, (0.5, 0.5, 0.0))
    wheel = Body("wheel", 1.0, 0.1, (1.0, 0.0, 0.0))
    loose = Body("loose", 1.0, 0.1, (2.0, 0.0, 0.0))
    mechanism = Mechanism(
        (block, wheel, loose),
        (
            RevoluteTranslational("guide", GROUND, (0.0, 0.5), (1.0, 0.0), "block", (0.0, 0.0)),
            Distance("strut", "block", (0.1, 0.0), "wheel", (0.0, 0.2), 0.6),
            Gears("mesh", "block", 0.1, 0.0, "wheel", 0.2, 0.0),
        ),
        contacts=(PointLineContact("stop", "block", (0.1, -0.1), GROUND, (0.0, 0.2), (0.0, 1.0)),),
        forces=(
            NonlinearSpring("buffer", "block", (0.0, 0.1), "wheel", (0.0, 0.0), law=lambda x, v: x),
            TorsionSpring("coil", "wheel"),
        ),
        outputs=(Output("block_x", "wheel.x", "", "m"),),
    )
    model = Model("Parts", "", (), lambda _: mechanism)
    shapes = model.shapes
    assert {type(shape) for shape in shapes} >= {Polyline, Link, Spring, Rod, Striker}
    by_name = {getattr(shape, "name", ""): shape for shape in shapes}
    assert by_name["guide"].points == ((-1.0, 0.5), (1.0, 0.5))
    assert by_name["stop"].points == ((1.0, 0.2), (-1.0, 0.2))  # through its point, across its normal
    assert by_name["block"].at == ("block_x_2", "block_y")
    assert by_name["wheel"].at[0] == "block_x"
    assert by_name["loose"].points == ((0.0, 0.0),)
    assert by_name["block (mesh)"].radius == 0.1
    assert by_name["buffer"].at.startswith("block.")
    drawing(model)  # which checks it
    compile_mechanism(model.build(model.values()))


@pytest.mark.parametrize("name", models.available())
def test_every_model_could_be_drawn_so(name: str) -> None:
    model = replace(models.load(name).MODEL, drawing=None)
    assert drawing(model)
    compile_mechanism(model.build(model.values()))
    trace(model)


def test_solids_are_drawn_as_they_were_given() -> None:
    """A bar from end to end, a plate by its corners from its centre of mass, a disc by its radius."""

    def mechanism(values: SimpleNamespace) -> Mechanism:
        rod = bar("rod", (0.0, 0.0), length=values.length, angle=0.0, mass=1.0)
        wedge = plate("wedge", [(0.0, 0.0), (0.3, 0.0), (0.0, 0.3)], mass=1.0)
        wheel = disc("wheel", radius=values.length, mass=1.0)
        joints = (Revolute("pin", rod.a, GROUND), Revolute("a", wedge, rod.b), Revolute("b", wheel, wedge.corners[1]))
        return Mechanism((rod, wedge, wheel), joints)

    shapes = {getattr(shape, "name", ""): shape for shape in Model("Solids", "", LENGTH, mechanism).shapes}
    corners = [float(x) for point in shapes["wedge (plate)"].points for x in point]
    assert corners == pytest.approx([-0.1, -0.1, 0.2, -0.1, -0.1, 0.2], abs=1e-15)
    assert shapes["wheel (disc)"] == Disc("wheel (disc)", ("wheel_x", "wheel_y"), "drawing_wheel_radius")
    assert shapes["rod"].points[:2] == (("drawing_rod_0_x", 0.0), ("drawing_rod_1_x", 0.0))


def test_cams_are_drawn_by_points_of_their_profiles() -> None:
    def mechanism(values: SimpleNamespace) -> Mechanism:
        cam, follower = Body("cam", 1.0, 0.1), Body("follower", 1.0, 0.1, (0.0, 0.3, 0.0))
        lift = motion_profile(values.length, (Move(0.1, 1.0), Move(0.0, 1.0)))
        pair = CamFollower("pair", "cam", lift, "follower", circle(0.05), centre_i=(0.01, 0.0), unilateral=True)
        return Mechanism((cam, follower), contacts=(pair,))

    model = Model("Cam", "", LENGTH, mechanism)
    cam, roller = (shape for shape in model.shapes if isinstance(shape, Wheel))
    assert (cam.name, cam.at, cam.angle, cam.count) == ("cam (pair)", "cam.0", "cam_angle", 1.0)
    assert {radius for radius, _ in roller.outline} == {0.05}
    assert [angle for _, angle in cam.outline] == pytest.approx([2 * math.pi * k / 36 for k in range(36)])
    found = {c.name: c.value for c in model.build(model.values(length=0.5)).calculated}
    assert found["drawing_pair_i_radius_0"] == 0.5
    top = 1.0 / (2 * math.pi / 36)  # the rise ends at 1 rad
    assert found[f"drawing_pair_i_radius_{round(top)}"] == pytest.approx(0.6, abs=1e-4)
    drawing(model)
    trace(model)


def test_markers_are_traced_and_read_and_no_point_is_drawn_twice() -> None:
    def marked(values: SimpleNamespace) -> Mechanism:
        found = pendulum(values)
        (rod,) = found.bodies
        markers = (Marker("pen", rod.at(0.0, 0.1)), Marker("end", "rod", (-(values.length / 2), 0.0)))
        return replace(found, markers=markers, outputs=())

    model = Model("Pendulum", "", LENGTH, marked)
    shapes = {getattr(shape, "name", ""): shape for shape in model.shapes}
    assert shapes["pen"].at == "rod.2"
    assert len(shapes["rod"].points) == 3
    assert shapes["end"].at == "rod.0"  # the pin's point, found again whatever the length is
    outputs = {output.name: output for output in model.build(model.values()).outputs}
    assert [outputs[f"pen_{name}"].unit for name in ("x", "y", "x_rate", "y_rate")] == ["m", "m", "m/s", "m/s"]
    assert outputs["pen_x"].source == Marker("pen", "rod", (0.0, 0.1)).x


def test_numbers_of_a_joint_with_the_name_of_a_corner_have_names_of_their_own() -> None:
    def mechanism(values: SimpleNamespace) -> Mechanism:
        rod = bar("rod", (0.0, 0.0), length=values.length, angle=0.0, mass=1.0)
        return Mechanism((rod,), (Revolute("rod_1", GROUND.at(values.length, 0.0), rod.b),), held=("rod.angle",))

    model = Model("Rod", "", LENGTH, mechanism)
    names = [known.name for known in model.build(model.values()).calculated]
    assert names == ["drawing_rod_0_x", "drawing_rod_1_x", "drawing_rod_1_x_2"]
    assert model.shapes[-1] == Hinge(("drawing_rod_1_x_2", 0.0))
    drawing(model)
    again = Model("Again", "", LENGTH, model.mechanism)  # of a mechanism that is drawn already
    assert again.shapes == model.shapes
    assert [known.name for known in again.build(again.values()).calculated] == names


@pytest.mark.parametrize("long", [1.0, 1e-3, 200.0])
def test_a_guide_is_drawn_by_its_direction_however_long_that_is(long: float) -> None:
    block = Body("block", 1.0, 0.1, (0.5, 0.5, 0.0))
    guide = RevoluteTranslational("guide", GROUND.line((0.0, 0.5), (0.6 * long, 0.8 * long)), block)
    line = Model("Guided", "", (), lambda _: Mechanism((block,), (guide,))).shapes[0]
    assert [x for point in line.points for x in point] == pytest.approx([-0.15, 0.3, 0.15, 0.7], rel=1e-12)


def toothed(copies: CircularCopies | LinearCopies, tooth: Outline | None = None) -> Model:
    """Two pins that may meet the same teeth, whose size is a parameter."""

    def mechanism(values: SimpleNamespace) -> Mechanism:
        wheel, pin, other = (
            Body("wheel", 1.0, 0.1),
            Body("pin", 1.0, 0.1, (9.0, 0.0, 0.0)),
            Body("other", 1.0, 0.1, (0.0, 9.0, 0.0)),
        )
        teeth = tooth or Outline.circle(0.1 * values.length, (values.length, 0.0))
        contacts = (
            OutlineContact("one", pin, wheel, outline_i=Outline.circle(0.1), outline_j=teeth, copies=copies),
            OutlineContact("two", other, wheel, outline_i=Outline.circle(0.1), outline_j=teeth, copies=copies),
        )
        return Mechanism((wheel, pin, other), contacts=contacts)

    return Model("Toothed", "", LENGTH, mechanism)


def test_teeth_are_drawn_once_however_many_touch_them_and_copies_have_no_numbers_of_their_own() -> None:
    model = toothed(CircularCopies(4))
    (teeth,) = (shape for shape in model.shapes if shape.name.endswith("_wheel"))
    assert teeth.name == "one_wheel"
    assert teeth.copies == ((0.0, 0.0, 0.5 * math.pi), (0.0, 0.0, math.pi), (0.0, 0.0, 1.5 * math.pi))
    found = {c.name: c.value for c in model.build(model.values(length=1.0)).calculated}
    assert len(found) == 2 * len(teeth.points) - 2  # of two points y is 0 whatever the length is
    assert all("wheel" in name for name in found)
    points = [(found.get(x, x), found.get(y, y)) for x, y in teeth.points]
    assert [math.hypot(x - 1.0, y) for x, y in points] == pytest.approx([0.1] * len(points), rel=1e-12)
    (entry,) = (s for s in json.loads(drawing(model)[DRAWING])["shapes"] if s.get("name") == "one_wheel")
    assert entry["copies"] == [[0.0, 0.0, 0.5 * math.pi], [0.0, 0.0, math.pi], [0.0, 0.0, 1.5 * math.pi]]
    trace(model)


def test_teeth_in_a_row_are_some_of_them_and_open_ones_around_a_wheel_one_line() -> None:
    (row,) = (shape for shape in toothed(LinearCopies((0.5, 0.0))).shapes if shape.name == "one_wheel")
    assert row.copies == tuple((0.5 * k, 0.0, 0.0) for k in (-5, -4, -3, -2, -1, 1, 2, 3, 4, 5))
    tooth = Outline.chain([(1.0, -0.2), (1.2, 0.0), (1.0, 0.2)])
    (rim,) = (shape for shape in toothed(CircularCopies(3), tooth).shapes if shape.name == "one_wheel")
    assert rim.copies == ()
    assert len(rim.points) == 9
    turn = cmath.exp(2j * math.pi / 3)
    second = [turn * complex(*point) for point in tooth.points]
    assert [complex(*point) for point in rim.points[3:6]] == pytest.approx(second, rel=1e-12)
