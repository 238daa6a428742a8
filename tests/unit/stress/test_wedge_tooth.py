import math

import numpy as np
import pytest

from mechanism_fmu.stress import WedgeTooth

TOOTH = WedgeTooth(length=0.05, apex_angle=0.5, thickness=0.03)


def test_thickness_is_the_papers_unless_given():
    assert WedgeTooth(length=0.05, apex_angle=0.5).thickness == 0.02


def test_root_section_is_a_rectangle():
    height, root = 0.05 * math.tan(0.5), np.array([0.0])
    assert TOOTH.area(root) == pytest.approx(0.03 * height)
    assert TOOTH.second_moment(root) == pytest.approx(0.03 * height**3 / 12)
    assert TOOTH.section_modulus(root) == pytest.approx(0.03 * height**2 / 6)
    assert TOOTH.outer_fibre(root) == pytest.approx(height / 2)


def test_sections_follow_equation_14_along_the_tooth():
    x = np.linspace(0.0, 0.05, 11)
    left = 0.05 - x
    np.testing.assert_allclose(TOOTH.area(x), 0.03 * left * math.tan(0.5), rtol=1e-14)
    np.testing.assert_allclose(TOOTH.second_moment(x), 0.03 / 12 * left**3 * math.tan(0.5) ** 3, rtol=1e-14)
    np.testing.assert_allclose(TOOTH.section_modulus(x), 0.03 / 6 * left**2 * math.tan(0.5) ** 2, rtol=1e-14)


def test_outer_fibre_is_second_moment_over_section_modulus_and_exact_at_the_tip():
    x = np.linspace(0.0, 0.05, 11)
    inside = x[:-1]
    np.testing.assert_allclose(
        TOOTH.outer_fibre(inside), TOOTH.second_moment(inside) / TOOTH.section_modulus(inside), rtol=1e-13
    )
    assert TOOTH.outer_fibre(x)[-1] == 0.0


@pytest.mark.parametrize("value", [0.0, -0.01, math.nan, math.inf, 1e308])
@pytest.mark.parametrize(
    ("field", "name"), [("length", "length"), ("apex_angle", "apex angle"), ("thickness", "thickness")]
)
def test_impossible_size_is_refused_by_name_with_value_and_limits(field, name, value):
    sizes = {"length": 0.05, "apex_angle": 0.5, "thickness": 0.02, field: value}
    with pytest.raises(ValueError, match=rf"^tooth {name} = .*{value:g}".replace("+", r"\+")) as refusal:
        WedgeTooth(**sizes)
    assert "must lie between" in str(refusal.value)


def test_right_angle_is_no_wedge():
    with pytest.raises(ValueError, match=r"tooth apex angle = 1\.5708 rad.*below a right angle"):
        WedgeTooth(length=0.05, apex_angle=math.pi / 2)


def test_angle_in_degrees_is_refused_with_the_way_out():
    with pytest.raises(ValueError, match=r"tooth apex angle = 30 rad.*in radians"):
        WedgeTooth(length=0.05, apex_angle=30.0)
