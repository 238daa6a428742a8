import math

import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.fmu.parts.fmi_units import OFFERED_DISPLAY_UNITS, UnitError, display_factor, parse_unit
from mechanism_fmu.units import BASE_UNITS, Unit


def exponents(**powers: int) -> tuple[int, ...]:
    return tuple(powers.get(name, 0) for name in BASE_UNITS)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1", exponents()),
        ("rad", exponents(rad=1)),
        ("rad/s", exponents(rad=1, s=-1)),
        ("1/s", exponents(s=-1)),
        ("N.m", exponents(kg=1, m=2, s=-2)),
        ("J", exponents(kg=1, m=2, s=-2)),
        ("kg.m2", exponents(kg=1, m=2)),
        ("N.m/rad", exponents(kg=1, m=2, s=-2, rad=-1)),
        ("N.m.s/rad", exponents(kg=1, m=2, s=-1, rad=-1)),
        ("N.s", exponents(kg=1, m=1, s=-1)),
        ("m/s2", exponents(m=1, s=-2)),
        ("m.s-2", exponents(m=1, s=-2)),
        ("Pa", exponents(kg=1, m=-1, s=-2)),
        ("N.m/(kg.K)", exponents(m=2, s=-2, K=-1)),
        ("W/(m2.K)", exponents(kg=1, s=-3, K=-1)),
        ("(N/m)/s", exponents(kg=1, s=-3)),
    ],
)
def test_si_units_have_their_base_exponents_and_factor_one(text: str, expected: tuple[int, ...]) -> None:
    assert parse_unit(text) == Unit(1.0, expected)


@pytest.mark.parametrize(
    ("unit", "display", "factor"),
    [
        ("rad", "deg", 180 / math.pi),
        ("rad/s", "rpm", 30 / math.pi),
        ("rad/s", "deg/s", 180 / math.pi),
        ("m", "mm", 1e3),
        ("kg", "g", 1e3),
        ("kg.m2", "kg.mm2", 1e6),
        ("N.m", "N.mm", 1e3),
        ("N.m/rad", "N.m/deg", math.pi / 180),
        ("Pa", "MPa", 1e-6),
        ("m/s", "km/s", 1e-3),
    ],
)
def test_display_factors(unit: str, display: str, factor: float) -> None:
    assert display_factor(unit, display) == pytest.approx(factor, rel=1e-15)


def test_every_offered_display_unit_measures_its_unit() -> None:
    assert len(OFFERED_DISPLAY_UNITS) > 2
    assert all(OFFERED_DISPLAY_UNITS.values())
    assert all(display_factor(u, d) > 0 for u, offered in OFFERED_DISPLAY_UNITS.items() for d in offered)


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("", "ends too early"),
        ("Nm", "'N.m'"),
        ("N.", "ends too early"),
        ("m/s/s", "one '/'"),
        ("m..s", "where a symbol should stand"),
        ("(m", "closing bracket"),
        ("m)", "cannot be read at ')'"),
        ("furlong", "unknown"),
        ("kkg", "unknown"),
        ("12", "cannot be read"),
        ("m^2", "cannot be read at '^2'"),
        ("m m", "cannot be read"),
    ],
)
def test_what_is_no_unit_is_refused_with_a_hint(text: str, hint: str) -> None:
    with pytest.raises(UnitError) as caught:
        parse_unit(text)
    assert hint in str(caught.value)


def test_a_display_unit_of_another_quantity_is_refused() -> None:
    with pytest.raises(UnitError, match="'mm' does not measure the same quantity as 'rad'"):
        display_factor("rad", "mm")


POWERS = st.lists(st.tuples(st.sampled_from(BASE_UNITS), st.integers(-4, 4).filter(bool)), min_size=1, max_size=6)


def written(powers: list[tuple[str, int]]) -> str:
    return ".".join(name if power == 1 else f"{name}{power}" for name, power in powers)


@given(POWERS)
def test_a_written_product_reads_back(powers: list[tuple[str, int]]) -> None:
    expected = exponents(**{name: sum(p for n, p in powers if n == name) for name in BASE_UNITS})
    assert parse_unit(written(powers)) == Unit(1.0, expected)


@given(POWERS, POWERS)
def test_a_slash_negates_the_exponents_behind_it(above: list[tuple[str, int]], below: list[tuple[str, int]]) -> None:
    inverse = [(name, -power) for name, power in below]
    assert parse_unit(f"{written(above)}/({written(below)})") == parse_unit(written(above + inverse))


@given(POWERS, st.sampled_from("GMkcmun"), st.integers(1, 3))
def test_there_and_back_is_one(powers: list[tuple[str, int]], prefix: str, power: int) -> None:
    unit, scaled = f"{written(powers)}.N{power}", f"{written(powers)}.{prefix}N{power}"
    assert display_factor(unit, scaled) * display_factor(scaled, unit) == pytest.approx(1.0, rel=1e-15)
