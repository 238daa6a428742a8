"""Each number of the public functions of stress: what cannot be is refused by name, value and limit."""

import math
from collections.abc import Callable
from dataclasses import fields, replace
from typing import Any

import pytest

from mechanism_fmu.stress import (
    STEEL,
    STEEL_CARD,
    Cycle,
    Material,
    RectangularTooth,
    Ringing,
    Strength,
    TrapezoidTooth,
    WedgeTooth,
    axial_stress,
    bending_moment,
    bending_stress,
    exact_wedge_frequencies,
    hertz_line_contact,
    maximum_stress,
    miner_damage,
    natural_modes,
    peak_force,
    ritz_modes,
    sequence_damage,
    shear_force,
    shear_stress,
    wedge_of_sawtooth,
)

WEDGE = WedgeTooth(0.05, 0.3, 0.02)
STRENGTH = STEEL_CARD.strength
NOT_FINITE = (math.nan, math.inf, -math.inf)

#: Sound records, and what else than numbers that are not finite their numbers cannot be.
RECORDS: list[tuple[Any, dict[str, tuple[float, ...]]]] = [
    (STEEL, {"youngs_modulus": (0.9, 1.1e15), "density": (9e-4, 1.1e6), "damping_ratio": (-0.01, 0.991)}),
    (
        STRENGTH,
        {
            "yield_strength": (0.0, 1.1e12),
            "tensile_strength": (0.99 * STRENGTH.yield_strength, 1.1e12),
            "fatigue_coefficient": (0.9, 1.1e13),
            "fatigue_exponent": (-1.1, -0.009, 0.1),
        },
    ),
    (WEDGE, {"length": (0.0, -0.1), "apex_angle": (0.0, 1.58), "thickness": (0.0, -0.1)}),
    (
        TrapezoidTooth(0.05, 0.02, 0.01, 0.02),
        {"length": (0.0,), "root_height": (0.0, -1.0), "tip_height": (-1e-9,), "thickness": (0.0,)},
    ),
    (RectangularTooth(0.05, 0.02, 0.02), {"length": (0.0,), "height": (0.0, -1.0), "thickness": (0.0,)}),
]
RECORD_CASES = [
    (record, field.name, bad)
    for record, more in RECORDS
    for field in fields(record)
    for bad in (*NOT_FINITE, *more[field.name])
]


@pytest.mark.parametrize(("record", "name", "bad"), RECORD_CASES)
def test_a_record_is_refused(record: Any, name: str, bad: float) -> None:
    with pytest.raises(ValueError, match="must lie between") as refusal:
        replace(record, **{name: bad})
    words = {"youngs_modulus": "Young's modulus", "fatigue_coefficient": "fatigue strength coefficient"}
    words |= {"fatigue_exponent": "fatigue strength exponent"}
    text = str(refusal.value)
    assert words.get(name, name.replace("_", " ")) in text
    assert f"= {bad:g}" in text


def test_the_records_are_there() -> None:
    assert {type(record) for record, _ in RECORDS} >= {Material, Strength}
    assert len(RECORD_CASES) > 70


def contact(**changes: float) -> object:
    return hertz_line_contact(**({"force": 1.0, "width": 0.01, "radius": 0.1, "material": STEEL} | changes))


