"""The tables [[connect]] and [[bond]]."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from ...description import Description, Variable
from ...errors import UsageError
from ...toml_file import Section, TomlFile
from ...toml_values import as_text, parsed
from ..connection import Connection, linked
from ..names import own_of, part_of
from .plan import BondPlan


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
        connection = _connection(section, description)
        if connection is None:
            continue
        if connection.target in first:
            earlier = first[connection.target].key[-1]
            section.wrong("to", f"'{connection.target}' has a connection already, {earlier}; an input can have one")
        first.setdefault(connection.target, section)
        if _checked(section, connection, description, known, names):
            found.append(connection)
    return found


def _connection(section: Section, description: Description) -> Connection | None:
    source = section.text("from", needed='write the output that is followed, as in from = "motor.speed"')
    target = section.text("to", needed='write the input that follows, as in to = "gears.drive_speed"')
    gain = section.number("gain", 1.0)
    rate = section.text("rate") or ""
    given = section.take("offset")
    section.done()
    offset: float | None = 0.0
    if given is not None and target is not None and target in description.variables:
        unit = description.variables[target].unit
        value = parsed(
            section, "offset", as_text(given), Variable("offset", -1, "Real", "input", unit=unit), description
        )
        offset = None if value is None else float(value)
    if source is None or target is None or gain is None or offset is None:
        return None
    return Connection(source, target, gain, offset, rate)


def _checked(
    section: Section,
    connection: Connection,
    description: Description,
    known: Collection[str],
    names: Collection[str],
) -> bool:
    """Whether a connection can be; if components are there that are not described, nobody knows, and it cannot."""
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
