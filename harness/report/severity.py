"""Which impact stresses what is struck most: closing speed, impulse, energy lost, jump and stress side by side."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import pandas as pd

from ..declared import Struck
from ..impacts import UNITS_OF_STOPS, contact_name
from ..numbers import engineering
from .interactive import interactive
from .page import chart, charts, section, table
from .plot import Curve, Plot
from .style import COLOURS

#: What could be taken for the severity of an impact, and its heading, but for the jump.
_MEASURES = {"closing_speed": "closing speed", "impulse": "impulse", "energy_lost": "energy lost"}
#: Contacts have their own units of these: a stop's are rad/s and N.m.s.
_BY_CONTACT = ("closing_speed", "impulse")
#: The charts show no more impacts of a contact than this.
_MOST_POINTS = 2000

_NOTE = (
    "Only the jump of the {body}'s speed makes its {plural} ring. How fast the contact closes, or what impulse it "
    "takes, says little about it: an impulse that a held {body}, its hinge or another contact bears does not reach the "
    "{plural}."
)


def severity_section(
    impacts: pd.DataFrame, units: Mapping[str, str], struck: Struck | None, names: Sequence[str] = ()
) -> str:
    """The largest impact by each measure and the stress that it leaves; "" for less than two impacts, or no stresses.

    Args:
        impacts: as of `tooth_stress.with_stress`.
        units: of its columns.
        struck: what they strike; None when it is not known.
        names: of the contacts, in the order of their numbers; () when they are not known.
    """
    if struck is None or not {"stress_max", struck.jump, "closing_speed"} <= set(impacts) or len(impacts) < 2:
        return ""
    most = float(impacts["stress_max"].max()) if impacts["stress_max"].notna().any() else 0.0
    known = _MEASURES | {struck.jump: f"jump of the {struck.name}'s tip, v_I", "stress_max": "stress"}
    measures = {name: words for name, words in known.items() if name in impacts}
    note = _NOTE.format(body=struck.body, plural=struck.plural)
    contacts = _named(impacts, names)
    rows = []
    for name, words in measures.items():
        parts = contacts if name in _BY_CONTACT and contacts else {"": impacts}
        rows += [_row(name, words, struck.jump, contact, part, units, most) for contact, part in parts.items()]
    headings = ["largest by", "its value", "time [s]", "jump v_I", "stress left", "of the largest stress"]
    plots = [
        _against(name, measures[name], impacts, contacts, units)
        for name in ("closing_speed", "energy_lost")
        if name in measures
    ]
    return section(
        f"Which impact stresses the {struck.name} most",
        table(headings, rows, numeric=range(1, len(headings))),
        charts(*(chart(interactive(plot, height=320)) for plot in plots)),
        note=f"{note} {UNITS_OF_STOPS}" if contacts else note,
    )


def _named(impacts: pd.DataFrame, names: Sequence[str]) -> dict[str, pd.DataFrame]:
    """The impacts of each contact by its name; {} where contacts are not reported."""
    if "contact" not in impacts:
        return {}
    numbers = sorted({int(number) for number in impacts["contact"]})
    return {contact_name(number, names): impacts[impacts["contact"] == number] for number in numbers}


def _row(
    name: str, words: str, jump: str, contact: str, part: pd.DataFrame, units: Mapping[str, str], most: float
) -> list[str]:
    """The largest of the impacts `part`; `most` is the largest stress of all [Pa]."""
    place = int(part[name].abs().fillna(-1.0).to_numpy().argmax())
    size, time, velocity, stress = (float(part[column].iloc[place]) for column in (name, "time", jump, "stress_max"))
    # The unit in the buffer is that of points on lines; stops and locks have another one.
    value = f"{abs(size):.4g}" if contact else engineering(abs(size), units[name])
    return [
        words + (f", {contact}" if contact else ""),
        value,
        f"{time:.9g}",
        engineering(velocity, units[jump]),
        str(part["remark"].iloc[place]) if math.isnan(stress) else engineering(stress, "Pa"),
        "–" if math.isnan(stress) or most == 0.0 else f"{stress / most:.1%}",
    ]


def _against(
    name: str, words: str, impacts: pd.DataFrame, contacts: Mapping[str, pd.DataFrame], units: Mapping[str, str]
) -> Plot:
    """Stress over another measure, a colour for each contact."""
    curves = []
    for k, (label, part) in enumerate((contacts or {"impacts": impacts}).items()):
        strong = part.dropna(subset=["stress_max"]).nlargest(_MOST_POINTS, "stress_max")
        if len(strong):
            colour = COLOURS[k % len(COLOURS)]
            curves.append(Curve(label, strong[name].abs(), strong["stress_max"], colour, line=False, dots=True))
    unit = "each contact's own unit" if name in _BY_CONTACT and contacts else units[name]
    label = f"{words} [{unit}]"
    return Plot(f"Stress against {words}", label, "largest bending stress [Pa]", curves, from_zero=True)
