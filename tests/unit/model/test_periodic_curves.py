"""Curves that repeat themselves: all of their pieces are looked at, the last one too, and its join to the first."""

import math

import pytest

from mechanism_fmu.model.curves import Curve, Piece, Term
from mechanism_fmu.model.curves.check_curves import curve_findings, least_value
from mechanism_fmu.model.findings import messages

START, SPAN = 0.5, 3.0
#: Back from 2 to 1 in one unit, level at both ends.
BACK = (2.0, 0.0, -3.0, 2.0)


def curve(last: tuple[float, ...] = BACK, begins: float = START + 2.0, span: float = SPAN) -> Curve:
    """Rests at 1 for one unit, rises to 2 in another, and has a last piece."""
    rest = Piece(START, (Term((1.0,)),))
    rise = Piece(START + 1.0, (Term((1.0, 0.0, 3.0, -2.0)),))
    return Curve((rest, rise, Piece(begins, (Term(last),))), START, span, periodic=True)


def told(one: Curve) -> list[str]:
    return messages(curve_findings("cam", one))


def test_a_curve_that_closes_is_taken() -> None:
    assert told(curve()) == []


@pytest.mark.parametrize(
    ("last", "message"),
    [
        ((2.0, 0.0, -3.3, 2.2), "jumps at 3.5 from 0.9 to 1"),
        ((2.0, 0.0, -2.0, 1.0), "has an edge at 3.5: its slope jumps from -1 to 0"),
        ((2.1, 0.0, -3.3, 2.2), "jumps at 2.5 from 2 to 2.1"),
        ((2.0, 0.5, -4.0, 2.5), "has an edge at 2.5: its slope jumps from 0 to 0.5"),
    ],
)
def test_both_ends_of_the_last_piece_are_looked_at(last: tuple[float, ...], message: str) -> None:
    (finding,) = told(curve(last))
    assert message in finding


def test_a_last_piece_behind_the_period_is_refused() -> None:
    found = told(curve(span=1.5))
    assert "has a piece from 2.5 on, but repeats itself at 2 already" in found[0]
    assert [text for text in told(curve(span=2.0)) if "already" in text] == []  # a piece of no length is one


@pytest.mark.parametrize("span", [0.0, -1.0, math.nan])
def test_a_period_is_positive(span: float) -> None:
    assert any("must be positive" in text or "not finite" in text for text in told(curve(span=span)))


@pytest.mark.parametrize("piece", range(3))
def test_the_least_value_is_found_in_every_piece(piece: int) -> None:
    """A dip of 0.5 in the middle of one piece of a curve at 1: 16 places a piece find the very bottom."""
    dip = Term((1.0, 0.0, -8.0, 16.0, -8.0))  # 1 - 8 xi^2 (1 - xi)^2
    level = Term((1.0,))
    pieces = tuple(Piece(START + k, (dip if k == piece else level,)) for k in range(3))
    assert least_value(Curve(pieces, START, SPAN, periodic=True)) == pytest.approx(0.5, rel=1e-12)


def test_beyond_its_end_a_last_piece_counts_only_where_nothing_repeats() -> None:
    """It falls for ever; of a curve that repeats itself, only until it does."""
    falling = (Piece(0.0, (Term((1.0, -0.25)),)),)
    assert least_value(Curve(falling, 0.0, 2.0, periodic=True)) == pytest.approx(1.0 - 0.25 * 2.0 * 15 / 16)
    assert least_value(Curve(falling)) == 1.0


def test_of_a_last_swing_without_an_end_the_bottom_is_known() -> None:
    """2 + 0.75 sin(3 xi + 0.2): at its start 2.149, at its bottom 1.25."""
    swing = Curve((Piece(0.0, (Term((2.0,), 0.75, 3.0, 0.2),)),))
    assert least_value(swing) == pytest.approx(1.25)
    still = Curve((Piece(0.0, (Term((2.0,), 0.75, 0.0, 0.2),)),))
    assert least_value(still) == pytest.approx(2.0 + 0.75 * math.sin(0.2))
