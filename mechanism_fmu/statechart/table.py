"""A mechanism's logic as tables."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from .records import Logic

#: Headings of `rows`.
HEADINGS = ("Part", "From", "Event", "Guard", "To", "Reset")
#: Headings of `definition_rows`.
DEFINITION_HEADINGS = ("Logical function", "is 1 when", "Unit", "Decided within", "Event")


def rows(logic: Logic, counts: Mapping[int, int] | None = None) -> list[list[str]]:
    """The transitions, a row each, with the columns of `HEADINGS`; with `counts`, one more: how often it happened."""
    return [
        [t.part, t.source, t.trigger, t.condition, t.target, t.reset]
        + ([] if counts is None else [str(counts.get(place, 0))])
        for place, t in enumerate(logic.transitions)
    ]


def definition_rows(logic: Logic) -> list[list[str]]:
    """The logical functions, a row each, with the columns of `DEFINITION_HEADINGS`."""
    return [[d.name, d.meaning, d.unit, d.tolerance, d.event] for d in logic.definitions]


def definitions_table(logic: Logic) -> str:
    """The logical functions as Markdown."""
    return _markdown(DEFINITION_HEADINGS, definition_rows(logic), code=(0, 4))


def markdown(logic: Logic, counts: Mapping[int, int] | None = None) -> str:
    """The transitions as Markdown, and what never changes."""
    headings = HEADINGS if counts is None else (*HEADINGS, "Times")
    kept = "".join(f"\n`{name}` is closed throughout.\n" for name in kept_parts(logic))
    return _markdown(headings, rows(logic, counts), code=(2, 3)) + kept


def kept_parts(logic: Logic) -> list[str]:
    """The parts that have one state and no transition."""
    moving = {t.part for t in logic.transitions}
    return [region.part for region in logic.regions if region.part not in moving]


def _markdown(headings: Sequence[str], table: Iterable[Sequence[str]], code: Sequence[int]) -> str:
    def line(cells: Iterable[str]) -> str:
        return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |\n"

    body = (line(f"`{c}`" if i in code and c else c for i, c in enumerate(row)) for row in table)
    return line(headings) + line("---" for _ in headings) + "".join(body)
