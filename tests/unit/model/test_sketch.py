"""Points of a sketch: the closed forms keep all lengths, and the branches are those of the ready-made four-bar."""

import math
from types import SimpleNamespace

import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.model import (
    Body,
    Mechanism,
    MechanismError,
    Model,
    dyad,
    four_bar_points,
    length_parameter,
    toward,
)
from mechanism_fmu.model.four_bar import start
from mechanism_fmu.model.symbol import Recorder, Symbol
from mechanism_fmu.model.trace import trace


@given(st.floats(-2, 2), st.floats(-2, 2), st.floats(0.6, 1.5), st.floats(0.6, 1.5), st.sampled_from(["left", "right"]))
def test_a_dyad_has_its_lengths_and_side(x: float, y: float, p: float, q: float, side: str) -> None:
    b = (x + math.cos(y), y + math.sin(y))  # 1 m away: the circles cross
    if abs(p - q) > 0.99:
        return
    pin = dyad((x, y), b, from_a=p, from_b=q, side=side)
    assert math.dist((x, y), pin) == pytest.approx(p, rel=1e-12)
    assert math.dist(b, pin) == pytest.approx(q, rel=1e-12)
    left = (b[0] - x) * (pin[1] - y) - (b[1] - y) * (pin[0] - x)
    assert left > 0 if side == "left" else left < 0


@pytest.mark.parametrize("branch", ["open", "crossed"])
@pytest.mark.parametrize("angle", [-2.0, 0.0, 0.7, 3.0])
def test_the_branches_are_those_of_the_ready_made_four_bar(branch: str, angle: float) -> None:
    lengths = {"crank_length": 0.05, "coupler_length": 0.18, "rocker_length": 0.12, "ground_length": 0.2}
    at = start(
        SimpleNamespace(**lengths, crossed=float(branch == "crossed"), crank_angle_start=angle, crank_speed_start=1.0)
    )
    pins = four_bar_points((0, 0), (0.2, 0), crank=0.05, coupler="18 cm", rocker=0.12, angle=angle, branch=branch)
    assert pins.rocker_pin[0] == pytest.approx(0.2 + 0.12 * math.cos(at.rocker_angle), abs=1e-15)
    assert pins.rocker_pin[1] == pytest.approx(0.12 * math.sin(at.rocker_angle), abs=1e-15)
    assert math.dist(pins.crank_pin, pins.rocker_pin) == pytest.approx(0.18, rel=1e-14)


def test_links_that_do_not_reach_each_other_are_refused() -> None:
    """A point somewhere between would give bars other lengths than were asked for, without a word."""
    with pytest.raises(MechanismError, match="links of 1 m and 2 m do not reach each other over the 4 m between"):
        dyad((0, 0), (4, 0), from_a=1.0, from_b=2.0)
    with pytest.raises(MechanismError, match="links of 1 m and 4 m do not reach"):
        dyad((0, 0), (2, 0), from_a=1.0, from_b=4.0)
    assert dyad((0, 0), (0.3, 0), from_a=0.1, from_b=0.2) == pytest.approx((0.1, 0.0), abs=1e-6)  # in one line


def test_links_that_begin_in_one_point_are_refused() -> None:
    with pytest.raises(MechanismError, match="links of 1 m and 2 m have their other ends in one point"):
        dyad((4, 1), (4, 1), from_a=1.0, from_b=2.0)


def test_between_a_point_and_itself_there_is_no_way() -> None:
    with pytest.raises(MechanismError, match=r"toward: both points are \(2, 1\) m"):
        toward((2, 1), (2, 1), 1)


def test_points_may_be_texts_with_units() -> None:
    assert toward(("1 mm", 0), (0.003, "0 mm"), "1 mm") == pytest.approx((0.002, 0.0))
    assert dyad(("4 mm", 0), (0, 0), from_a="5 mm", from_b="3 mm")[1] == pytest.approx(-0.003)
    texts = four_bar_points(("0 mm", 0), ("20 cm", 0), crank=0.05, coupler=0.18, rocker=0.12, angle=1.0)
    assert texts == four_bar_points((0.0, 0), (0.2, 0), crank=0.05, coupler=0.18, rocker=0.12, angle=1.0)
    for wrong, said in (("ab", "toward: a is 'ab', but it must be a point"), (("1 kg", 0), "toward: a wants m, got")):
        with pytest.raises(MechanismError, match=said):
            toward(wrong, (1, 1), 1)


def test_of_parameters_it_is_the_trace_that_refuses_links() -> None:
    recorder = Recorder()
    x, _ = dyad((0, 0), (4, 0), from_a=recorder.parameter(0), from_b=2.0)
    assert isinstance(x, Symbol)
    (refused,) = recorder.refusals  # 4 m apart is known: no finding of that
    assert refused.text.startswith("dyad: links of {:g} m and {:g} m do not reach each other over the {:g} m between")
    assert refused.numbers[1:] == (2.0, 4.0)


def test_of_parameters_it_is_the_pin_of_plain_lengths_to_the_bit() -> None:
    drawn = []

    def pinned(values: SimpleNamespace) -> Mechanism:
        drawn.append(dyad((0, 0), (4, 0), from_a=values.link, from_b=2.0))
        return Mechanism(bodies=(Body("pin", 1.0, 1.0, (*drawn[-1], 0.0)),))

    link = length_parameter("link", 3.0, "Length of the link that begins at the origin")
    traced = trace(Model("Pin", "The pin of two links", (link,), pinned))
    pin = next(point for point in drawn if isinstance(point[0], Symbol))
    assert tuple(traced.numbers(pin, SimpleNamespace(link=3.5))) == dyad((0, 0), (4, 0), from_a=3.5, from_b=2.0)
    (objection,) = traced.objections
    (applies,) = traced.numbers([objection.applies], SimpleNamespace(link=1.0))
    assert applies > 0.0
