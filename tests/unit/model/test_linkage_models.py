"""Slider-crank and four-bar: their parameters-to-tables functions, what is refused, what is warned of."""

import math
import re

import numpy as np
import pytest
from derivatives import assert_derivatives_agree

from mechanism_fmu.model import MechanismError
from mechanism_fmu.simulation import Simulation
from models.four_bar.model import MODEL as FOUR_BAR
from models.four_bar_path_generator.model import MODEL as PATH_GENERATOR
from models.slider_crank.model import MODEL as SLIDER_CRANK

POINTS = [
    pytest.param(SLIDER_CRANK, {"crank_angle_start": 0.7, "offset": 0.03, "gravity": 9.81}, id="slider-crank"),
    pytest.param(SLIDER_CRANK, {"crank_length": 0.3, "crank_angle_start": 2.8}, id="slider-crank that swings"),
    pytest.param(FOUR_BAR, {"crank_angle_start": 0.7, "gravity": 9.81, "spring_stiffness": 0.1}, id="four-bar, open"),
    pytest.param(FOUR_BAR, {"crank_angle_start": 4.0, "crossed": 1, "crank_length": 0.3}, id="four-bar, crossed"),
    pytest.param(PATH_GENERATOR, {"crank_angle_start": 0.7, "arm_angle": -1.0, "arm_depth": 8e-3}, id="path generator"),
]


@pytest.mark.parametrize(("model", "point"), POINTS)
def test_derivatives_agree_with_differences(model, point):
    for name in (p.name for p in model.parameters if p.type != "Boolean"):
        assert_derivatives_agree(model, vars(model.values(**point)), name)


@pytest.mark.parametrize("degrees", range(-180, 541, 15))
@pytest.mark.parametrize(
    ("model", "point"),
    [(SLIDER_CRANK, {"offset": 0.06}), (FOUR_BAR, {}), (FOUR_BAR, {"crossed": 1}), (PATH_GENERATOR, {})],
)
def test_it_can_start_at_any_angle_just_there(model, point, degrees):
    """Assembly moves nothing: the start is exact."""
    mechanism = model.build(model.values(**point, crank_angle_start=math.radians(degrees)))
    state = Simulation(mechanism).field("y_end")
    given = (
        [x for body in mechanism.bodies for x in body.start],
        [x for body in mechanism.bodies for x in body.start_rate],
    )
    np.testing.assert_allclose(state[:18], np.concatenate(given), rtol=0, atol=1e-14)


@pytest.mark.parametrize("shift", [1e-6, 1e-3, 0.1])
@pytest.mark.parametrize("offset", [0.19, -0.19])
def test_a_rod_that_does_not_reach_the_line_is_refused_with_the_least_that_does(offset, shift):
    angle = -math.copysign(math.radians(30), offset)
    given = {"crank_angle_start": angle, "offset": offset, "rod_length": 0.215 - shift}
    with pytest.raises(MechanismError, match=r"rod_length = .* does not reach the slider's line") as refusal:
        SLIDER_CRANK.build(SLIDER_CRANK.values(**given))
    least = float(re.search(r"Give more than (\S+) m", str(refusal.value))[1])
    assert least == pytest.approx(0.215, rel=1e-6)
    Simulation(SLIDER_CRANK.build(SLIDER_CRANK.values(**given | {"rod_length": least + 1e-6})))


@pytest.mark.parametrize(
    ("lengths", "text"),
    [
        (
            {"ground_length": 0.4},
            r"coupler_length \+ rocker_length = 0.3 m is too short: .* is 0.35 m .* more than 0.05 m",
        ),
        ({"rocker_length": 0.4}, r"differ by 0.22 m, which is too much: .* is 0.15 m .* less than 0.15 m"),
        ({"coupler_length": 0.4}, r"differ by 0.28 m, which is too much"),
        ({"crank_length": 0.2}, r"At crank_angle_start = 0 deg the crank pin lies on the rocker's hinge"),
    ],
    ids=str,
)
def test_links_that_do_not_meet_are_refused_with_what_is_missing(lengths, text):
    with pytest.raises(MechanismError, match=text):
        FOUR_BAR.build(FOUR_BAR.values(**lengths))


def test_links_that_just_meet_are_refused_and_a_little_more_is_not():
    """Stretched in line, coupler and rocker cannot say where they go."""
    for excess, refused in ((0.0, True), (1e-12, True), (1e-8, False)):
        values = FOUR_BAR.values(ground_length=0.25 + 0.1, coupler_length=0.18 + excess)
        assert bool(FOUR_BAR.refused(values)) == refused
    Simulation(FOUR_BAR.build(values))


@pytest.mark.parametrize(
    ("model", "lengths", "text"),
    [
        (SLIDER_CRANK, {}, None),
        (SLIDER_CRANK, {"offset": -0.149}, None),
        (SLIDER_CRANK, {"offset": -0.15}, "Change point: .* Give a rod longer by more than 4e-07 m"),
        (SLIDER_CRANK, {"rod_length": 0.05}, "Change point: .*offset. = 0 m"),
        (SLIDER_CRANK, {"crank_length": 0.25, "offset": 0.05}, "Change point: .* longer or shorter"),
        (SLIDER_CRANK, {"offset": 0.16}, "cannot turn fully: rod_length = 0.2 m .* = 0.21 m"),
        (FOUR_BAR, {}, None),
        (FOUR_BAR, {"ground_length": 0.05, "crank_length": 0.2}, None),
        (
            FOUR_BAR,
            {"rocker_length": 0.05, "coupler_length": 0.2},
            "Change point: ground \\+ crank = coupler \\+ rocker",
        ),
        (
            FOUR_BAR,
            {"coupler_length": 0.2, "rocker_length": 0.35},
            "Change point: ground \\+ rocker|ground \\+ coupler",
        ),
        (FOUR_BAR, {"coupler_length": 0.12, "rocker_length": 0.12}, "rocker_length = 0.24 m is shorter than .* 0.25 m"),
        (FOUR_BAR, {"crank_length": 0.16, "coupler_length": 0.26}, "differ by 0.14 m, .* only by 0.04 m"),
    ],
    ids=lambda value: getattr(value, "name", str(value)),
)
def test_a_crank_that_cannot_turn_fully_is_warned_of(model, lengths, text):
    warned = model.warned(model.values(**lengths))
    if text is None:
        assert warned == []
    else:
        (message,) = warned
        assert re.search(text, message)


@pytest.mark.parametrize("speed", [3.0, -3.0])
def test_a_parallelogram_is_warned_of_and_is_one_until_it_lies_flat(speed):
    lengths = {"ground_length": 0.2, "coupler_length": 0.2, "crank_length": 0.05, "rocker_length": 0.05}
    values = FOUR_BAR.values(**lengths, crank_angle_start=math.pi / 2, crank_speed_start=speed, drive_damping=0.0)
    (message,) = FOUR_BAR.warned(values)
    assert "Change point" in message
    assert "undetermined" in message
    simulation = Simulation(FOUR_BAR.build(values))
    for time in np.linspace(0.0, 0.5, 11):
        simulation.advance(time)
        found = simulation.read()
        assert found["rocker_angle"] == pytest.approx(found["crank_angle"], abs=1e-9)
        assert found["coupler_angle"] == pytest.approx(0.0, abs=1e-9)
        assert found["crank_speed"] == pytest.approx(speed, abs=1e-8)
