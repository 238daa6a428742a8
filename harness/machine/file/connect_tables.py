"""Connections and power bonds of a machine's file: the tables [[connect]] and [[bond]], and terminals."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from ...errors import UsageError
from ...fmu.description import Description, Variable
from ...fmu.terminals import Member, Terminal
from ...toml_file import Section, TomlFile, as_text, parsed
from ..connection import Connection, linked, own_of, part_of
from .machine_plan import BondPlan

# Two terminals as connections: one for each of their members.

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


def connections(
    file: TomlFile, description: Description, known: Collection[str], names: Collection[str]
) -> list[Connection]:
    """All connections; mistakes are noted.

    Args:
        file: of the machine.
        description: of the machine, of those components that could be described.
        known: names of these components.
        names: of all components.
    """
    found: list[Connection] = []
    first: dict[str, Section] = {}
    for section in file.sections("connect"):
        for connection in _connections(section, description):
            if connection.target in first:
                earlier = first[connection.target].key[-1]
                section.wrong("to", f"'{connection.target}' has a connection already, {earlier}; an input can have one")
            first.setdefault(connection.target, section)
            if _checked(section, connection, description, known, names):
                found.append(connection)
    return found


def _connections(section: Section, description: Description) -> list[Connection]:
    """What a table says: a connection, or those of two terminals."""
    source = section.text("from", needed='write the output that is followed, as in from = "motor.speed"')
    target = section.text("to", needed='write the input that follows, as in to = "gears.drive_speed"')
    ends = [end for end in (source, target) if end in description.terminals and end not in description.variables]
    if source is not None and target is not None and ends:
        return _plugged(section, source, target, description)
    gain = section.number("gain", 1.0)
    rate = section.text("rate") or ""
    convert = section.flag("convert")
    offset = _offset(section, description.variables.get(target or ""), description)
    section.done()
    if source is None or target is None or gain is None or offset is None:
        return []
    return [Connection(source, target, gain, offset, rate, convert)]


def _plugged(section: Section, source: str, target: str, description: Description) -> list[Connection]:
    """The connections of two terminals."""
    for key in ("gain", "rate", "convert"):
        if section.take(key) is not None:
            section.wrong(key, "goes with a connection of variables, not of terminals: these say it themselves")
    terminals = [description.terminals.get(end) for end in (source, target)]
    for key, end, terminal in zip(("from", "to"), (source, target), terminals, strict=True):
        if terminal is None:
            there = ", ".join(description.terminals)
            section.wrong(key, f"'{end}' is no terminal, as the other end is; there are: {there}")
    angle = None
    for terminal in terminals:
        for member in () if terminal is None else terminal.members:
            variable = description.variables.get(member.variable)
            if member.name in SHIFTED and variable is not None and variable.causality == "input":
                angle = variable
    offset = _offset(section, angle, description)
    section.done()
    if offset is None or terminals[0] is None or terminals[1] is None:
        return []
    try:
        return plugged(terminals[0], terminals[1], description, offset)
    except UsageError as error:
        section.wrong("from", str(error))
        return []


def _offset(section: Section, target: Variable | None, description: Description) -> float | None:
    """The offset, in the unit of the variable that it is added to; None if it is wrong."""
    given = section.take("offset")
    if given is None:
        return 0.0
    if target is None:
        return 0.0  # what is wrong with the target is reported elsewhere
    unit = Variable("offset", -1, "Real", "input", unit=target.unit)
    value = parsed(section, "offset", as_text(given), unit, description)
    return None if value is None else float(value)


def _checked(
    section: Section,
    connection: Connection,
    description: Description,
    known: Collection[str],
    names: Collection[str],
) -> bool:
    """Whether a connection can be; if components are there that are not described, it is unknown, and it cannot."""
    ends = {"from": connection.source, "to": connection.target, "rate": connection.rate}
    sound = True
    for key, end in ends.items():
        if end and part_of(end) not in names:
            section.wrong(key, f"'{end}' is none of <component>.<variable>; components: {', '.join(names)}")
            sound = False
        elif end and part_of(end) in known and end not in description.variables:
            section.wrong(key, no_variable(end, description))
            sound = False
        elif end and part_of(end) not in known:
            sound = False
    if not sound:
        return False
    try:
        linked(connection, description)
    except UsageError as error:
        section.wrong("from", str(error))
        return False
    return True


def no_variable(name: str, description: Description) -> str:
    """That a component has no such variable, with those most like it."""
    part, _, own = name.partition(".")
    of_part = {own_of(v.name): v for v in description.variables.values() if part_of(v.name) == part}
    try:
        Description(part, "", "", of_part).variable(own)
    except UsageError as error:
        return str(error)
    return ""


def bonds(file: TomlFile, connected: Sequence[Connection], complete: bool) -> list[BondPlan]:
    """All power bonds; each names two connected inputs.

    Args:
        file: of the machine.
        connected: the connections that can be.
        complete: whether these are all that the file has.
    """
    by_target: Mapping[str, Connection] = {connection.target: connection for connection in connected}
    found: list[BondPlan] = []
    for section in file.sections("bond"):
        name = section.text("name")
        ends = [
            _bonded(section, key, by_target, complete, needed)
            for key, needed in (
                ("flow", 'write the input that the speed goes to, as in flow = "gears.drive_speed"'),
                ("effort", 'write the input that the torque goes to, as in effort = "motor.load_torque"'),
            )
        ]
        reaction = section.flag("reaction")
        section.done()
        flow, effort = ends
        if flow is None or effort is None:
            continue
        there, back = (flow.source, flow.target), (effort.target, effort.source)
        if [part_of(end) for end in there] != [part_of(end) for end in back]:
            section.wrong("effort", f"'{effort}' does not go back between the components of '{flow}'")
            continue
        found.append(BondPlan(name or f"{part_of(flow.source)} to {part_of(flow.target)}", flow, effort, reaction))
    for name in {bond.name for bond in found}:
        if [bond.name for bond in found].count(name) > 1:
            file.wrong(("bond",), f"two bonds have the name '{name}'; give them others by name = ")
    return found


def _bonded(
    section: Section, key: str, by_target: Mapping[str, Connection], complete: bool, needed: str
) -> Connection | None:
    name = section.text(key, needed=needed)
    if name is None or name in by_target:
        return None if name is None else by_target[name]
    if complete:
        section.wrong(key, f"'{name}' is no connected input; there are: {', '.join(by_target) or 'none'}")
    return None
