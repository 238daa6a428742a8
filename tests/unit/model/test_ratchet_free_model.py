"""The free ratchet's parameters-to-tables function: what it refuses, symbolic numbers, its drawing."""

import math
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest
from derivatives import assert_derivatives_agree

from docs.drawings import ratchet_free_drawing
from mechanism_fmu.model import MechanismError
from mechanism_fmu.simulation import Simulation
from models.ratchet.model import MODEL as RATCHET
from models.ratchet_free.model import MODEL, tooth_outline
from models.ratchet_free.ports import SHAPES
from models.ratchet_free.start import TOOTH_COUNT

#: With a given start angle, the crank's and the hinge's place still matter.
POINTS = {"on the slope": {}, "given": {"pawl_angle_start": 3.0, "drive_stiffness": 5.0, "holding_pawl": True}}


@pytest.mark.parametrize("point", POINTS)
def test_derivatives_agree_with_differences(point: str) -> None:
    values = vars(MODEL.values(**POINTS[point]))
    for parameter in MODEL.parameters:
        if parameter.type != "Boolean" and (parameter.name != "pawl_angle_start" or values[parameter.name]):
            assert_derivatives_agree(MODEL, values, parameter.name)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"tooth_slope_angle": math.radians(80)}, "tooth_slope_angle = 80 deg gives teeth without height"),
        ({"slope_ratio": 0.9}, "slope_ratio = 0.9 gives blunt teeth"),
        ({"crank_length": 0.05}, "The crank pin starts 0.0281137 m behind the line on which the nose slides"),
        ({"pawl_length": 0.03}, "pawl_length = 0.03 m is 0.0"),
        ({"tooth_tip_radius": 0.01}, "tooth_tip_radius = 0.01 m is too large"),
    ],
)
def test_values_that_fit_no_ratchet_are_refused_in_words(values: dict[str, float], message: str) -> None:
    with pytest.raises(MechanismError, match=re.escape(message)):
        MODEL.build(MODEL.values(**values))


def test_the_largest_rounding_that_is_named_fits() -> None:
    with pytest.raises(MechanismError) as refusal:
        MODEL.build(MODEL.values(tooth_tip_radius=0.01))
    allowed = float(str(refusal.value).split("Give less than ")[1].split(" m")[0])
    MODEL.build(MODEL.values(tooth_tip_radius=allowed * (1 - 1e-5)))


def test_a_nose_inside_a_tooth_is_refused_with_the_depth() -> None:
    mechanism = MODEL.build(MODEL.values(nose_radius=5e-3, crank_angle_start=1.52, wheel_angle_start=1.25))
    with pytest.raises(MechanismError, match=r"'pawl' reaches 0.0\d+ m into 'wheel'"):
        Simulation(mechanism)


def test_what_it_shares_with_the_ratchet_has_its_names_and_limits() -> None:
    theirs = {parameter.name: parameter for parameter in RATCHET.parameters}
    own = [parameter for parameter in MODEL.parameters if parameter.name not in theirs]
    assert [parameter.name for parameter in own] == ["nose_radius", "tooth_tip_radius"]
    for parameter in MODEL.parameters:
        other = theirs.get(parameter.name, parameter)
        assert (parameter.minimum, parameter.maximum, parameter.unit) == (other.minimum, other.maximum, other.unit)


def test_the_teeth_are_drawn_where_they_are() -> None:
    values = MODEL.values()
    known = vars(values) | {c.name: c.value for c in MODEL.build(values).calculated}
    wheel = SHAPES[0]
    drawn = [
        (known.get(radius, radius), known.get(angle, angle))
        for radius, angle in wheel.outline  # type: ignore[union-attr]
    ]
    corners = [(math.hypot(x, y), math.atan2(y, x)) for x, y in tooth_outline(values).points[:0:-1]]
    assert drawn == [pytest.approx(corner, abs=1e-15) for corner in corners]
    assert wheel.count == TOOTH_COUNT  # type: ignore[union-attr]


def test_drawing_is_that_of_the_defaults() -> None:
    folder = Path(ratchet_free_drawing.__file__).parents[2] / "models" / "ratchet_free"
    written = (folder / "drawing.svg").read_text(encoding="utf-8")
    assert written == ratchet_free_drawing.drawing(MODEL.values()), "run python -m docs.drawings.ratchet_free_drawing"
    ElementTree.fromstring(written)
