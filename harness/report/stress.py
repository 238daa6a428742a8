"""Charts of the bending stress that one impact leaves."""

from __future__ import annotations

import plotly.graph_objects as go
from plotly.subplots import make_subplots

from ..numbers import engineering
from ..tooth_stress import StressField
from .style import COLOURS, IMPACT_COLOUR, WIDE_TOP, layout


def stress_chart(field: StressField) -> go.Figure:
    """Stress along the tooth (when it is largest, and its envelope) and in time (where it is largest)."""
    figure = make_subplots(cols=2, horizontal_spacing=0.09, subplot_titles=("Along the tooth", "In time"))
    envelope = abs(field.stress).max(axis=1)
    delay_us = field.delay * 1e6
    maximum = field.maximum
    label = f"{engineering(maximum.stress, 'Pa')} at x/l = {maximum.position:.4f}"
    figure.add_trace(_line(field.position, envelope, "largest at any time", "#9aa5b1", dash="dash"), row=1, col=1)
    figure.add_trace(
        _line(field.position, field.along, f"{engineering(maximum.time, 's')} after the impact", COLOURS[0]),
        row=1,
        col=1,
    )
    figure.add_trace(_line(delay_us, field.in_time, f"at x/l = {maximum.position:.4f}", COLOURS[2]), row=1, col=2)
    for column, x in ((1, maximum.position), (2, maximum.time * 1e6)):
        marker = go.Scatter(
            x=[x],
            y=[maximum.stress],
            mode="markers",
            marker={"color": IMPACT_COLOUR, "size": 9},
            name=label,
            showlegend=column == 1,
        )
        figure.add_trace(marker, row=1, col=column)
    figure.update_xaxes(title_text="x / length, from the root [1]", row=1, col=1)
    figure.update_xaxes(title_text="time since the impact [µs]", row=1, col=2)
    figure.update_yaxes(title_text="bending stress [Pa]", exponentformat="SI", row=1, col=1)
    figure.update_yaxes(exponentformat="SI", row=1, col=2)
    figure.update_layout(layout(height=420, margin=WIDE_TOP, legend={"orientation": "h", "y": -0.2}))
    return figure


def _line(x: object, y: object, name: str, colour: str, dash: str = "solid") -> go.Scatter:
    return go.Scatter(x=x, y=y, name=name, mode="lines", line={"color": colour, "width": 2, "dash": dash})
