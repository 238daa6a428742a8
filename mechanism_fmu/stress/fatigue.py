"""Fatigue damage of a stress history: rainflow counting, S-N line, mean stress, Miner's sum."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import Enum

from .beam import require_within

#: Largest number of anything here; it only keeps out what is not finite.
_MOST = 1e300


class MeanStress(Enum):
    """How the mean of a cycle counts.

    Attributes:
        GOODMAN: a tensile mean raises the amplitude to sigma_a / (1 - sigma_m / R_m); a compressive one gives no
            credit.
        NONE: not at all.
    """

    GOODMAN = "Goodman"
    NONE = "none"


@dataclass(frozen=True)
class Strength:
    """What a material bears.

    Attributes:
        yield_strength: R_e [Pa].
        tensile_strength: R_m [Pa], not below R_e.
        fatigue_coefficient: sigma_f' of Basquin's line sigma_a = sigma_f' (2 N)^b [Pa], at zero mean stress.
        fatigue_exponent: b [-], between -1 and -0.01.

    Raises:
        ValueError: when a value is outside its limits or not a number.

    Source: textbook: Basquin's line, sigma_a = sigma_f' (2 N)^b; docs/decisions/014-damage-of-impact-sequences.md.
    """

    yield_strength: float
    tensile_strength: float
    fatigue_coefficient: float
    fatigue_exponent: float

    def __post_init__(self) -> None:
        """Refuse a value outside its limits."""
        require_within("yield strength", self.yield_strength, 1.0, 1e12, "Pa", "structural steel has 2.35e8")
        advice = "it is no less than the yield strength"
        require_within("tensile strength", self.tensile_strength, self.yield_strength, 1e12, "Pa", advice)
        require_within("fatigue strength coefficient", self.fatigue_coefficient, 1.0, 1e13, "Pa", "steel has 1.5 R_m")
        require_within("fatigue strength exponent", self.fatigue_exponent, -1.0, -0.01, "", "steel has -0.087")

    def amplitude_at(self, cycles: float) -> float:
        """Amplitude [Pa] that is borne for a number of cycles at zero mean stress.

        Args:
            cycles: number of them, 0.5 or more.

        Raises:
            ValueError: fewer cycles, or not a finite number of them.
        """
        require_within("number of cycles", cycles, 0.5, _MOST, "", "half a cycle breaks what its coefficient breaks")
        return float(self.fatigue_coefficient * (2 * cycles) ** self.fatigue_exponent)

    def damage_of(self, amplitude: float) -> float:
        """Damage 1 / N of one cycle of an amplitude [Pa] at zero mean stress.

        The line goes on below any endurance limit ("elementary Miner"): small cycles of a sequence with large ones do
        harm, so every cycle counts.

        Args:
            amplitude: half the range of the cycle [Pa], >= 0.

        Raises:
            ValueError: a negative amplitude, or not a number; an infinite one breaks at once.
        """
        require_within("amplitude", amplitude, 0.0, math.inf, "Pa", "give half the range of the cycle, without sign")
        return float(2 * (amplitude / self.fatigue_coefficient) ** (-1 / self.fatigue_exponent))


@dataclass(frozen=True)
class Cycle:
    """One closed swing of the stress, or half of one.

    Attributes:
        amplitude: sigma_a, half the range [Pa].
        mean: sigma_m [Pa].
        count: 1, or 0.5 for a half cycle [-].
    """

    amplitude: float
    mean: float
    count: float


def rainflow_cycles(stress: Iterable[float]) -> Iterator[Cycle]:
    """Cycles of a history of stress [Pa], as they close.

    Takes the history piece by piece and remembers only what is still open.

    Args:
        stress: the history, one value after the other [Pa].

    Source: ASTM E1049-85, section 5.4.4, by the package `rainflow`.
    """
    from rainflow import extract_cycles  # type: ignore[import-untyped]

    for width, mean, count, _, _ in extract_cycles(stress):
        yield Cycle(width / 2, mean, count)


def effective_amplitude(
    amplitude: float, mean: float, tensile_strength: float, mean_stress: MeanStress = MeanStress.GOODMAN
) -> float:
    """Amplitude at zero mean stress that does the same harm as a cycle [Pa]; infinite from a mean of R_m on.

    Args:
        amplitude: sigma_a of the cycle [Pa].
        mean: sigma_m of the cycle [Pa], tension positive.
        tensile_strength: R_m [Pa].
        mean_stress: how the mean counts.

    Source: the Goodman line in its usual, linear form; compression: no credit, on the safe side.
    """
    if mean_stress is MeanStress.NONE or mean <= 0:
        return amplitude
    left = 1 - mean / tensile_strength
    return amplitude / left if left > 0 else math.inf


def miner_damage(cycles: Iterable[Cycle], strength: Strength, mean_stress: MeanStress = MeanStress.GOODMAN) -> float:
    """Sum of count / N over the cycles [-]: at 1 the material fails.

    Args:
        cycles: of the stress.
        strength: what the material bears.
        mean_stress: how the mean of a cycle counts.

    Raises:
        ValueError: a cycle has a negative amplitude or count, or one that is not finite, or no mean.

    Source: A. Palmgren (1924), M. A. Miner (1945).
    """
    damage = 0.0
    for cycle in cycles:
        require_within("amplitude of a cycle", cycle.amplitude, 0.0, _MOST, "Pa", "it is half the range, without sign")
        require_within("mean of a cycle", cycle.mean, -_MOST, _MOST, "Pa", "give a finite one")
        require_within("count of a cycle", cycle.count, 0.0, _MOST, "", "it is 1, or 0.5 for a half cycle")
        amplitude = effective_amplitude(cycle.amplitude, cycle.mean, strength.tensile_strength, mean_stress)
        damage += cycle.count * strength.damage_of(amplitude)
    return damage
