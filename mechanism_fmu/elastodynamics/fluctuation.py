"""How unevenly a drive works over a cycle."""

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
