"""The external Geneva drive in closed form: known kinematics and the motion of its one degree of freedom.

Independent of the library: formulas of J. H. Bickford, Mechanisms for Intermittent Motion, 1972, and scipy. With n
slots, mu = sin(pi/n), and phi the driver's angle from the line of centres, the wheel's angle from it is

    beta = atan2(mu sin(phi), 1 - mu cos(phi))        |phi| <= phi_0 = pi/2 - pi/n

and the wheel turns the other way round.

    python -m benchmarks.geneva > models/geneva/reference.csv
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from .curve_file import print_curve

#: Of the reference curve: slots, turns of the driver per second, time between two rows [s].
SLOTS, SPEED, STEP = 4, 2 * math.pi, 2.5e-3


class Wheel(NamedTuple):
    """The wheel's angle [rad], and its first and second derivative by the driver's angle."""

    angle: float
    rate: float
    curvature: float


def in_slot(phi: float, slots: int) -> Wheel:
    """The wheel while the pin is in the slot; `phi` is the driver's angle from the line of centres [rad]."""
    mu = math.sin(math.pi / slots)
    s, c = math.sin(phi), math.cos(phi)
    D = 1 + mu * mu - 2 * mu * c
    return Wheel(math.atan2(mu * s, 1 - mu * c), mu * (c - mu) / D, -mu * (1 - mu * mu) * s / (D * D))


def wheel(theta: float, slots: int) -> Wheel:
    """The wheel's absolute angle psi [rad] and its derivatives by the driver's absolute angle theta [rad].

    In the frame of `models.geneva`: theta = 0 with the pin on the far side, where slot 0 is at pi/n on one side.
    """
    turns = math.floor(theta / (2 * math.pi))
    phi, pitch = theta - math.pi - 2 * math.pi * turns, 2 * math.pi / slots
    if abs(phi) < math.pi / 2 - pitch / 2:
        beta, rate, curvature = in_slot(phi, slots)
        return Wheel(-beta - turns * pitch, -rate, -curvature)
    return Wheel(-math.copysign(pitch / 2, phi) - turns * pitch, 0.0, 0.0)


class Peak(NamedTuple):
    """Where the wheel's acceleration is largest: the driver's angle phi [rad], and |beta''|."""

    angle: float
    curvature: float


def peak(slots: int) -> Peak:
    """The largest acceleration at constant driver speed, where its derivative is zero."""
    mu = math.sin(math.pi / slots)

    def slope(phi: float) -> float:
        s, c = math.sin(phi), math.cos(phi)
        # (s/D^2)' = (c D - 2 s D')/D^3 with D' = 2 mu s
        return c * (1 + mu * mu - 2 * mu * c) - 4 * mu * s * s

    angle = brentq(slope, 0.0, math.pi / 2, xtol=1e-15, rtol=1e-15)
    return Peak(angle, -in_slot(angle, slots).curvature)


class Masses(NamedTuple):
    """Inertias [kg m2] and constant torques [N m] on driver and wheel, and the wheel's damping [N m s/rad]."""

    driver: float
    wheel: float
    drive: float
    load: float
    damping: float


def motion(masses: Masses, slots: int, theta: float, speed: float, time: float) -> tuple[float, float]:
    """Driver angle [rad] and speed [rad/s] after `time` [s]: Lagrange's equation of the one degree of freedom.

    (I_d + I_w beta'^2) theta'' + I_w beta' beta'' theta'^2 = T_d - beta' (T_w + d beta' theta'), because psi' = -beta'
    theta'; integrated from one entry or exit to the next, where its right side jumps.
    """
    limit = math.sin(math.pi / slots)

    def acceleration(theta: float, speed: float, moving: bool) -> float:
        phi = math.remainder(theta - math.pi, 2 * math.pi)
        _, rate, curvature = in_slot(phi, slots) if moving else Wheel(0.0, 0.0, 0.0)
        torque = masses.drive - rate * masses.load - masses.damping * rate * rate * speed
        torque -= masses.wheel * rate * curvature * speed * speed
        return torque / (masses.driver + masses.wheel * rate * rate)

    now = 0.0
    while now < time:
        moving = _is_moving(theta, speed, limit)

        def derivative(_time: float, y: Sequence[float], moving: bool = moving) -> tuple[float, float]:
            return y[1], acceleration(y[0], y[1], moving)

        def mouth(_time: float, y: Sequence[float], moving: bool = moving) -> float:
            return (-math.cos(y[0]) - limit) * (1.0 if moving else -1.0)

        mouth.terminal, mouth.direction = True, -1.0  # type: ignore[attr-defined]
        done = solve_ivp(
            derivative, (now, time), (theta, speed), "DOP853", rtol=1e-13, atol=1e-14, events=mouth, max_step=0.01
        )
        now, theta, speed = float(done.t[-1]), float(done.y[0, -1]), float(done.y[1, -1])
    return theta, speed


def _is_moving(theta: float, speed: float, limit: float) -> bool:
    """Whether the pin is in a slot, or at its mouth on the way in."""
    inside = -math.cos(theta) - limit
    return inside > 0 if abs(inside) > 1e-9 else math.sin(theta) * speed > 0


def curve() -> Iterator[tuple[float, ...]]:
    """Rows of the reference: time [s], angles [rad], wheel speed [rad/s], wheel acceleration [rad/s2]; one turn."""
    for k in range(round(2 * math.pi / SPEED / STEP) + 1):
        theta = SPEED * k * STEP
        psi, rate, curvature = wheel(theta, SLOTS)
        yield k * STEP, theta, psi, rate * SPEED, curvature * SPEED**2


def main() -> None:
    """Print the reference curve as CSV."""
    print_curve("time,driver_angle,wheel_angle,wheel_speed,wheel_acceleration", curve())


if __name__ == "__main__":
    main()
