"""The Geneva drive with play: its parameters-to-tables function, what it refuses, its drawing."""

import math
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest
from derivatives import assert_derivatives_agree

from docs.drawings import geneva_clearance_drawing
from mechanism_fmu.model import MechanismError
from models.geneva_clearance.geometry import SLOT_COUNT
from models.geneva_clearance.model import MODEL
from models.geneva_clearance.ports import SHAPES

#: A large drive, so that differences of its lengths are more than rounding.
LARGE = {
    "centre_distance": 10.0,
    "pin_diameter": 0.8,
    "slot_clearance": 0.05,
    "locking_clearance": 0.04,
    "mouth_radius": 0.1,
}
POINTS = {
    "pin outside": {**LARGE, "driver_angle_start": 0.3},
    "pin in the slot": {**LARGE, "driver_angle_start": 3.4},
}


@pytest.mark.parametrize("point", POINTS)
def test_derivatives_agree_with_differences(point: str) -> None:
    for parameter in MODEL.parameters:
        assert_derivatives_agree(MODEL, vars(MODEL.values(**POINTS[point])), parameter.name)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"pin_diameter": 0.04}, "make the slots run into each other"),
        ({"centre_distance": 10.0}, "pin_diameter = 0.008 m must be more than 0.005 centre_distance = 0.05 m"),
        ({"mouth_radius": 0.004}, "are left of the wheel's rim: pin_diameter = 0.008 m must be more than"),
    ],
)
def test_what_cannot_be_is_refused_in_words(values: dict[str, float], message: str) -> None:
    with pytest.raises(MechanismError, match=re.escape(message)):
        MODEL.build(MODEL.values(**values))


def test_the_arm_that_is_drawn_goes_on_where_the_next_begins() -> None:
    values = MODEL.values()
    known = {one.name: float(one.value) for one in MODEL.build(values).calculated}
    wheel = SHAPES[0]
    points = [(known[str(radius)], known[str(angle)]) for radius, angle in wheel.outline]  # type: ignore[union-attr]
    (first_radius, first), (last_radius, last) = points[0], points[-1]
    assert last - first == pytest.approx(2 * math.pi / SLOT_COUNT, rel=1e-14)
    assert last_radius == pytest.approx(first_radius, rel=1e-14)
    middle = points[len(points) // 2]
    assert middle[1] == pytest.approx(math.pi / SLOT_COUNT, rel=1e-14)
    assert middle[0] + known["outline_disc_radius"] == pytest.approx(values.centre_distance - 1e-4, rel=1e-12)


def test_drawing_is_that_of_the_defaults() -> None:
    folder = Path(geneva_clearance_drawing.__file__).parents[2] / "models" / "geneva_clearance"
    written = (folder / "drawing.svg").read_text(encoding="utf-8")
    command = "run python -m docs.drawings.geneva_clearance_drawing"
    assert written == geneva_clearance_drawing.drawing(MODEL.values()), command
    ElementTree.fromstring(written)
