"""The pictures of the gallery, from the default drawings of its mechanisms.

    python -m docs.drawings.gallery_drawing      rewrites docs/gallery/*.svg, in the root of a clone

Each shows the mechanism a while after its start, and the paths of traced points over the whole run.
"""

from __future__ import annotations

import cmath
import runpy
from collections.abc import Mapping
from itertools import cycle
from pathlib import Path

from mechanism_fmu.model import Disc, Hinge, Link, Model, Polyline, Rod, Spring, Striker, Trace, Wheel
from mechanism_fmu.model.drawing import Place, Quantity, Shape
from mechanism_fmu.simulation import Simulation

from .pictures import INK, Point, View, sheet

EXAMPLES = Path(__file__).parents[1] / "examples" / "gallery"
PICTURES = Path(__file__).parents[1] / "gallery"

WIDTH, HEIGHT, MARGIN = 420, 300, 36
#: The moment that is shown, as a part of the run, and how many moments make a path.
SHOWN, SAMPLES = 0.15, 240
#: Points of an outline that are nearer to each other are one [px].
NEAR = 1.5
COLOURS = ("#2b7a78", "#d9731a", "#6b46c1", "#b83280", "#2c5282", "#975a16", "#4a5568")


def model(name: str) -> Model:
    """The MODEL of an example."""
    found = runpy.run_path(str(EXAMPLES / f"{name}.py"))["MODEL"]
    assert isinstance(found, Model)
    return found


class Moment:
    """Where shapes are at one moment.

    Args:
        shapes: of the drawing.
        values: of outputs, calculated parameters and parameters.
    """

    def __init__(self, shapes: tuple[Shape, ...], values: Mapping[str, float]) -> None:
        self.values = values
        self.known: dict[str, complex] = {}
        for shape in shapes:
            if isinstance(shape, Link | Polyline):
                for k, point in enumerate(self.points(shape)):
                    self.known[f"{shape.name}.{k}"] = point

    def number(self, quantity: Quantity) -> float:
        """A number, or the value of what it names."""
        if not isinstance(quantity, str):
            return quantity
        value = self.values[quantity.removeprefix("-")]
        return -value if quantity.startswith("-") else value

    def place(self, place: Place) -> complex:
        """A point x + i y [m]."""
        return self.known[place] if isinstance(place, str) else complex(*map(self.number, place))

    def points(self, shape: Link | Polyline) -> list[complex]:
        """The points of a body, x + i y [m]."""
        turn = cmath.exp(1j * self.number(shape.angle))
        return [self.place(shape.at) + turn * complex(*map(self.number, point)) for point in shape.points]

    def chains(self, shape: Polyline) -> list[list[complex]]:
        """The points of a line and those of each of its copies, x + i y [m]."""
        start, points = self.place(shape.at), self.points(shape)
        turn = cmath.exp(1j * self.number(shape.angle))
        found = [points]
        for copy in shape.copies:
            x, y, angle = map(self.number, copy)
            found.append([start + turn * complex(x, y) + cmath.exp(1j * angle) * (point - start) for point in points])
        return found

    def rim(self, shape: Wheel) -> list[complex]:
        """The points of a wheel's rim, x + i y [m]."""
        count, way = round(self.number(shape.count)), -1 if shape.clockwise else 1
        starts = [self.number(shape.angle) + way * k * 2 * cmath.pi / count for k in range(count)]
        outline = [(self.number(radius), self.number(angle)) for radius, angle in shape.outline]
        return [
            self.place(shape.at) + cmath.rect(radius, start + angle) for start in starts for radius, angle in outline
        ]


def hull(points: list[complex]) -> list[complex]:
    """The corners of the convex hull, counter-clockwise; two where all lie on a line."""
    ordered = sorted({complex(round(p.real, 9), round(p.imag, 9)) for p in points}, key=lambda p: (p.real, p.imag))
    if len(ordered) < 3:
        return ordered
    corners: list[complex] = []
    for way in (ordered, ordered[::-1]):
        chain: list[complex] = []
        for p in way:
            while len(chain) > 1 and ((chain[-1] - chain[-2]).conjugate() * (p - chain[-1])).imag <= 1e-9:
                chain.pop()
            chain.append(p)
        corners += chain[:-1]
    return corners


def coil(start: complex, end: complex) -> list[complex]:
    """A zigzag of fixed number of turns between two points [px], as wide as 5 px to each side."""
    way = end - start
    side = 5j * way / abs(way) if way else 0j
    zigzag = [start + way * (0.15 + 0.7 * (k + 0.5) / 12) + side * (-1) ** k for k in range(12)]
    return [start, start + 0.15 * way, *zigzag, start + 0.85 * way, end]


def svg(name: str) -> str:
    """The picture of an example, as SVG text."""
    return picture(model(name))


