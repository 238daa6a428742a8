"""The picture of docs/explanation/woodpecker.md: the toy, and the bird's rate over its angle in the limit cycles.

python -m docs.drawings.woodpecker_drawing      rewrites docs/explanation/woodpecker.svg, in the root of a clone
"""

from __future__ import annotations

import cmath
import runpy
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from mechanism_fmu.simulation import Simulation

from .pictures import DIMENSION, INK, Point, View, sheet

PICTURE = Path(__file__).parents[1] / "explanation" / "woodpecker.svg"
PROGRAM = Path(__file__).parents[1] / "examples" / "woodpecker_cycle.py"

#: Limit cycles that are shown: law, its name on the sheet, colour; "small" has small angles.
SHOWN = (("newton", "Newton", "#2b7a78"), ("poisson", "Poisson", "#d9731a"), ("small", "small angles", "#a0aec0"))

#: Of the toy, in the frame of each body [mm]: the sleeve's sides and arm, the bird from its centre.
SIDES = (((3.1, -5.8), (5.1, -5.8), (5.1, 5.8), (3.1, 5.8)), ((-3.1, -5.8), (-5.1, -5.8), (-5.1, 5.8), (-3.1, 5.8)))
ARM = ((5.1, 0.0), (10.0, 0.0))
BIRD: tuple[Point, ...] = (
    (-20.1, 20.0),
    (-13.0, 24.5),
    (-6.0, 23.0),
    (0.0, 9.0),
    (6.0, -4.0),
    (15.0, -22.0),
    (10.0, -24.0),
    (0.0, -9.0),
)
BIRD += ((-6.0, -4.0), (-15.0, 0.0), (-8.0, 4.0), (-10.0, 14.0), (-12.5, 19.0))


def _moved(points: tuple[Point, ...], angle: float, at: complex) -> list[Point]:
    places = [at + cmath.rect(1.0, angle) * complex(*point) for point in points]
    return [(place.real, place.imag) for place in places]


def _toy(view: View, sleeve: float, bird: float, faint: bool) -> list[str]:
    """Sleeve and bird at their angles [rad], in mm."""
    pin = 10.0 * cmath.rect(1.0, sleeve)
    line = 'fill-opacity="0" stroke-dasharray="3 3"' if faint else 'fill-opacity="0.3"'
    at = pin + 15.0 * cmath.rect(1.0, bird)
    parts = [view.path(_moved(BIRD, bird, at), f'fill="#d9731a" stroke="#d9731a" {line}', closed=True)]
    for side in SIDES:
        parts.append(view.path(_moved(side, sleeve, 0j), f'fill="#2b7a78" stroke="#2b7a78" {line}', closed=True))
    if not faint:
        parts.append(view.path(_moved(ARM, sleeve, 0j), 'stroke="#c53030" stroke-width="3"'))
        parts.append(view.circle((pin.real, pin.imag), 4, f'fill="#fff" stroke="{INK}" stroke-width="1.6"'))
    return parts


def _motion(program: dict[str, Any], law: str) -> tuple[list[list[Point]], dict[str, float]]:
    """The bird's (angle, rate) over a cycle, in pieces between its impacts, and the outputs where the beak strikes."""
    size = program["SMALL_ANGLES"] if law == "small" else 1.0
    law = "newton" if law == "small" else law
    found, *_ = program["limit_cycle"](law, 1e-9, size)
    strikes = [time for time, _, speed in found.events if speed]
    simulation = Simulation(program["toy"](found.start, law, 1e-9, size))
    pieces, pecks = [], {}
    for start, end in pairwise([0.0, *strikes, found.period]):
        piece = []
        for time in np.linspace(start + 1e-7, end - 1e-7, 24):
            simulation.advance(float(time))
            now = simulation.read()
            piece.append((size * now["bird"], size * now["bird_rate"]))
        pieces.append(piece)
    peck = next(time for time, name, _ in found.events if name == "beak.gap")
    pecks = program["state_at"](program["toy"](found.start, law, 1e-9, size), peck)
    return pieces, {"start": found.start, **pecks}


def drawing() -> str:
    """The picture as SVG text."""
    program = runpy.run_path(str(PROGRAM))
    motions = {law: _motion(program, law) for law, *_ in SHOWN}
    toy = View((90.0, 175.0), 4.9)
    pole = f'fill="#e2e8f0" stroke="{DIMENSION}"'
    parts = [toy.path([(-2.5, -29.0), (2.5, -29.0), (2.5, 31.0), (-2.5, 31.0)], pole, closed=True)]
    pecks = motions["newton"][1]
    parts += _toy(toy, pecks["sleeve"], pecks["bird"], faint=True)
    parts += _toy(
        toy,
        program["state_at"](program["toy"](pecks["start"], "newton", 1e-9), 0.0)["sleeve"],
        pecks["start"],
        faint=False,
    )
    plane = View((650.0, 178.0), 1.0)
    across, up = 480.0, 6.6  # px per rad, px per rad/s
    thin = f'stroke="{DIMENSION}" stroke-width="0.8" fill="none"'
    small = 'font-size="13" font-style="normal"'
    parts.append(plane.path([(-0.58 * across, 0), (0.19 * across, 0)], thin))
    parts.append(plane.path([(0, -17 * up), (0, 20 * up)], thin))
    for angle in (-0.5, -0.4, -0.3, -0.2, -0.1, 0.1):
        parts.append(plane.path([(angle * across, -3), (angle * across, 3)], thin))
        parts.append(plane.label((angle * across, 0), f"{angle:g}", small, dy=18))
    for rate in (-15, -10, -5, 5, 10, 15):
        parts.append(plane.path([(-3, rate * up), (3, rate * up)], thin))
        parts.append(plane.label((0, rate * up), f"{rate:g}", small, dx=20, dy=4))
    parts.append(plane.label((-0.25 * across, 0), "angle of the bird [rad]", small, dy=-8))
    parts.append(plane.label((0, 20 * up), "its rate [rad/s]", small, dy=-8))
    for k, (law, name, colour) in enumerate(reversed(SHOWN)):
        for piece in motions[law][0]:
            style = f'fill="none" stroke="{colour}" stroke-width="2"'
            parts.append(plane.path([(x * across, y * up) for x, y in piece], style))
        for one, other in pairwise(motions[law][0]):
            jump = [(x * across, y * up) for x, y in (one[-1], other[0])]
            parts.append(plane.path(jump, f'fill="none" stroke="{colour}" stroke-width="1" stroke-dasharray="2 3"'))
        parts.append(plane.label((-0.44 * across, (-17 + 2.6 * k) * up), name, f'{small} fill="{colour}"'))
    return sheet(800, 340, "Woodpecker toy: jammed, and where it pecks; its limit cycles", parts)


def main() -> None:
    """Rewrite the picture."""
    PICTURE.write_text(drawing(), encoding="utf-8")


if __name__ == "__main__":
    main()
