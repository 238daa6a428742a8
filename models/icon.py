"""The icon of a model, made with matplotlib (`pip install ".[docs]"`)."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any


@contextmanager
def icon_axes(path: Path, margin: float = 0.05) -> Iterator[Any]:
    """Axes without a frame, 100 x 100 px; at the end, what has been drawn in them is written.

    Args:
        path: of the PNG file.
        margin: around what is drawn, as a fraction of its size.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(1, 1), dpi=100)
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.02, 0.02, 0.96, 0.96))
    yield axes
    axes.set_aspect("equal")
    axes.margins(margin)
    axes.axis("off")
    figure.savefig(path, transparent=True, metadata={"Software": None})
