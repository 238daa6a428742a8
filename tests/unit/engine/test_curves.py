"""The engine's value and derivatives of curves against numpy's polynomials."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from mechanism_fmu.engine.compiler.subset import entry
from mechanism_fmu.engine.profiles.curves import curve as value_and_derivatives
from mechanism_fmu.model import AngleDriver, Body, Curve, Mechanism, Piece, Term
from mechanism_fmu.model.compile import compile_tables
from mechanism_fmu.tables.layout import pack
from tests.curve_values import value


@entry
def engine_curve(block, number, x):
    return value_and_derivatives(block, number, x)


NUMBER = st.floats(-3.0, 3.0)
TERM = st.builds(Term, st.lists(NUMBER, max_size=6).map(tuple), NUMBER, NUMBER, NUMBER)
STARTS = st.lists(st.floats(0.1, 2.0), min_size=1, max_size=6).map(lambda widths: np.cumsum([-1.0, *widths]).tolist())


@st.composite
def curves(draw, periodic):
    """A curve with the end of its range."""
    *starts, end = draw(STARTS)
    pieces = tuple(Piece(start, tuple(draw(st.lists(TERM, max_size=3)))) for start in starts)
    return Curve(pieces, -1.0, end + 1.0, periodic)


def block_of(*those):
    """Curves as motions of as many drivers; no checks, as curves need not join here."""
    drivers = tuple(AngleDriver(f"driver_{k}", "body", curve) for k, curve in enumerate(those))
    return pack(compile_tables(Mechanism((Body("body", 1.0, 1.0),), drivers)))


def require_same(found, curve, x):
    for order in range(4):
        assert found[order] == pytest.approx(value(curve, x, order), rel=1e-11, abs=1e-9)


@settings(deadline=None)
@given(curves(periodic=False), curves(periodic=False), st.floats(-4.0, 14.0))
def test_value_and_derivatives(first, second, x):
    block = block_of(first, second)
    require_same(engine_curve(block, 0, x), first, x)
    require_same(engine_curve(block, 1, x), second, x)


@settings(deadline=None)
@given(curves(periodic=True), st.floats(0.0, 1.0, exclude_max=True), st.integers(-1000, 1000))
def test_a_periodic_curve_repeats_itself(curve, part, turns):
    within = curve.start + 1e-6 + part * (curve.span - 2e-6)
    starts = np.array([piece.start for piece in curve.pieces])
    if np.abs(starts - within).min() < 1e-9:
        within += 1e-8  # where a curve jumps, rounding decides
    found = np.array(engine_curve(block_of(curve), 0, within + turns * curve.span))
    expected = [value(curve, within, order) for order in range(4)]
    np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-6)


@settings(deadline=None)
@given(curves(periodic=False))
def test_a_piece_holds_from_its_start_on(curve):
    block = block_of(curve)
    for piece in curve.pieces:
        require_same(engine_curve(block, 0, piece.start), curve, piece.start)
        before = math.nextafter(piece.start, -math.inf)
        require_same(engine_curve(block, 0, before), curve, before)


def test_the_first_piece_holds_before_its_start_and_the_last_one_for_ever():
    line, parabola = Piece(0.0, (Term((1.0, 2.0)),)), Piece(1.0, (Term((3.0, 0.0, 4.0)),))
    block = block_of(Curve((line, parabola)))
    assert engine_curve(block, 0, -5.0) == (-9.0, 2.0, 0.0, 0.0)
    assert engine_curve(block, 0, 11.0) == (403.0, 80.0, 8.0, 0.0)


def test_of_two_pieces_at_one_place_the_second_holds():
    """So the first of them holds before that place alone (`table_motion`)."""
    rest, line = Piece(1.0, (Term((5.0,)),)), Piece(1.0, (Term((5.0, 2.0)),))
    block = block_of(Curve((rest, line)))
    assert engine_curve(block, 0, 0.5)[:2] == (5.0, 0.0)
    assert engine_curve(block, 0, 1.0)[:2] == (5.0, 2.0)
