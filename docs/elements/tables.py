"""The tables of fields and outputs on the pages of force elements and contacts, from the classes themselves.

python -m docs.elements.tables      rewrites what stands between the marks of the pages, in the root of a clone
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mechanism_fmu import model

from .described import arguments, limit, meaning, unit

PAGES = Path(__file__).parent
#: A table: what it is of, the class, and its text.
TABLE = re.compile(r"(<!-- (fields|outputs) of (\w+) -->\n)(.*?)(<!-- end -->)", re.DOTALL)

_SIGNS = {">= 0": "≥ 0", "> 0": "> 0", "0..1": "0 … 1", "": ""}
#: What can be read of contacts: unit where the gap is a length, where it is an angle, and what it is.
READINGS = {
    "force": ("N", "N.m", "what pushes the bodies apart; 0 when open"),
    "gap": ("m", "rad", "positive when open"),
    "closed": ("1", "1", "1 while closed, else 0"),
    "gap_acceleration": ("m/s2", "rad/s2", "second derivative of the gap by the present forces; 0 while closed"),
    "eccentricity": ("1", "1", "d/c: 0 in the middle, 1 where the pin touches"),
    "contact_angle": ("rad", "rad", "direction from the middle to the pin's centre, in the frame of body j"),
    "sliding_work": ("J", "J", "normal force times |slip speed|, added up since the start"),
    "wear_volume": ("m3", "m3", "the same times `wear_coefficient`: Archard's law"),
    "clicks": ("1", "1", "how often the latched angle has grown"),
    "latched": ("rad", "rad", "the latched angle"),
}


def fields(part: Any) -> Iterator[tuple[str, str, str, str, str]]:
    """Name, unit, default, limit and meaning of each argument but the name."""
    said = arguments(part)
    ends = {slot.argument: slot for slot in getattr(part, "slots", ())}
    for name, argument in inspect.signature(part).parameters.items():
        if name == "name":
            continue
        default = "must be given" if argument.default is argument.empty else f"`{_shown(argument.default)}`"
        if name in ends:
            slot = ends[name]
            kind = "a line" if slot.direction else "a point" if slot.point else "a body as a whole"
            yield name, "", default, "", kind
            continue
        stated = unit(said[name]) or ""
        units = {**getattr(part, "units", {}), **getattr(part, "positive", {}), **getattr(part, "not_negative", {})}
        yield name, units.get(name, stated), default, _SIGNS[limit(said[name])], _as_code(meaning(said[name]))


def _shown(value: object) -> str:
    return "GROUND" if value is model.GROUND else f'"{value}"' if isinstance(value, str) else str(value)


def _as_code(text: str) -> str:
    """Names in quotes as code, since Markdown would take <name> for a tag."""
    return re.sub(r'"([^"]*)"', r"`\1`", text)


def outputs(part: Any) -> Iterator[tuple[str, str, str, str]]:
    """Source, unit, meaning of what can be read, and the entries on which it depends at the same instant."""
    for name, quantity in getattr(part, "quantities", {}).items():
        depends = ", ".join(f"`<name>.{entry}`" for entry in quantity.feedthrough)
        yield f"<name>.{name}", quantity.unit, quantity.description, depends
    if part is model.CircularPattern:
        yield "<name>.index", "1", "number of the present copy, not modulo a turn", ""
    for name in getattr(part, "readings", ()):
        length, angle, what = READINGS[name]
        depends = "every input whose force reaches it" if name in ("force", "gap_acceleration") else ""
        yield f"<name>.{name}", angle if part.angular else length, what, depends


def table(what: str, name: str) -> str:
    """A table in Markdown."""
    part = getattr(model, name)
    if what == "fields":
        lines = ["| field | unit | default | limit | |", "| --- | --- | --- | --- | --- |"]
        lines += [f"| `{row[0]}` | {' | '.join(row[1:])} |" for row in fields(part)]
    else:
        lines = ["| source | unit | what | depends at once on inputs of |", "| --- | --- | --- | --- |"]
        lines += [f"| `{row[0]}` | {' | '.join(row[1:])} |" for row in outputs(part)]
    return "\n".join([*lines, ""]).replace("|  |", "| |").replace("|  |", "| |")


def main() -> None:
    """Rewrite all tables."""
    for page in PAGES.glob("*.md"):
        text = page.read_text(encoding="utf-8")
        written = TABLE.sub(lambda found: found[1] + table(found[2], found[3]) + found[5], text)
        page.write_text(written, encoding="utf-8")


if __name__ == "__main__":
    main()
