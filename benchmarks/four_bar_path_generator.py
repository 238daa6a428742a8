"""The bending four-bar path generator in closed form: its motion, and the deflection of its path point by hand.

Independent of the library. The motion is that of one freedom (`eksergian`), with half of each link's mass at either of
its ends. The deflection delta = B^T F B P of the path point is the paper's Case 2, whose transfer matrix B is written
out, with the misprint of its sixth column put right (a moment on the coupler loads crank and rocker, too); P are the
inertia forces of path point, crank pin and rocker pin.

Source: A. G. Erdman, G. N. Sandor, R. G. Oakberg, J. Engineering for Industry 94 (1972), eqs (10) to (13).

    python -m benchmarks.four_bar_path_generator > models/four_bar_path_generator/reference.csv
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from .curve_file import print_curve
from .eksergian import Course, Link, Point, along, motion
from .four_bar import FourBar

FloatArray = npt.NDArray[np.float64]

_INCH, _POUND = 0.0254, 0.45359237
#: Lengths [m]; angle of the arm [rad]; width and depth of all sections [m].
GROUND, CRANK, COUPLER, ROCKER, ARM = (inches * _INCH for inches in (10.0, 4.0, 10.0, 8.0, 6.0))
TILT, WIDTH, DEPTH = math.radians(30), 0.25 * _INCH, 0.5 * _INCH
#: Modulus of elasticity [Pa] and density [kg/m3]; disks at path point, crank pin and rocker pin: mass, inertia.
YOUNG, DENSITY = 30e6 * _POUND * 9.80665 / _INCH**2, 0.283 * _POUND / _INCH**3
DISKS = (
    (0.5 * _POUND, 0.5 * _POUND * (0.75 * _INCH) ** 2 / 2),
    (0.1 * _POUND, 0.1 * _POUND * (0.5 * _INCH) ** 2 / 2),
    (0.1 * _POUND, 0.0),
)
#: Crank at the start [rad], its speed and that of the shaft's driven end [rad/s], and damping of the shaft.
START, SPEED, DAMPING = math.radians(30), 500 * math.pi / 30, 100.0
#: Length of the run [s], and steps.
LENGTH, STEPS = 0.24, 480

_LINKAGE = FourBar(ground=GROUND, crank=CRANK, coupler=COUPLER, rocker=ROCKER)


def half(length: float) -> float:
    """Half of the mass of a link [kg]."""
    return DENSITY * WIDTH * DEPTH * length / 2


def points(theta: float) -> tuple[Course, Point, Point, Point]:
    """The coupler's angle, path point, crank pin and rocker pin, with two derivatives by the crank's angle."""
    phi, _ = _LINKAGE.angles(theta)
    pin = along(CRANK, Course(theta, 1.0, 0.0))
    return phi, along(ARM, phi._replace(value=phi.value + TILT), pin), pin, along(COUPLER, phi, pin)


def lumps(theta: float) -> tuple[Link, Link, Link]:
    """The masses at path point, crank pin and rocker pin, with what turns as the coupler does."""
    phi, *places = points(theta)
    on = half(ARM), half(ARM) + half(CRANK) + half(COUPLER), half(COUPLER) + half(ROCKER)
    path, pin, far = (
        Link(disk[0] + mass, disk[1], phi, place) for disk, mass, place in zip(DISKS, on, places, strict=True)
    )
    return path, pin, far


def deflection(theta: float, speed: float, acceleration: float) -> tuple[float, float]:
    """By how much the path point gives way, in x and y [m]: delta = B^T F B P."""
    loads: list[float] = []
    for link in lumps(theta):
        force = -link.mass * (link.centre[1] * acceleration + link.centre[2] * speed**2)
        moment = -link.inertia * (link.angle.rate * acceleration + link.angle.curvature * speed**2)
        loads += [force.real, force.imag, moment]
    transfer = _transfer(theta)
    bent = transfer.T @ (_flexibility() @ (transfer @ np.array(loads[:8])))
    return float(bent[0]), float(bent[1])


def _flexibility() -> FloatArray:
    """Of the elements in the order of the paper, shape (8, 8): arm, crank, coupler, rocker."""
    ea, ei = YOUNG * WIDTH * DEPTH, YOUNG * WIDTH * DEPTH**3 / 12
    arm, crank = [ARM / ea, ARM**3 / 3 / ei, ARM / ei], [CRANK / ea, CRANK**3 / 3 / ei]
    flexibility = np.diag([*arm, *crank, COUPLER / 3 / ei, COUPLER / ea, ROCKER / ea])
    flexibility[1, 2] = flexibility[2, 1] = ARM**2 / 2 / ei
    return flexibility


def _transfer(theta: float) -> FloatArray:
    """B for x, y, rotation of the path point and of the crank pin, and x, y of the rocker pin, shape (8, 8)."""
    phi, psi = (course.value for course in _LINKAGE.angles(theta))
    x, y = (cmath.rect(1.0, phi + TILT).real, cmath.rect(1.0, phi + TILT).imag)
    moment = np.array([-ARM * y, ARM * x, 1.0])
    rocker = moment / (COUPLER * math.sin(psi - phi))
    transfer = np.zeros((8, 8))
    transfer[:, :3] = np.vstack(
        [
            (x, y, 0.0),
            (-y, x, 0.0),
            (0.0, 0.0, 1.0),
            np.array([math.cos(theta), math.sin(theta), 0.0]) - rocker * math.cos(psi - theta),
            np.array([-math.sin(theta), math.cos(theta), 0.0]) - rocker * math.sin(psi - theta),
            moment,
            -rocker * math.cos(psi - phi),
            rocker,
        ]
    )
    transfer[3:, 5] = transfer[3:, 2]
    transfer[3:5, 3:5] = [[math.cos(theta), math.sin(theta)], [-math.sin(theta), math.cos(theta)]]
    # a force on the rocker pin: along coupler and rocker
    oblique = np.linalg.inv(np.array([[math.cos(phi), math.cos(psi)], [math.sin(phi), math.sin(psi)]]))
    along_links = np.zeros((8, 2))
    along_links[3:5, 0] = [math.cos(phi - theta), math.sin(phi - theta)]
    along_links[6, 0] = along_links[7, 1] = 1.0
    transfer[:, 6:] = along_links @ oblique
    return transfer


def curve() -> Iterator[tuple[float, ...]]:
    """Rows of the reference: the default run, with the columns that `main` names."""
    times = np.linspace(0.0, LENGTH, STEPS + 1).tolist()
    for time, theta, speed in zip(times, *motion(lumps, _drive, START, SPEED, times), strict=True):
        phi, path, *_ = points(theta)
        now = lumps(theta)
        inertia = sum(link.reduced_inertia for link in now)
        rate = sum(link.reduced_inertia_rate for link in now)
        acceleration = (_drive(theta, speed) - rate * speed**2 / 2) / inertia
        x, y = deflection(theta, speed, acceleration)
        rigid = path[0]
        psi = _LINKAGE.angles(theta)[1]
        angles = theta, phi.value, psi.value, speed
        yield time, *angles, rigid.real, rigid.imag, rigid.real + x, rigid.imag + y, math.hypot(x, y)


def _drive(_theta: float, speed: float) -> float:
    return DAMPING * (SPEED - speed)


def main() -> None:
    """Print the reference curve as CSV."""
    angles = "crank_angle,coupler_angle,rocker_angle,crank_speed"
    print_curve(f"time,{angles},path_x,path_y,path_x_elastic,path_y_elastic,path_deviation", curve())


if __name__ == "__main__":
    main()
