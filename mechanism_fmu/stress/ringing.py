"""Stress of a tooth that is struck again while it still rings, and what a whole sequence of impacts does to it."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .beam import LARGEST_VELOCITY, Beam, FloatArray, require_all_within, require_within
from .fatigue import Cycle, MeanStress, Strength, effective_amplitude, rainflow_cycles
from .material import Material
from .maximum import audible_stretches, maximum_stress
from .modes import converged_modes
from .recovery import BendingField
from .ritz import Mode

# Stress at one place of a tooth that is struck again while it still rings.

ComplexArray = npt.NDArray[np.complex128]

#: Points of a period of the fastest mode still heard at which the slope of the stress is looked at. Two extremes
#: between two of them would be missed; they would differ by next to nothing.
_POINTS_OF_PERIOD = 24

#: A mode is heard above this part of `silence`. Quieter ones belong to every value, but no longer set the pace.
_HEARD = 1e-3

#: The grid is looked at in blocks of rows of so many points: long ringing takes no more memory than short, and products
#: of matrices this small wait for no threads of a BLAS.
_ROWS, _POINTS_OF_ROW = 64, 64

#: Ringing is followed until no swing exceeds this part of what the fastest impact alone can cause.
RESOLUTION = 1e-2

#: Extremes that are refined at once: enough that each costs little, and no more memory for long ringing.
_ROOTS_AT_ONCE = 1000

#: Steps of a regula falsi that bring an extreme from a cell of the grid to rounding.
_REFINEMENTS = 8

#: As of `maximum_stress`: with less damping the ringing hardly ends.
_LEAST_DAMPING = 1e-4

_LATEST_TIME = 1e12


class Swing(NamedTuple):
    """An extreme of the stress, or its value at an impact.

    Attributes:
        time, stress: [s] and [Pa].
    """

    time: float
    stress: float


class Ringing:
    """Modes of a tooth that a sequence of impacts excites, by exact superposition.

    Each mode is one complex amplitude, eta(t) = Im(c exp(p t)) with p = -zeta Lambda + i Lambda_d. It swings freely
    between impacts, c becoming c exp(p dt); an impact adds v / Lambda_d, since it changes eta' by v, not eta.

    Args:
        tooth: the beam.
        material: what it is made of; its damping ratio must be 1e-4 or more.
        times: of the impacts [s], ascending, equal ones allowed; shape (n,), n >= 1.
        velocities: v_I of each impact [m/s], with sign: the tooth's length times the jump of the wheel's rate,
            l (omega_after - omega_before); shape (n,). Velocities of one time add up, so the jump that several records
            of one instant share must be given once.
        modes: the modes that take part; without them `converged_modes`.

    Raises:
        ValueError: when there is no impact, times and velocities do not belong together, do not ascend or are not
            finite, damping is too small, or `modes` is empty.

    Source: Pennestrì, Valentini, Vita, eqs (10), (13), (16), superposed.
    """

    def __init__(
        self,
        tooth: Beam,
        material: Material,
        times: npt.ArrayLike,
        velocities: npt.ArrayLike,
        modes: Sequence[Mode] | None = None,
    ) -> None:
        self.times, self.velocities = _checked(times, velocities)
        advice = "with less, an impact is heard for thousands of swings"
        require_within("damping ratio", material.damping_ratio, _LEAST_DAMPING, 1.0, "", advice)
        self.length = tooth.length
        self._field = BendingField(tooth, material, converged_modes(tooth, material) if modes is None else modes)
        self._damping_ratio = material.damping_ratio
        decay = material.damping_ratio * self._field.frequencies
        self._damped: FloatArray = self._field.frequencies * math.sqrt(1 - material.damping_ratio**2)
        self._poles: ComplexArray = -decay + 1j * self._damped

    def stress(self, x: npt.ArrayLike, t: npt.ArrayLike) -> FloatArray:
        """Bending stress [Pa] at places x [m] and times t [s], of shape (len(x), len(t)); zero before the first impact.

        Args:
            x: distances from the root [m], from 0 to the length of the tooth; a number or shape (n,).
            t: times [s], as those of the impacts; a number or shape (m,).

        Raises:
            ValueError: when a place is off the tooth, or a time is not a number.
        """
        places = self._places(x)
        instants = np.atleast_1d(np.asarray(t, dtype=np.float64))
        require_all_within("time", instants, -_LATEST_TIME, _LATEST_TIME, "s", "give times of the run")
        amplitudes = np.array([amplitude for _, amplitude in self._impacts()])
        last = np.searchsorted(self.times, instants, side="right") - 1
        since = np.where(last >= 0, instants - self.times[last], 0.0)
        response = (amplitudes[last] * np.exp(np.multiply.outer(since, self._poles))).imag
        return np.asarray(self._field.modal_stress(places) @ np.where(last[:, None] >= 0, response, 0.0).T)

    def swings(self, x: float) -> Iterator[Swing]:
        """Stress at the place x [m]: at each impact, and at each of its extremes until the ringing is over.

        Extremes are found to rounding; between two the stress goes one way. Memory does not grow with the impacts.

        Args:
            x: distance from the root [m], from 0 to the length of the tooth.

        Raises:
            ValueError: when the place is off the tooth.
        """
        weights = self._field.modal_stress(self._places(x))[0]
        loudest = float(np.abs(self.velocities).max())
        silence = RESOLUTION * loudest * float(np.sum(np.abs(weights) / self._damped))
        ends = itertools.chain(self.times[1:], [math.inf])
        for (time, amplitude), end in zip(self._impacts(), ends, strict=True):
            modal = weights * amplitude
            yield Swing(time, float(modal.imag.sum()))
            for delay, stress in self._extremes(modal, end - time, silence):
                yield Swing(time + delay, stress)
        yield Swing(time + self._over(modal, silence), 0.0)

    def _impacts(self) -> Iterator[tuple[float, ComplexArray]]:
        """Time of each impact and amplitudes of the modes just after it."""
        amplitude = np.zeros(len(self._poles), dtype=np.complex128)
        before = self.times[0]
        for time, velocity in zip(self.times, self.velocities, strict=True):
            amplitude = amplitude * np.exp(self._poles * (time - before)) + velocity / self._damped
            before = time
            yield float(time), amplitude

    def _over(self, modal: ComplexArray, silence: float) -> float:
        """Time after which the sum of the amplitudes `modal` [Pa] stays below `silence` [Pa]."""
        loudness = float(np.abs(modal).sum())
        return math.log(loudness / silence) / float(-self._poles.real.max()) if loudness > silence > 0 else 0.0

    def _extremes(self, modal: ComplexArray, until: float, silence: float) -> Iterator[tuple[float, float]]:
        """Delay [s] and value [Pa] of the extremes between an impact and the next, `until` [s] later.

        The slope of the stress changes its sign between two points of a grid; there its root is refined.
        """
        until = min(until, self._over(modal, silence))
        if until <= 0:
            return
        slopes = modal * self._poles
        cells: list[FloatArray] = []
        for times, values in self._blocks(slopes, np.abs(modal), _HEARD * silence, until):
            changes = np.flatnonzero((values[:-1] > 0) != (values[1:] > 0))
            cells.append(np.array([times[changes], times[changes + 1], values[changes], values[changes + 1]]))
            if sum(cell.shape[1] for cell in cells) > _ROOTS_AT_ONCE:
                yield from self._refined(modal, slopes, np.hstack(cells))
                cells.clear()
        if cells:
            yield from self._refined(modal, slopes, np.hstack(cells))

    def _refined(self, modal: ComplexArray, slopes: ComplexArray, cells: FloatArray) -> Iterator[tuple[float, float]]:
        """Extremes in cells (begin, end, slope at begin, slope at end), by the Illinois method, all at once."""
        a, b, at_a, at_b = cells
        for _ in range(_REFINEMENTS):
            rise = at_b - at_a
            middle = b - at_b * (b - a) / np.where(rise == 0.0, 1.0, rise)
            value = self._sum(slopes, middle)
            crossed = value * at_b < 0
            a, at_a = np.where(crossed, b, a), np.where(crossed, at_b, at_a / 2)
            b, at_b = middle, value
        yield from zip(b.tolist(), self._sum(modal, b).tolist(), strict=True)

    def _blocks(
        self, amplitudes: ComplexArray, loudness: FloatArray, threshold: float, until: float
    ) -> Iterator[tuple[FloatArray, FloatArray]]:
        """Grid from an impact to `until` [s] in blocks that begin where the one before ended, and `_sum` on it.

        On a grid of equal steps exp(p t) is a product of one factor for each row and one for each place in it.
        """
        last_time, last_value = np.zeros(1), amplitudes.imag.sum(keepdims=True)
        for stretch in audible_stretches(loudness, self._field.frequencies, self._damping_ratio, threshold, until):
            count = math.ceil((stretch.end - stretch.begin) * stretch.frequency / (2 * math.pi) * _POINTS_OF_PERIOD)
            step = (stretch.end - stretch.begin) / count
            in_row = np.exp(np.multiply.outer(self._poles, step * np.arange(1, _POINTS_OF_ROW + 1)))
            for first in range(0, count, _ROWS * _POINTS_OF_ROW):
                indices = np.arange(first, min(first + _ROWS * _POINTS_OF_ROW, count))
                rows = stretch.begin + step * indices[::_POINTS_OF_ROW]
                of_row = amplitudes * np.exp(np.multiply.outer(rows, self._poles))
                values = (of_row.real @ in_row.imag + of_row.imag @ in_row.real).ravel()[: len(indices)]
                times = np.concatenate((last_time, stretch.begin + step * (indices + 1)))
                yield times, np.concatenate((last_value, values))
                last_time, last_value = times[-1:], values[-1:]

    def _sum(self, amplitudes: ComplexArray, t: FloatArray) -> FloatArray:
        """Sum over the modes of Im(amplitude exp(p t)), in the shape of `t`."""
        # No product of matrices: with ones this small it waits longer for the threads of a BLAS than it works.
        phase = np.multiply.outer(self._poles.imag, t)
        swing = amplitudes.real[:, None] * np.sin(phase) + amplitudes.imag[:, None] * np.cos(phase)
        return np.asarray((np.exp(np.multiply.outer(self._poles.real, t)) * swing).sum(axis=0))

    def _places(self, x: npt.ArrayLike) -> FloatArray:
        places = np.atleast_1d(np.asarray(x, dtype=np.float64))
        require_all_within("place", places, 0.0, self.length, "m", "x runs from the root to the tip of the tooth")
        return places


def _checked(times: npt.ArrayLike, velocities: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Times and velocities as arrays, after refusing what cannot be right."""
    instants = np.atleast_1d(np.asarray(times, dtype=np.float64))
    jumps = np.atleast_1d(np.asarray(velocities, dtype=np.float64))
    if instants.ndim != 1 or instants.shape != jumps.shape or not len(instants):
        raise ValueError(
            f"{instants.size} times and {jumps.size} velocities are no sequence of impacts: give one velocity for each "
            "time, at least one."
        )
    require_all_within("time of an impact", instants, -_LATEST_TIME, _LATEST_TIME, "s", "give times of the run")
    advice = "give the jump v_I of each impact, with sign"
    require_all_within("impact velocity", jumps, -LARGEST_VELOCITY, LARGEST_VELOCITY, "m/s", advice)
    backwards = np.flatnonzero(np.diff(instants) < 0)
    if backwards.size:
        i = int(backwards[0])
        raise ValueError(
            f"impact {i + 2} at {instants[i + 1]:g} s comes before impact {i + 1} at {instants[i]:g} s: "
            "sort them by time."
        )
    return instants, jumps


# What a whole sequence of impacts does to a tooth: largest stress, cycles, damage, safety.

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
        cycles: number of them by rainflow, halves as 0.5, without swings below 1e-2 of the largest possible.
        damage: Miner's sum for one such sequence, at the worse of the two outer fibres [-].
        repeats_to_failure: number of times that the whole sequence is borne, 1 / damage; infinite without damage.
        yield_safety: R_e over the largest stress [-].
        fatigue_safety: how much larger every stress could be for the worst cycle to be borne 1e7 times [-].
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

    Source: docs/decisions/014-damage-of-impact-sequences.md: `Ringing`, then ASTM E1049-85, Basquin, Goodman and Miner.
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
