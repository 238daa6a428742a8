"""Two terminals as connections: one for each of their members."""

from __future__ import annotations

from collections.abc import Mapping

from ..description import Description, Variable
from ..errors import UsageError
from ..terminals import Member, Terminal
from .connection import Connection

#: The only rule by which terminals are connected here.
_PLUG = "plug"
#: Whose derivative is whose.
_RATES = {"angle": "speed", "position": "velocity"}
#: What an offset is added to.
SHIFTED = tuple(_RATES)


def plugged(first: Terminal, second: Terminal, description: Description, offset: float = 0.0) -> list[Connection]:
    """The connections of two terminals of a machine; which end of each follows the other, its causality says.

    Signals become equal; what flows into both of them (a torque) sums to zero, so that it is turned round.

    Args:
        first: terminal, with the names that its variables have in the machine.
        second: the other one, likewise.
        description: of the machine.
        offset: added to the angle, or the position, where it goes in, in the unit of that input.

    Raises:
        UsageError: they do not fit; the message says why.
    """
    where = f"Connection from '{first.name}' to '{second.name}'"
    for terminal in (first, second):
        if terminal.rule != _PLUG:
            raise UsageError(
                f"{where}: the terminal '{terminal.name}' is matched by the rule '{terminal.rule}'; only '{_PLUG}' "
                "can be connected as a whole. Connect its variables one by one."
            )
    ours, theirs = ({member.name: member for member in terminal.members} for terminal in (first, second))
    if ours.keys() != theirs.keys():
        raise UsageError(
            f"{where}: '{first.name}' has the members {', '.join(ours)}, and '{second.name}' has {', '.join(theirs)}; "
            "a plug needs the same ones. Connect variables one by one."
        )
    if offset and not any(name in SHIFTED for name in ours):
        raise UsageError(f"{where}: an offset is added to a member {' or '.join(SHIFTED)}, and there is none.")
    found = []
    for name, member in ours.items():
        source, target = _ends(where, member, theirs[name], description)
        side = ours if source is member else theirs
        found.append(
            Connection(
                source.variable,
                target.variable,
                gain=-1.0 if member.kind == theirs[name].kind != "signal" else 1.0,
                offset=offset if name in SHIFTED else 0.0,
                rate=_rate(name, side, description),
            )
        )
    return found


def _ends(where: str, first: Member, second: Member, description: Description) -> tuple[Member, Member]:
    """The member that is followed, and the one that follows."""
    variables = [_variable(where, member, description) for member in (first, second)]
    if (first.kind == "signal") is not (second.kind == "signal"):
        raise UsageError(f"{where}: the member {first.name} is of kind {first.kind} there, and {second.kind} here.")
    sides = tuple(variable.causality for variable in variables)
    if sides == ("output", "input"):
        return first, second
    if sides == ("input", "output"):
        return second, first
    raise UsageError(
        f"{where}: of the member {first.name}, {first.variable} is of causality {sides[0]} and {second.variable} of "
        f"causality {sides[1]}; one must be an output and the other an input."
    )


def _variable(where: str, member: Member, description: Description) -> Variable:
    if member.variable not in description.variables:
        raise UsageError(f"{where}: the terminal names '{member.variable}', which the FMU does not have.")
    return description.variables[member.variable]


def _rate(name: str, side: Mapping[str, Member], description: Description) -> str:
    """The output beside a member that is its derivative; "" where there is none."""
    rate = side.get(_RATES.get(name, ""))
    if rate is None or rate.variable not in description.variables:
        return ""
    return rate.variable if description.variables[rate.variable].causality == "output" else ""
