"""The four-bar path generator of Erdman, Sandor and Oakberg (1972) with elastic members (inch, lbf, s)."""

from __future__ import annotations

import math
from collections.abc import Sequence

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Disk,
    Mechanism,
    Member,
    Output,
    Revolute,
    Section,
    polynomial_motion,
)

#: Lengths, angle of the arm, modulus, weight density, gravity as the oracle has it, speed.
GROUND_LENGTH, CRANK, COUPLER, FOLLOWER, ARM, TILT = 10.0, 4.0, 10.0, 8.0, 6.0, math.pi / 6
YOUNG, GRAVITY = 30e6, 9.80665 / 0.0254
DENSITY = 0.283 / GRAVITY
SPEED = 500 * 2 * math.pi / 60
SECTION = Section.rectangle(0.25, 0.5)
#: The guesses that assembly closes, at 30 deg.
COUPLER_ANGLE, FOLLOWER_ANGLE = 0.62, 1.37


def path_generator(outputs: Sequence[Output] = (), start: float = math.radians(30), speed: float = SPEED) -> Mechanism:
    """The linkage, its crank driven at a constant speed [rad/s] from an angle [rad] near 30 deg on."""
    point = (ARM * math.cos(TILT), ARM * math.sin(TILT))
    x, y = CRANK * math.cos(start), CRANK * math.sin(start)
    hinge = (GROUND_LENGTH, 0.0)
    return Mechanism(
        bodies=(
            Body("crank", 1.0, 1.0, (x / 2, y / 2, start), (-y / 2 * speed, x / 2 * speed, speed)),
            Body("coupler", 1.0, 1.0, (x, y, COUPLER_ANGLE)),
            Body("follower", 1.0, 1.0, (*hinge, FOLLOWER_ANGLE)),
        ),
        joints=(
            Revolute("crank_hinge", "crank", (-CRANK / 2, 0.0), GROUND, (0.0, 0.0)),
            Revolute("A", "coupler", (0.0, 0.0), "crank", (CRANK / 2, 0.0)),
            Revolute("B", "follower", (FOLLOWER, 0.0), "coupler", (COUPLER, 0.0)),
            Revolute("follower_hinge", "follower", (0.0, 0.0), GROUND, hinge),
            AngleDriver("drive", "crank", polynomial_motion(start, speed)),
        ),
        members=(
            _member("arm", "coupler", (0.0, 0.0), point),
            _member("crank_bar", "crank", (-CRANK / 2, 0.0), (CRANK / 2, 0.0)),
            _member("link", "coupler", (0.0, 0.0), (COUPLER, 0.0)),
            _member("follower_bar", "follower", (0.0, 0.0), (FOLLOWER, 0.0)),
        ),
        disks=(
            Disk("P", "coupler", point, 0.5 / GRAVITY, 0.5 * 0.5 / GRAVITY * 0.75**2),
            Disk("disk_A", "coupler", (0.0, 0.0), 0.1 / GRAVITY, 0.5 * 0.1 / GRAVITY * 0.5**2),
            Disk("disk_B", "coupler", (COUPLER, 0.0), 0.1 / GRAVITY),
        ),
        outputs=tuple(outputs),
        held=("crank.angle",),
    )


def _member(name: str, body: str, start: tuple[float, float], end: tuple[float, float]) -> Member:
    return Member(name, body, start, end, SECTION, YOUNG, DENSITY)
