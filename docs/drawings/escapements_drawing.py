"""The drawings and icons of the escapements of models/, from their default drawings, and the figure of their page.

    python -m docs.drawings.escapements_drawing      rewrites models/<name>/drawing.svg and model.png, the figure of
                                                     docs/explanation/escapements.md and its numbers; takes minutes

The icons need matplotlib (`pip install ".[docs]"`); all else needs nothing.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path

from benchmarks.escapements import ESCAPEMENTS, FACTORS, Beat, Swung, exponent, rate_of_reference, steady
from mechanism_fmu.model import Disc, Model, Polyline, Wheel
from mechanism_fmu.simulation import Simulation

from .gallery_drawing import SHOWN, Moment, picture
from .pictures import DIMENSION, INK, Point, View, icon_axes, sheet

MODELS = Path(__file__).parents[2] / "models"
PAGE = Path(__file__).parents[1] / "explanation" / "escapements.md"
FIGURE = PAGE.with_suffix(".svg")
METAL = "#c9d2dc"

#: Of a model: what it is called in the figure, and its colour.
NAMED = {
    "verge": ("verge", "#c53030"),
    "recoil_anchor": ("recoil anchor", "#d9731a"),
    "graham": ("Graham", "#2b7a78"),
    "pin_pallet": ("pin pallet", "#6b46c1"),
    "lever_escapement": ("lever", "#2c5282"),
}
DAY = 86400.0

#: Of each model, its limit cycles at all factors of the default torque.
Measured = Mapping[str, Mapping[float, Beat]]


def icon(model: Model, path: Path) -> None:
    """Write a model's icon, 100 x 100 px, with matplotlib.

    Args:
        model: which.
        path: of the PNG file.
    """
    simulation = Simulation(model.build(model.values()))
    simulation.advance(SHOWN * model.stop_time)
    now = Moment(model.shapes, {**vars(model.values()), **simulation.read()})
    with icon_axes(path) as axes:
        for shape in model.shapes:
            if isinstance(shape, Disc):
                centre, radius = now.place(shape.at), now.number(shape.radius)
                chains = [[centre + radius * 1j ** (k / 6) for k in range(24)]]
            elif isinstance(shape, Polyline):
                chains = now.chains(shape)
            elif isinstance(shape, Wheel):
                chains = [now.rim(shape)]
            else:
                continue
            for points in chains:
                places = [(p.real, p.imag) for p in points]
                axes.fill(*zip(*places, strict=True), facecolor=METAL, edgecolor=INK, linewidth=0.6)


def redraw(one: Swung) -> None:
    """Rewrite the drawing and the icon of a model."""
    folder = MODELS / one.model
    (folder / "drawing.svg").write_text(picture(one.described), encoding="utf-8")
    icon(one.described, folder / "model.png")


def measured() -> Measured:
    """Of all models at all torques; takes minutes."""
    return {one.model: {factor: steady(one, factor) for factor in FACTORS} for one in ESCAPEMENTS}


def figure(found: Measured) -> str:
    """Periods over torques as SVG text: of all, logarithmic; and of all but the verge, as rates."""
    left, right = View((200.0, 190.0), 1.0), View((585.0, 190.0), 1.0)
    thin, small = f'stroke="{DIMENSION}" stroke-width="0.8" fill="none"', 'font-size="13" font-style="normal"'
    across, up, day = 110.0, 190.0, 0.26  # px for a factor of e, and for a second a day
    parts = []
    for view, title in ((left, "period, over that by default"), (right, "gain [s/d] on that by default")):
        parts.append(view.path([(-0.8 * across, 0), (1.5 * across, 0)], thin))
        parts.append(view.path([(0, -150), (0, 150)], thin))
        parts.append(view.label((0.35 * across, 168), title, small))
        for factor in (0.5, 2.0, 4.0):
            at = across * math.log(factor)
            parts.append(view.path([(at, -3), (at, 3)], thin))
            parts.append(view.label((at, 0), f"{factor:g}", small, dy=18))
        parts.append(view.label((1.28 * across, 0), "torque / default", small, dy=-8))
    for value in (0.5, 0.7, 1.4):
        parts.append(left.path([(-3, up * math.log(value)), (3, up * math.log(value))], thin))
        parts.append(left.label((0, up * math.log(value)), f"{value:g}", small, dx=-20, dy=4))
    for value in (-500, -250, 250, 500):
        parts.append(right.path([(-3, day * value), (3, day * value)], thin))
        parts.append(right.label((0, day * value), f"{value:g}", small, dx=-26, dy=4))
    for k, (name, beats) in enumerate(found.items()):
        called, colour = NAMED[name]
        style, middle = f'fill="none" stroke="{colour}" stroke-width="2"', beats[1.0].period
        curve: list[Point] = [(across * math.log(f), up * math.log(b.period / middle)) for f, b in beats.items()]
        parts += [left.path(curve, style), *(left.circle(point, 2.5, f'fill="{colour}"') for point in curve)]
        if name != "verge":
            curve = [(across * math.log(f), day * DAY * (middle / b.period - 1.0)) for f, b in beats.items()]
            parts += [right.path(curve, style), *(right.circle(point, 2.5, f'fill="{colour}"') for point in curve)]
        parts.append(left.label((-90 + 105 * k, -185), called, f'{small} fill="{colour}"'))
    return sheet(800, 400, "Period against torque of five escapements", parts)


def numbers(found: Measured) -> dict[str, str]:
    """The tables of the page, by their names in it."""
    rows = ["| torque / default | " + " | ".join(called for called, _ in NAMED.values()) + " |", "| --- " * 6 + "|"]
    for factor in FACTORS:
        rows.append(f"| {factor:g} | " + " | ".join(f"{found[name][factor].period:.6f}" for name in NAMED) + " |")
    low, high = FACTORS[0], FACTORS[-1]
    each = [
        "| | torque [N.mm] | amplitude [deg] | power [mW] | exponent over all | exponent from 1 to 1.5 | rate [s/d] |",
        "| --- " * 7 + "|",
    ]
    for one in ESCAPEMENTS:
        beats, torque = found[one.model], 1e3 * one.described.inputs[0].start
        ends = [(factor, beats[factor]) for factor in (low, high)]
        near = [(factor, beats[factor]) for factor in (1.0, 1.5)]
        each.append(
            f"| [{NAMED[one.model][0]}](../../models/{one.model}) | {low * torque:.4g} to {high * torque:.4g} | "
            f"{math.degrees(ends[0][1].amplitude):.2f} to {math.degrees(ends[1][1].amplitude):.2f} | "
            f"{1e3 * beats[1.0].power:.4f} | {exponent(*ends):+.6f} | {exponent(*near):+.6f} | "
            f"{rate_of_reference(one):+.3f} |"
        )
    return {"each": "\n".join(each), "periods": "\n".join(rows), "date": f"Measured on {datetime.now(UTC):%Y-%m-%d}."}


def with_numbers(page: str, tables: Mapping[str, str]) -> str:
    """The page with its tables anew."""
    for name, table in tables.items():
        page = re.sub(rf"(<!-- {name} -->\n).*?(<!-- end -->)", rf"\g<1>{table}\n\g<2>", page, flags=re.DOTALL)
    return page


def main() -> None:
    """Rewrite all."""
    found = measured()
    FIGURE.write_text(figure(found), encoding="utf-8")
    PAGE.write_text(with_numbers(PAGE.read_text(encoding="utf-8"), numbers(found)), encoding="utf-8")
    for one in ESCAPEMENTS:
        redraw(one)


if __name__ == "__main__":
    main()
