"""The four-bar path generator of Erdman, Sandor and Oakberg (1972), Fig. 3, by their Case 2, in any unit system.

Its dimensions, masses and speed are this project's: the paper's numerical example lies beyond the pages at hand.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    LumpedMass,
    Mechanism,
    Member,
    Revolute,
    Section,
    lumped_body,
)
from mechanism_fmu.model.curves.motions import polynomial_motion

INCH, POUND, POUND_FORCE = 0.0254, 0.45359237, 0.45359237 * 9.80665

_SECTION = Section.rectangle(0.25 * INCH, 0.5 * INCH)


@dataclass(frozen=True)
class PathGenerator:
    """Its numbers, in any consistent units; as they stand, of the steel one in SI.

    Attributes:
        ground, crank, coupler, follower, arm: lengths; the arm leads from the crank pin to the path point.
        angle: of the arm against the coupler [rad].
        section: of all members.
        young, density: of their material.
        disks: at the path point, at the crank pin and at the follower pin: mass and inertia.
        speed: of the crank [rad/s].
        start: angle of the crank at t = 0 [rad].
    """

    ground: float = 10 * INCH
    crank: float = 4 * INCH
    coupler: float = 10 * INCH
    follower: float = 8 * INCH
    arm: float = 6 * INCH
    angle: float = math.pi / 6
    section: Section = _SECTION
    young: float = 30e6 * POUND_FORCE / INCH**2
    density: float = 0.283 * POUND / INCH**3
    disks: tuple[tuple[float, float], ...] = (
        (0.5 * POUND, 0.5 * POUND * (0.75 * INCH) ** 2 / 2),
        (0.1 * POUND, 0.1 * POUND * (0.5 * INCH) ** 2 / 2),
        (0.1 * POUND, 0.0),
    )
    speed: float = 500 * 2 * math.pi / 60
    start: float = 0.0

    def mechanism(self) -> Mechanism:
        """With a driver of the crank; members "crank_bar", "coupler_bar", "follower_bar" of these bodies, and "arm"."""
        path, pin = (self.arm * math.cos(self.angle), self.arm * math.sin(self.angle)), (self.coupler, 0.0)
        origin = (0.0, 0.0)
        (at_path, at_crank, at_follower) = self.disks
        coupler = lumped_body(
            (self._member("arm", "coupler", path), self._member("coupler_bar", "coupler", pin)),
            (
                LumpedMass("path_disk", "coupler", path, *at_path),
                LumpedMass("crank_disk", "coupler", origin, *at_crank),
                LumpedMass("follower_disk", "coupler", pin, *at_follower),
            ),
        )
        crank = lumped_body((self._member("crank_bar", "crank", (self.crank, 0.0)),))
        follower = lumped_body((self._member("follower_bar", "follower", (self.follower, 0.0)),))
        parts = {"crank": crank, "coupler": coupler, "follower": follower}
        on_coupler, on_follower = self._angles()
        angles = {"crank": self.start, "coupler": on_coupler, "follower": on_follower}
        at = {"crank": origin, "coupler": _along(self.crank, self.start), "follower": (self.ground, 0.0)}

        def point(body: str, x: float = 0.0) -> tuple[float, float]:
            return x - parts[body].centre[0], -parts[body].centre[1]

        bodies = []
        for name, part in parts.items():
            c, s = math.cos(angles[name]), math.sin(angles[name])
            x, y = part.centre
            place = at[name][0] + c * x - s * y, at[name][1] + s * x + c * y
            bodies.append(Body(name, part.mass, part.inertia, (*place, angles[name])))
        return Mechanism(
            bodies=tuple(bodies),
            joints=(
                Revolute("crank_hinge", "crank", point("crank"), GROUND, origin),
                Revolute("crank_pin", "coupler", point("coupler"), "crank", point("crank", self.crank)),
                Revolute(
                    "follower_pin",
                    "follower",
                    point("follower", self.follower),
                    "coupler",
                    point("coupler", self.coupler),
                ),
                Revolute("follower_hinge", "follower", point("follower"), GROUND, (self.ground, 0.0)),
                AngleDriver("drive", "crank", polynomial_motion(self.start, self.speed)),
            ),
            members=(coupler.members[0], *crank.members, coupler.members[1], *follower.members),
            lumped_masses=coupler.lumped_masses,
        )

    def _member(self, name: str, body: str, end: tuple[float, float]) -> Member:
        return Member(name, body, (0.0, 0.0), end, self.section, self.young, self.density)

    def _angles(self) -> tuple[float, float]:
        """Angles of coupler and follower at the start [rad], open branch."""
        x, y = self.ground - self.crank * math.cos(self.start), -self.crank * math.sin(self.start)
        diagonal = math.hypot(x, y)
        cosine = (self.coupler**2 + diagonal**2 - self.follower**2) / (2 * self.coupler * diagonal)
        coupler = math.atan2(y, x) + math.acos(cosine)
        end = self.coupler * math.cos(coupler) - x, self.coupler * math.sin(coupler) - y
        return coupler, math.atan2(end[1], end[0])


def _along(distance: float, angle: float) -> tuple[float, float]:
    return distance * math.cos(angle), distance * math.sin(angle)
