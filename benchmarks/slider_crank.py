"""The slider-crank in closed form: kinematics, and the motion of its one degree of freedom.

Independent of the library. With the crank r, the rod l and the offset e, and the crank's angle theta:

    phi = arcsin((e - r sin(theta))/l)       x = r cos(theta) + sqrt(l^2 - (e - r sin(theta))^2)

    python -m benchmarks.slider_crank > models/slider_crank/reference.csv
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from .eksergian import Course, Link, motion


class SliderCrank(NamedTuple):
    """Lengths [m], masses [kg], inertias about the centre of mass [kg m2]; the defaults are those of the model."""

    crank: float = 0.05
    rod: float = 0.2
    offset: float = 0.0
    crank_mass: float = 1.0
    crank_inertia: float = 2e-3
    crank_centre: float = 0.0
    rod_mass: float = 0.5
    rod_inertia: float = 2e-3
    rod_centre: float = 0.06
    slider_mass: float = 0.8

    def rod_angle(self, theta: float) -> Course:
        """Angle of the rod [rad]."""
        s, c = math.sin(theta), math.cos(theta)
        phi = math.asin((self.offset - self.crank * s) / self.rod)
        along = self.rod * math.cos(phi)
        rate = -self.crank * c / along
        return Course(phi, rate, (self.crank * s + self.rod * math.sin(phi) * rate**2) / along)

    def slider(self, theta: float) -> Course:
        """Position of the slider along its line [m]."""
        r, s, c = self.crank, math.sin(theta), math.cos(theta)
        # x = r c + w with w^2 = l^2 - u^2, u = e - r s: w w' = -u u', w'^2 + w w'' = -u'^2 - u u''
        u, u1, u2 = self.offset - r * s, -r * c, r * s
        w = math.sqrt(self.rod**2 - u**2)
        w1 = -u * u1 / w
        w2 = -(u1**2 + u * u2 + w1**2) / w
        return Course(r * c + w, -r * s + w1, -r * c + w2)

    def links(self, theta: float) -> tuple[Link, Link, Link]:
        """Crank, rod and slider."""
        phi, x = self.rod_angle(theta), self.slider(theta)
        outwards, along = cmath.exp(1j * theta), cmath.exp(1j * phi.value)
        on_crank, pin, on_rod = self.crank_centre * outwards, self.crank * outwards, self.rod_centre * along
        rod_centre = (
            pin + on_rod,
            1j * (pin + on_rod * phi.rate),
            -pin + on_rod * (1j * phi.curvature - phi.rate**2),
        )
        return (
            Link(self.crank_mass, self.crank_inertia, Course(theta, 1, 0), (on_crank, 1j * on_crank, -on_crank)),
            Link(self.rod_mass, self.rod_inertia, phi, rod_centre),
            Link(
                self.slider_mass, 0.0, Course(0, 0, 0), (complex(x.value, self.offset), x.rate + 0j, x.curvature + 0j)
            ),
        )


#: Of the reference curve: speed at the start and of the shaft's driven end [rad/s], damping of the shaft [N m s/rad],
#: length [s] and number of rows.
SPEED, DAMPING, LENGTH, ROWS = 2 * math.pi, 0.1, 2.0, 400


def curve() -> Iterator[tuple[float, ...]]:
    """Rows of the reference: the default run, with the columns that `main` names."""
    linkage = SliderCrank()
    times = np.linspace(0.0, LENGTH, ROWS + 1)
    motions = motion(linkage.links, lambda _theta, speed: DAMPING * (SPEED - speed), 0.0, SPEED, times.tolist())
    for time, theta, speed in zip(times, *motions, strict=True):
        phi, x = linkage.rod_angle(theta), linkage.slider(theta)
        yield time, theta, phi.value, x.value, speed, phi.rate * speed, x.rate * speed


def main() -> None:
    """Print the reference curve as CSV."""
    print("time,crank_angle,rod_angle,slider_position,crank_speed,rod_speed,slider_velocity")
    for row in curve():
        print(",".join(f"{number:.15g}" for number in row))


if __name__ == "__main__":
    main()
