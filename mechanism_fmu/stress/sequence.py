"""What a whole sequence of impacts does to a tooth: largest stress, cycles, damage, safety."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy.typing as npt

from .beam import Beam
from .checks import require_within
from .converged import converged_modes
from .fatigue import Cycle, MeanStress, Strength, effective_amplitude, rainflow_cycles
from .material import Material
from .maximum import maximum_stress
from .natural_mode import Mode
from .ringing import Ringing, Swing

#: Cycles that a tooth which lasts for ever is asked to bear, for the safety factor against fatigue.
ENDURANCE_CYCLES = 1e7


@dataclass(frozen=True)
class SequenceDamage:
    """What a sequence of impacts does at the critical section of a tooth.

    Attributes:
        stress: largest |sigma_b| [Pa].
        time: of it [s].
        position: xi = x / length of the section [-].
        impacts: their number.
        cycles: of the stress, by rainflow counting, halves as 0.5; swings below 1e-2 of the largest possible are not in
            it.
        damage: Miner's sum for one such sequence, at the worse of the two outer fibres [-].
        repeats_to_failure: of the whole sequence, 1 / damage; infinite without damage.
        yield_safety: R_e over the largest stress.
        fatigue_safety: how much larger every stress could be for the worst cycle to be borne 1e7 times.
    """

    stress: float
    time: float
    position: float
    impacts: int
    cycles: float
    damage: float
    repeats_to_failure: float
    yield_safety: float
    fatigue_safety: float


def sequence_damage(
    tooth: Beam,
    material: Material,
    strength: Strength,
    times: npt.ArrayLike,
    velocities: npt.ArrayLike,
    *,
    position: float | None = None,
    modes: tuple[Mode, ...] | None = None,
    mean_stress: MeanStress = MeanStress.GOODMAN,
) -> SequenceDamage:
    """Damage of a sequence of impacts on a tooth that still rings from those before.

    Both outer fibres see the same history with opposite signs; they differ by their mean stresses. The worse counts.

    Args:
        tooth: the beam.
        material: what it is made of; its damping ratio must be 1e-4 or more.
        strength: what that bears.
        times: of the impacts [s], ascending; shape (n,), n >= 1.
        velocities: v_I of each impact [m/s], with sign; shape (n,). As of `Ringing`: jumps, each counted once.
        position: xi of the section [-]; without it, where a single impact stresses the tooth most with these modes.
        modes: the modes that take part; without them `converged_modes`.
        mean_stress: how the mean of a cycle counts.

    Raises:
        ValueError: as of `Ringing`, or the position is not between 0 and 1.
    """
    if position is not None:
        require_within("position", position, 0.0, 1.0, "", "0 is the root of the tooth, 1 its tip")
    modes = converged_modes(tooth, material) if modes is None else modes
    ringing = Ringing(tooth, material, times, velocities, modes)
    if position is None:
        position = maximum_stress(tooth, material, 1.0, modes).position
    largest = Swing(float(ringing.times[0]), 0.0)

    def history() -> Iterator[float]:
        nonlocal largest
        for swing in ringing.swings(position * tooth.length):
            largest = max(largest, swing, key=lambda s: abs(s.stress))
            yield swing.stress

    count, damage, worst = 0.0, [0.0, 0.0], 0.0
    for cycle in rainflow_cycles(history()):
        count += cycle.count
        for fibre, sign in enumerate((1.0, -1.0)):
            mean = sign * cycle.mean
            amplitude = effective_amplitude(cycle.amplitude, mean, strength.tensile_strength, mean_stress)
            damage[fibre] += cycle.count * strength.damage_of(amplitude)
        worst = max(worst, _use(cycle, strength, mean_stress))
    return SequenceDamage(
        stress=abs(largest.stress),
        time=largest.time,
        position=position,
        impacts=len(ringing.times),
        cycles=count,
        damage=max(damage),
        repeats_to_failure=_inverse(max(damage)),
        yield_safety=_inverse(abs(largest.stress) / strength.yield_strength),
        fatigue_safety=_inverse(worst),
    )


def _use(cycle: Cycle, strength: Strength, mean_stress: MeanStress) -> float:
    """How much of the endurance a cycle takes at the fibre where its mean is tensile; both stresses grow alike."""
    tension = abs(cycle.mean) / strength.tensile_strength if mean_stress is MeanStress.GOODMAN else 0.0
    return cycle.amplitude / strength.amplitude_at(ENDURANCE_CYCLES) + tension


def _inverse(value: float) -> float:
    return 1 / value if value > 0 else math.inf
