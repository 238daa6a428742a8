"""The table of units, row by row, against the SI brochure (9th edition, 2019), typed from its tables 2, 4, 7 and 8.

Angles are kept apart from numbers, as FMI 2.0 does (section 2.2.2): a turn has the base unit rad.
"""

import math

import pytest
from scipy import constants

from harness.fmu import units
from harness.fmu.units import BASE_UNITS, Measure, parse_unit
from mechanism_fmu.units import PREFIXES as PREFIXES_READ

#: By symbol: value of one in coherent units, and the brochure's expression in base units.
SYMBOLS = {
    # table 2
    "g": (1e-3, "kg"),
    "m": (1.0, "m"),
    "s": (1.0, "s"),
    "A": (1.0, "A"),
    "K": (1.0, "K"),
    "mol": (1.0, "mol"),
    "cd": (1.0, "cd"),
    # table 4
    "rad": (1.0, "rad"),
    "Hz": (1.0, "s-1"),
    "N": (1.0, "kg m s-2"),
    "Pa": (1.0, "kg m-1 s-2"),
    "J": (1.0, "kg m2 s-2"),
    "W": (1.0, "kg m2 s-3"),
    "V": (1.0, "kg m2 s-3 A-1"),
    "ohm": (1.0, "kg m2 s-3 A-2"),
    "H": (1.0, "kg m2 s-2 A-2"),
    # table 8, and turns
    "min": (60.0, "s"),
    "d": (86400.0, "s"),
    "deg": (math.pi / 180, "rad"),
    "°": (math.pi / 180, "rad"),
    "rpm": (2 * math.pi / 60, "rad s-1"),
    "1": (1.0, ""),
}
#: Table 7, as far as mechanics needs it.
PREFIXES = {"G": 9, "M": 6, "k": 3, "c": -2, "m": -3, "u": -6, "µ": -6, "μ": -6, "n": -9}
#: Symbols that never have one: min would be a milli-inch, cd a centi-day.
WITHOUT_PREFIX = ("cd", "d", "min", "deg", "°", "rpm", "1")

#: What scipy knows of them, apart from this table.
SCIPY = {
    "g": constants.gram,
    "min": constants.minute,
    "d": constants.day,
    "deg": constants.degree,
    "G": constants.giga,
    "M": constants.mega,
    "k": constants.kilo,
    "c": constants.centi,
    "m": constants.milli,
    "u": constants.micro,
    "n": constants.nano,
}


def exponents(expression: str) -> tuple[int, ...]:
    """Of the base units, of an expression as the brochure writes it: "kg m2 s-3"."""
    found = dict.fromkeys(BASE_UNITS, 0)
    for factor in expression.split():
        base = factor.rstrip("-0123456789")
        found[base] += int(factor[len(base) :] or 1)
    return tuple(found.values())


def test_the_table_has_these_rows_and_no_others() -> None:
    grammar = units._WRITTEN
    assert {*grammar.symbols, "°"} == {*SYMBOLS, "kg"}
    assert {*grammar.without_prefix, "°"} == {*WITHOUT_PREFIX, "kg"}
    assert {*PREFIXES_READ, "µ", "μ"} == set(PREFIXES)
    assert BASE_UNITS == ("kg", "m", "s", "A", "K", "mol", "cd", "rad")


@pytest.mark.parametrize("symbol", SYMBOLS)
def test_a_symbol_means_what_the_brochure_says(symbol: str) -> None:
    factor, expression = SYMBOLS[symbol]
    assert parse_unit(symbol) == Measure(exponents(expression), factor, 0.0)


@pytest.mark.parametrize("prefix", PREFIXES)
@pytest.mark.parametrize("symbol", [symbol for symbol in SYMBOLS if symbol not in WITHOUT_PREFIX])
def test_a_prefix_scales_and_nothing_else(prefix: str, symbol: str) -> None:
    if prefix + symbol in SYMBOLS:
        pytest.skip("another symbol")
    factor, expression = SYMBOLS[symbol]
    found = parse_unit(prefix + symbol)
    assert found is not None
    assert found.exponents == exponents(expression)
    assert found.factor == pytest.approx(factor * 10.0 ** PREFIXES[prefix], rel=1e-15)
    assert found.offset == 0.0


def test_what_is_also_another_symbol_is_that_one() -> None:
    """Of all prefixed symbols: cd is the candela; a milli-inch and others do not come up."""
    both = {p + s for p in PREFIXES for s in SYMBOLS if s not in WITHOUT_PREFIX} & set(SYMBOLS)
    assert both == set()


@pytest.mark.parametrize("symbol", [symbol for symbol in WITHOUT_PREFIX if symbol != "1"])  # m1 is a metre
def test_some_symbols_take_no_prefix(symbol: str) -> None:
    read = [prefix + symbol for prefix in PREFIXES if parse_unit(prefix + symbol) is not None]
    assert read == (["cd"] if symbol == "d" else [])  # the candela


@pytest.mark.parametrize("name", SCIPY)
def test_scipy_says_the_same(name: str) -> None:
    found = 10.0 ** PREFIXES[name] if name in PREFIXES else SYMBOLS[name][0]
    assert found == pytest.approx(SCIPY[name], rel=1e-15)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("W", "V.A"),
        ("V", "A.ohm"),
        ("J", "N.m"),
        ("J", "W.s"),
        ("W", "J/s"),
        ("Pa", "N/m2"),
        ("N", "kg.m/s2"),
        ("H", "V.s/A"),
        ("H", "ohm.s"),
        ("Hz", "1/s"),
        ("ohm", "W/A2"),
        ("rpm", "6.deg/s"),
        ("kW", "MN.mm/s"),
    ],
)
def test_relations_between_units_hold(one: str, other: str) -> None:
    times = 1.0
    if other[0] == "6":
        times, other = 6.0, other[2:]
    left, right = parse_unit(one), parse_unit(other)
    assert left is not None
    assert right is not None
    assert left.exponents == right.exponents
    assert left.factor == pytest.approx(times * right.factor, rel=1e-14)
