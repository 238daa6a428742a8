"""Charts of a run, one below the other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

Array = np.ndarray[Any, np.dtype[Any]]

_HEIGHT = 220  # of a chart, in pixels


#: More lines of impacts hide what they mark.
_MOST_LINES = 100


class Curve(NamedTuple):
    """What is drawn over time.

    Attributes:
        name: of the column.
        values: shape (rows,).
        unit: SI.
        description: for the reader.
    """

    name: str
    values: Array
    unit: str
    description: str


def figure(times: Array, curves: Sequence[Curve], impacts: Sequence[float]) -> Any:
    """Curves over time, one chart for each unit; dotted lines mark impacts.

    Args:
        times: [s], shape (rows,).
        curves: to be drawn.
        impacts: their times [s]; lines of a hundred are drawn.
    """
    units = list(dict.fromkeys(curve.unit for curve in curves))
    count = max(len(units), 1)
    charts = make_subplots(rows=count, cols=1, shared_xaxes=True, vertical_spacing=0.03)
    for name, values, unit, description in curves:
        hover = f"{description}<br>%{{y:.6g}} {unit} at %{{x:.6g}} s"
        line = go.Scatter(x=times, y=values, name=name.replace("_", " "), hovertemplate=hover)
        charts.add_trace(line, row=units.index(unit) + 1, col=1)
    for row, unit in enumerate(units, start=1):
        charts.update_yaxes(title_text=f"[{unit}]", row=row, col=1)
    for time in list(dict.fromkeys(impacts))[:_MOST_LINES]:
        charts.add_vline(x=time, line={"width": 1, "dash": "dot", "color": "#b2182b"})
    charts.update_xaxes(title_text="time [s]", row=count, col=1)
    charts.update_layout(height=_HEIGHT * count + 100, hovermode="closest")
    return charts
