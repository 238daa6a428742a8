"""The table of impacts."""

from __future__ import annotations

import math
from collections.abc import Mapping

import pandas as pd

from ..description import Value
from .page import section, table

#: A longer table is in impacts.csv.
_MOST = 100


def impacts_section(impacts: pd.DataFrame, units: Mapping[str, str], heading: str = "Impacts") -> str:
    """A row for each of the first impacts, with units by column; "" when there are none."""
    if impacts.empty:
        return ""
    headings = [_heading(name, units[name]) for name in impacts.columns]
    rows = [[_cell(value) for value in row] for row in impacts.head(_MOST).itertuples(index=False)]
    note = f"The first {_MOST} of {len(impacts)}; all are in impacts.csv." if len(impacts) > _MOST else ""
    numbered = [[str(i), *row] for i, row in enumerate(rows, 1)]
    return section(heading, table(["#", *headings], numbered, numeric=range(len(headings) + 1)), note=note)


def _heading(name: str, unit: str) -> str:
    words = name.replace("_", " ")
    return f"{words} [{unit}]" if unit else words


def _cell(value: Value) -> str:
    if not isinstance(value, float):
        return str(value)
    return "–" if math.isnan(value) else f"{value:.7g}"
