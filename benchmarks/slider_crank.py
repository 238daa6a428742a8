"""The slider-crank in closed form: kinematics, and the motion of its one degree of freedom.

Independent of the library. With the crank r, the rod l and the offset e, and the crank's angle theta:

    phi = arcsin((e - r sin(theta))/l)       x = r cos(theta) + sqrt(l^2 - (e - r sin(theta))^2)

    python -m benchmarks.slider_crank > models/slider_crank/reference.csv
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from .curve_file import print_curve
from .eksergian import Course, Link, along, default_run


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
        own = Course(theta, 1.0, 0.0)
        return (
            Link(self.crank_mass, self.crank_inertia, own, along(self.crank_centre, own)),
            Link(self.rod_mass, self.rod_inertia, phi, along(self.rod_centre, phi, along(self.crank, own))),
            Link(
                self.slider_mass, 0.0, Course(0, 0, 0), (complex(x.value, self.offset), x.rate + 0j, x.curvature + 0j)
            ),
        )


def curve() -> Iterator[tuple[float, ...]]:
    """Rows of the reference: the default run, with the columns that `main` names."""
    linkage = SliderCrank()
    for time, theta, speed in default_run(linkage.links):
        phi, x = linkage.rod_angle(theta), linkage.slider(theta)
        yield time, theta, phi.value, x.value, speed, phi.rate * speed, x.rate * speed


def main() -> None:
    """Print the reference curve as CSV."""
    print_curve("time,crank_angle,rod_angle,slider_position,crank_speed,rod_speed,slider_velocity", curve())


if __name__ == "__main__":
    main()