def picture(shown: Model) -> str:
    """The picture of a model, as SVG text: its default drawing."""
    shapes = shown.shapes
    simulation = Simulation(shown.build(shown.values()))
    fixed = vars(shown.values())
    moments = []
    for k in range(SAMPLES + 1):
        simulation.advance(k * shown.stop_time / SAMPLES)
        moments.append(Moment(shapes, {**fixed, **simulation.read()}))
    now = moments[round(SHOWN * SAMPLES)]
    paths = {shape.name: [m.place(shape.at) for m in moments] for shape in shapes if isinstance(shape, Trace)}
    view = _view(shapes, now, paths)
    colours, parts = cycle(COLOURS), []
    for path in paths.values():
        parts.append(view.path([*map(_pair, path)], 'fill="none" stroke="#a0aec0" stroke-width="1.5"'))
    for shape in shapes:
        parts.append(_drawn(shape, now, view, colours))
    return sheet(WIDTH, HEIGHT, shown.description, [part for part in parts if part])


def _pair(point: complex) -> Point:
    return point.real, point.imag


def _view(shapes: tuple[Shape, ...], now: Moment, paths: Mapping[str, list[complex]]) -> View:
    """All shapes and paths within the margins."""
    points = [*now.known.values(), *(point for path in paths.values() for point in path)]
    for shape in shapes:
        if isinstance(shape, Hinge | Striker | Spring | Rod):
            points.append(now.place(shape.at))
        if isinstance(shape, Spring | Rod):
            points.append(now.place(shape.to))
        if isinstance(shape, Disc):
            points += [now.place(shape.at) + now.number(shape.radius) * 1j**k for k in range(4)]
        if isinstance(shape, Wheel):
            points += now.rim(shape)
        if isinstance(shape, Polyline):
            points += [point for chain in now.chains(shape) for point in chain]
    left, right = min(p.real for p in points), max(p.real for p in points)
    low, high = min(p.imag for p in points), max(p.imag for p in points)
    wide, tall = max(right - left, 1e-9), max(high - low, 1e-9)
    scale = min((WIDTH - 2 * MARGIN) / wide, (HEIGHT - 2 * MARGIN) / tall)
    return View((WIDTH / 2 - scale * (left + right) / 2, HEIGHT / 2 + scale * (low + high) / 2), scale)


def _drawn(shape: Shape, now: Moment, view: View, colours: cycle[str]) -> str:
    """One shape; bodies take the next colour."""
    match shape:
        case Link():
            corners = hull(now.points(shape))
            colour = next(colours)
            style = f'fill="{colour}" fill-opacity="0.25" stroke="{colour}" stroke-width="6"'
            if len(corners) == 1:
                return view.circle(_pair(corners[0]), 5, f'fill="{colour}"')
            return view.path([*map(_pair, corners)], style, closed=len(corners) > 2)
        case Polyline():
            closed = len(shape.points) > 2
            style = f'fill="{"#e2e8f0" if closed else "none"}" stroke="#718096" stroke-width="1.5"'
            chains = (_thinned(points, NEAR / view.scale) for points in now.chains(shape))
            return "\n".join(view.path([*map(_pair, points)], style, closed) for points in chains)
        case Disc():
            size = now.number(shape.radius) * view.scale
            return view.circle(_pair(now.place(shape.at)), size, 'fill="#e2e8f0" stroke="#718096" stroke-width="1.5"')
        case Wheel():
            style = f'fill="none" stroke="{INK}" stroke-width="1.5"'
            return view.path([*map(_pair, now.rim(shape))], style, closed=True)
        case Spring():
            start, end = (complex(*view.place(_pair(now.place(p)))) for p in (shape.at, shape.to))
            sheet_view = View((0.0, 0.0), 1.0)
            points = [(p.real, -p.imag) for p in coil(start, end)]
            return sheet_view.path(points, 'fill="none" stroke="#c53030" stroke-width="1.5"')
        case Rod():
            ends = [_pair(now.place(shape.at)), _pair(now.place(shape.to))]
            return view.path(ends, f'stroke="{INK}" stroke-width="2.5"')
        case Hinge(at=str()):
            return view.circle(_pair(now.place(shape.at)), 4, f'fill="#fff" stroke="{INK}" stroke-width="1.6"')
        case Hinge():
            return view.hinge(_pair(now.place(shape.at)))
        case Striker():
            return view.circle(_pair(now.place(shape.at)), 3.5, 'fill="#c53030"')
        case Trace():
            return ""
    raise TypeError(f"{type(shape).__name__} is no shape of a default drawing; draw it here, too.")


def _thinned(points: list[complex], near: float) -> list[complex]:
    """Without points that are nearer to the one before than the picture shows; the last one stays."""
    kept = points[:1]
    for point in points[1:-1]:
        if abs(point - kept[-1]) > near:
            kept.append(point)
    return [*kept, *points[1:][-1:]]


def main() -> None:
    """Rewrite all pictures."""
    for path in sorted(EXAMPLES.glob("*.py")):
        (PICTURES / f"{path.stem}.svg").write_text(svg(path.stem), encoding="utf-8")


if __name__ == "__main__":
    main()
