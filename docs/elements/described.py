"""What a docstring says of each argument, and the unit and limit that it states: for pages and tests."""

from __future__ import annotations

import inspect
import re
from typing import Any

_HEADING = re.compile(r"(Args|Attributes|Outputs|Raises|Returns|Source|Yields):(.*)")
_ENTRY = re.compile(r"\*{0,2}((?:\w+, )*\w+): (.*)")
_UNIT = re.compile(r"\[([^\]]*)\]")
_LIMIT = re.compile(r"(>= 0|> 0|0\.\.1)")


def sections(docstring: str | None) -> dict[str, list[str]]:
    """The lines below each heading of a docstring, without indentation; of Outputs also behind it."""
    found: dict[str, list[str]] = {}
    lines: list[str] = []
    for line in inspect.cleandoc(docstring or "").splitlines():
        heading = _HEADING.fullmatch(line)
        if heading:
            lines = found.setdefault(heading[1], [heading[2].strip()])
        elif line.startswith("    "):
            lines.append(line[4:])
        elif line:
            lines = []
    return found


def entries(lines: list[str]) -> dict[str, str]:
    """What is said of each name; several in one line share it."""
    found: dict[str, str] = {}
    names: list[str] = []
    for line in lines:
        entry = _ENTRY.fullmatch(line)
        if entry:
            names = entry[1].split(", ")
            found.update(dict.fromkeys(names, entry[2]))
        else:
            found.update({name: f"{found[name]} {line.strip()}" for name in names})
    return found


def arguments(thing: Any) -> dict[str, str]:
    """What the docstring of a class or function says of its arguments, by name."""
    said = sections(thing.__doc__)
    found = entries(said.get("Attributes", [])) | entries(said.get("Args", []))
    if inspect.isclass(thing):
        found |= entries(sections(thing.__init__.__doc__).get("Args", []))
    return found


def unit(text: str) -> str | None:
    """The unit in brackets, as FMI writes it, or None."""
    found = _UNIT.search(text)
    if found is None or " or " in found[1]:
        return None if found is None else found[1]
    return found[1].replace(" ", ".")


def limit(text: str) -> str:
    """The limit that a text states: ">= 0", "> 0", "0..1", or none."""
    found = _LIMIT.search(text)
    return found[1] if found else ""


def meaning(text: str) -> str:
    """A text without its unit and limit."""
    plain = _UNIT.sub("", text, count=1)
    plain = re.sub(r",?\s*(>= 0|> 0|0\.\.1)(?=[\s,.;:]|$)", "", plain)
    return re.sub(r"\s+([,.;:])", r"\1", " ".join(plain.split())).strip(" .,;:")
