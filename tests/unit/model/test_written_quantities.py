"""Numbers with units in a description, and curves whose arguments are looked at where they are made."""

import math
import re
import traceback
from typing import Any

import pytest

from mechanism_fmu.model import (
    Curve,
    Input,
    MechanismError,
    Parameter,
    Piece,
    Term,
    angle_parameter,
    cm,
    constant,
    deg,
    length_parameter,
    mm,
    quantity,
    rpm,
    speed_parameter,
)


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("5 mm", "m", 0.005),
        ("5mm", "m", 0.005),
        (" -2.5e1 cm ", "m", -0.25),
        ("30 deg", "rad", math.pi / 6),
        ("60 rpm", "rad/s", 2 * math.pi),
        ("2 N/mm", "N/m", 2000.0),
        ("7.85 g/cm3", "kg/m3", 7850.0),
        ("210 GPa", "Pa", 2.1e11),
        ("0.3", "1", 0.3),
        (".5 m", "m", 0.5),
    ],
)
def test_a_text_with_a_unit_is_a_number_in_si(text: str, unit: str, value: float) -> None:
    assert quantity(text, unit) == pytest.approx(value, rel=1e-14)


def test_functions_of_units() -> None:
    assert (mm(5), cm(5), deg(180)) == (0.005, 0.05, math.pi)
    assert rpm(30) == pytest.approx(math.pi, rel=1e-15)
    assert quantity(3, "m") == 3


@pytest.mark.parametrize(
    ("text", "unit", "said"),
    [
        ("5 kg", "m", "length wants m, got '5 kg'; give e.g. 0.5, or with a unit, '0.5 m'."),
        ("5", "m", "length wants m, got '5'; give"),
        ("five mm", "m", "length wants m, got 'five mm', which is no number with a unit; give"),
        ("5 mm", "1", "length wants a plain number, got '5 mm'; give e.g. 0.5 or '0.5'."),
        ("5 furlong", "m", "length wants m, got '5 furlong': unit 'furlong': the symbol 'furlong' is unknown;"),
    ],
)
def test_a_text_that_is_no_such_quantity_is_refused(text: str, unit: str, said: str) -> None:
    with pytest.raises(MechanismError) as error:
        quantity(text, unit, "length")
    assert str(error.value).startswith(said)


def test_starts_and_limits_of_ports_may_have_units() -> None:
    assert length_parameter("a", "200 mm", "").start == 0.2
    assert angle_parameter("a", "90 deg", "").start == math.pi / 2
    assert speed_parameter("a", "60 rpm", "").start == pytest.approx(2 * math.pi, rel=1e-15)
    reach = Parameter("a", "20 cm", "", "m", "1 cm", "1 m")
    assert (reach.start, reach.minimum, reach.maximum) == (0.2, 0.01, 1.0)
    assert Input("a", "drive.torque", "1 N.cm", "", "N.m").start == 0.01
    with pytest.raises(MechanismError, match="a: start wants m, got '5 kg'"):
        length_parameter("a", "5 kg", "")
    with pytest.raises(MechanismError, match="a: minimum wants m, got '5 kg'"):
        Parameter("a", 0.2, "", "m", "5 kg")


CURVES = {
    "Term: polynomial is 1.0, but it must be a tuple of coefficients": lambda: Term(1.0),
    "Term: a polynomial of 8 coefficients; 6 is the most: give several pieces.": lambda: Term((0.0,) * 8),
    "Term: coefficient 1 of the polynomial is 'b', but it must be a number.": lambda: Term((1.0, "b")),
    "Term: coefficient 0 of the polynomial is (1.0,), but": lambda: constant((1.0,)),
    "Term: phase is None, but it must be a number.": lambda: Term((), 1.0, 2.0, None),
    "Piece: start is Term(": lambda: Piece(constant(1.0), (constant(1.0),)),
    "Piece: terms is Term(": lambda: Piece(0.0, constant(1.0)),
    "Piece: entry 1 of terms is 1.0, but it must be a Term, e.g. constant(1.0)": lambda: Piece(0.0, (1.0,)),
    "Curve: pieces is Piece(": lambda: Curve(Piece(0.0, (constant(1.0),))),
    "Curve: entry 1 of pieces is Term(": lambda: Curve((constant(1.0),)),
    "Curve: span is 'a', but it must be a number.": lambda: Curve((), 0.0, "a"),
}


@pytest.mark.parametrize("said", CURVES)
def test_an_argument_of_a_curve_is_refused_at_the_line_that_gives_it(said: str) -> None:
    with pytest.raises(MechanismError) as error:
        CURVES[said]()
    assert str(error.value).startswith(said)
    assert any(frame.filename == __file__ and frame.name == "<lambda>" for frame in traceback.extract_tb(error.tb))


def test_lists_become_tuples() -> None:
    assert Curve([Piece(0.0, [Term([1.0, 2.0])])]) == Curve((Piece(0.0, (Term((1.0, 2.0)),)),))


def test_a_usual_range_takes_texts() -> None:
    parameter = Parameter("torque", "2 N.mm", "", "N.m", 0.0, 1.0, usual=("1 N.mm", 0.005))
    assert parameter.usual == (0.001, 0.005)
    assert Input("push", "push.x", 0.0, "", "N", usual=(0, 3)).usual == (0.0, 3.0)
    assert length_parameter("reach", "1 m", "", usual=("10 cm", "2 m")).usual == (0.1, 2.0)


@pytest.mark.parametrize(
    ("usual", "message"),
    [
        ((2.0, 1.0), "a: its usual range is 2 to 1 m; give two finite numbers, the lower one first"),
        ((1.0, 1.0), "the lower one first"),
        ((0.5, math.inf), "give two finite numbers"),
        ((0.5, math.nan), "give two finite numbers"),
        ((0.5, 4.0), "a: its usual range is 0.5 to 4 m, beyond the limits 0 to 3 m; give a part of them"),
        ((-0.5, 2.0), "beyond the limits 0 to 3 m"),
        ((1.5, 2.0), "a: its usual range is 1.5 to 2 m, without the start value 1 m; give one that holds it"),
        (("1 s", "2 s"), "a: usual wants m, got '1 s'"),
        ((1.0,), "a: usual = (1.0,), but it must be two numbers"),
        (2.0, "a: usual = 2.0, but it must be two numbers"),
        ((0.5, None), "but it must be two numbers"),
    ],
)
def test_what_is_no_usual_range_is_refused(usual: Any, message: str) -> None:
    with pytest.raises(MechanismError, match=re.escape(message)):
        Parameter("a", 1.0, "", "m", 0.0, 3.0, usual=usual)
