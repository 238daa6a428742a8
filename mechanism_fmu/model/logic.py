"""Logical functions: named functions of the position with the values 0 and 1 (Pennestrì et al., section 3)."""

from __future__ import annotations

from dataclasses import dataclass

from .. import codes
from .errors import MechanismError
from .functions import Number


@dataclass(frozen=True)
class LogicalFunction:
    """A function of the position that is 1 while a quantity is below a limit, and 0 while it is above.

    It closes and opens the contacts that name it in `closed_while`. The logical functions that every contact has of its
    own (touches, approaches, pushes ...) need not be declared: `mechanism_fmu.model.transitions` lists them all.

    Attributes:
        name: unique within the mechanism.
        of: "<contact>.along", the distance of the contact's point from its line's point along the line, in the
            direction in which the line was drawn (the normal turned by -90 deg); or "<body>.angle".
        below: the limit [m or rad].
    """

    name: str
    of: str
    below: Number


def resolve_function(function: LogicalFunction, contacts: dict[str, int], bodies: dict[str, int]) -> tuple[int, int]:
    """The (kind, index) of what a logical function looks at; the index is that of the contact or body.

    Raises:
        MechanismError: there is no such thing.
    """
    part, _, quantity = function.of.partition(".")
    if quantity == "along" and part in contacts:
        return codes.ALONG, contacts[part]
    if quantity == "angle" and part in bodies:
        return codes.ANGLE, bodies[part]
    choices = [*(f"{name}.along" for name in contacts), *(f"{name}.angle" for name in bodies)]
    raise MechanismError(
        f"Logical function {function.name!r} looks at {function.of!r}, which does not exist; "
        f"choose among {', '.join(choices)}."
    )


def switch(closed_while: str | None) -> tuple[str | None, bool]:
    """The function that closes a contact, and the value at which it does: ("f", True) or, of "not f", ("f", False)."""
    if closed_while is None:
        return None, True
    negated = closed_while.startswith("not ")
    return closed_while.removeprefix("not ").strip(), not negated
