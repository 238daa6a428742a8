"""Charts as SVG and PNG files: the same picture, without a browser (docs/decisions/015-static-figures.md)."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from ..run.results import write_bytes
from .plot import Curve, FloatArray, Plot

# What a picture is drawn on: an SVG text, or a PNG by Pillow. Places are in CSS px, y points down.

#: (x, y) [px].
Point = tuple[float, float]

_INK = "#1c2733"
_FONT = "Arial, Helvetica, 'DejaVu Sans', sans-serif"

#: Pixels of a PNG for each px, and how much finer it is drawn, so that its edges are smooth.
_RESOLUTION, _FINENESS = 1.5, 2

#: What the font that Pillow brings has not got.
_PLAIN = str.maketrans({"β": "beta", "₀": "_0", "σ": "sigma", "ω": "omega", "−": "-", "µ": "u", "…": "..."})


#: SVG's names of anchors in Pillow's; both at half the height.
_ANCHORS = {"start": "lm", "middle": "mm", "end": "rm"}


class Canvas(Protocol):
    """Takes lines, areas, dots and texts, the later ones on top."""

    def line(self, points: Sequence[Point], colour: str, width: float) -> None:
        """Straight lines from point to point."""

    def area(self, points: Sequence[Point], colour: str) -> None:
        """What a polygon encloses."""

    def dot(self, centre: Point, radius: float, colour: str) -> None:
        """A disc."""

    def text(self, at: Point, text: str, size: float, anchor: str = "middle", upright: bool = True) -> None:
        """A text whose "start", "middle" or "end" is at a point, at half its height; else it reads upwards."""


class Svg:
    """An SVG of `width` by `height` px."""

    def __init__(self, width: int, height: int) -> None:
        size = f'viewBox="0 0 {width} {height}" width="{width}" height="{height}"'
        self._parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="{_FONT}" fill="none" '
            'stroke-linejoin="round" stroke-linecap="round">',
            f'<rect width="{width}" height="{height}" fill="#ffffff"/>',
        ]

    def line(self, points: Sequence[Point], colour: str, width: float) -> None:
        """See `Canvas`."""
        self._parts.append(f'<polyline points="{_places(points)}" stroke="{colour}" stroke-width="{width:g}"/>')

    def area(self, points: Sequence[Point], colour: str) -> None:
        """See `Canvas`."""
        self._parts.append(f'<polygon points="{_places(points)}" fill="{colour}"/>')

    def dot(self, centre: Point, radius: float, colour: str) -> None:
        """See `Canvas`."""
        self._parts.append(f'<circle cx="{centre[0]:.1f}" cy="{centre[1]:.1f}" r="{radius:g}" fill="{colour}"/>')

    def text(self, at: Point, text: str, size: float, anchor: str = "middle", upright: bool = True) -> None:
        """See `Canvas`."""
        x, y = at
        turn = "" if upright else f' transform="rotate(-90 {x:.1f} {y:.1f})"'
        self._parts.append(
            f'<text x="{x:.1f}" y="{y:.1f}" dy="0.36em" font-size="{size:g}" text-anchor="{anchor}" '
            f'fill="{_INK}"{turn}>{escape(text)}</text>'
        )

    def file(self) -> bytes:
        """The whole file."""
        return "\n".join([*self._parts, "</svg>\n"]).encode()


class Png:
    """A PNG of `width` by `height` px."""

    def __init__(self, width: int, height: int) -> None:
        from PIL import Image, ImageDraw

        self._scale = _RESOLUTION * _FINENESS
        self._image = Image.new("RGB", (round(width * self._scale), round(height * self._scale)), "#ffffff")
        self._draw = ImageDraw.Draw(self._image)

    def line(self, points: Sequence[Point], colour: str, width: float) -> None:
        """See `Canvas`."""
        self._draw.line(self._scaled(points), fill=colour, width=max(1, round(width * self._scale)), joint="curve")

    def area(self, points: Sequence[Point], colour: str) -> None:
        """See `Canvas`."""
        self._draw.polygon(self._scaled(points), fill=colour)

    def dot(self, centre: Point, radius: float, colour: str) -> None:
        """See `Canvas`."""
        x, y = centre
        self._draw.ellipse(self._scaled([(x - radius, y - radius), (x + radius, y + radius)]), fill=colour)

    def text(self, at: Point, text: str, size: float, anchor: str = "middle", upright: bool = True) -> None:
        """See `Canvas`."""
        from PIL import Image, ImageDraw, ImageFont

        font: Any = ImageFont.load_default(size * self._scale)
        plain = text.translate(_PLAIN)
        [(x, y)] = self._scaled([at])
        if upright:
            self._draw.text((x, y), plain, fill=_INK, font=font, anchor=_ANCHORS[anchor])
            return
        box = font.getbbox(plain, anchor="mm")
        width, height = round(box[2] - box[0]) + 4, round(box[3] - box[1]) + 4
        level = Image.new("RGB", (width, height), "#ffffff")
        ImageDraw.Draw(level).text((width / 2, height / 2), plain, fill=_INK, font=font, anchor="mm")
        self._image.paste(level.rotate(90, expand=True), (round(x - height / 2), round(y - width / 2)))

    def file(self) -> bytes:
        """The whole file."""
        file = io.BytesIO()
        self._image.reduce(_FINENESS).save(file, format="png")
        return file.getvalue()

    def _scaled(self, points: Sequence[Point]) -> list[Point]:
        return [(self._scale * x, self._scale * y) for x, y in points]


def _places(points: Sequence[Point]) -> str:
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in points)


# One plot on a canvas: axes with round numbers, grid, curves, legend.

#: Margins around the axes [px]: for numbers and labels, and on the right for the legend.
_LEFT, _TOP, _BOTTOM, _RIGHT, _LEGEND = 64.0, 34.0, 52.0, 18.0, 124.0
#: Sizes of texts, and the distance of two entries of the legend [px].
_TITLE, _LABEL, _NUMBER, _ENTRY = 15.0, 13.0, 12.0, 20.0

_FRAME, _GRID = "#5b6875", "#dfe5ea"

#: Margin beyond the curves, as a part of their range.
_MARGIN = 0.04


@dataclass(frozen=True)
class _View:
    """Where a value stands: the rectangle `x` by `y` in the plot's units fills one of pixels."""

    x: tuple[float, float]
    y: tuple[float, float]
    left: float
    right: float
    bottom: float
    top: float

    def place(self, x: float, y: float) -> Point:
        across, up = (x - self.x[0]) / (self.x[1] - self.x[0]), (y - self.y[0]) / (self.y[1] - self.y[0])
        return self.left + across * (self.right - self.left), self.bottom + up * (self.top - self.bottom)


