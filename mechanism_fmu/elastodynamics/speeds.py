"""Speeds at which a linkage resonates with its own cycle, and its response over a range of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from .elastic_cycle import ElasticCycle
from .fourier import FloatArray
from .frequencies import InstantaneousModes
from .periodic import periodic_response


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
