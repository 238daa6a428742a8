"""Which contacts are active when: Boolean outputs named `<contact>_active`, as bands over time."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import plotly.graph_objects as go

from ..description import Variable
from ..experiment import Run
from .style import COLOURS
from .thin import FloatArray, frame_rows

#: What Boolean outputs end with that tell of contacts.
SUFFIX = "_active"

#: Gaps shorter than this part of the run are narrower than a pixel, and are not drawn.
_INVISIBLE = 1 / 2000

#: Places along a lane that answer to the pointer.
_HOVER_POINTS = 800


@dataclass(frozen=True)
class Contact:
    """A contact that is active or not.

    Attributes:
        name: for the reader, e.g. "holding pawl".
        variable: the FMU's Boolean output, e.g. "holding_pawl_active".
        colour: the same wherever the report shows it.
    """

    name: str
    variable: str
    colour: str


def contacts(run: Run) -> list[Contact]:
    """The contacts whose activity was recorded, in the FMU's order."""
    return contacts_among([v for v in run.description.of("output") if v.name in run.results])


def contacts_among(outputs: Iterable[Variable]) -> list[Contact]:
    """The contacts of whose activity some outputs tell."""
    variables = [v.name for v in outputs if v.type == "Boolean" and v.name.endswith(SUFFIX)]
    return [
        Contact(name.removesuffix(SUFFIX).replace("_", " "), name, COLOURS[i % len(COLOURS)])
        for i, name in enumerate(variables)
    ]


def intervals(time: FloatArray, active: npt.NDArray[np.bool_]) -> FloatArray:
    """When a Boolean signal is true: from the first sample that says so to the next that does not, or the last one.

    Args:
        time: shape (samples,), increasing.
        active: shape (samples,).

    Returns:
        Shape (intervals, 2): begin and end, in the unit of `time`.
    """
    if len(time) == 0:
        return np.empty((0, 2))
    edges = np.flatnonzero(np.diff(active.astype(np.int8), prepend=0, append=0))
    return np.asarray(time[np.minimum(edges, len(time) - 1)], dtype=np.float64).reshape(-1, 2)


def joined(spans: FloatArray, shortest_gap: float) -> FloatArray:
    """Intervals with every gap below `shortest_gap` closed.

    Args:
        spans: shape (intervals, 2), in order, as of `intervals`.
        shortest_gap: the least that stays open, in the same unit.

    Returns:
        Shape (fewer, 2).
    """
    opens = spans[1:, 0] - spans[:-1, 1] >= shortest_gap
    begins = np.concatenate((spans[:1, 0], spans[1:, 0][opens]))
    ends = np.concatenate((spans[:-1, 1][opens], spans[-1:, 1]))
    return np.column_stack((begins, ends))


def add_lanes(figure: go.Figure, run: Run, row: int) -> None:
    """Draw a lane for each contact into a row of the figure, the first one on top."""
    lanes = contacts(run)
    time = run.results["time"].to_numpy(dtype=np.float64)
    begin, end = float(time[0]), float(time[-1])
    signals = [run.results[lane.variable].to_numpy(dtype=bool) for lane in lanes]
    spans = [intervals(time, signal) for signal in signals]
    for lane, own in zip(lanes, spans, strict=True):
        figure.add_trace(_band(lane, joined(own, (end - begin) * _INVISIBLE)), row=row, col=1)
    edges = np.concatenate([own.ravel() for own in spans])
    shown = edges[np.linspace(0, len(edges) - 1, min(len(edges), _HOVER_POINTS // 4)).astype(int)]
    rows = frame_rows(time, shown, _HOVER_POINTS)
    for lane, own, signal in zip(lanes, spans, signals, strict=True):
        figure.add_trace(_hover(lane, own, time[rows], signal[rows]), row=row, col=1)
    if end > begin:
        # Bars would widen the time axis that all rows share.
        figure.update_xaxes(range=[begin, end])
    # A lane that is never active keeps its place.
    names = [lane.name for lane in lanes]
    figure.update_yaxes(
        type="category",
        categoryorder="array",
        categoryarray=names,
        range=[len(names) - 0.5, -0.5],
        tickmode="array",
        tickvals=names,
        showgrid=False,
        fixedrange=True,
        row=row,
        col=1,
    )


def _band(lane: Contact, spans: FloatArray) -> go.Bar:
    return go.Bar(
        base=spans[:, 0],
        x=spans[:, 1] - spans[:, 0],
        y=[lane.name] * len(spans),
        orientation="h",
        width=0.72,
        marker={"color": lane.colour, "line": {"width": 0}},
        hoverinfo="skip",
        showlegend=False,
    )


def _hover(lane: Contact, spans: FloatArray, time: FloatArray, active: npt.NDArray[np.bool_]) -> go.Scatter:
    """What the pointer tells: bars answer for their end, wherever they are touched; unseen points tell the truth."""
    number = np.searchsorted(spans[:, 0], time, side="right") - 1
    texts = [
        "active {:.7g} … {:.7g} s".format(*spans[n]) if on else "not active"
        for n, on in zip(number, active, strict=True)
    ]
    return go.Scatter(
        x=time,
        y=[lane.name] * len(time),
        text=texts,
        name=lane.name,
        mode="markers",
        marker={"color": lane.colour, "opacity": 0},
        hovertemplate="%{text}",
        showlegend=False,
    )