def draw_plot(canvas: Canvas, plot: Plot, corner: Point, width: float, height: float) -> None:
    """Draw a plot into the rectangle whose upper left corner is given [px]."""
    right = corner[0] + width - (_LEGEND if plot.legend else _RIGHT)
    left, top, bottom = corner[0] + _LEFT, corner[1] + _TOP, corner[1] + height - _BOTTOM
    view = _view(plot, left, right, bottom, top)
    _draw_grid(canvas, view)
    for curve in plot.curves:
        _draw_curve(canvas, view, curve)
    middle = (left + right) / 2
    canvas.text((middle, corner[1] + 18), plot.title, _TITLE)
    canvas.text((middle, bottom + 36), plot.x_label, _LABEL)
    canvas.text((corner[0] + 14, (top + bottom) / 2), plot.y_label, _LABEL, upright=False)
    if plot.legend:
        _draw_legend(canvas, plot, (right + 12, top + 10))


def ticks(low: float, high: float, intervals: int = 7) -> list[float]:
    """Multiples of 1, 2 or 5 times a power of ten within low < high, at most so many intervals apart."""
    least = (high - low) / intervals
    power = math.floor(math.log10(least))
    step = next(factor * 10.0**power for factor in (1, 2, 5, 10, 20) if factor * 10.0**power >= least)
    return [k * step for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


def tick_labels(values: list[float]) -> list[str]:
    """The same number of decimals for all ticks, as few as distinguish them."""
    step = min(np.diff(values), default=1.0)
    decimals = max(0, -math.floor(math.log10(step) + 1e-9))
    return [f"{value:.{decimals}f}".replace("-", "−") for value in values]


def _view(plot: Plot, left: float, right: float, bottom: float, top: float) -> _View:
    x, y = (_range([np.asarray(getattr(curve, axis), dtype=np.float64) for curve in plot.curves]) for axis in "xy")
    if plot.from_zero:
        y = (0.0, y[1])
    if plot.to_scale:
        scale = min((right - left) / (x[1] - x[0]), (bottom - top) / (y[1] - y[0]))
        x, y = _widened(x, (right - left) / scale), _widened(y, (bottom - top) / scale)
    return _View(x, y, left, right, bottom, top)


def _range(values: list[FloatArray]) -> tuple[float, float]:
    low, high = min(float(v.min()) for v in values), max(float(v.max()) for v in values)
    margin = _MARGIN * (high - low) or abs(high) or 1.0
    return low - margin, high + margin


def _widened(limits: tuple[float, float], size: float) -> tuple[float, float]:
    middle = (limits[0] + limits[1]) / 2
    return middle - size / 2, middle + size / 2


def _draw_grid(canvas: Canvas, view: _View) -> None:
    x_ticks, y_ticks = ticks(*view.x), ticks(*view.y)
    for x, label in zip(x_ticks, tick_labels(x_ticks), strict=True):
        canvas.line([view.place(x, view.y[0]), view.place(x, view.y[1])], _GRID, 1)
        canvas.text((view.place(x, 0)[0], view.bottom + 14), label, _NUMBER)
    for y, label in zip(y_ticks, tick_labels(y_ticks), strict=True):
        canvas.line([view.place(view.x[0], y), view.place(view.x[1], y)], _GRID, 1)
        canvas.text((view.left - 7, view.place(0, y)[1]), label, _NUMBER, "end")
    canvas.line([(view.left, view.top), (view.left, view.bottom), (view.right, view.bottom)], _FRAME, 1)


def _draw_curve(canvas: Canvas, view: _View, curve: Curve) -> None:
    x, y = np.asarray(curve.x, dtype=np.float64), np.asarray(curve.y, dtype=np.float64)
    points = [view.place(*point) for point in zip(x.tolist(), y.tolist(), strict=True)]
    if curve.filled:
        canvas.area(points, _paler(curve.colour))
    if curve.line:
        canvas.line(points, curve.colour, 2)
    for point in points if curve.dots else ():
        canvas.dot(point, 3.5, curve.colour)


def _draw_legend(canvas: Canvas, plot: Plot, at: Point) -> None:
    entries = {curve.name: curve for curve in reversed(plot.curves)}
    names = list(dict.fromkeys(curve.name for curve in plot.curves))
    for number, name in enumerate(names):
        x, y = at[0], at[1] + number * _ENTRY
        canvas.line([(x, y), (x + 16, y)], entries[name].colour, 2)
        canvas.text((x + 22, y), name, _NUMBER, "start")


def _paler(colour: str) -> str:
    """A quarter of "#rrggbb" on white."""
    parts = (int(colour[i : i + 2], 16) for i in (1, 3, 5))
    return "#" + "".join(f"{255 - (255 - part) // 4:02x}" for part in parts)


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
