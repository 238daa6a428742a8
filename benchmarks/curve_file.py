"""Reference curves as text."""

from __future__ import annotations

from collections.abc import Iterable


def print_curve(columns: str, rows: Iterable[Iterable[float]], digits: int = 15) -> None:
    """Print a curve as CSV: the names of its columns, then its rows with so many significant digits."""
    print(columns)
    for row in rows:
        print(",".join(f"{number:.{digits}g}" for number in row))
