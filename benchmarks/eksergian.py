"""A linkage of one degree of freedom by Eksergian's equation of motion, for those whose kinematics are known.

Independent of the library. With the generalised inertia I(theta) = sum of m |r'|^2 + J phi'^2 over all links, where '
is the derivative by the crank's angle theta, and Q all applied forces reduced to the crank:

    I theta.. + 1/2 I' theta.^2 = Q          R. Eksergian, Dynamical Analysis of Machines, J. Franklin Institute, 1930

Points are complex numbers, x + i y [m].
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp


class Course(NamedTuple):
    """A quantity and its first and second derivative by the crank's angle."""

    value: float
    rate: float
    curvature: float


#: A point and its first and second derivative by the crank's angle [m].
Point = tuple[complex, complex, complex]


class Link(NamedTuple):
    """A link at one angle of the crank.

    Attributes:
        mass, inertia: [kg], and about its centre of mass [kg m2].
        angle: [rad].
        centre: its centre of mass and the two derivatives [m].
    """

    mass: float
    inertia: float
    angle: Course
    centre: Point

    @property
    def reduced_inertia(self) -> float:
        """Its part of I [kg m2]."""
        return self.mass * abs(self.centre[1]) ** 2 + self.inertia * self.angle.rate**2

    @property
    def reduced_inertia_rate(self) -> float:
        """Its part of I' [kg m2/rad]."""
        translation = (self.centre[1].conjugate() * self.centre[2]).real
        return 2 * (self.mass * translation + self.inertia * self.angle.rate * self.angle.curvature)


def along(distance: float, angle: Course, begin: Point = (0.0, 0.0, 0.0)) -> Point:
    """The point at a distance [m] along a link from where that begins."""
    point = distance * cmath.exp(1j * angle.value)
    return (
        begin[0] + point,
        begin[1] + 1j * point * angle.rate,
        begin[2] + point * (1j * angle.curvature - angle.rate**2),
    )


#: The links at an angle of the crank [rad].
Links = Callable[[float], Sequence[Link]]

#: Applied forces reduced to the crank [N m], at an angle [rad] and a speed [rad/s] of the crank.
Torque = Callable[[float, float], float]


def kinetic_energy(links: Sequence[Link], speed: float) -> float:
    """Of all links [J], at a speed of the crank [rad/s]."""
    return sum(link.reduced_inertia for link in links) * speed**2 / 2


def weight(links: Sequence[Link], gravity: float) -> float:
    """Weights of all links, reduced to the crank [N m]; gravity [m/s2] acts downwards."""
    return -gravity * sum(link.mass * link.centre[1].imag for link in links)


def motion(
    links: Links, torque: Torque, theta: float, speed: float, times: Sequence[float]
) -> tuple[Sequence[float], Sequence[float]]:
    """Angle [rad] and speed [rad/s] of the crank at `times` [s], which begin with the start."""

    def derivative(_time: float, y: Sequence[float]) -> tuple[float, float]:
        now = links(y[0])
        inertia = sum(link.reduced_inertia for link in now)
        rate = sum(link.reduced_inertia_rate for link in now)
        return y[1], (torque(y[0], y[1]) - rate * y[1] ** 2 / 2) / inertia

    done = solve_ivp(
        derivative, (times[0], times[-1]), (theta, speed), "DOP853", t_eval=np.asarray(times), rtol=1e-13, atol=1e-13
    )
    return done.y[0].tolist(), done.y[1].tolist()


#: Of reference curves: speed at the start and of the shaft's driven end [rad/s], damping of the shaft [N m s/rad],
#: length [s] and number of rows.
SPEED, DAMPING, LENGTH, ROWS = 2 * math.pi, 0.1, 2.0, 400


def default_run(links: Links) -> Iterator[tuple[float, float, float]]:
    """Time [s], angle [rad] and speed [rad/s] of the crank in the default run of the models of linkages."""
    times = np.linspace(0.0, LENGTH, ROWS + 1)
    angles, speeds = motion(links, lambda _theta, speed: DAMPING * (SPEED - speed), 0.0, SPEED, times.tolist())
    return zip(times, angles, speeds, strict=True)
