"""The damage that all impacts of a run do, as a section of its report."""

from __future__ import annotations

import plotly.graph_objects as go

from ..experiment import Run
from ..tooth_damage import HEADINGS, damage_note, damage_row, stress_history
from .page import chart, section, table
from .style import COLOURS, layout
from .thin import thin

#: The chart shows the stress after so many impacts at most.
_MOST_IMPACTS = 1000


def fatigue_section(run: Run) -> str:
    """Numbers and the history of the stress; nothing for a run without damage to tell."""
    if run.damage is None:
        return ""
    card = run.experiment.material
    numbers = table(list(HEADINGS), [damage_row(run.damage, card)], numeric=range(1, len(HEADINGS)))
    sources = f"{card.text}. {'; '.join(card.sources)}."
    return section("Fatigue of the tooth", numbers, chart(_history(run)), note=f"{damage_note(run.damage)} {sources}")


def _history(run: Run) -> go.Figure:
    """Stress at the critical section over the run: a line from extreme to extreme."""
    assert run.tooth is not None
    assert run.damage is not None
    impacts = run.impacts.head(_MOST_IMPACTS)
    time, stress = thin(*stress_history(impacts, run.tooth, run.experiment.material, run.damage.position))
    left_out = f" (the first {_MOST_IMPACTS} impacts)" if len(run.impacts) > _MOST_IMPACTS else ""
    figure = go.Figure(go.Scatter(x=time, y=stress, mode="lines", line={"color": COLOURS[0], "width": 1}))
    figure.update_xaxes(title_text=f"time [s]{left_out}; zoom in to see a tooth ring")
    figure.update_yaxes(title_text="bending stress [Pa]", exponentformat="SI")
    figure.update_layout(layout(height=300))
    return figure
