"""Contacts."""

from __future__ import annotations

from dataclasses import dataclass

from .body import Point
from .functions import Number


@dataclass(frozen=True)
class PointLineContact:
    """A point of one body against a straight line fixed in another (Pennestrì et al., Fig. 1).

    The gap is s = normal . (A_j^T (r_i^P - r_j) - line_point), positive when open. A contact that is closed is a
    constraint row like a joint's ("guided": it pushes and pulls, as in the paper); one that is open is watched, and
    s = 0 is an impact by eq (7). With `restitution` = 0 the contact stays closed after the impact; with more, the
    point comes back until its closing speed falls below the engine's stick speed.

    Attributes:
        name: unique within the mechanism.
        body_i: the body that carries the point; point_i: the point in its frame [m].
        body_j: the body that carries the line; line_point: a point of the line in its frame [m].
        normal: unit normal of the line in the frame of `body_j`, towards the open side.
        closed: whether the contact is closed at the start.
        restitution: e of eq (4), 0..1.
        beam_length: length l of the struck tooth as a beam [m]; the impact velocity of the stress recovery is
            v_I = l * (rate of `body_j` after the impact).
        tooth: index of the tooth that the line belongs to.
    """

    name: str
    body_i: str
    point_i: Point
    body_j: str
    line_point: Point
    normal: Point
    closed: bool = False
    restitution: Number = 0.0
    beam_length: Number = 0.0
    tooth: int = 0

    def data(self) -> tuple[Number, ...]:
        """The contact's row of the table `contact_data`: point_i, line_point, normal."""
        return (*self.point_i, *self.line_point, *self.normal)
