"""Motion laws of cams against their known ends and peaks (Norton)."""

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.model import (
    Curve,
    MechanismError,
    Move,
    cycloidal,
    dwell,
    modified_sine,
    motion_profile,
    polynomial_345,
)
from tests.curve_values import jumps, value

LAWS = [cycloidal, modified_sine, polynomial_345]
LAWS_AND_DWELL = [*LAWS, dwell]
RISE = st.floats(-3.0, 3.0)
WIDTH = st.floats(0.1, 2.0)


@pytest.mark.parametrize("law", LAWS)
@given(start=RISE, base=RISE, rise=RISE, width=WIDTH)
def test_it_begins_and_ends_at_rest_without_acceleration(law, start, base, rise, width):
    curve = Curve(law(start, base, rise, width))
    assert curve.pieces[0].start == start
    for x, expected in ((start, base), (start + width, base + rise)):
        found = [value(curve, x, order) * width**order for order in range(3)]
        assert found == pytest.approx([expected, 0, 0], abs=1e-10)


@pytest.mark.parametrize("law", LAWS)
@given(start=RISE, rise=RISE, width=WIDTH)
def test_its_pieces_join_with_two_derivatives(law, start, rise, width):
    curve = Curve(law(start, 1.0, rise, width))
    for order in range(3):
        assert jumps(curve, order) == pytest.approx([0.0] * (len(curve.pieces) - 1), abs=1e-11 / width**order)


@pytest.mark.parametrize("law", LAWS)
@given(place=st.floats(0.0, 1.0))
def test_its_second_half_mirrors_the_first(law, place):
    curve = Curve(law(0.0, 0.0, 1.0, 1.0))
    assert value(curve, place) + value(curve, 1.0 - place) == pytest.approx(1.0, abs=1e-14)


@pytest.mark.parametrize(
    ("law", "velocity", "acceleration", "where"),
    [
        (cycloidal, 2.0, 2 * math.pi, 0.25),
        (polynomial_345, 1.875, 10 / math.sqrt(3), (3 - math.sqrt(3)) / 6),
        (modified_sine, 4 * math.pi / (math.pi + 4), 4 * math.pi**2 / (math.pi + 4), 0.125),
    ],
)
def test_its_peaks_are_the_known_ones(law, velocity, acceleration, where):
    rise, width = 0.02, 1.5
    curve = Curve(law(0.5, 0.1, rise, width))
    u = np.linspace(0.0, 1.0, 4801)[:-1]
    speeds = [value(curve, 0.5 + width * x, 1) * width / rise for x in u]
    accelerations = [value(curve, 0.5 + width * x, 2) * width**2 / rise for x in u]
    assert value(curve, 0.5 + width / 2, 1) * width / rise == pytest.approx(velocity, rel=1e-12)
    assert max(speeds) == pytest.approx(velocity, rel=1e-12)
    assert value(curve, 0.5 + width * where, 2) * width**2 / rise == pytest.approx(acceleration, rel=1e-12)
    assert max(np.abs(accelerations)) == pytest.approx(acceleration, rel=1e-6)


def test_the_peak_factors_as_tables_give_them():
    """Rounded to the digits that the docstrings of the laws state."""
    factors = 2 * math.pi, 10 / math.sqrt(3), 4 * math.pi**2 / (math.pi + 4)
    assert [round(factor, digits) for factor, digits in zip(factors, (3, 4, 3), strict=True)] == [6.283, 5.7735, 5.528]


MOVES = st.lists(st.builds(Move, RISE, WIDTH, st.sampled_from(LAWS)), max_size=3)


@given(MOVES, st.sampled_from(LAWS), st.floats(4.0, 5.0))
def test_a_program_of_moves_closes_without_a_jump_of_acceleration(moves, back, base):
    curve = motion_profile(base, moves, back)
    assert value(curve, 0.0) == base
    for order in range(3):
        assert jumps(curve, order) == pytest.approx([0.0] * len(curve.pieces), abs=1e-8)
    reached = 0.0
    for move in moves:
        reached += move.width
        assert value(curve, reached) == pytest.approx(base + move.lift, abs=1e-9)


@pytest.mark.parametrize("back", LAWS_AND_DWELL)
def test_a_program_that_has_come_back_rests(back):
    curve = motion_profile(0.1, [Move(0.02, 1.0), Move(0.02, 0.5, dwell), Move(0.0, 1.0)], back)
    for x in np.linspace(2.6, 6.2, 7):
        assert [value(curve, x, order) for order in range(4)] == pytest.approx([0.1, 0, 0, 0], abs=1e-14)


@pytest.mark.parametrize("back", LAWS_AND_DWELL)
@pytest.mark.parametrize("third", [2 * math.pi / 3, math.nextafter(2 * math.pi / 3, 3)])
def test_a_program_may_fill_the_turn(back, third):
    curve = motion_profile(0.1, [Move(0.02, third), Move(0.03, third), Move(0.0, third)], back)
    assert jumps(curve, 0) == pytest.approx([0.0] * len(curve.pieces), abs=1e-14)


def test_a_program_that_does_not_come_back_is_seen_to_jump():
    assert jumps(motion_profile(0.1, [Move(0.02, 1.0)], dwell), 0) == pytest.approx([0.0, -0.02], abs=1e-15)


@pytest.mark.parametrize("law", LAWS_AND_DWELL)
def test_a_move_of_no_width_that_leads_nowhere_is_none(law):
    nothing = Move(0.02, 0.0, law)
    curve = motion_profile(0.1, [Move(0.02, 1.0), nothing, Move(0.0, 1.0)])
    plain = motion_profile(0.1, [Move(0.02, 1.0), Move(0.0, 1.0)])
    assert jumps(curve, 0) == pytest.approx([0.0] * len(curve.pieces), abs=1e-15)
    starts = [piece.start for piece in curve.pieces]
    assert starts == sorted(starts)
    for x in np.linspace(0.0, 6.0, 25):
        assert [value(curve, x, order) for order in range(4)] == [value(plain, x, order) for order in range(4)]


@pytest.mark.parametrize("law", LAWS)
def test_a_rise_over_no_width_is_seen_to_jump(law):
    curve = motion_profile(0.1, [Move(0.02, 0.0, law), Move(0.0, 1.0)])
    assert sum(map(abs, jumps(curve, 0))) > 0.01


@pytest.mark.parametrize(
    ("moves", "fragments"),
    [
        ([Move(0.1, 1.0), Move(0.0, -0.5)], ["Move 2", "width = -0.5 rad", "not be negative"]),
        ([Move(0.1, math.nan)], ["Move 1", "width = nan rad"]),
        ([Move(0.1, 4.0), Move(0.0, 3.0)], ["take 7 rad", "6.28319 rad", "narrower"]),
    ],
)
def test_moves_that_cannot_be_are_refused(moves, fragments):
    with pytest.raises(MechanismError) as refusal:
        motion_profile(1.0, moves)
    for fragment in fragments:
        assert fragment in str(refusal.value)
