import math

import pytest

from mechanism_fmu.stress import STEEL, Material


def test_steel_is_the_material_of_the_paper():
    assert Material(youngs_modulus=2.06e11, density=7850.0, damping_ratio=0.03) == STEEL


@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
@pytest.mark.parametrize(("field", "name"), [("youngs_modulus", "Young's modulus"), ("density", "density")])
def test_impossible_constant_is_refused_by_name(field, name, value):
    constants = {"youngs_modulus": 2.06e11, "density": 7850.0, "damping_ratio": 0.03, field: value}
    with pytest.raises(ValueError, match=rf"^{name} = {value:g} \S+, but it must lie between .*steel has"):
        Material(**constants)


@pytest.mark.parametrize("value", [-0.01, 1.0, 3.0, math.nan])
def test_damping_that_does_not_oscillate_is_refused(value):
    with pytest.raises(ValueError, match=rf"^damping ratio = {value:g}, but .* between 0 and 0\.99.*oscillate"):
        Material(youngs_modulus=2.06e11, density=7850.0, damping_ratio=value)


def test_undamped_material_is_allowed():
    assert Material(youngs_modulus=2.06e11, density=7850.0, damping_ratio=0.0).damping_ratio == 0.0
