import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from harness.papers.study.study import Rim, rim_of
from harness.run.drawing import Drawing, Shape

ROOT_TWO = math.sqrt(2.0)


def wheel(**changed: object) -> Shape:
    quantities = {"angle": "wheel_angle", "count": "tooth_count"}
    outline = (("radius", 0.0), (1.5, "-lean"))
    return Shape("wheel", (0.0, 0.0), "wheel", quantities, **{"outline": outline, "clockwise": True} | changed)  # type: ignore[arg-type]


def test_a_square() -> None:
    x, y = Rim(4, (1.0,), (0.0,), clockwise=True).wheel()
    assert x == pytest.approx([1, 0, -1, 0, 1], abs=1e-15)
    assert y == pytest.approx([0, -1, 0, 1, 0], abs=1e-15)


@pytest.mark.parametrize("clockwise", [True, False])
def test_a_side_of_a_square_seen_from_its_root(clockwise: bool) -> None:
    # The radius to the root points up; a quarter further lies the next one, to the right.
    x, y = Rim(4, (ROOT_TWO,), (0.7,), clockwise).tooth()
    assert abs(x) == pytest.approx([0, ROOT_TWO], abs=1e-15)
    assert y == pytest.approx([0, -ROOT_TWO], abs=1e-15)
    assert x[1] > 0


@given(st.integers(3, 60), st.floats(0.5, 2.0), st.floats(-0.05, 0.05), st.booleans())
def test_the_rim_repeats_itself_from_tooth_to_tooth(count: int, radius: float, angle: float, clockwise: bool) -> None:
    rim = Rim(count, (1.0, radius), (0.0, angle), clockwise)
    x, y = rim.wheel()
    z = x + 1j * y
    assert z[-1] == z[0]
    assert len(z) == 2 * count + 1
    turned = z[2:] * np.exp((1 if clockwise else -1) * 2j * math.pi / count)
    assert turned == pytest.approx(z[:-2], abs=1e-12)


def test_the_numbers_are_the_parameters() -> None:
    parameters = {"tooth_count": 12, "radius": 2.0, "lean": 0.25}
    assert rim_of(Drawing((wheel(),)), parameters) == Rim(12, (2.0, 1.5), (0.0, -0.25), True)


def test_a_wheel_whose_form_is_no_parameter_has_no_rim() -> None:
    assert rim_of(Drawing((wheel(),)), {"tooth_count": 12, "radius": 2.0}) is None
    assert rim_of(Drawing((Shape("hinge", (0.0, 0.0)),)), {}) is None
