"""From the impacts of a run to the damage that all of them together do to the beam that they strike."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd

from mechanism_fmu.stress import (
    Beam,
    MaterialCard,
    Ringing,
    SequenceDamage,
    WedgeTooth,
    beam_theory_note,
    material_card,
    sequence_damage,
)

from .declared import Struck
from .errors import UsageError
from .impacts import one_of_each_instant
from .tooth_stress import as_fmu_error

#: Units of the numbers of a `SequenceDamage`.
DAMAGE_UNITS = {
    "stress": "Pa",
    "time": "s",
    "position": "1",
    "impacts": "1",
    "cycles": "1",
    "damage": "1",
    "repeats_to_failure": "1",
    "yield_safety": "1",
    "fatigue_safety": "1",
}

HEADINGS = (
    "material",
    "sigma_max [Pa]",
    "cycles [1]",
    "damage [1]",
    "runs to\nfailure [1]",
    "safety:\nyield [1]",
    "safety:\nfatigue [1]",
)

#: Beyond this, a number of runs only says that there is no end.
_COUNTABLE = 1e12


def card_of(name: str) -> MaterialCard:
    """The material card with this name.

    Raises:
        UsageError: there is none.
    """
    try:
        return material_card(name)
    except ValueError as error:
        raise UsageError(f"--material: {error}") from None


def damage_of_impacts(impacts: pd.DataFrame, struck: Struck, beam: Beam, card: MaterialCard) -> SequenceDamage | None:
    """What all impacts of a run do to one beam; None without an impact.

    All of them count for one beam: the jump of the body's speed shakes all its beams alike. See docs/decisions/014.

    Raises:
        FmuError: the FMU reports impacts that the stress model does not reach.
    """
    if impacts.empty:
        return None
    with as_fmu_error():
        return sequence_damage(beam, card.material, card.strength, *_jolts(impacts, struck))


def stress_history(
    impacts: pd.DataFrame, struck: Struck, beam: Beam, card: MaterialCard, position: float
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Bending stress [Pa] at x / length = `position`, as its extremes, and their times [s]; at least one impact."""
    swings = list(Ringing(beam, card.material, *_jolts(impacts, struck)).swings(position * beam.length))
    return np.array([swing.time for swing in swings]), np.array([swing.stress for swing in swings])


def _jolts(impacts: pd.DataFrame, struck: Struck) -> tuple[pd.Series[float], pd.Series[float]]:
    """Times, ascending, and v_I with sign, once for each instant."""
    jolts = one_of_each_instant(impacts).sort_values("time", kind="stable")
    return jolts["time"], jolts[struck.jump]


def damage_summary(damage: SequenceDamage, card: MaterialCard) -> dict[str, Any]:
    """Damage and the numbers it rests on, ready for JSON; what is infinite is null."""
    numbers = {name: value if math.isfinite(value) else None for name, value in asdict(damage).items()}
    material = {"name": card.name, "text": card.text, "sources": list(card.sources)}
    return numbers | {"material": material | asdict(card.material) | asdict(card.strength)}


def damage_row(damage: SequenceDamage, card: MaterialCard) -> list[str]:
    """The cells below `HEADINGS`."""
    return [
        card.name,
        f"{damage.stress:.5g}",
        f"{damage.cycles:g}",
        f"{damage.damage:.3g}",
        _count(damage.repeats_to_failure),
        _count(damage.yield_safety),
        _count(damage.fatigue_safety),
    ]


def damage_note(damage: SequenceDamage, struck: Struck, beam: Beam) -> str:
    """What the numbers stand for, and whether they may be believed."""
    less = " (the paper's two give 22 % less)" if isinstance(beam, WedgeTooth) else ""
    note = (
        f"All jumps of the {struck.body}'s speed on one {struck.name} that still rings from those before, at x/l = "
        f"{damage.position:.4f}, by converged modes{less}; rainflow cycles, Goodman, "
        f"Miner; smooth specimens, no notch at the root (docs/stress.md). {beam_theory_note(beam)}"
    )
    if damage.yield_safety < 1:
        beyond = f"a {struck.name} yields there, and these numbers no longer hold."
        note += f" The stress is beyond the yield strength: {beyond}"
    return note


def _count(value: float) -> str:
    return f"{value:.3g}" if value <= _COUNTABLE else f"> {_COUNTABLE:g}"
