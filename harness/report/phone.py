"""Charts above each other on a phone's screen, where there is no room for legends beside them."""

from __future__ import annotations

import math
from typing import Any

import plotly.graph_objects as go

#: Of a line of a legend, between two charts, and around them all [px].
_LINE, _GAP, _TOP, _BOTTOM = 17, 34, 10, 46
#: Two names that are no longer stand beside each other in a legend.
_SHORT = 11


def stacked(figure: go.Figure) -> dict[str, Any]:
    """The layout of a stack of charts with a common x axis for `page.chart`: each legend stands above its chart.

    The charts keep their heights. Each is on a y axis of its own, the first at the top, and its legend, if it has
    one, has the number of the axis.
    """
    layout = figure.layout
    inner = layout.height - layout.margin.t - layout.margin.b
    numbers = range(1, len({trace.yaxis for trace in figure.data}) + 1)
    heights = [inner * (axis.domain[1] - axis.domain[0]) for axis in (layout[_name("yaxis", n)] for n in numbers)]
    legends = [_LINE * _lines(figure, n) for n in numbers]
    total = sum(heights) + sum(legends) + _GAP * (len(heights) - 1)
    changed: dict[str, Any] = {"height": total + _TOP + _BOTTOM, "margin": {"t": _TOP, "b": _BOTTOM}}
    bottom = total
    for number, height, legend in zip(numbers, heights, legends, strict=True):
        top = bottom - legend
        bottom = top - height
        changed[_name("yaxis", number)] = {"domain": [max(bottom, 0.0) / total, top / total]}
        if legend:
            place = {"x": 0, "xanchor": "left", "y": top / total, "yanchor": "bottom"}
            changed[_name("legend", number)] = {"orientation": "h", "font": {"size": 11}} | place
        bottom -= _GAP
    return changed


def _name(kind: str, number: int) -> str:
    return kind if number == 1 else f"{kind}{number}"


def _lines(figure: go.Figure, number: int) -> int:
    names = [
        trace.name
        for trace in figure.data
        if (trace.yaxis or "y") == _name("y", number) and trace.showlegend is not False
    ]
    if all(len(name) <= _SHORT for name in names):
        return math.ceil(len(names) / 2)
    return sum(1 + name.count("<br>") for name in names)
