import json
from dataclasses import replace

import pendulum
import pytest

import models
from mechanism_fmu.fmu.parts.resources import DRAWING, drawing
from mechanism_fmu.model import Bar, Hinge, MechanismError, Wheel

ARM = Bar("arm", (0.0, 0.0), "angle", "length")


def test_a_model_without_a_drawing_has_no_file() -> None:
    assert drawing(pendulum.MODEL) == {}


def test_the_file_lists_the_shapes_with_their_kinds() -> None:
    wheel = Wheel("wheel", ("-length", 1), 0.5, "teeth", (("inertia", 0.0), (2.0, -0.1)), clockwise=True)
    files = drawing(replace(pendulum.MODEL, drawing=(ARM, Hinge("arm"), wheel)))
    assert DRAWING == "resources/drawing.json"
    assert list(files) == [DRAWING]
    assert json.loads(files[DRAWING]) == {
        "format": 1,
        "shapes": [
            {"kind": "bar", "name": "arm", "at": [0.0, 0.0], "angle": "angle", "length": "length"},
            {"kind": "hinge", "at": "arm"},
            {
                "kind": "wheel",
                "name": "wheel",
                "at": ["-length", 1],
                "angle": 0.5,
                "count": "teeth",
                "outline": [["inertia", 0.0], [2.0, -0.1]],
                "clockwise": True,
            },
        ],
    }


def test_the_same_drawing_gives_the_same_bytes() -> None:
    model = models.load("ratchet").MODEL
    assert drawing(model) == drawing(replace(model))
    assert drawing(model)[DRAWING].decode("ascii").endswith("}\n")


@pytest.mark.parametrize("name", ["psi", "torque", "impacts[1].time", "arm"])
def test_what_is_no_parameter_and_no_output_of_the_fmu_is_refused(name: str) -> None:
    with pytest.raises(MechanismError, match="Bar 'arm': the model has no variable"):
        drawing(replace(pendulum.MODEL, drawing=(Bar("arm", (0.0, 0.0), name, 1.0),)))
