"""How far links give way in a run, as a section of its report."""

from __future__ import annotations

from collections.abc import Sequence

from ..compliance import Compliance, compliance_units, compliance_values
from ..declared import Chain
from ..numbers import engineering
from .page import section, table

_NOTE = (
    "{Arm} and {strut} give way: with the drive standing still, the {wheel} stays behind by the lost motion. The "
    "effective {tooth} resolution is pitch and lost motion: by so much the drive must move the {wheel} to gain a "
    "{tooth}. The contact force acts slowly; the impact is that with the largest force, F = v sqrt(k m), with m from "
    "impulse and closing speed and k of the {strut} alone ({arm} and {tooth} would make it smaller); {arm} and lost "
    "motion are those of the smaller force of {strut} and {arm} in a chain, by the same energy. Both are bars of "
    "constant section{source}."
)


def compliance_section(chain: Chain | None, found: Sequence[Compliance]) -> str:
    """A column for each load; "" when the FMU declares no links, or nothing loads them."""
    if chain is None or not found:
        return ""
    columns = [compliance_values(chain, one) for one in found]
    rows = [
        [name.replace("_", " "), *(_cell(column[name], unit) for column in columns)]
        for name, unit in compliance_units(chain).items()
    ]
    headings = ["quantity", *(one.case for one in found)]
    words = {"arm": chain.arm.name, "strut": chain.strut.name, "wheel": chain.wheel.name, "tooth": chain.tooth}
    source = f" ({chain.source})" if chain.source else ""
    note = _NOTE.format(**words, Arm=chain.arm.name.capitalize(), source=source)
    return section("Compliance", table(headings, rows, numeric=range(1, len(headings))), note=note)


def _cell(value: float, unit: str) -> str:
    return f"{value:.4g}" if unit == "1" else engineering(value, unit)
