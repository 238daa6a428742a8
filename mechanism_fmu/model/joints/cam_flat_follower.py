"""A cam against a follower with a flat face."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from ... import codes
from ..body import Point
from ..curves import Curve
from ..findings import Finding
from ..functions import Number
from .base import no_direction
from .profile_contact import ProfileContact
from .unit_vector import unit_vector


@dataclass(frozen=True)
class CamFlatFollower(ProfileContact):
    """A profile touches a straight face (ME451, cam-flat-faced follower).

    1. Allows: the profile rolls and slides on the face; two degrees of freedom remain of three.
    2. Phi = ((R u_j).(r_i^C - r_j^P), (R u_j).g_i), two rows [m, m], with r_i^C = r_i + A_i (s + rho(alpha) e(alpha))
       the point of contact and g_i = A_i (rho' e + rho R e) along the profile; alpha_i is a coordinate without mass.
    3. Phi_q = [n, n.R p, -n, -u.d - n.R b, n.g] and [0, u.g, 0, -u.g, n.h] with u = A_j u_j, n = R u, p = r_i^C - r_i,
       b = A_j s_j, d = r_i^C - r_j^P, and h the derivative of g with respect to alpha.
    4. nu = 0.
    5. gamma = n.d phi_j'^2 + 2 u.d' phi_j' - n.d'' and n.g phi_j'^2 + 2 u.g' phi_j' - n.g'', all without accelerations;
       the last needs rho'''.

    Traps: the rows do not know the inside of the profile, so that the face may come to lie on the far side of the cam:
    the start guess decides. Nor do they know that a face bridges a hollow of the profile.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: names of cam and follower (or `GROUND`).
        profile_i: rho [m] over alpha [rad], about the cam's centre.
        point_j: a point of the face in the frame of body j [m].
        direction_j: along the face in the frame of body j (any length > 0; u_j is its unit vector), so that R u_j,
            u_j turned by +90 deg, points from the face towards the cam.
        centre_i: s, the centre of the profile in the frame of body i [m].
        unilateral, restitution, closed, enabled: as of `ProfileContact`.
    """

    kind: ClassVar[int] = codes.CAM_FLAT_FOLLOWER
    rows: ClassVar[int] = 2
    alphas: ClassVar[int] = 1

    name: str
    body_i: str
    profile_i: Curve
    body_j: str
    point_j: Point
    direction_j: Point
    centre_i: Point = (0.0, 0.0)
    unilateral: Number = False
    restitution: Number = 0.0
    closed: Number = True
    enabled: Number = True

    @property
    def profiles(self) -> tuple[Curve | None, Curve | None]:
        """The profile of body i, and none of body j."""
        return self.profile_i, None

    def data(self) -> tuple[Number, ...]:
        """The contact's row of the table `contact_data`: centre_i, point_j, u_j."""
        return (*self.centre_i, *self.point_j, *unit_vector(self.direction_j))

    def shape_findings(self) -> Iterator[Finding]:
        """That the face has no direction."""
        yield no_direction(f"{self.label}: direction_j", self.direction_j)
