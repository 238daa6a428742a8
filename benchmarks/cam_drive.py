"""A cam with a roller follower on an arm, solved on the pitch curve: kinematics, contact force, lift-off and landing.

Independent of the library: the roller's centre runs on the curve p(alpha) = C + r n at the roller's radius from the cam
C = rho(alpha) e^(i alpha), n its outward normal. Its distance |p| from the cam's hinge, the arm and the distance of the
hinges make a triangle, which gives the follower's angle psi, and the cam's angle theta = arg(-d + l e^(i psi)) - arg p.
Both are known in closed form over alpha; theta is inverted by scipy, and derivatives follow by the chain rule.

    python -m benchmarks.cam_drive > models/cam_drive/reference.csv
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from .curve_file import print_curve

#: Of the reference curve: cam speed [rad/s], rows in its one turn.
SPEED, ROWS = 2 * math.pi, 400


class Cam(NamedTuple):
    """A cam with cycloidal moves and its follower, SI units.

    base, lift; rise, dwell, back: angles of the cam for rise, upper dwell and return; roller: its radius; distance: of
    the hinges; arm: length of the follower. inertia, stiffness, preload, damping: of the follower, about its hinge.
    """

    base: float = 0.03
    lift: float = 0.0216
    rise: float = math.radians(150)
    dwell: float = math.radians(30)
    back: float = math.radians(150)
    roller: float = 0.01
    distance: float = 0.08
    arm: float = 0.06
    inertia: float = 1.5e-4
    stiffness: float = 0.1
    preload: float = 0.02
    damping: float = 0.0


class Follower(NamedTuple):
    """The follower at an angle of the cam: psi [rad], its derivatives by theta, the lever of the contact force [m]."""

    angle: float
    rate: float
    curvature: float
    lever: float


def radius(cam: Cam, alpha: float) -> tuple[float, float, float, float]:
    """Radius and its first three derivatives: a cam that turns forwards meets the rise at the end of its turn first."""
    x = alpha % (2 * math.pi)
    h, upper = cam.lift, cam.back + cam.dwell
    if x < cam.back:
        return _cycloid(cam.base, h, cam.back, x)
    if x < upper:
        return cam.base + h, 0.0, 0.0, 0.0
    if x < upper + cam.rise:
        return _cycloid(cam.base + h, -h, cam.rise, x - upper)
    return cam.base, 0.0, 0.0, 0.0


def _cycloid(start: float, h: float, width: float, x: float) -> tuple[float, float, float, float]:
    k = 2 * math.pi / width
    s, c = math.sin(k * x), math.cos(k * x)
    return start + h * (x / width - s / (2 * math.pi)), h / width * (1 - c), h / width * k * s, h / width * k * k * c


class _Place(NamedTuple):
    """Over alpha: theta and psi with two derivatives, and the lever."""

    theta: tuple[float, float, float]
    psi: tuple[float, float, float]
    lever: float


def _place(cam: Cam, alpha: float) -> _Place:
    """Cam and follower with the contact at `alpha`."""
    rho, rho1, rho2, rho3 = radius(cam, alpha)
    e = cmath.exp(1j * alpha)
    c0, c1 = rho * e, (rho1 + 1j * rho) * e
    c2, c3 = (rho2 - rho + 2j * rho1) * e, (rho3 - 3 * rho1 + 1j * (3 * rho2 - rho)) * e
    length = abs(c1)
    bend = (c1.conjugate() * c2).imag / length**3
    bend1 = (c1.conjugate() * c3).imag / length**3 - 3 * bend * (c1.conjugate() * c2).real / length**2
    normal = -1j * c1 / length
    p0 = c0 + cam.roller * normal
    p1 = c1 * (1 + cam.roller * bend)
    p2 = c2 * (1 + cam.roller * bend) + c1 * cam.roller * bend1
    log1, log2 = p1 / p0, p2 / p0 - (p1 / p0) ** 2
    d, arm, s = cam.distance, cam.arm, abs(p0)
    psi = math.acos((d * d + arm * arm - s * s) / (2 * d * arm))
    turn = arm * cmath.exp(1j * psi)
    g = turn - d
    psi1 = log1.real / (1j * turn / g).real
    g1 = 1j * turn * psi1
    psi2 = (log2 + (g1 / g) ** 2 + turn * psi1 * psi1 / g).real / (1j * turn / g).real
    g2 = turn * (1j * psi2 - psi1 * psi1)
    theta = cmath.phase(g) - alpha - cmath.phase(p0 / e)
    theta1 = (g1 / g - log1).imag
    theta2 = (g2 / g - (g1 / g) ** 2 - log2).imag
    push = normal * cmath.exp(1j * theta)
    return _Place((theta, theta1, theta2), (psi, psi1, psi2), (turn.conjugate() * push).imag)


def follower(cam: Cam, theta: float) -> Follower:
    """The follower at the cam's angle `theta` [rad]."""

    def off(alpha: float) -> float:
        return _place(cam, alpha).theta[0] - theta

    middle = _place(cam, 0.0).theta[0] - theta
    alpha = brentq(off, middle - 2, middle + 2, xtol=1e-15, rtol=1e-15)
    at = _place(cam, alpha)
    (_, t1, t2), (psi, p1, p2) = at.theta, at.psi
    return Follower(psi, p1 / t1, (p2 * t1 - p1 * t2) / t1**3, at.lever)


