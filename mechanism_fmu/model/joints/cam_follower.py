"""A cam against a follower with a profile of its own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ... import codes
from ..body import Point
from ..curves import Curve
from ..functions import Number
from .profile_contact import ProfileContact


@dataclass(frozen=True)
class CamFollower(ProfileContact):
    """Two profiles touch each other (ME451, cam-follower).

    1. Allows: the profiles roll and slide on each other; two degrees of freedom remain of three.
    2. Phi = (r_i^C - r_j^C, (R g_i).g_j), three rows [m, m, m2], with r^C = r + A (s + rho(alpha) e(alpha)) the point
       of contact and g = A (rho' e + rho R e) along the profile; alpha_i and alpha_j are coordinates without mass.
    3. Phi_q = [1, R p_i, -1, -R p_j, g_i, -g_j] and [0, -g_i.g_j, 0, g_i.g_j, (R h_i).g_j, (R g_i).h_j] with
       p = r^C - r and h the derivative of g with respect to alpha.
    4. nu = 0.
    5. gamma = -(p_i'' - p_j'') and -((R g_i'').g_j + 2 (R g_i').g_j' + (R g_i).g_j''), all without accelerations; the
       last needs rho'''.

    Traps: the rows do not know the inside of a profile, so that both bodies may come to lie on the same side: the start
    guess decides.

    Attributes:
        name: unique within the mechanism.
        body_i, body_j: names of cam and follower (or `GROUND`).
        profile_i, profile_j: rho [m] over alpha [rad], about each profile's centre.
        centre_i, centre_j: s, the centres in the frame of each body [m].
        unilateral, restitution, closed, enabled: as of `ProfileContact`.
    """

    kind: ClassVar[int] = codes.CAM_FOLLOWER
    rows: ClassVar[int] = 3
    alphas: ClassVar[int] = 2

    name: str
    body_i: str
    profile_i: Curve
    body_j: str
    profile_j: Curve
    centre_i: Point = (0.0, 0.0)
    centre_j: Point = (0.0, 0.0)
    unilateral: Number = False
    restitution: Number = 0.0
    closed: Number = True
    enabled: Number = True

    @property
    def profiles(self) -> tuple[Curve | None, Curve | None]:
        """The profiles of body i and body j."""
        return self.profile_i, self.profile_j

    def data(self) -> tuple[Number, ...]:
        """The contact's row of the table `contact_data`: centre_i, centre_j."""
        return (*self.centre_i, *self.centre_j)
