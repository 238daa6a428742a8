"""What higher pairs have in common: they are joints by the textbook, and contacts in the motion."""

from __future__ import annotations

from typing import ClassVar

from ..contact_facts import ContactFacts
from ..functions import Number


class ProfileContact(ContactFacts):
    """A contact in which at least one of the bodies has a profile.

    Not a record itself, so that the fields of each pair keep their order: its bodies, what they touch with, then these.

    Attributes:
        unilateral: whether the contact only pushes, and opens; otherwise it holds, as a groove does.
        restitution: e of eq (4), 0..1, of a unilateral contact.
        closed: whether assembly puts the profiles in contact.
        enabled: whether the contact exists; a number, so that a parameter can switch it off.
    """

    holds: ClassVar = "unilateral"
    friction: ClassVar[Number] = 0.0
    pattern: ClassVar[str | None] = None
    closed_while: ClassVar[str | None] = None

    unilateral: Number
    restitution: Number
    closed: Number
    enabled: Number

    @property
    def guided(self) -> Number:
        """Whether the contact, once closed, also pulls and never opens."""
        return 1 - self.unilateral
