"""Chart data: thinned to the points that its curve needs, and written for plotly's JavaScript."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd

from .page import layout

# Fewer points for the same curve, fewer frames for the same motion.

FloatArray = npt.NDArray[np.floating]


def thin(time: FloatArray, values: FloatArray, limit: int = 4000) -> tuple[FloatArray, FloatArray]:
    """At most about `limit` points of a curve, with every peak kept.

    Each of `limit / 2` equal stretches of the curve keeps its smallest and its largest value, in their order.

    Args:
        time: shape (points,), increasing.
        values: shape (points,).
        limit: number of points that a chart draws without delay.
    """
    if len(time) <= limit:
        return time, values
    edges = np.linspace(0, len(time), limit // 2 + 1).astype(int)
    kept = {0, len(time) - 1}
    for begin, end in pairwise(edges):
        kept |= {begin + int(np.argmin(values[begin:end])), begin + int(np.argmax(values[begin:end]))}
    order = np.array(sorted(kept))
    return time[order], values[order]


def strongest(impacts: pd.DataFrame, limit: int) -> FloatArray:
    """Times [s] of at most `limit` impacts, in their order: those of the largest velocity.

    Args:
        impacts: a row for each impact, with `time` and, where the FMU reports it, `velocity`; without a velocity the
            impacts that are left are spread evenly.
        limit: >= 1.
    """
    if impacts.empty:
        return np.empty(0)
    time = impacts["time"].to_numpy(dtype=np.float64)
    if len(time) <= limit:
        return np.asarray(time)
    if "velocity" not in impacts:
        kept = np.linspace(0, len(time) - 1, limit).astype(int)
    else:
        speed = np.abs(impacts["velocity"].to_numpy(dtype=np.float64))
        kept = np.sort(np.argsort(-speed, kind="stable")[:limit])
    return np.asarray(time[kept])


def frame_rows(time: FloatArray, instants: FloatArray, limit: int) -> npt.NDArray[np.int_]:
    """Samples for a moving picture: evenly spread, with the two samples around every instant.

    Args:
        time: shape (samples,), increasing, at least one.
        instants: shape (instants,), e.g. of impacts, within the time.
        limit: the most samples, unless the instants alone ask for more.

    Returns:
        Indices of samples, increasing, with the first and the last.
    """
    last = len(time) - 1
    after = np.clip(np.searchsorted(time, instants, side="left"), min(1, last), last)
    needed = np.unique(np.concatenate((np.maximum(after - 1, 0), after, [0, last])))
    spread = np.linspace(0, last, max(min(limit - len(needed), last + 1), 0)).astype(int)
    return np.union1d(needed, spread)


# A chart as data: `interactive` draws it in a report, `static` into SVG and PNG files.


@dataclass(frozen=True)
class Curve:
    """One curve, in the units that the plot's axes name.

    Attributes:
        name: for the legend; curves of the same name are shown and hidden together, with one entry.
        x, y: shape (points,) each.
        colour: as "#rrggbb".
        line: whether its points are joined.
        dots: whether each point has a dot.
        filled: whether the area that it encloses is filled; it must be closed.
    """

    name: str
    x: npt.ArrayLike
    y: npt.ArrayLike
    colour: str
    line: bool = True
    dots: bool = False
    filled: bool = False


@dataclass(frozen=True)
class Plot:
    """Curves with common axes.

    Attributes:
        title: what it shows.
        x_label, y_label: what the axes measure, with the unit.
        curves: in the order in which they are drawn.
        to_scale: whether both axes have the same scale, as a shape needs it.
        from_zero: whether the y axis begins at 0.
        legend: whether names are shown.
    """

    title: str
    x_label: str
    y_label: str
    curves: Sequence[Curve]
    to_scale: bool = False
    from_zero: bool = False
    legend: bool = True


# A plot in a report, as plotly's JavaScript takes it: plain data, without plotly's slow checks in Python.

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
