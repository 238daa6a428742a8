"""The four-bar linkage in closed form: kinematics by Freudenstein's equation, and the motion of its one freedom.

Independent of the library. With the ground d, crank a, coupler b, rocker c and k1 = d/a, k2 = d/c,
k3 = (a^2 - b^2 + c^2 + d^2)/(2 a c), the rocker's angle psi solves

    k1 cos(psi) - k2 cos(theta) + k3 = cos(theta - psi)      F. Freudenstein, Trans. ASME 77, 1955

which is quadratic in tan(psi/2); the rates come from the loop a e^(i theta) + b e^(i phi) = d + c e^(i psi).

    python -m benchmarks.four_bar > models/four_bar/reference.csv
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from typing import NamedTuple

from .curve_file import print_curve
from .eksergian import Course, Link, along, default_run


class FourBar(NamedTuple):
    """Lengths [m], masses [kg], inertias about the centre of mass [kg m2]; the defaults are those of the model."""

    ground: float = 0.2
    crank: float = 0.05
    coupler: float = 0.18
    rocker: float = 0.12
    crossed: bool = False
    crank_mass: float = 0.2
    crank_inertia: float = 1e-3
    crank_centre: float = 0.025
    coupler_mass: float = 0.5
    coupler_inertia: float = 1.35e-3
    coupler_centre: float = 0.09
    rocker_mass: float = 0.4
    rocker_inertia: float = 4.8e-4
    rocker_centre: float = 0.06

    def angles(self, theta: float) -> tuple[Course, Course]:
        """Coupler and rocker angle [rad], each in -pi..pi."""
        d, a, b, c = self[:4]
        cosine, sine = math.cos(theta), math.sin(theta)
        k1, k2, k3 = d / a, d / c, (a * a - b * b + c * c + d * d) / (2 * a * c)
        # A t^2 + B t + C = 0 for t = tan(psi/2)
        A, B, C = cosine - k1 - k2 * cosine + k3, -2 * sine, k1 - (k2 + 1) * cosine + k3
        root = math.sqrt(B * B - 4 * A * C) * (1 if self.crossed else -1)
        psi = 2 * math.atan2(-B + root, 2 * A)
        crank, rocker = a * cmath.exp(1j * theta), c * cmath.exp(1j * psi)
        coupler = d + rocker - crank
        # The loop, differentiated once and twice.
        phi1, psi1 = _solve(coupler, rocker, -1j * crank)
        phi2, psi2 = _solve(coupler, rocker, crank + coupler * phi1**2 - rocker * psi1**2)
        return Course(cmath.phase(coupler), phi1, phi2), Course(math.remainder(psi, 2 * math.pi), psi1, psi2)

    def links(self, theta: float) -> tuple[Link, Link, Link]:
        """Crank, coupler and rocker."""
        phi, psi = self.angles(theta)
        own = Course(theta, 1.0, 0.0)
        coupler = along(self.coupler_centre, phi, along(self.crank, own))
        rocker = along(self.rocker_centre, psi, (self.ground, 0.0, 0.0))
        return (
            Link(self.crank_mass, self.crank_inertia, own, along(self.crank_centre, own)),
            Link(self.coupler_mass, self.coupler_inertia, phi, coupler),
            Link(self.rocker_mass, self.rocker_inertia, psi, rocker),
        )


def _solve(coupler: complex, rocker: complex, right: complex) -> tuple[float, float]:
    """The real (p, q) with i coupler p - i rocker q = right."""
    determinant = (coupler.conjugate() * rocker).imag
    u = -1j * right
    return -(rocker.conjugate() * u).imag / determinant, -(coupler.conjugate() * u).imag / determinant


def curve() -> Iterator[tuple[float, ...]]:
    """Rows of the reference: the default run, with the columns that `main` names."""
    linkage = FourBar()
    for time, theta, speed in default_run(linkage.links):
        phi, psi = linkage.angles(theta)
        yield time, theta, phi.value, psi.value, speed, phi.rate * speed, psi.rate * speed


def main() -> None:
    """Print the reference curve as CSV."""
    print_curve("time,crank_angle,coupler_angle,rocker_angle,crank_speed,coupler_speed,rocker_speed", curve())


if __name__ == "__main__":
    main()
