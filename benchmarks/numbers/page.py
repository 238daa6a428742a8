"""The page docs/project/numbers.md: of each number the last that was found on a machine, and the one before."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from .history import HISTORY, Entry

PAGE = HISTORY.with_suffix(".md")
#: Each run finds all of these or none: what the last one has not found is no more.
_WHOLE = ("size", "time", "deviation", "tests")


def page_of(history: Sequence[Entry]) -> str:
    """The page of the machine of the last run.

    A number that the last run did not look for stays, with the run that found it.
    """
    last = history[-1]
    found = _by_number([entry for entry in history if entry.machine == last.machine], last.run)
    groups: dict[str, list[list[Entry]]] = {}
    for values in found:
        groups.setdefault(values[0].number.group, []).append(values)
    lines = [
        "# Numbers",
        "",
        f"Made by `python -m benchmarks.numbers`, on {last.machine}. All runs: [numbers.csv](numbers.csv).",
    ]
    if any(values[0].run != last.run for values in found):
        lines += ["", f"Last run: {last.run}. Where another stands, it did not look for the number; `--all` does."]
    for group, rows in groups.items():
        lines += ["", f"## {group.capitalize()}", "", *_table(rows, last.run)]
    return "\n".join(lines) + "\n"


def shown(value: float) -> str:
    """A number as tables have it."""
    return f"{value:.0f}" if value == int(value) and abs(value) < 1e6 else f"{value:.3g}"


def _by_number(history: Sequence[Entry], last: str) -> list[list[Entry]]:
    """Entries of each number, one a run and the last run first; those of the last run before others."""
    found: dict[tuple[str, str], dict[str, Entry]] = {}
    for entry in reversed(history):
        place = (entry.number.group, entry.number.name)
        found.setdefault(place, {}).setdefault(entry.run, entry)
    numbers = [list(of_runs.values()) for of_runs in found.values()]
    renewed = {values[0].number.group for values in numbers if values[0].run == last} & set(_WHOLE)
    kept = [values for values in numbers if values[0].run == last or values[0].number.group not in renewed]
    order = {entry: k for k, entry in enumerate(history)}
    runs = list(dict.fromkeys(entry.run for entry in reversed(history)))
    return sorted(kept, key=lambda values: (runs.index(values[0].run), order[values[0]]))


def _table(rows: Sequence[Sequence[Entry]], last: str) -> list[str]:
    """Value and value before; the run of each row where they are not all of one run."""
    now = _runs(values[0] for values in rows)
    before = _runs(values[1] for values in rows if len(values) > 1)
    is_mixed = len(now) > 1
    heads = ["", "unit", last if is_mixed else now[0]]
    if before:
        heads.append(before[0] if len(before) == 1 else "before")
    heads += ["if older"] * is_mixed
    lines = [_row(heads), f"|{' --- |' * len(heads)}"]
    for values in rows:
        first = values[0]
        cells = [first.number.name, first.number.unit, shown(first.number.value)]
        if before:
            cells.append(shown(values[1].number.value) if len(values) > 1 else "")
        cells += ["" if first.run == last else first.run] * is_mixed
        lines.append(_row(cells))
    return lines


def _runs(entries: Iterable[Entry]) -> list[str]:
    return list(dict.fromkeys(entry.run for entry in entries))


def _row(cells: Iterable[str]) -> str:
    return "|" + "|".join(f" {cell} " if cell else " " for cell in cells) + "|"