def rest_angle(cam: Cam) -> float:
    """The follower's angle on the base circle [rad], where its spring has the preload."""
    d, arm, s = cam.distance, cam.arm, cam.base + cam.roller
    return math.acos((d * d + arm * arm - s * s) / (2 * d * arm))


def contact_force(cam: Cam, theta: float, speed: float) -> float:
    """Force between cam and roller [N] at a steady cam speed [rad/s]."""
    at = follower(cam, theta)
    spring = cam.stiffness * (at.angle - rest_angle(cam)) + cam.preload
    return (cam.inertia * at.curvature * speed**2 + cam.damping * at.rate * speed + spring) / at.lever


def lift_off(cam: Cam, theta: float, speed: float) -> float:
    """Time [s] at which the contact force first vanishes, from the cam's angle `theta` on at a steady speed."""

    def force(time: float) -> float:
        return contact_force(cam, theta + speed * time, speed)

    return _first_root(force, 0.0, 0.01 / abs(speed))


class Landing(NamedTuple):
    """The first landing after lift-off: time [s], closing speed [m/s], follower's speed before [rad/s], lever [m]."""

    time: float
    closing_speed: float
    follower_speed: float
    lever: float


def landing(cam: Cam, theta: float, speed: float) -> Landing:
    """Where the follower, flying on its undamped spring, comes back to a cam of steady speed."""
    off = lift_off(cam, theta, speed)
    left = follower(cam, theta + speed * off)
    middle = rest_angle(cam) - cam.preload / cam.stiffness
    w = math.sqrt(cam.stiffness / cam.inertia)
    x, v = left.angle - middle, left.rate * speed

    def flight(time: float) -> tuple[float, float]:
        c, s = math.cos(w * (time - off)), math.sin(w * (time - off))
        return middle + x * c + v / w * s, v * c - x * w * s

    def above(time: float) -> float:
        return flight(time)[0] - follower(cam, theta + speed * time).angle

    time = _first_root(above, off + 0.05 / abs(speed), 0.01 / abs(speed))
    at, falls = follower(cam, theta + speed * time), flight(time)[1]
    return Landing(time, at.lever * (at.rate * speed - falls), falls, at.lever)


def _first_root(function: Callable[[float], float], start: float, step: float) -> float:
    """Where a function that is positive at `start` first vanishes."""
    while function(start + step) > 0.0:
        start += step
    return float(brentq(function, start, start + step, xtol=1e-16, rtol=1e-15))


def curve() -> Iterator[tuple[float, ...]]:
    """Rows of the reference: time [s], angles [rad], follower speed and acceleration, force [N]; one steady turn."""
    cam = Cam()
    for time in np.linspace(0.0, 2 * math.pi / SPEED, ROWS + 1).tolist():
        at = follower(cam, SPEED * time)
        force = contact_force(cam, SPEED * time, SPEED)
        yield time, SPEED * time, at.angle, at.rate * SPEED, at.curvature * SPEED**2, force


def main() -> None:
    """Print the reference curve as CSV."""
    print_curve("time,cam_angle,follower_angle,follower_speed,follower_acceleration,contact_force", curve())


if __name__ == "__main__":
    main()
