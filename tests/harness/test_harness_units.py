import math

import pytest
from fake_slave import UNITS, measure
from hypothesis import given, strategies as st

from harness.fmu.units import UnitMismatchError, Units, parse_unit


@pytest.mark.parametrize(
    ("text", "factor", "exponents"),
    [
        ("N.mm", 1e-3, {"kg": 1, "m": 2, "s": -2}),
        ("mN.m", 1e-3, {"kg": 1, "m": 2, "s": -2}),
        ("kg.mm2", 1e-6, {"kg": 1, "m": 2}),
        ("g.mm^2", 1e-9, {"kg": 1, "m": 2}),
        ("deg/s", math.pi / 180, {"rad": 1, "s": -1}),
        ("rpm", math.pi / 30, {"rad": 1, "s": -1}),
        ("N.m/(rad/s)", 1.0, {"kg": 1, "m": 2, "s": -1, "rad": -1}),
        ("N.m.s/rad", 1.0, {"kg": 1, "m": 2, "s": -1, "rad": -1}),
        ("1/s2", 1.0, {"s": -2}),
        ("min", 60.0, {"s": 1}),
        ("ms", 1e-3, {"s": 1}),
        ("µs", 1e-6, {"s": 1}),
        ("MPa", 1e6, {"kg": 1, "m": -1, "s": -2}),
        ("cd", 1.0, {"cd": 1}),
        ("m^2", 1.0, {"m": 2}),
        ("(N·mm)/s", 1e-3, {"kg": 1, "m": 2, "s": -3}),
    ],
)
def test_unit_expressions(text: str, factor: float, exponents: dict[str, int]) -> None:
    parsed = parse_unit(text)
    assert parsed is not None
    assert parsed.factor == pytest.approx(factor, rel=1e-15)
    assert parsed.exponents == measure(**exponents).exponents


@pytest.mark.parametrize(
    "text", ["", "Nm", "xm", "m/s/s", "m/s.kg", "N..m", "m2.5", "parsec", "/s", "m/(s", "12", "m^", "m2^3"]
)
def test_what_is_no_unit_expression(text: str) -> None:
    assert parse_unit(text) is None


@pytest.mark.parametrize(
    ("value", "given_unit", "wanted", "expected"),
    [
        (95.0, "deg", "rad", math.radians(95.0)),
        (2.0, "N.mm", "N.m", 2e-3),
        (30.0, "rpm", "rad/s", math.pi),
        (20.0, "degC", "K", 293.15),
        (90.0, "kg.mm2", "kg.m2", 9e-5),
        (130.0, "mm", "m", 0.13),
    ],
)
def test_conversion_to_the_unit_of_a_variable(value: float, given_unit: str, wanted: str, expected: float) -> None:
    assert UNITS.convert(value, given_unit, wanted) == pytest.approx(expected, rel=1e-15)


@given(st.floats(-1e6, 1e6), st.sampled_from([("rad", "deg"), ("rad/s", "rpm"), ("K", "degC")]))
def test_display_value_converts_back(value: float, units: tuple[str, str]) -> None:
    unit, display = units
    shown = UNITS.to_display(value, unit, display)
    assert shown is not None
    assert UNITS.convert(shown, display, unit) == pytest.approx(value, rel=1e-12, abs=1e-9)


def test_the_fmu_s_own_definition_comes_first() -> None:
    furlong = Units(defined={"m": measure(m=1)}, displayed={"m": {"mm": (5.0, 0.0)}})
    assert furlong.convert(1.0, "mm", "m") == 0.2


def test_a_unit_of_another_quantity_is_refused_with_those_that_fit() -> None:
    with pytest.raises(UnitMismatchError, match=r"'mm' does not measure the same quantity; these fit: N\.m"):
        UNITS.convert(1.0, "mm", "N.m")


def test_an_angle_is_no_pure_number_and_no_frequency() -> None:
    with pytest.raises(UnitMismatchError):
        UNITS.convert(1.0, "Hz", "rad/s")


def test_an_unknown_unit_is_refused_with_those_that_fit() -> None:
    with pytest.raises(UnitMismatchError, match="'grad' is not known; these fit: rad, deg"):
        UNITS.convert(1.0, "grad", "rad")


def test_a_unit_that_nobody_defined_fits_only_itself() -> None:
    odd = Units()
    assert odd.convert(3.0, "bushel", "bushel") == 3.0
    with pytest.raises(UnitMismatchError, match="must be bushel, or leave it out"):
        odd.convert(3.0, "m", "bushel")
