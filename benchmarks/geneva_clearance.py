"""One passage of a pin through a slot with play, in closed form: what the Geneva drive with play is measured against.

Independent of the library. The driver turns steadily, and blows are plastic. With the pin at the distance rho and the
angle alpha from the wheel's hinge, and half the clearance h, the wheel is free while |psi - alpha| < asin(h/rho):

1. it rests, until the pin, which comes in along the middle of the slot, has gone h aside: a (1 - cos tau) = h;
2. it is pushed, psi = alpha + asin(h/rho), until that would need a pull: psi'' = 0;
3. it goes on freely, until it meets the other wall;
4. it is held back, psi = alpha - asin(h/rho), until the pin comes to the rounding of the mouth.

    python -m benchmarks.geneva_clearance > models/geneva_clearance/reference.csv
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass

from scipy.optimize import brentq

from .curve_file import print_curve

#: Time between two rows of the reference [s].
STEP = 2.5e-3


@dataclass(frozen=True)
class Drive:
    """Centre distance, slot clearance, radius of the mouths' roundings [m]; slots; driver speed [rad/s]."""

    centre: float = 0.1
    clearance: float = 1e-4
    mouth: float = 1e-3
    slots: int = 4
    speed: float = 2 * math.pi

    @property
    def arm(self) -> float:
        """Distance a of the pin from the driver's hinge [m]."""
        return self.centre * math.sin(math.pi / self.slots)

    @property
    def rim(self) -> float:
        """Distance R of the mouths from the wheel's hinge [m]."""
        return self.centre * math.cos(math.pi / self.slots)


@dataclass(frozen=True)
class Passage:
    """Driver angles [rad] at which the pin strikes, the wheel goes free, meets the other wall, and comes to the mouth.

    Attributes:
        strikes, leaves, meets, ends: in this order.
        speed: of the wheel over that of the driver while it is free [1].
        place: angle of the wheel where it goes free [rad].
    """

    strikes: float
    leaves: float
    meets: float
    ends: float
    speed: float
    place: float


def pushed(d: Drive, theta: float, side: int) -> float:
    """The wheel's angle [rad] with the pin on a wall: pushed on (side 1), or held back (-1)."""
    x, y = d.centre + d.arm * math.cos(theta), d.arm * math.sin(theta)
    return math.atan2(y, x) + side * math.asin(d.clearance / 2 / math.hypot(x, y))


def rate(d: Drive, theta: complex, side: int) -> complex:
    """Its derivative by the driver's angle; the imaginary part of a theta + i step is step times the second one."""
    c, a, h = d.centre, d.arm, d.clearance / 2
    square = c * c + a * a + 2 * c * a * cmath.cos(theta)
    return (a * a + c * a * cmath.cos(theta)) / square + side * h * c * a * cmath.sin(theta) / (
        square * cmath.sqrt(square - h * h)
    )


def passage(d: Drive) -> Passage:
    """The four phases of a passage, for a wheel that rests in the middle of its play at the start."""
    enters = math.pi / 2 + math.pi / d.slots
    strikes = enters + math.acos(1 - d.clearance / 2 / d.arm)
    leaves = float(brentq(lambda t: rate(d, t + 1e-30j, 1).imag, strikes, enters + math.pi / 2, xtol=1e-15))
    speed, place = rate(d, leaves, 1).real, pushed(d, leaves, 1)
    out = 1.5 * math.pi - math.pi / d.slots
    meets = float(brentq(lambda t: place + speed * (t - leaves) - pushed(d, t, -1), leaves, out, xtol=1e-15))

    def along(theta: float) -> float:
        x, y = d.centre + d.arm * math.cos(theta), d.arm * math.sin(theta)
        return math.sqrt(x * x + y * y - d.clearance**2 / 4) - d.rim + d.mouth

    return Passage(strikes, leaves, meets, float(brentq(along, math.pi, out, xtol=1e-15)), speed, place)


def wheel(d: Drive, p: Passage, theta: float) -> tuple[float, float]:
    """Angle [rad] and speed [rad/s] of the wheel at a driver angle up to `p.ends` [rad]."""
    if theta < p.strikes:
        return math.pi / d.slots, 0.0
    if theta < p.leaves:
        return pushed(d, theta, 1), d.speed * rate(d, theta, 1).real
    if theta < p.meets:
        return p.place + p.speed * (theta - p.leaves), d.speed * p.speed
    return pushed(d, theta, -1), d.speed * rate(d, theta, -1).real


def curve() -> Iterator[tuple[float, ...]]:
    """Rows of the reference: time [s], angles [rad], wheel speed [rad/s], up to where the pin comes to the mouth."""
    d = Drive()
    p = passage(d)
    for k in range(int(p.ends / d.speed / STEP) + 1):
        theta = d.speed * k * STEP
        yield k * STEP, theta, *wheel(d, p, theta)


def main() -> None:
    """Print the reference curve as CSV."""
    print_curve("time,driver_angle,wheel_angle,wheel_speed", curve())


if __name__ == "__main__":
    main()
