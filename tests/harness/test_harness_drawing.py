import json
from pathlib import Path

import pytest
from fake_slave import fake_description
from hypothesis import given, strategies as st

from harness.run.drawing import Drawing, Shape, read_drawing

ARM = {"kind": "bar", "name": "arm", "at": [0, "-tooth_pitch"], "angle": "wheel_angle", "length": 2}
WHEEL = {"kind": "wheel", "name": "wheel", "at": [0, 0], "angle": 0, "count": "tooth_count", "outline": [[1, 0]]}

TEETH = {"kind": "polyline", "name": "teeth", "at": [0, 0], "angle": 0, "points": [[1, 0], [2, 0]]}


def read(folder: Path, text: str) -> Drawing:
    (folder / "resources").mkdir(exist_ok=True)
    (folder / "resources" / "drawing.json").write_text(text, encoding="utf-8")
    return read_drawing(folder, fake_description())


def read_shapes(folder: Path, *shapes: object) -> Drawing:
    return read(folder, json.dumps({"format": 1, "shapes": shapes}))


def test_an_fmu_without_a_drawing_is_no_trouble(tmp_path: Path) -> None:
    assert read_drawing(tmp_path, fake_description()) == Drawing((), "")


def test_shapes_are_read_in_their_order(tmp_path: Path) -> None:
    teeth = TEETH | {"copies": [[0, "tooth_pitch", 1.5]]}
    drawing = read_shapes(tmp_path, ARM, WHEEL | {"clockwise": True}, {"kind": "striker", "at": "arm"}, teeth)
    assert drawing.objection == ""
    assert drawing.shapes == (
        Shape("bar", (0.0, "-tooth_pitch"), "arm", {"angle": "wheel_angle", "length": 2.0}),
        Shape("wheel", (0.0, 0.0), "wheel", {"angle": 0.0, "count": "tooth_count"}, ((1.0, 0.0),), True),
        Shape("striker", "arm"),
        Shape(
            "polyline",
            (0.0, 0.0),
            "teeth",
            {"angle": 0.0},
            ((1.0, 0.0), (2.0, 0.0)),
            copies=((0.0, "tooth_pitch", 1.5),),
        ),
    )


@pytest.mark.parametrize(
    ("shape", "problem"),
    [
        (ARM | {"angle": "psi"}, "angle of bar 'arm' is the variable 'psi', which the FMU has not"),
        (ARM | {"angle": "note"}, "'note', which the FMU has not"),
        (ARM | {"angle": "impacts[1].time"}, "which the FMU has not"),
        (ARM | {"length": None}, "length of bar 'arm' is None, neither a number nor the name of a variable"),
        (ARM | {"length": True}, "is True, neither"),
        (ARM | {"length": float("inf")}, "is inf, neither"),
        (ARM | {"at": [0]}, "place of bar 'arm' is no pair of numbers"),
        (ARM | {"at": "arm"}, "bar 'arm' starts from 'arm', which is no bar before it"),
        (ARM | {"name": ""}, "shape 1 has no name"),
        (ARM | {"kind": "tube"}, "shape 1 is of the unknown kind 'tube'"),
        (ARM | {"kind": ["bar"]}, "unknown kind"),
        (WHEEL | {"outline": []}, "wheel 'wheel' has no outline"),
        (WHEEL | {"outline": [1]}, "outline of wheel 'wheel' is no pair"),
        (TEETH | {"copies": [[0, 0]]}, "copies of polyline 'teeth' are no list of x, y and an angle each"),
        (TEETH | {"copies": {"0": 1}}, "copies of polyline 'teeth' are no list"),
        (TEETH | {"copies": [[0, 0, "psi"]]}, "copies of polyline 'teeth' is the variable 'psi'"),
        ("arm", "shape 1 is of the unknown kind None"),
    ],
)
def test_a_shape_that_cannot_be_drawn_is_an_objection(tmp_path: Path, shape: object, problem: str) -> None:
    drawing = read_shapes(tmp_path, shape)
    assert drawing.shapes == ()
    assert problem in drawing.objection
    assert drawing.objection.endswith("Build the FMU again.")


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("{", "it is no JSON"),
        ("[" * 100_000, "it is no JSON"),
        ("[]", "it holds no list of shapes"),
        ('{"format": 1}', "it holds no list of shapes"),
        ('{"format": 2, "shapes": []}', "its format is 2, and this harness knows format 1"),
    ],
)
def test_a_damaged_file_is_an_objection(tmp_path: Path, text: str, problem: str) -> None:
    assert problem in read(tmp_path, text).objection


def test_a_file_that_cannot_be_read_is_an_objection(tmp_path: Path) -> None:
    (tmp_path / "resources" / "drawing.json").mkdir(parents=True)
    assert "it cannot be read" in read_drawing(tmp_path, fake_description()).objection


JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.sampled_from(["arm", "bar", "wheel", "wheel_angle"]),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(
            st.sampled_from(["kind", "name", "at", "angle", "length", "count", "outline", "copies"]), inner
        )
    ),
)


@given(shapes=st.lists(JSON, max_size=4))
def test_no_content_is_a_traceback(tmp_path_factory: pytest.TempPathFactory, shapes: list[object]) -> None:
    drawing = read_shapes(tmp_path_factory.mktemp("fmu"), *shapes)
    assert len(drawing.shapes) in (0, len(shapes))
    assert bool(drawing.objection) == (len(drawing.shapes) < len(shapes))
