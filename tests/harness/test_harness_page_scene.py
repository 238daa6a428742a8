"""Pictures and charts of a page, by its scripts in node: those of the reports."""

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from page_in_node import in_node, needs_node

from harness.report.animation import picture_data
from harness.report.scene import Scene
from harness.run.drawing import WITH_POINTS, Shape

SHAPES = (
    Shape("disc", (0.0, "-y"), "eye", {"radius": "size"}),
    Shape("bar", ("x", "-y"), "arm", {"angle": "-turn", "length": 2.0}),
    Shape("bar", "arm", "hand", {"angle": "turn", "length": "size"}),
    Shape("striker", "arm"),
    Shape("wheel", (1.0, 0.0), "wheel", {"angle": "turn", "count": "teeth"}, (("size", 0.0), (0.3, "-y")), True),
    Shape("hinge", (0.0, 0.0)),
    Shape("link", ("x", 0.5), "plate", {"angle": "turn"}, ((0.0, 0.0), ("size", 0.1), (0.2, "y"), (0.1, 0.1))),
    Shape("polyline", (0.0, 0.0), "wall", {"angle": 0.3}, ((0.0, -1.0), (0.0, "size"))),
    Shape("polyline", ("x", 0.0), "teeth", {"angle": "turn"}, ((1.0, 0.0), ("size", 0.1)), copies=((0.5, "y", 2.5),)),
    Shape("spring", "plate.1", "coil", to="wall.1"),
    Shape("rod", (0.0, "y"), "rod", to=("x", 3.0)),
    Shape("trace", "plate.2", "path"),
)


def raw(shape: Shape) -> dict[str, Any]:
    """A shape as drawing.json has it."""
    entry: dict[str, Any] = {"kind": shape.kind, "at": shape.at, **shape.quantities}
    entry |= {"name": shape.name} if shape.name else {}
    entry |= {"points" if shape.kind in WITH_POINTS else "outline": shape.outline} if shape.outline else {}
    entry |= {"to": shape.to} if shape.to else {}
    entry |= {"copies": shape.copies} if shape.copies else {}
    return entry | ({"clockwise": True} if shape.clockwise else {})


@needs_node
def test_pictures_are_those_of_the_reports() -> None:
    rng = np.random.default_rng(7)
    scenes = []
    for _ in range(40):
        turn = np.cumsum(rng.uniform(-0.25, 0.25, rng.integers(1, 30)))
        x = rng.normal(size=len(turn))
        values = {"y": rng.normal(), "size": rng.uniform(0, 2), "teeth": rng.uniform(-2, 30)}
        shapes = SHAPES[: rng.integers(6, len(SHAPES) + 1)]
        scenes.append(Scene(shapes, {"turn": np.round(turn, 3), "x": np.round(x, 3)}, values))
    still = replace(scenes[0], columns={}, constants=scenes[0].constants | {"turn": 0.1, "x": 0.2})
    calls = [
        ["scene", [raw(s) for s in one.shapes], {n: c.tolist() for n, c in one.columns.items()}, one.constants]
        for one in (*scenes, still)
    ]
    for one, drawn in zip((*scenes, still), in_node(*calls), strict=True):
        expected = picture_data(one, {"turn"})
        assert expected is not None
        assert drawn["view"] == pytest.approx(expected["view"], rel=1e-12, abs=1e-12)
        for own, other in zip(drawn["shapes"], expected["shapes"], strict=True):
            other.pop("colour", None)
            assert own == json.loads(json.dumps(other))


@needs_node
def test_what_is_not_finite_or_has_no_extent_is_no_picture() -> None:
    disc = {"kind": "disc", "at": [0.0, 0.0], "name": "d", "radius": "r"}
    calls = [["scene", [disc], {}, {"r": radius}] for radius in (1e-10, 0.4e-12, None)]
    assert [one is None for one in in_node(*calls, ["scene", [], {}, {}])] == [False, True, True, True]
