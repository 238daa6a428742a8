"""Higher pairs: joints by the textbook, and contacts in the motion."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import ClassVar

from ... import codes
from ..attached import Slot
from ..body import Point
from ..contact_facts import ContactFacts
from ..curves import Curve
from ..findings import Finding
from ..functions import Number
from .base import no_direction, unit_vector

# What higher pairs have in common: they are joints by the textbook, and contacts in the motion.


class ProfileContact(ContactFacts):
    """A contact in which at least one of the bodies has a profile.

    Not a record itself, so that the fields of each pair keep their order: its bodies, what they touch with, then these.

    Attributes:
        unilateral: whether the contact only pushes, and opens; otherwise it holds, as a groove does.
        restitution: e of eq (4), 0..1, of a unilateral contact.
        closed: whether assembly puts the profiles in contact.
        enabled: whether the contact exists; a number, so that a parameter can switch it off.
        friction: Coulomb coefficient along the common tangent [1], >= 0.
        friction_static: the same while it sticks [1], at least as large; None: as large.
    """

    holds: ClassVar = "unilateral"
    closed_while: ClassVar[str | None] = None

    unilateral: Number
    restitution: Number
    closed: Number
    enabled: Number

    @property
    def guided(self) -> Number:
        """Whether the contact, once closed, also pulls and never opens."""
        return 1 - self.unilateral


# A cam against a follower with a profile of its own.


@dataclass(frozen=True, init=False)
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
        unilateral, restitution, closed, enabled, friction, friction_static: as of `ProfileContact`.
    """

    kind: ClassVar[int] = codes.CAM_FOLLOWER
    rows: ClassVar[int] = 3
    alphas: ClassVar[int] = 2
    slots: ClassVar = (Slot("body_i", "centre_i"), Slot("body_j", "centre_j"))

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
    friction: Number = 0.0
    friction_static: Number | None = field(default=None, kw_only=True)

    def data(self) -> tuple[Number, ...]:
        """The contact's row of the table `contact_data`: centre_i, centre_j."""
        return (*self.centre_i, *self.centre_j)


# A cam against a follower with a flat face.


@dataclass(frozen=True, init=False)
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
        unilateral, restitution, closed, enabled, friction, friction_static: as of `ProfileContact`.
    """

    kind: ClassVar[int] = codes.CAM_FLAT_FOLLOWER
    rows: ClassVar[int] = 2
    alphas: ClassVar[int] = 1
    slots: ClassVar = (Slot("body_i", "centre_i"), Slot("body_j", "point_j", "direction_j"))

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
    friction: Number = 0.0
    friction_static: Number | None = field(default=None, kw_only=True)

    def data(self) -> tuple[Number, ...]:
        """The contact's row of the table `contact_data`: centre_i, point_j, u_j."""
        return (*self.centre_i, *self.point_j, *unit_vector(self.direction_j))

    def shape_findings(self) -> Iterator[Finding]:
        """That the face has no direction."""
        yield no_direction(f"{self.label}: direction_j", self.direction_j)


# A point on a profile, as a pin in a curved slot.


@dataclass(frozen=True, init=False)
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
        unilateral, restitution, closed, enabled, friction, friction_static: as of `ProfileContact`.
    """

    kind: ClassVar[int] = codes.POINT_FOLLOWER
    rows: ClassVar[int] = 2
    alphas: ClassVar[int] = 1
    slots: ClassVar = (Slot("body_i", "point_i"), Slot("body_j", "centre_j"))

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
    friction: Number = 0.0
    friction_static: Number | None = field(default=None, kw_only=True)

    def data(self) -> tuple[Number, ...]:
        """The contact's row of the table `contact_data`: point_i, centre_j."""
        return (*self.point_i, *self.centre_j)
