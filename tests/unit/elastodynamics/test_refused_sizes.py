"""Each number of the public functions of elastodynamics and kinematics: what cannot be is refused by name and value."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from mechanism_fmu.elastodynamics import (
    GearTooth,
    bent_coupler,
    cantilever,
    critical_speeds,
    elastic_cycle,
    flywheel,
    growth_per_period,
    instantaneous_modes,
    lightest,
    mass_matrix,
    momentum_shaking,
    quasi_static,
    shaking,
    spatial_link,
    supported_beam,
    tapered_cantilever,
    torsion_shaft,
    turn,
    two_force_member,
    with_friction,
)
from mechanism_fmu.kinematics import analyse, cam_report, mobility
from mechanism_fmu.model import Section
from mechanism_fmu.stress import RectangularTooth
from models.four_bar_path_generator.model import MODEL

SECTION = Section(1e-4, 1e-9, 1e-2)
YOUNG = 2e11
TOOTH = GearTooth(0.01, 0.01, 0.005, 0.02, YOUNG, 0.3)
BEAM = RectangularTooth(0.1, 0.01, 0.01)
NOT_POSITIVE = (math.nan, math.inf, -math.inf, 0.0, -1.0)


def sized(element: Callable[..., object]) -> dict[str, Callable[[float], object]]:
    """An element by each of its sizes."""
    return {
        "length": lambda x: element(x, SECTION, YOUNG),
        "area": lambda x: element(1.0, replace(SECTION, area=x), YOUNG),
        "second_moment": lambda x: element(1.0, replace(SECTION, second_moment=x), YOUNG),
        "young": lambda x: element(1.0, SECTION, x),
    }


ELEMENTS = [
    (name, call)
    for element in (cantilever, two_force_member, supported_beam, spatial_link)
    for name, call in sized(element).items()
]
ELEMENTS += [
    ("length", lambda x: bent_coupler(x, 1.0, SECTION, YOUNG)),
    ("length", lambda x: bent_coupler(1.0, x, SECTION, YOUNG)),
    ("length", lambda x: torsion_shaft(x, 1e-9, 8e10)),
    ("polar_moment", lambda x: torsion_shaft(1.0, x, 8e10)),
    ("shear_modulus", lambda x: torsion_shaft(1.0, 1e-9, x)),
    ("modulus", lambda x: tapered_cantilever(BEAM, x)),
    ("height", lambda x: replace(TOOTH, height=x)),
    ("root_thickness", lambda x: replace(TOOTH, root_thickness=x)),
    ("contact_thickness", lambda x: replace(TOOTH, contact_thickness=x)),
    ("face_width", lambda x: replace(TOOTH, face_width=x)),
    ("young", lambda x: replace(TOOTH, young=x)),
]


@pytest.mark.parametrize("bad", NOT_POSITIVE)
@pytest.mark.parametrize(("name", "call"), ELEMENTS)
def test_a_size_of_an_element_is_refused(name: str, call: Callable[[float], object], bad: float) -> None:
    with pytest.raises(ValueError, match="must be positive and finite") as refusal:
        call(bad)
    assert name in str(refusal.value)
    assert f"{bad:g}" in str(refusal.value)


@pytest.mark.parametrize("bad", [math.nan, math.inf, -0.1, 1.1])
def test_poisson_s_ratio_of_a_tooth_is_refused(bad: float) -> None:
    with pytest.raises(ValueError, match=f"Poisson's ratio of the tooth is {bad:g}, but must lie between 0 and 1"):
        replace(TOOTH, poisson=bad)


ANGLES = np.linspace(0.0, 2 * math.pi, 37)
MECHANISM = MODEL.build(MODEL.values())


@pytest.fixture(scope="module")
def configured() -> object:
    return turn(MECHANISM, 10.0, 36)


@pytest.mark.parametrize("bad", NOT_POSITIVE)
def test_a_turn_is_refused(bad: float) -> None:
    with pytest.raises(ValueError, match=f"speed of the crank is {bad:g} rad/s, but must be positive and finite"):
        turn(MECHANISM, bad, 36)
    with pytest.raises(ValueError, match=f"{bad} samples of a turn are too few; give 8 or more"):
        turn(MECHANISM, 10.0, bad)  # type: ignore[arg-type]


@pytest.mark.parametrize("bad", NOT_POSITIVE)
def test_a_flywheel_is_refused(bad: float) -> None:
    with pytest.raises(ValueError, match=f"speed is {bad:g} rad/s; .* a positive one"):
        flywheel(ANGLES, np.sin(ANGLES), bad, 0.1)
    with pytest.raises(ValueError, match=f"coefficient of fluctuation is {bad:g}; give one above 0 and below 2"):
        flywheel(ANGLES, np.sin(ANGLES), 1.0, bad)


@pytest.mark.parametrize("bad", [math.nan, math.inf, -1.0])
def test_friction_is_refused(bad: float) -> None:
    with pytest.raises(ValueError, match=f"coefficient of friction is {bad:g}; give one from 0 on"):
        with_friction(MECHANISM, bad, 0.01)
    with pytest.raises(ValueError, match=f"radius of the pins is {bad:g} m; give one from 0 on"):
        with_friction(MECHANISM, 0.1, bad)


def test_what_a_cycle_cannot_take_is_refused(configured: object) -> None:
    still = quasi_static(configured)  # type: ignore[arg-type]
    moving = elastic_cycle(still, 0.02)
    modes = instantaneous_modes(still.configurations.stiffness, mass_matrix(still.configurations))
    for bad in (math.nan, math.inf, -0.1, 1.0):
        with pytest.raises(ValueError, match=f"damping ratio is {bad}, but must be 0 or more and below 1"):
            elastic_cycle(still, bad)
    for bad in (0, -1):
        with pytest.raises(ValueError, match=f"^{bad} harmonics: ask for one or more"):
            critical_speeds(modes, bad)
        with pytest.raises(ValueError, match=f"^{bad} steps of a period: there must be one or more"):
            growth_per_period(moving, bad)
    for moment in (shaking, momentum_shaking):
        for bad in (math.nan, math.inf):
            with pytest.raises(ValueError, match=rf"about = \({bad}, 0.0\), is not finite"):
                moment(still, (bad, 0.0))


@pytest.mark.parametrize("bad", [math.nan, 0.0, -1.0])
def test_limits_of_a_synthesis_are_refused(bad: float) -> None:
    def judge(_design: object) -> object:
        raise AssertionError("nothing is judged before the limits are known")

    for limits in ((bad, 1.0), (1.0, bad)):
        with pytest.raises(ValueError, match=f"limits are .*{bad:g}.*both must be positive"):
            lightest(judge, [1.0], [0.5], [2.0], *limits)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"must have as many numbers as the bounds .* and lie between them"):
        lightest(judge, [bad], [0.5], [2.0], 1.0, 1.0)  # type: ignore[arg-type]


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_a_time_that_is_none_is_refused(bad: float) -> None:
    with pytest.raises(ValueError, match=f"time = {bad:g} s is not finite"):
        mobility(MECHANISM, bad)
    with pytest.raises(ValueError, match="times must be finite and increase"):
        analyse(MECHANISM, [0.0, bad])


@pytest.mark.parametrize("bad", [0, -1, math.nan, math.inf])
def test_a_turn_of_a_cam_in_no_steps_is_refused(bad: float) -> None:
    with pytest.raises(ValueError, match=f"angles = {bad} steps of a turn; give 1 or more"):
        cam_report(MECHANISM, "pair", "cam", bad)  # type: ignore[arg-type]