#: By what is refused: how it is called, the words for it, and values that cannot be besides those that are not finite.
CALLS: dict[str, tuple[Callable[[float], object], str, tuple[float, ...]]] = {
    "amplitude_at": (STRENGTH.amplitude_at, "number of cycles", (0.0, -1.0)),
    "cycle amplitude": (lambda x: miner_damage([Cycle(x, 0.0, 1.0)], STRENGTH), "amplitude of a cycle", (-1.0,)),
    "cycle mean": (lambda x: miner_damage([Cycle(1e8, x, 1.0)], STRENGTH), "mean of a cycle", ()),
    "cycle count": (lambda x: miner_damage([Cycle(1e8, 0.0, x)], STRENGTH), "count of a cycle", (-1.0,)),
    "impulse": (lambda x: peak_force(x, 1e-3), "impulse", (-1.0,)),
    "duration": (lambda x: peak_force(1.0, x), "duration", (0.0, -1.0)),
    "axial force": (lambda x: axial_stress(WEDGE, x, 0.0), "force", (2e300,)),
    "axial place": (lambda x: axial_stress(WEDGE, 1.0, x), "place", (-1e-9, 0.051)),
    "contact force": (lambda x: contact(force=x), "force", (0.0, -1.0)),
    "contact width": (lambda x: contact(width=x), "width of the contact", (0.0, -1.0)),
    "contact radius": (lambda x: contact(radius=x), "radius", (0.0, -1.0)),
    "poisson": (lambda x: contact(poisson_ratio=x), "Poisson's ratio", (-0.1, 0.51)),
    "maximum": (lambda x: maximum_stress(WEDGE, STEEL, x), "impact velocity", (-1.0, 1.1e6)),
    "moment": (lambda x: bending_moment(WEDGE, STEEL, x, 0.0, 0.0), "impact velocity", (-1.0,)),
    "stress": (lambda x: bending_stress(WEDGE, STEEL, x, 0.0, 0.0), "impact velocity", (-1.0,)),
    "stress place": (lambda x: bending_stress(WEDGE, STEEL, 1.0, x, 0.0), "place", (-1e-9, 0.051)),
    "stress time": (lambda x: bending_stress(WEDGE, STEEL, 1.0, 0.0, x), "time", (-1e-9,)),
    "shear": (lambda x: shear_stress(WEDGE, STEEL, x, 0.0, 0.0), "impact velocity", (-1.0,)),
    "shear force": (lambda x: shear_force(WEDGE, STEEL, 1.0, x, 0.0), "place", (-1e-9, 0.051)),
    "ritz terms": (lambda x: ritz_modes(WEDGE, STEEL, x), "number of Ritz terms", (0, -1, 1000)),  # type: ignore[arg-type]
    "terms": (lambda x: natural_modes(WEDGE, STEEL, x), "number of Ritz terms", (0, -1, 1000)),  # type: ignore[arg-type]
    "count": (lambda x: exact_wedge_frequencies(WEDGE, STEEL, x), "number of frequencies", (0, -1)),  # type: ignore[arg-type]
    "ringing time": (lambda x: Ringing(WEDGE, STEEL, [x], [1.0]), "time of an impact", ()),
    "ringing velocity": (lambda x: Ringing(WEDGE, STEEL, [0.0], [x]), "impact velocity", (1.1e6,)),
    "position": (
        lambda x: sequence_damage(WEDGE, STEEL, STRENGTH, [0.0], [1.0], position=x),
        "position",
        (-0.1, 1.1),
    ),
    "chord": (lambda x: wedge_of_sawtooth(x, 0.05, 1.0), "chord", (0.0, -1.0)),
    "slope": (lambda x: wedge_of_sawtooth(0.02, x, 1.0), "slope length", (0.0, -1.0)),
    "chord angle": (lambda x: wedge_of_sawtooth(0.02, 0.05, x), "angle between chord and slope", (0.0, 3.15)),
    "thickness": (lambda x: wedge_of_sawtooth(0.02, 0.05, 1.0, x), "thickness", (0.0, -1.0)),
}


@pytest.mark.parametrize(
    ("what", "bad"), [(what, bad) for what, call in CALLS.items() for bad in (*NOT_FINITE, *call[2])]
)
def test_an_argument_is_refused(what: str, bad: float) -> None:
    call, words, _ = CALLS[what]
    with pytest.raises(ValueError, match="must lie between") as refusal:
        call(bad)
    assert words in str(refusal.value)
    assert f"= {bad:g}" in str(refusal.value)


@pytest.mark.parametrize("bad", [math.nan, -1.0, -math.inf])
def test_damage_of_no_amplitude_is_refused(bad: float) -> None:
    with pytest.raises(ValueError, match=f"amplitude = {bad:g} Pa, but it must lie between 0 and inf"):
        STRENGTH.damage_of(bad)
    assert STRENGTH.damage_of(math.inf) == math.inf
    assert STRENGTH.damage_of(0.0) == 0.0
