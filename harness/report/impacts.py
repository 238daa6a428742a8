"""The table of impacts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import pandas as pd

from ..description import Value
from ..impacts import UNITS_OF_STOPS, contact_name
from ..tooth_stress import BY_TWO_MODES
from .page import section, table

#: A longer table is in impacts.csv.
_MOST = 100
_BEFORE = "_speed_before"
#: What impacts.csv has besides: place and delay are those of the section on stress, and the remark stands for a stress.
_LEFT_OUT = ("stress_position", "stress_delay", "remark")


def impacts_section(
    impacts: pd.DataFrame, units: Mapping[str, str], heading: str = "Impacts", contacts: Sequence[str] = ()
) -> str:
    """A row for each of the first impacts, with units by column; "" when there are none.

    Args:
        impacts: of a run.
        units: of its columns.
        heading: of the section.
        contacts: their names, in the order of their numbers; () when they are not known.
    """
    if impacts.empty:
        return ""
    left_out = {*_LEFT_OUT, *_speeds_of_others(impacts)}
    names = [str(name) for name in impacts if name not in left_out]
    headings = [_heading(name, units[name]) for name in names]
    shown = impacts.head(_MOST)
    rows = [[_cell(name, value) for name, value in zip(names, row, strict=True)] for row in _rows(shown[names])]
    if "remark" in shown:
        for row, remark in zip(rows, shown["remark"], strict=True):
            row[names.index("stress_max")] = remark or row[names.index("stress_max")]
    if "contact" in names:
        for row, number in zip(rows, shown["contact"], strict=True):
            row[names.index("contact")] = contact_name(int(number), contacts)
    notes = [UNITS_OF_STOPS] if "contact" in names else []
    if "stress_max" in names:
        notes.append(f"Stress of each impact {BY_TWO_MODES}")
    if left_out - {*_LEFT_OUT}:
        notes.append("Speeds of more bodies are in impacts.csv.")
    note = f"The first {_MOST} of {len(impacts)}; all are in impacts.csv." if len(impacts) > _MOST else ""
    note = " ".join([note, *notes]).strip()
    numbered = [[str(i), *row] for i, row in enumerate(rows, 1)]
    return section(heading, table(["#", *headings], numbered, numeric=range(len(headings) + 1)), note=note)


def _speeds_of_others(impacts: pd.DataFrame) -> list[str]:
    """Speeds before and after, of all bodies but the first: they would make the table wider than a page."""
    bodies = [str(name).removesuffix(_BEFORE) for name in impacts if str(name).endswith(_BEFORE)]
    return [f"{body}{suffix}" for body in bodies[1:] for suffix in (_BEFORE, "_speed")]


def _rows(impacts: pd.DataFrame) -> Iterator[tuple[Value, ...]]:
    return impacts.itertuples(index=False, name=None)


def _heading(name: str, unit: str) -> str:
    words = name.replace("_", " ")
    return f"{words} [{unit}]" if unit else words


def _cell(name: str, value: Value) -> str:
    """Times to nine digits, other numbers to five."""
    if not isinstance(value, float):
        return str(value)
    return f"{value:.9g}" if name == "time" else f"{value:.5g}"
