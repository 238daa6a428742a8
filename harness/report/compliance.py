"""How far pawl and crank give way in a run, as a section of its report."""

from __future__ import annotations

from collections.abc import Sequence

from ..compliance import COMPLIANCE_UNITS, Compliance
from ..numbers import engineering
from .page import section, table

_NOTE = (
    "Crank and pawl give way: with the drive standing still, the wheel stays behind by the lost motion. The effective "
    "tooth resolution is pitch and lost motion: by so much the drive must move the wheel to gain a tooth. The contact "
    "force acts slowly; the impact is that with the largest force, F = v sqrt(k m), with m from impulse and closing "
    "speed and k of the pawl alone (crank and tooth would make it smaller); crank and lost motion are those of the "
    "smaller force of pawl and crank in a chain, by the same energy. Both are bars of constant section "
    "(models/ratchet/README.md)."
)


def compliance_section(found: Sequence[Compliance]) -> str:
    """A column for each load; "" when the FMU describes no such links, or nothing loads them."""
    if not found:
        return ""
    rows = [
        [name.replace("_", " "), *(_cell(getattr(one, name), unit) for one in found)]
        for name, unit in COMPLIANCE_UNITS.items()
    ]
    headings = ["quantity", *(one.case for one in found)]
    return section("Compliance", table(headings, rows, numeric=range(1, len(headings))), note=_NOTE)


def _cell(value: float, unit: str) -> str:
    return f"{value:.4g}" if unit == "1" else engineering(value, unit)
