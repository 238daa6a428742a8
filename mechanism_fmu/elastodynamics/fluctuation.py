"""How unevenly a drive works over a cycle, and the flywheel that evens it out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.integrate import cumulative_trapezoid

from .elements import FloatArray
from .errors import LinkageError


@dataclass(frozen=True)
class Fluctuation:
    """A torque over a range of angles.

    Attributes:
        mean: over the angle [N m].
        least, largest: [N m].
        energy: by which the work of the torque runs ahead of that of its mean, from least to most [J]: a flywheel J at
            the mean speed w keeps the speed within +- energy/(2 J w^2) of it.
    """

    mean: float
    least: float
    largest: float
    energy: float


@dataclass(frozen=True)
class Flywheel:
    """What evens a speed out.

    Attributes:
        coefficient: of fluctuation, (largest - least speed) / mean speed [-].
        inertia: J of the flywheel on the crank [kg m2].
        speed: of the crank with it, under a drive of constant torque, shape (times,) [rad/s].
    """

    coefficient: float
    inertia: float
    speed: FloatArray


def flywheel(angle: FloatArray, torque: FloatArray, speed: float, coefficient: float) -> Flywheel:
    """The flywheel that keeps to a coefficient of fluctuation: J = E / (coefficient speed^2).

    The drive gives the mean torque, the flywheel the rest: J w^2/2 falls by what the torque has worked beyond its mean.
    E is `Fluctuation.energy`. The torque is that at constant speed: what the linkage's own inertia evens out besides is
    left to it, so that the real fluctuation is somewhat smaller.

    Args:
        angle: increasing, over a whole cycle, shape (times,) [rad].
        torque: that the crank needs at constant speed, shape (times,) [N m].
        speed: mean of the least and the largest one [rad/s].
        coefficient: of fluctuation, above 0 and below 2.

    Raises:
        LinkageError: the coefficient or the speed cannot be, or the angles are as `torque_fluctuation` refuses them.
    """
    if not 0.0 < coefficient < 2.0:
        raise LinkageError(
            f"The coefficient of fluctuation is {coefficient:g}; give one above 0 and below 2, e.g. 0.02 for 2 %."
        )
    if not 0.0 < speed < np.inf:
        raise LinkageError(f"The speed is {speed:g} rad/s; a flywheel evens out a positive one.")
    found = torque_fluctuation(angle, torque)
    ahead = cumulative_trapezoid(torque - found.mean, angle, initial=0.0)
    inertia = found.energy / (coefficient * speed**2)
    if inertia == 0.0:
        return Flywheel(coefficient, 0.0, np.full_like(torque, speed))
    largest = speed * (1.0 + coefficient / 2)
    return Flywheel(coefficient, inertia, np.sqrt(largest**2 - 2.0 * (ahead - ahead.min()) / inertia))


def torque_fluctuation(angle: FloatArray, torque: FloatArray) -> Fluctuation:
    """Mean, extremes and energy of a torque, shape (times,) [N m], over increasing angles, shape (times,) [rad].

    Raises:
        LinkageError: there are fewer than two angles, or they do not increase.
    """
    if len(angle) < 2 or np.any(np.diff(angle) <= 0.0):
        raise LinkageError("The angles must increase; give at least two, over a whole cycle.")
    mean = float(np.trapezoid(torque, angle) / (angle[-1] - angle[0]))
    ahead = cumulative_trapezoid(torque - mean, angle, initial=0.0)
    return Fluctuation(mean, float(torque.min()), float(torque.max()), float(np.ptp(ahead)))
