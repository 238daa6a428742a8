"""A plot in a report, as plotly's JavaScript takes it: plain data, without plotly's slow checks in Python."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from .plot import Curve, Plot
from .style import layout

_HEIGHT = 360


def interactive(plot: Plot, height: int = _HEIGHT) -> dict[str, Any]:
    """The figure {data, layout} of a plot, `height` pixels high."""
    names = [curve.name for curve in plot.curves]
    traces = [_trace(curve, first=curve.name not in names[:i]) for i, curve in enumerate(plot.curves)]
    x_axis: dict[str, Any] = {"title": {"text": plot.x_label}}
    y_axis: dict[str, Any] = {"title": {"text": plot.y_label}, "exponentformat": "SI"}
    if plot.to_scale:
        x_axis["constrain"] = y_axis["constrain"] = "domain"
        y_axis["scaleanchor"] = "x"
    if plot.from_zero:
        y_axis["rangemode"] = "tozero"
    # on the left: plotly's tool bar comes on the right
    heading = {"title": {"text": plot.title, "font": {"size": 15}, "xref": "paper", "x": 0, "xanchor": "left"}}
    legend = {"orientation": "h", "y": -0.22, "yanchor": "top"}
    return {
        "data": traces,
        "layout": layout(height=height, xaxis=x_axis, yaxis=y_axis, showlegend=plot.legend, legend=legend, **heading),
    }


def _trace(curve: Curve, first: bool) -> dict[str, Any]:
    trace = {
        "type": "scatter",
        "mode": "+".join(["lines"] * curve.line + ["markers"] * curve.dots),
        "name": curve.name,
        "legendgroup": curve.name,
        "showlegend": first,
        "x": _numbers(curve.x),
        "y": _numbers(curve.y),
        # simplified by plotly, a smooth curve of few points has corners
        "line": {"color": curve.colour, "width": 2, "simplify": False},
        "marker": {"color": curve.colour, "size": 7},
    }
    if curve.filled:
        trace |= {"fill": "toself", "fillcolor": f"{curve.colour}40", "hoveron": "points"}
    return trace


def _numbers(values: npt.ArrayLike) -> list[float | None]:
    """What JSON can hold: a point that is not finite is a gap in the curve."""
    return [value if math.isfinite(value) else None for value in np.asarray(values, dtype=np.float64).tolist()]
