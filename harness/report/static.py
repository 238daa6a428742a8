"""Plots as files: the same picture as SVG and as PNG, without a browser (docs/decisions/015-static-figures.md)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from ..results import write_bytes
from .axes import draw_plot
from .canvas import Png, Svg
from .plot import Plot

#: Of one plot [px].
_WIDTH, _HEIGHT = 480, 340


def write_static(plots: Sequence[Plot], path: Path) -> list[Path]:
    """Write plots beside each other, two to a row, into `path` with the endings .svg and .png.

    The same plots give the same bytes. All points must be finite.

    Raises:
        UsageError: the disk refuses.
    """
    return [
        write_bytes(path.with_suffix(suffix), _drawn(plots, kind)) for suffix, kind in ((".svg", Svg), (".png", Png))
    ]


def svg_text(plots: Sequence[Plot]) -> str:
    """Plots beside each other as the text of an SVG; see `write_static`."""
    return _drawn(plots, Svg).decode()


def _drawn(plots: Sequence[Plot], kind: type[Svg] | type[Png]) -> bytes:
    columns = min(len(plots), 2)
    canvas = kind(_WIDTH * columns, _HEIGHT * math.ceil(len(plots) / columns))
    for number, plot in enumerate(plots):
        corner = (_WIDTH * (number % columns), _HEIGHT * (number // columns))
        draw_plot(canvas, plot, corner, _WIDTH, _HEIGHT)
    return canvas.file()
