"""Chart data: thinned to the points that its curve needs, and written for the page's scripts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd

from .style import THEMED

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
        about: what else there is to know of it, such as the variable's name, for the pointer.
        labels: of its points, for the pointer; () when they have none.
    """

    name: str
    x: npt.ArrayLike
    y: npt.ArrayLike
    colour: str
    line: bool = True
    dots: bool = False
    filled: bool = False
    about: str = ""
    labels: Sequence[str] = ()


@dataclass(frozen=True)
class Lane:
    """A band over time that is full while something is on.

    Attributes:
        name: beside it.
        spans: shape (times, 2): from when to when it is on.
        colour: as "#rrggbb".
        about: as of a curve.
    """

    name: str
    spans: npt.ArrayLike
    colour: str
    about: str = ""


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
        log_x, log_y: whether an axis is logarithmic, on a page.
        marks: places on the x axis where something happened, each a line across the chart, on a page.
        lanes: in place of curves, on a page.
        bars: names of groups of bars, on a page: a curve has a bar in each, and no x.
        range: of the x axis; None for that of the curves.
    """

    title: str
    x_label: str
    y_label: str
    curves: Sequence[Curve]
    to_scale: bool = False
    from_zero: bool = False
    legend: bool = True
    log_x: bool = False
    log_y: bool = False
    marks: npt.ArrayLike = ()
    lanes: Sequence[Lane] = ()
    bars: Sequence[str] = ()
    range: tuple[float, float] | None = None


# A plot in a report, as `curves.js` takes it.

_HEIGHT = 300
#: What a curve or a plot holds that goes to the page where it is not the default.
_OF_CURVE = ("line", "dots", "filled", "about", "labels")
_OF_PLOT = ("to_scale", "from_zero", "legend", "log_x", "log_y", "bars", "range")


def interactive(plot: Plot, height: int = _HEIGHT) -> dict[str, Any]:
    """The figure of a plot for `page.chart`, `height` pixels high; with lanes, as high as these need."""
    curves = [
        {"name": curve.name, "x": _numbers(curve.x), "y": _numbers(curve.y), "colour": _colour(curve.colour)}
        | _changed(curve, _OF_CURVE)
        # the scripts take a line where it is said
        | {"line": curve.line}
        for curve in plot.curves
    ]
    figure: dict[str, Any] = {"title": plot.title, "x": plot.x_label, "y": plot.y_label, "curves": curves}
    figure |= {"height": height} | _changed(plot, _OF_PLOT)
    marks = _numbers(plot.marks)
    if marks:
        figure["marks"] = marks
    if plot.lanes:
        del figure["height"]
        figure["lanes"] = [
            {
                "name": lane.name,
                "spans": np.asarray(lane.spans).tolist(),
                "colour": _colour(lane.colour),
                "about": lane.about,
            }
            for lane in plot.lanes
        ]
    return figure


def _changed(one: Curve | Plot, names: Sequence[str]) -> dict[str, Any]:
    defaults = {field.name: field.default for field in fields(one)}
    return {name: getattr(one, name) for name in names if getattr(one, name) != defaults[name]}


def _colour(colour: str) -> str:
    return THEMED.get(colour, colour)


def _numbers(values: npt.ArrayLike) -> list[float]:
    numbers: list[float] = np.asarray(values, dtype=np.float64).tolist()
    return numbers
