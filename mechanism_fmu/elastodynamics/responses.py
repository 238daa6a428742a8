"""Dynamic response of a bending linkage: periodic steady state, transient, by feedback, and over a range of speeds."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .elastic_cycle import ElasticCycle, InstantaneousModes
from .elements import FloatArray
from .fourier import ComplexArray, coefficients, differentiation, evaluate, even_angles

# Periodic steady state of a bending linkage, by Fourier collocation.

#: What is left of the equations at all given times, in parts of the largest elastic energy's root.
TOLERANCE = 1e-10
#: A deviation that exceeds the quasi-static one by this is a resonance without damping, cut short by rounding.
_RESONANCE = 1e6
#: Harmonics of the first attempt; they are doubled until little enough is left.
_FIRST_HARMONICS = 16


@dataclass(frozen=True)
class PeriodicResponse:
    """Deviation from the rigid motion that repeats every period.

    Attributes:
        period: [s].
        series: Fourier coefficients, shape (harmonics + 1, n).
        residual: what is left of M u'' + C u' + K u = p at the given times, in parts of the motion [-], both
            measured by the root of the elastic energy that they have, or would make.

    Source: `periodic_response`: docs/explanation/elastodynamics-dynamics.md, eqs (K1), (K5).
    """

    period: float
    series: ComplexArray
    residual: float

    def at(self, times: npt.ArrayLike, derivative: int = 0) -> FloatArray:
        """u, or its first or second derivative by time, at `times` [s], shape (times, n).

        Args:
            times: [s], shape (times,).
            derivative: number of the derivative by time, 0 for u itself.
        """
        speed = 2.0 * math.pi / self.period
        angles = speed * np.asarray(times, dtype=float)
        return evaluate(self.series, angles, derivative) * speed**derivative

    def samples(self, count: int, derivative: int = 0) -> FloatArray:
        """u, or a derivative by time, at `count` even times of one period, shape (count, n).

        Args:
            count: number of times, even ones from 0 on.
            derivative: number of the derivative by time, 0 for u itself.
        """
        return self.at(self.period / count * np.arange(count), derivative)


def periodic_response(cycle: ElasticCycle) -> PeriodicResponse:
    """The periodic solution of M u'' + C u' + K(t) u = p.

    u is a trigonometric series that fulfils the equations at 2 H + 1 even times, where M, C, K and p are read off the
    series through their samples; H grows until they are fulfilled at all T given times, to `TOLERANCE`. With more
    than T / 4 harmonics the samples could no longer resolve the motion, so that is where it ends, with a warning.

    Args:
        cycle: the equations.

    Warns:
        UserWarning: T / 4 harmonics are not enough.

    Raises:
        ValueError: without damping a harmonic meets a resonance, so there is no periodic solution.

    Source: docs/explanation/elastodynamics-dynamics.md, eq (K5): Fourier collocation by the derivative matrix of L. N.
        Trefethen, Spectral Methods in MATLAB, SIAM 2000, chapter 3.
    """
    most = (cycle.samples - 2) // 4
    harmonics = min(_FIRST_HARMONICS, most)
    while True:
        found = _collocated(cycle, harmonics)
        if found.residual <= TOLERANCE:
            return found
        if harmonics == most:
            break
        harmonics = min(2 * harmonics, most)
    warnings.warn(
        f"{harmonics} harmonics, all that {cycle.samples} samples allow, fulfil the equations of the periodic motion "
        f"to {found.residual:.1g} only, not to {TOLERANCE:g}: give more samples of the cycle, or a smoother load.",
        stacklevel=2,
    )
    return found


def _collocated(cycle: ElasticCycle, harmonics: int) -> PeriodicResponse:
    """The series that fulfils the equations at 2 `harmonics` + 1 times."""
    count = 2 * harmonics + 1
    here = cycle.resampled(count)
    n = here.load.shape[1]
    d = differentiation(count) * (2.0 * math.pi / cycle.period)
    # Row (j, a), column (k, b): equation a at time j, coordinate b at time k.
    matrix = np.einsum("jab,jk->jakb", here.mass, d @ d) + np.einsum("jab,jk->jakb", here.damping, d)
    diagonal = np.arange(count)
    matrix[diagonal, :, diagonal, :] += here.stiffness
    try:
        u = np.linalg.solve(matrix.reshape(count * n, count * n), here.load.reshape(-1)).reshape(count, n)
    except np.linalg.LinAlgError:
        u = np.full((count, n), np.inf)
    if not here.size(u) <= _RESONANCE * here.size(here.static()):
        raise ValueError(
            "there is no periodic motion: undamped, the linkage resonates with a harmonic of its own cycle. Give it "
            "damping, 0.02 for instance, or another speed."
        )
    series = coefficients(u)
    return PeriodicResponse(cycle.period, series, _left_over(cycle, series))


def _left_over(cycle: ElasticCycle, series: ComplexArray) -> float:
    angles, speed = even_angles(cycle.samples), 2.0 * math.pi / cycle.period
    u, v, a = (evaluate(series, angles, k)[..., None] * speed**k for k in range(3))
    rest = cycle.mass @ a + cycle.damping @ v + cycle.stiffness @ u - cycle.load[..., None]
    bent, wrong = cycle.size(u[..., 0]), cycle.size(np.asarray(np.linalg.solve(cycle.stiffness, rest)[..., 0]))
    return wrong / bent if bent > 0.0 else 0.0


# Whether a bending linkage settles to its periodic motion: Floquet's multipliers.

#: Radau IIA of three stages and fifth order: the weights, of which the last row ends the step, and its instants.
_SIX = math.sqrt(6.0)
_RADAU = np.array(
    [
        [(88 - 7 * _SIX) / 360, (296 - 169 * _SIX) / 1800, (-2 + 3 * _SIX) / 225],
        [(296 + 169 * _SIX) / 1800, (88 + 7 * _SIX) / 360, (-2 - 3 * _SIX) / 225],
        [(16 - _SIX) / 36, (16 + _SIX) / 36, 1 / 9],
    ]
)
_INSTANTS = _RADAU.sum(axis=1)


def growth_per_period(cycle: ElasticCycle, steps: int) -> float:
    """By how much a disturbance of the periodic motion grows in a period: the largest Floquet multiplier, as a modulus.

    Above 1 the periodic motion is not what a linkage settles to: its own change of stiffness excites it (parametric
    resonance). M u'' + C u' + K u = 0 is integrated over the period from each unit state, by Radau IIA: of fifth order,
    and L-stable, so that modes too fast for the steps die out as if they were damped. Coordinates may lack mass.

    Args:
        cycle: the equations; its load does not matter.
        steps: of the period. The slowest mode should have 20 of them in its own.

    Raises:
        ValueError: there are no steps.

    Source: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II (1996), section IV.5.
    """
    if not 1 <= steps < np.inf:
        raise ValueError(f"{steps} steps of a period: there must be one or more.")
    n, h, stages = cycle.load.shape[1], cycle.period / steps, len(_INSTANTS)
    angles = 2.0 * math.pi / steps * np.add.outer(np.arange(steps), _INSTANTS)
    mass, damping, stiffness = (
        evaluate(coefficients(part), angles.ravel()).reshape(steps, stages, n, n)
        for part in (cycle.mass, cycle.damping, cycle.stiffness)
    )
    once, twice = h * _RADAU, h * h * _RADAU @ _RADAU  # from the accelerations of the stages to v and to u
    u, v = np.eye(n, 2 * n), np.eye(n, 2 * n, n)
    for m, c, k in zip(mass, damping, stiffness, strict=True):
        matrix = np.einsum("iab,ij->iajb", c, once) + np.einsum("iab,ij->iajb", k, twice)
        matrix[np.arange(stages), :, np.arange(stages), :] += m
        right = c @ v + k @ (u + h * _INSTANTS[:, None, None] * v)
        a = -np.linalg.solve(matrix.reshape(stages * n, stages * n), right.reshape(stages * n, 2 * n))
        a = a.reshape(stages, n, 2 * n)
        u, v = u + h * v + np.tensordot(twice[-1], a, 1), v + np.tensordot(once[-1], a, 1)
    return float(np.abs(np.linalg.eigvals(np.vstack([u, v]))).max())


# The elastic acceleration fed back into the inertia forces, again and again.

#: A change of this part of the deviation ends the iteration.
FEEDBACK_TOLERANCE = 1e-9
#: Rounds at most; a series that has not settled by then will not.
_MOST_ROUNDS = 100
#: Harmonics below this part of the largest are rounding; fed back, they would grow.
_ROUNDING = 1e-13


@dataclass(frozen=True)
class Feedback:
    """Where the iteration ended.

    Attributes:
        displacement: u with the least change, at the samples of the cycle, shape (T, n).
        changes: of each round, in parts of the quasi-static deviation (roots of elastic energy), shape (rounds,).
        converged: whether the last change is below `TOLERANCE`.
    """

    displacement: FloatArray
    changes: FloatArray
    converged: bool


def fed_back(cycle: ElasticCycle) -> Feedback:
    """u_0 = K^-1 p, then u_(k+1) = K^-1 (p - C u_k' - M u_k''): what the paper's kineto-elastodynamics calls for.

    Each round multiplies harmonic h of a mode of natural frequency omega by (h Omega / omega)^2, so it converges only
    while every harmonic that is there stays below every natural frequency; otherwise the changes shrink at first and
    grow from then on, as those of an asymptotic series. The iteration stops as soon as a change is not less than the
    one before, and gives what had changed least. `periodic_response` solves the same equations at any speed.

    Args:
        cycle: the equations.

    Warns:
        UserWarning: it stopped before it converged.

    Source: docs/explanation/elastodynamics-dynamics.md, eq (K6): the "effects of elastic deformation upon the inertia
        forces" of Erdman, Sandor, Oakberg (1972) as an iteration.
    """
    speed = 2.0 * math.pi / cycle.period
    static = cycle.static()
    whole = cycle.size(static)
    u = best = static
    changes: list[float] = []
    while len(changes) < _MOST_ROUNDS:
        new = _once_more(cycle, u, speed)
        changes.append(cycle.size(new - u) / whole if whole > 0.0 else 0.0)
        if not (len(changes) == 1 or changes[-1] < changes[-2]):
            break
        u = best = new
        if changes[-1] <= FEEDBACK_TOLERANCE:
            break
    found = Feedback(best, np.array(changes), changes[-1] <= FEEDBACK_TOLERANCE)
    if not found.converged:
        warnings.warn(
            f"the elastic acceleration, fed back, settles to {found.changes.min():.1g} of the quasi-static deviation "
            f"after {len(changes)} rounds and no further: harmonics of the cycle reach natural frequencies. Take "
            "periodic_response.",
            stacklevel=2,
        )
    return found


def _once_more(cycle: ElasticCycle, u: FloatArray, speed: float) -> FloatArray:
    series, angles = coefficients(u), even_angles(cycle.samples)
    series = np.where(np.abs(series) > _ROUNDING * np.abs(series).max(axis=0), series, 0.0)
    v, a = (evaluate(series, angles, k)[..., None] * speed**k for k in (1, 2))
    rest = cycle.load[..., None] - cycle.damping @ v - cycle.mass @ a
    return np.asarray(np.linalg.solve(cycle.stiffness, rest)[..., 0])


# Speeds at which a linkage resonates with its own cycle, and its response over a range of them.


def critical_speeds(modes: InstantaneousModes, harmonics: int) -> FloatArray:
    """Crank speeds omega_i / h [rad/s], shape (modes, harmonics), at which harmonic h of the crank meets mode i.

    omega_i is the mean over the cycle of the i-th instantaneous natural frequency, at even crank angles: this project's
    definition, which depends on the linkage alone. Which of these speeds matter depends on the load: see `speed_sweep`.

    Args:
        modes: of the linkage over a cycle, at even crank angles.
        harmonics: number of harmonics of the crank, 1 or more.

    Raises:
        ValueError: there is not one harmonic or more.

    Source: docs/explanation/elastodynamics-dynamics.md, eq (K7).
    """
    if harmonics < 1:
        raise ValueError(f"{harmonics} harmonics: ask for one or more.")
    return np.asarray(np.divide.outer(modes.omega.mean(axis=0), np.arange(1.0, harmonics + 1.0)))


@dataclass(frozen=True)
class SpeedSweep:
    """Largest deviation over a cycle at each speed.

    Attributes:
        speed: of the crank [rad/s], shape (S,).
        dynamic: of the periodic motion, shape (S,).
        static: of the quasi-static one, Case 2, shape (S,).
    """

    speed: FloatArray
    dynamic: FloatArray
    static: FloatArray


def speed_sweep(
    cycle: ElasticCycle,
    speed: float,
    factors: npt.ArrayLike,
    deviation: Callable[[FloatArray], FloatArray],
    samples: int | None = None,
    on_speed: Callable[[int], None] = lambda _: None,
) -> SpeedSweep:
    """Largest deviation of the periodic motion, and of the quasi-static one, at `factors` times the speed.

    Args:
        cycle: the equations at `speed`, of a linkage that only inertia loads: see `ElasticCycle.faster`.
        speed: of the crank [rad/s].
        factors: of the speed, shape (S,), positive.
        deviation: from u at the samples of the cycle, shape (T, n), to how far off the path is, shape (T,).
        samples: of the equations that are solved; those of the cycle unless fewer are given, which takes less time.
        on_speed: called with the number of the speed that is done.

    Warns:
        UserWarning: as of `periodic_response`.

    Raises:
        ValueError: as of `periodic_response`.

    Source: `periodic_response` at each speed: docs/explanation/elastodynamics-dynamics.md, eqs (K1) and (K5).
    """
    parts = np.asarray(factors, dtype=float)
    solved = cycle if samples is None else cycle.resampled(samples)
    static = deviation(cycle.static()).max()
    dynamic = []
    for number, factor in enumerate(parts.tolist()):
        dynamic.append(deviation(periodic_response(solved.faster(factor)).samples(cycle.samples)).max())
        on_speed(number)
    return SpeedSweep(speed * parts, np.array(dynamic), static * parts**2)
