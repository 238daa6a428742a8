"""How a bending linkage swings: its periodic steady state, from any state, by feedback, and over a range of speeds."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterable
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
        residual: what is left of M u'' + C u' + K u = p at the given times, in parts of the motion, both
            measured by the root of the elastic energy that they have, or would make.
    """

    period: float
    series: ComplexArray
    residual: float

    def at(self, times: npt.ArrayLike, derivative: int = 0) -> FloatArray:
        """u, or its first or second derivative by time, at `times` [s], shape (times, n)."""
        speed = 2.0 * math.pi / self.period
        angles = speed * np.asarray(times, dtype=float)
        return evaluate(self.series, angles, derivative) * speed**derivative

    def samples(self, count: int, derivative: int = 0) -> FloatArray:
        """u, or a derivative by time, at `count` even times of one period, shape (count, n)."""
        return self.at(self.period / count * np.arange(count), derivative)


def periodic_response(cycle: ElasticCycle) -> PeriodicResponse:
    """The periodic solution of M u'' + C u' + K(t) u = p.

    u is a trigonometric series that fulfils the equations at 2 H + 1 even times, where M, C, K and p are read off the
    series through their samples; H grows until they are fulfilled at all T given times, to `TOLERANCE`. With more
    than T / 4 harmonics the samples could no longer tell, so that is where it ends, with a warning.

    Warns:
        UserWarning: T / 4 harmonics are not enough.

    Raises:
        ValueError: without damping a harmonic meets a resonance, so there is no periodic solution.
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


# How a bending linkage swings in from any state: direct integration.


@dataclass(frozen=True)
class Transient:
    """Deviation over some periods.

    Attributes:
        time: shape (steps + 1,) [s], from 0.
        displacement, velocity, acceleration: shape (steps + 1, n).
    """

    time: FloatArray
    displacement: FloatArray
    velocity: FloatArray
    acceleration: FloatArray


def transient(
    cycle: ElasticCycle,
    steps: int,
    periods: int = 1,
    displacement: FloatArray | None = None,
    velocity: FloatArray | None = None,
) -> Transient:
    """Integrate M u'' + C u' + K(t) u = p by Newmark's average acceleration: of second order, stable at any step.

    Args:
        cycle: the equations.
        steps: of one period. The shortest natural period that matters should have 20 of them.
        periods: how many.
        displacement: u at t = 0, shape (n,); zero unless told.
        velocity: u' at t = 0, shape (n,); zero unless told.

    Raises:
        ValueError: there are no steps or periods, or M is singular, so that there is no acceleration to begin with.

    Source: N. M. Newmark, A method of computation for structural dynamics, J. Eng. Mech. Div. ASCE 85 (1959), with
        beta = 1/4 and gamma = 1/2.
    """
    if steps < 1 or periods < 1:
        raise ValueError(f"{steps} steps of each of {periods} periods: there must be one or more of either.")
    u, v = (
        np.zeros(cycle.load.shape[1]) if x is None else np.asarray(x, dtype=float) for x in (displacement, velocity)
    )
    found = _integrated(cycle.resampled(steps), periods, u, v)
    time = np.asarray(cycle.period / steps * np.arange(periods * steps + 1))
    return Transient(time, *found)


def growth_per_period(cycle: ElasticCycle, steps: int) -> float:
    """By how much a disturbance of the periodic motion grows in a period: the largest Floquet multiplier, as a modulus.

    Above 1 the periodic motion is not what a linkage settles to: its own change of stiffness excites it (parametric
    resonance). Arguments and errors are those of `transient`.
    """
    if not 1 <= steps < np.inf:
        raise ValueError(f"{steps} steps of a period: there must be one or more.")
    n = cycle.load.shape[1]
    unloaded = ElasticCycle(cycle.period, cycle.mass, cycle.damping, cycle.stiffness, np.zeros_like(cycle.load))
    start = np.eye(2 * n)
    u, v, _ = _integrated(unloaded.resampled(steps), 1, start[:n], start[n:])
    return float(np.abs(np.linalg.eigvals(np.vstack([u[-1], v[-1]]))).max())


def _integrated(
    here: ElasticCycle, periods: int, u: FloatArray, v: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """u, v and a at all times; `u` and `v` at the first have the shape (n,), or (n, m) for m motions at once."""
    h = here.period / here.samples
    load = here.load if u.ndim == 1 else np.repeat(here.load[:, :, None], u.shape[1], axis=2)
    effective = np.linalg.inv(4.0 / h**2 * here.mass + 2.0 / h * here.damping + here.stiffness)
    try:
        a = np.linalg.solve(here.mass[0], load[0] - here.damping[0] @ v - here.stiffness[0] @ u)
    except np.linalg.LinAlgError as error:
        raise ValueError(
            "a coordinate has no mass, so its acceleration is not known: give it one, or take the periodic response."
        ) from error
    count = periods * here.samples + 1
    states = tuple(np.empty((count, *u.shape)) for _ in range(3))
    for k in range(count):
        if k > 0:
            j = k % here.samples
            from_u, from_v = 4.0 / h**2 * u + 4.0 / h * v + a, 2.0 / h * u + v
            new = effective[j] @ (load[j] + here.mass[j] @ from_u + here.damping[j] @ from_v)
            u, v, a = new, 2.0 / h * new - from_v, 4.0 / h**2 * new - from_u
        for kept, value in zip(states, (u, v, a), strict=True):
            kept[k] = value
    return states[0], states[1], states[2]


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

    Warns:
        UserWarning: it stopped before it converged.
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

    omega_i is the mean over the cycle of the i-th instantaneous natural frequency, at even crank angles. That is our
    definition; it depends on the linkage alone. Which of these speeds matter depends on the load: see `speed_sweep`.

    Raises:
        ValueError: there is not one harmonic or more.
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
    speeds: Iterable[float], cycle_at: Callable[[float], ElasticCycle], coordinates: tuple[int, ...]
) -> SpeedSweep:
    """Periodic response at each of `speeds` [rad/s].

    Args:
        speeds: of the crank.
        cycle_at: the equations at a speed.
        coordinates: columns of u whose Euclidean norm is the deviation, such as x and y of the path point.

    Warns:
        UserWarning: as of `periodic_response`.

    Raises:
        ValueError: as of `periodic_response`.
    """
    rows = []
    for speed in speeds:
        cycle = cycle_at(speed)
        moving = periodic_response(cycle).samples(cycle.samples)
        rows.append((speed, *(_largest(u[:, coordinates]) for u in (moving, cycle.static()))))
    speed_column, dynamic, static = np.array(rows).reshape(-1, 3).T
    return SpeedSweep(speed_column, dynamic, static)


def _largest(u: FloatArray) -> float:
    return float(np.linalg.norm(u, axis=1).max())
