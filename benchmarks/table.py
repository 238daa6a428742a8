"""Comparisons as a table for people and as JSON for programs."""

from __future__ import annotations

import os
import platform
from collections.abc import Sequence
from datetime import UTC, datetime
from importlib.metadata import version
from statistics import median
from typing import Any

from rich.table import Table

from .timing import Comparison

#: Of a table that is printed into a file [characters].
WIDTH_OF_A_FILE = 120

_PACKAGES = ("numpy", "scipy", "numba", "fmpy", "pythonfmu")
_UNITS = (("s", 1.0), ("ms", 1e-3), ("us", 1e-6))
_WHOLE_FROM = 5.0
_VERDICTS = {True: "[green]met[/]", False: "[bold red]missed[/]", None: ""}


def table(comparisons: Sequence[Comparison]) -> Table:
    """One line a comparison, under its subject."""
    result = Table(box=None, padding=(0, 1), header_style="bold")
    result.add_column("")
    for heading in ("baseline", "mechanism_fmu", "ratio", "required", "verdict"):
        result.add_column(heading, justify="right", no_wrap=True)
    for subject in dict.fromkeys(comparison.subject for comparison in comparisons):
        result.add_row(f"[bold]{subject}[/]")
        for c in (comparison for comparison in comparisons if comparison.subject == subject):
            result.add_row(
                f"  {c.case}", _span(c.slow), _span(c.fast), _factor(c.ratio), _required(c), _VERDICTS[c.met]
            )
    return result


def as_json(machine: dict[str, Any], comparisons: Sequence[Comparison]) -> dict[str, Any]:
    """Machine and comparisons: times of every round [s]."""
    return {
        "machine": machine,
        "comparisons": [
            {
                "subject": c.subject,
                "case": c.case,
                "slow": c.slow,
                "fast": c.fast,
                "ratio": c.ratio,
                "least_ratio": c.least_ratio,
                "longest": c.longest,
                "met": c.met,
            }
            for c in comparisons
        ],
    }


def this_machine() -> dict[str, Any]:
    """What the times depend on."""
    return {
        "date": datetime.now(UTC).date().isoformat(),
        "system": f"{platform.system()} {platform.machine()}",
        "cpus": os.cpu_count(),
        "load": round(os.getloadavg()[0], 1) if hasattr(os, "getloadavg") else None,
        "python": platform.python_version(),
        **{package: version(package) for package in _PACKAGES},
    }


def _span(times: Sequence[float]) -> str:
    """Median and range, in a unit that suits the median."""
    middle = median(times)
    name, unit = next((entry for entry in _UNITS if middle >= entry[1]), _UNITS[-1])
    span = f" [{min(times) / unit:.3g}-{max(times) / unit:.3g}]" if len(times) > 1 else ""
    return f"{middle / unit:.3g} {name}{span}"


def _factor(ratio: float) -> str:
    """Whole numbers, but where the two are about as fast."""
    return f"{ratio:.0f}" if ratio >= _WHOLE_FROM else f"{ratio:.2f}"


def _required(comparison: Comparison) -> str:
    if comparison.longest is not None:
        return f"< {comparison.longest:g} s"
    return "" if comparison.least_ratio is None else f">= {_factor(comparison.least_ratio)}"
