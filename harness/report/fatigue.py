"""The damage that all impacts of a run do, as a section of its report."""

from __future__ import annotations

from typing import Any

import pandas as pd

from mechanism_fmu.stress import Beam, MaterialCard, SequenceDamage

from ..declared import Struck
from ..tooth_damage import HEADINGS, damage_note, damage_row, stress_history
from .page import chart, section, table
from .style import COLOURS, layout
from .thin import thin

#: The chart shows the stress after so many impacts at most.
_MOST_IMPACTS = 1000


def fatigue_section(
    impacts: pd.DataFrame,
    struck: Struck,
    beam: Beam,
    card: MaterialCard,
    damage: SequenceDamage,
    heading: str = "",
) -> str:
    """Numbers and the history of the stress, for a beam of the material of `card`; at least one impact."""
    heading = heading or f"Fatigue of the {struck.name}"
    numbers = table(list(HEADINGS), [damage_row(damage, card)], numeric=range(1, len(HEADINGS)))
    sources = f"{card.text}. {'; '.join(card.sources)}."
    history = chart(_history(impacts, struck, beam, card, damage.position))
    return section(heading, numbers, history, note=f"{damage_note(damage, struck, beam)} {sources}")


def _history(impacts: pd.DataFrame, struck: Struck, beam: Beam, card: MaterialCard, position: float) -> dict[str, Any]:
    """Stress at the critical section over the run: a line from extreme to extreme, as plotly takes it."""
    time, stress = thin(*stress_history(impacts.head(_MOST_IMPACTS), struck, beam, card, position))
    left_out = f" (the first {_MOST_IMPACTS} impacts)" if len(impacts) > _MOST_IMPACTS else ""
    line = {"color": COLOURS[0], "width": 1}
    trace = {"type": "scatter", "mode": "lines", "x": time.tolist(), "y": stress.tolist(), "line": line}
    axes = {
        "xaxis": {"title": {"text": f"time [s]{left_out}; zoom in to see a {struck.name} ring"}},
        "yaxis": {"title": {"text": "bending stress [Pa]"}, "exponentformat": "SI"},
    }
    return {"data": [trace], "layout": layout(height=300, **axes)}
