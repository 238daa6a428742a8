"""Terminals of an FMU: variables that belong together, as angle, speed and torque of a shaft do.

FMI 3.0, section 2.4.9 (terminalsAndIcons.xml); this project writes the same file into FMUs of FMI 2.0.
"""

from __future__ import annotations

import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

#: Where the file is, in both versions of the standard.
FILE = "terminalsAndIcons/terminalsAndIcons.xml"


@dataclass(frozen=True)
class Member:
    """One variable of a terminal.

    Attributes:
        name: by which it is matched with that of another terminal.
        variable: name of it.
        kind: "signal": both are equal; "inflow" or "outflow": what flows into, or out of the FMU, sums to zero.
    """

    name: str
    variable: str
    kind: str


@dataclass(frozen=True)
class Terminal:
    """Variables that belong together.

    Attributes:
        name: "<terminal>", or "<terminal>.<terminal>" of one within another one.
        rule: how members are matched; "plug": by their names, all of them.
        kind: what it is, in words of its maker's; "" where not declared.
        members: in the order of the file.
    """

    name: str
    rule: str
    kind: str
    members: tuple[Member, ...]


def read_terminals(path: Path) -> dict[str, Terminal]:
    """Terminals of the FMU file `path` by name; none where it has no such file.

    Raises:
        ValueError: the file is there, and is none.
    """
    with zipfile.ZipFile(path) as archive:
        if FILE not in archive.namelist():
            return {}
        data = archive.read(FILE)
    try:
        root = ElementTree.fromstring(data)
    except ElementTree.ParseError as error:
        raise ValueError(f"its {FILE} is no XML: {error}") from None
    return {terminal.name: terminal for parent in root.findall("Terminals") for terminal in _terminals(parent, "")}


def _terminals(parent: Element, within: str) -> Iterator[Terminal]:
    for element in parent.findall("Terminal"):
        name = within + element.get("name", "")
        members = tuple(
            Member(
                member.get("memberName", member.get("variableName", "")),
                member.get("variableName", ""),
                member.get("variableKind", "signal"),
            )
            for member in element.findall("TerminalMemberVariable")
        )
        yield Terminal(name, element.get("matchingRule", ""), element.get("terminalKind", ""), members)
        yield from _terminals(element, f"{name}.")
