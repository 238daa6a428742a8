"""Which impact stresses the tooth most: closing speed, impulse, energy lost, jump and stress side by side."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import pandas as pd

from ..numbers import engineering
from .interactive import interactive
from .page import chart, charts, section, table
from .plot import Curve, Plot
from .style import COLOURS

#: What could be taken for the severity of an impact, and its heading.
_MEASURES = {
    "closing_speed": "closing speed",
    "impulse": "impulse",
    "energy_lost": "energy lost",
    "velocity": "jump of the tooth's tip, v_I",
    "stress_max": "stress",
}
#: Contacts have their own units of these: a stop's are rad/s and N.m.s.
_BY_CONTACT = ("closing_speed", "impulse")
#: The charts show no more impacts than this.
_MOST_POINTS = 2000

_NOTE = (
    "Only the jump of the wheel's speed makes its teeth ring. How fast the contact closes, or what impulse it takes, "
    "says little about it: an impulse that a held wheel, its hinge or another contact bears does not reach the teeth."
)


def severity_section(impacts: pd.DataFrame, units: Mapping[str, str]) -> str:
    """The largest impact by each measure and the stress that it leaves; "" for less than two impacts with stresses.

    Args:
        impacts: as of `tooth_stress.with_stress`.
        units: of its columns.
    """
    if not {"stress_max", "velocity", "closing_speed"} <= set(impacts) or impacts["stress_max"].notna().sum() < 2:
        return ""
    most = float(impacts["stress_max"].max())
    rows = [_row(name, part, units, most) for name, part in _groups(impacts)]
    headings = ["largest by", "its value", "time [s]", "jump v_I", "stress left", "of the largest stress"]
    plots = [_against(name, impacts, units) for name in ("closing_speed", "energy_lost") if name in impacts]
    return section(
        "Which impact stresses the tooth most",
        table(headings, rows, numeric=range(1, len(headings))),
        charts(*(chart(interactive(plot, height=320)) for plot in plots)),
        note=_NOTE,
    )


def _groups(impacts: pd.DataFrame) -> Iterator[tuple[str, pd.DataFrame]]:
    """Each measure with the impacts among which it can be compared."""
    for name in _MEASURES:
        if name not in impacts:
            continue
        if name in _BY_CONTACT and "contact" in impacts:
            for _, part in impacts.groupby("contact"):
                yield name, part
        else:
            yield name, impacts


def _row(name: str, part: pd.DataFrame, units: Mapping[str, str], most: float) -> list[str]:
    sizes = part[name].abs()
    worst = part.loc[sizes.idxmax()] if sizes.notna().any() else part.iloc[0]
    label = _MEASURES[name]
    if name in _BY_CONTACT and "contact" in part:
        label += f", contact {int(worst['contact'])}"
    held = pd.isna(worst["stress_max"])
    # the buffer's unit is that of points on lines; of a stop it is another
    unit = units[name] if name not in _BY_CONTACT else ""
    value = engineering(abs(float(worst[name])), unit) if unit else f"{abs(float(worst[name])):.4g}"
    return [
        label,
        value,
        f"{worst['time']:.9g}",
        engineering(float(worst["velocity"]), units["velocity"]),
        str(worst["remark"]) if held else engineering(float(worst["stress_max"]), "Pa"),
        "–" if held or most == 0 else f"{worst['stress_max'] / most:.1%}",
    ]


def _against(name: str, impacts: pd.DataFrame, units: Mapping[str, str]) -> Plot:
    """Stress over another measure, a colour for each contact."""
    strong = impacts.dropna(subset=["stress_max"]).nlargest(_MOST_POINTS, "stress_max")
    parts = strong.groupby("contact") if "contact" in strong else [("", strong)]
    curves = [
        Curve(
            f"contact {contact}" if contact != "" else "impacts",
            part[name].abs(),
            part["stress_max"],
            COLOURS[k % len(COLOURS)],
            line=False,
            dots=True,
        )
        for k, (contact, part) in enumerate(parts)
    ]
    unit = "contact's own unit" if name in _BY_CONTACT else units[name]
    label = f"{_MEASURES[name]} [{unit}]"
    return Plot(f"Stress against {_MEASURES[name]}", label, "largest bending stress [Pa]", curves, from_zero=True)
