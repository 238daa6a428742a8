"""A point on a profile, as a pin in a curved slot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ... import codes
from ..body import Point
from ..curves import Curve
from ..functions import Number
from .profile_contact import ProfileContact


@dataclass(frozen=True)
class PointFollower(ProfileContact):
    """A point of body i stays on a profile of body j (ME451, point-follower).

    1. Allows: the point slides along the profile, and body i turns; two degrees of freedom remain of three.
    2. Phi = r_i^P - r_j - A_j (s + rho(alpha) e(alpha)), two rows [m]; alpha_j is a coordinate without mass.
    3. Phi_q = [1, R a, -1, -R p, -g] with a = A_i s_i, p = A_j (s + rho e) and g = A_j (rho' e + rho R e).
    4. nu = 0.
    5. gamma = a phi_i'^2 - p phi_j'^2 + 2 phi_j' alpha' R g + alpha'^2 h, h the derivative of g with respect to alpha.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: names of the bodies with the point and with the profile (or `GROUND`).
        point_i: P in the frame of body i [m].
        profile_j: rho [m] over alpha [rad], about the profile's centre.
        centre_j: s, the centre of the profile in the frame of body j [m].
        unilateral, restitution, closed, enabled: as of `ProfileContact`.
    """

    kind: ClassVar[int] = codes.POINT_FOLLOWER
    rows: ClassVar[int] = 2
    alphas: ClassVar[int] = 1

    name: str
    body_i: str
    point_i: Point
    body_j: str
    profile_j: Curve
    centre_j: Point = (0.0, 0.0)
    unilateral: Number = False
    restitution: Number = 0.0
    closed: Number = True
    enabled: Number = True

    @property
    def profiles(self) -> tuple[Curve | None, Curve | None]:
        """None of body i, and the profile of body j."""
        return None, self.profile_j

    def data(self) -> tuple[Number, ...]:
        """The contact's row of the table `contact_data`: point_i, centre_j."""
        return (*self.point_i, *self.centre_j)
