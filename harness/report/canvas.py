"""What a picture is drawn on: an SVG text, or a PNG by Pillow. Places are in CSS px, y points down."""

from __future__ import annotations

import io
from collections.abc import Sequence
from html import escape
from typing import Any, Protocol

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
