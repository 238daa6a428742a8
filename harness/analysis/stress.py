"""Bending stress of each impact of a run in the beam that it strikes, and fatigue damage of all of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd

from mechanism_fmu.stress import (
    STEEL,
    Beam,
    Material,
    MaterialCard,
    MaximumStress,
    RectangularTooth,
    Ringing,
    SequenceDamage,
    TableBeam,
    TrapezoidTooth,
    WedgeTooth,
    beam_theory_note,
    bending_stress,
    material_card,
    maximum_stress,
    sequence_damage,
    slenderness,
)

from ..errors import FmuError, UsageError
from ..fmu.declared import SIZES, Struck, size_of
from ..fmu.description import Value
from .impacts import body_held, one_of_each_instant

#: The beams that an FMU can declare, by their kinds.
_BEAMS: dict[str, Callable[..., Beam]] = {
    one.__name__: one for one in (WedgeTooth, TrapezoidTooth, RectangularTooth, TableBeam)
}

#: Units of the numbers that `with_stress` adds to the table of impacts.
STRESS_UNITS = {"stress_max": "Pa", "stress_position": "1", "stress_delay": "s"}
#: Those of all columns that it adds; "": a text.
STRESS_COLUMNS = STRESS_UNITS | {"remark": ""}

#: How the stress of one impact is found; that of all of them together has converged modes.
BY_TWO_MODES = "by the paper's two modes; converged modes give a wedge 29 % more (docs/explanation/stress.md)."

_TIMES = 600
_PLACES = 101
#: The shown time span reaches this many times the delay of the maximum.
_SPAN = 12.0


def beam_of(struck: Struck, values: Mapping[str, Value]) -> Beam:
    """The beam that the FMU declares, for values of its parameters.

    Raises:
        FmuError: the FMU reports a beam that cannot be.
    """
    try:
        return _BEAMS[struck.kind](**{name: size_of(size, values) for name, size in struck.sizes.items()})
    except ValueError as error:
        raise FmuError(f"The FMU's {_listed(struck.variables)} describe no {struck.name}: {error}") from error


def _listed(names: tuple[str, ...]) -> str:
    return f"{', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else "".join(names) or "numbers"


def beam_summary(struck: Struck | None, beam: Beam | None) -> dict[str, Any] | None:
    """The beam, and how far beam theory covers it, ready for JSON; None without a beam."""
    if beam is None or struck is None:
        return None
    return {
        **{size: getattr(beam, size) for size in SIZES[struck.kind]},
        "length_over_root_height": slenderness(beam),
        "beam_theory": beam_theory_note(beam),
    }


def with_stress(impacts: pd.DataFrame, struck: Struck, beam: Beam, material: Material = STEEL) -> pd.DataFrame:
    """The table of impacts with the largest bending stress that each leaves, by |v_I| and the paper's two modes.

    Adds `stress_max` [Pa], `stress_position` (x / length, from the root), `stress_delay` [s] after the impact, and
    `remark`. Where the body is held, its beam is not shaken: the remark says so, and there is no stress.

    Raises:
        FmuError: the FMU reports an impact that the stress model does not reach.
    """
    with as_fmu_error():
        found = [maximum_stress(beam, material, abs(velocity)) for velocity in impacts[struck.jump]]
    held = body_held(impacts, struck.jump)
    numbers = np.array([(maximum.stress, maximum.position, maximum.time) for maximum in found]).reshape(-1, 3)
    numbers[held] = np.nan
    added = pd.DataFrame(numbers, columns=list(STRESS_UNITS), index=impacts.index)
    return impacts.assign(**added, remark=[struck.held if one else "" for one in held])


def worst_impact(impacts: pd.DataFrame) -> int | None:
    """The place of the impact with the largest stress, of equal ones the first; None if none left any.

    Args:
        impacts: as of `with_stress`.
    """
    stress = impacts["stress_max"].to_numpy(dtype=np.float64)
    return None if np.isnan(stress).all() else int(np.nanargmax(stress))


@contextmanager
def as_fmu_error() -> Iterator[None]:
    """What the stress model says of an impact is said of the FMU that reports it."""
    try:
        yield
    except ValueError as error:
        raise FmuError(f"The FMU reports impacts without a stress model: {error}") from error


@dataclass(frozen=True)
class StressField:
    """Bending stress after one impact, signed so that the largest one is positive.

    Attributes:
        position: x / length from the root, shape (places,).
        delay: time since the impact [s], shape (times,).
        stress: [Pa], shape (places, times).
        along: stress along the beam when it is largest [Pa], shape (places,).
        in_time: stress in time where it is largest [Pa], shape (times,).
        maximum: value, position and delay of the largest.
    """

    position: npt.NDArray[np.float64]
    delay: npt.NDArray[np.float64]
    stress: npt.NDArray[np.float64]
    along: npt.NDArray[np.float64]
    in_time: npt.NDArray[np.float64]
    maximum: MaximumStress


def stress_field(beam: Beam, velocity: float, material: Material = STEEL) -> StressField:
    """Bending stress of a beam along its length and in time, after an impact with `velocity` [m/s]."""
    speed = abs(velocity)
    maximum = maximum_stress(beam, material, speed)
    position, along = stress_along(beam, velocity, material)
    delay = np.linspace(0.0, _SPAN * maximum.time, _TIMES)
    place = maximum.position * beam.length
    sign = float(np.sign(bending_stress(beam, material, speed, [place], [maximum.time])[0, 0]))
    return StressField(
        position=position,
        delay=delay,
        stress=sign * bending_stress(beam, material, speed, position * beam.length, delay),
        along=along,
        in_time=sign * bending_stress(beam, material, speed, [place], delay)[0],
        maximum=maximum,
    )


def stress_along(
    beam: Beam, velocity: float, material: Material = STEEL
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Bending stress of a beam along its length, at the instant of the largest one after an impact.

    Args:
        beam: what is struck.
        velocity: of the impact [m/s].
        material: of the beam.

    Returns:
        x / length from the root, and the stress there [Pa], signed so that the largest one is positive;
        shape (places,) each.
    """
    speed = abs(velocity)
    maximum = maximum_stress(beam, material, speed)
    position = np.linspace(0.0, 1.0, _PLACES)
    place = maximum.position * beam.length
    stress = bending_stress(beam, material, speed, [place, *(position * beam.length)], [maximum.time])[:, 0]
    return position, np.sign(stress[0]) * stress[1:]


# From the impacts of a run to the damage that all of them together do to the beam that they strike.

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
        f"Miner; smooth specimens, no notch at the root (docs/explanation/stress.md). {beam_theory_note(beam)}"
    )
    if damage.yield_safety < 1:
        beyond = f"a {struck.name} yields there, and these numbers no longer hold."
        note += f" The stress is beyond the yield strength: {beyond}"
    return note


def _count(value: float) -> str:
    return f"{value:.3g}" if value <= _COUNTABLE else f"> {_COUNTABLE:g}"
