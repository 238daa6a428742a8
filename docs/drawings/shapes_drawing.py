"""The pictures of docs/explanation/shapes.md; here the first: the ready outlines, with copies of those of wheels.

python -m docs.drawings.shapes_drawing      rewrites docs/explanation/shapes*.svg, in the root of a clone
"""

from __future__ import annotations

from pathlib import Path

from docs.joints.sketch import AXIS, BODY_I, EDGE
from mechanism_fmu.model import (
    Outline,
    deadbeat_pallet,
    deg,
    escape_tooth,
    geneva_sector,
    hook,
    involute_tooth,
    pin_tooth,
    ratchet_tooth,
    recoil_pallet,
    round_hole,
    slot_hole,
)

from .pictures import INK, Point, View, sheet
from .plane import SMALL
from .shapes_runs_drawing import edge_drawing, pallet_drawing, places_drawing

PICTURES = Path(__file__).parents[1] / "explanation"

#: Size of a panel [px], the middle of what it shows, and how far that reaches [px].
WIDE, HIGH, MIDDLE, REACH = 186, 176, 78, 64
_SHADE = f'fill="{BODY_I}" fill-opacity="0.75" {EDGE}'
_ONE = 'fill="none" stroke="#b23a48" stroke-width="2.6"'

#: Of wheels: number of copies; of the others, 0.
SHAPES: tuple[tuple[str, int, Outline], ...] = (
    ("ratchet_tooth", 12, ratchet_tooth(12, deg(88), 0.1, 1.1, tip_radius=2e-3, root_fillet=4e-3)),
    ("involute_tooth", 16, involute_tooth(16, 0.01, root_fillet=1e-3)),
    ("pin_tooth", 12, pin_tooth(12, 0.1, 0.012)),
    ("geneva_sector", 6, geneva_sector(6, 0.1, 0.012, 0.055, 0.034, mouth_radius=3e-3)),
    ("escape_tooth", 15, escape_tooth(15, 0.1, 0.075, deg(8), deg(27), tip_radius=5e-4, root_fillet=3e-3)),
    ("recoil_pallet", 0, recoil_pallet((0.1, 0.0), (0.0, 0.03), 0.03, relief_angle=deg(35), corner_radius=4e-3)),
    ("deadbeat_pallet", 0, deadbeat_pallet(0.09, 0.12, deg(110), deg(100), deg(60))),
    ("hook", 0, hook(0.1, 0.02, 0.025, 0.03, undercut=deg(8), tip_radius=4e-3, throat_fillet=3e-3)),
    ("round_hole", 0, round_hole(0.02)),
    ("slot_hole", 0, slot_hole(0.06, 0.03, angle=deg(25))),
)


def points_of(outline: Outline) -> list[Point]:
    """Points along an outline, arcs in forty pieces [m]."""
    found: list[Point] = []
    for element in outline.elements:
        found += [element.point(k / 40) for k in range(1 if element.is_straight else 40)]
    return found if outline.closed else [*found, outline.elements[-1].end]


def _panel(place: int, name: str, count: int, outline: Outline) -> list[str]:
    """One outline, in red, with its copies or, of a hole, with material around it."""
    x, y = WIDE * (place % 5 + 0.5), HIGH * (place // 5) + MIDDLE + 8
    copies = [points_of(outline.moved(angle=deg(360) * k / count)) for k in range(count)] if count else []
    own = points_of(outline)
    around = [p for copy in copies for p in copy] or own
    low, high = (tuple(edge(p[k] for p in around) for k in (0, 1)) for edge in (min, max))
    middle = ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2)
    part = 0.6 if outline.hole else 1.0
    scale = part * 2 * REACH / max(high[0] - low[0], high[1] - low[1])
    s = View((x - scale * middle[0], y + scale * middle[1]), scale)
    parts = []
    if outline.hole:
        reach = REACH / scale
        corners = [(middle[0] + a * reach, middle[1] + b * reach) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        parts += [s.path(corners, _SHADE, closed=True), s.path(own, 'fill="#fff"', closed=True)]
    elif count and outline.closed:
        parts += [s.path(copy, _SHADE, closed=True) for copy in copies]
    else:
        parts.append(s.path(around, _SHADE, closed=True))
    if count:
        parts.append(s.circle((0.0, 0.0), 3, f'fill="{INK}"'))
        parts += [s.path([(0.0, 0.0), (high[0], 0.0)], AXIS)]
    parts.append(s.path(own, _ONE, closed=outline.closed))
    return [*parts, View((x, y), 1.0).label((0.0, 0.0), name, SMALL, dy=84)]


def ready_drawing() -> str:
    """The picture as SVG text."""
    parts = [part for place, shape in enumerate(SHAPES) for part in _panel(place, *shape)]
    return sheet(5 * WIDE, 2 * HIGH + 6, "Ready outlines", parts)


#: Of each file, without .svg: what draws it.
DRAWINGS = {
    "shapes": ready_drawing,
    "shapes_edge": edge_drawing,
    "shapes_pallet": pallet_drawing,
    "shapes_places": places_drawing,
}


def main() -> None:
    """Rewrite all pictures."""
    for name, draw in DRAWINGS.items():
        (PICTURES / f"{name}.svg").write_text(draw(), encoding="utf-8")


if __name__ == "__main__":
    main()
