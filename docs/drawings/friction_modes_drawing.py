"""The four modes of a contact with friction, and what leads from one to another; drawn by `friction_drawing`."""

from __future__ import annotations

import math
from itertools import permutations

from docs.joints.sketch import BODY_I, BODY_J, Sketch, add, along

from .pictures import INK, Point, sheet
from .plane import SMALL, words

WIDTH, HEIGHT = 900, 440
#: Of each mode: its place on the sheet, upwards [px], its colour, what holds.
MODES: dict[str, tuple[Point, str, str]] = {
    "apart": ((450, 375), "#ffffff", "λ_N = 0, λ_T = 0"),
    "slips backwards": ((115, 180), BODY_I, "v_T < 0, λ_T = +μ λ_N"),
    "sticks": ((450, 180), BODY_J, "v_T = 0, |λ_T| ≤ μ_s λ_N"),
    "slips forwards": ((785, 180), BODY_I, "v_T > 0, λ_T = −μ λ_N"),
}
#: What leads from a mode to another: the name of the event behind that of the contact, and when it comes.
EVENTS = {
    ("apart", "sticks"): ("gap", "the gap closes"),
    ("apart", "slips forwards"): ("gap", "the gap closes"),
    ("apart", "slips backwards"): ("gap", "the gap closes"),
    ("sticks", "apart"): ("force", "λ_N comes to 0"),
    ("slips forwards", "apart"): ("force", "λ_N comes to 0"),
    ("slips backwards", "apart"): ("force", "λ_N comes to 0"),
    ("sticks", "slips forwards"): ("slips", "λ_T = −μ_s λ_N"),
    ("sticks", "slips backwards"): ("slips", "λ_T = +μ_s λ_N"),
    ("slips forwards", "sticks"): ("sticks", "v_T comes to 0"),
    ("slips backwards", "sticks"): ("sticks", "v_T comes to 0"),
    ("slips forwards", "slips backwards"): ("sticks", "v_T comes to 0, and λ_T to stick would be beyond ± μ_s λ_N"),
    ("slips backwards", "slips forwards"): ("sticks", "v_T comes to 0, and λ_T to stick would be beyond ± μ_s λ_N"),
}

_BOX: Point = (220, 96)
_MONO = 'font-style="normal" font-family="DejaVu Sans Mono, Menlo, monospace" font-size="13"'
_ARROW = f'fill="none" stroke="{INK}" stroke-width="1.6" marker-end="url(#arrow{INK[1:]})"'

#: Of each straight arrow: where it begins, where it ends, where its text is, and how that is aligned.
_WAYS: dict[tuple[str, str], tuple[Point, Point, Point, str]] = {
    ("apart", "slips backwards"): ((340, 360), (150, 228), (224, 253), "start"),
    ("slips backwards", "apart"): ((100, 228), (340, 395), (205, 325), "end"),
    ("apart", "slips forwards"): ((560, 360), (750, 228), (676, 253), "end"),
    ("slips forwards", "apart"): ((800, 228), (560, 395), (695, 325), "start"),
    ("apart", "sticks"): ((438, 327), (438, 228), (430, 287), "end"),
    ("sticks", "apart"): ((462, 228), (462, 327), (470, 287), "start"),
    ("slips backwards", "sticks"): ((225, 155), (340, 155), (282, 155), "middle"),
    ("sticks", "slips backwards"): ((340, 205), (225, 205), (282, 205), "middle"),
    ("slips forwards", "sticks"): ((675, 155), (560, 155), (618, 155), "middle"),
    ("sticks", "slips forwards"): ((560, 205), (675, 205), (618, 205), "middle"),
}


def _straight(s: Sketch, event: tuple[str, str], way: tuple[Point, Point, Point, str]) -> list[str]:
    """An arrow and its event: above and below it where it is level, else beside it."""
    start, end, at, anchor = way
    high, low = (-7, 17) if anchor == "middle" else (-2, 15)
    name, text = event
    return [
        s.path([start, end], _ARROW),
        words(s, at, text, SMALL, dy=high, anchor=anchor),
        words(s, at, f".{name}", _MONO, dy=low, anchor=anchor),
    ]


def _bow(s: Sketch, start: Point, end: Point, depth: float) -> list[str]:
    """An arrow to both sides below what lies between: the slip goes on the other way at once."""
    points = [add(along(start, end, k / 40), (0.0, -depth * math.sin(math.pi * k / 40))) for k in range(41)]
    (event,) = {EVENTS[pair] for pair in permutations(("slips backwards", "slips forwards"), 2)}
    name, text = event
    return [
        s.path(points, f'{_ARROW} marker-start="url(#arrow{INK[1:]})"'),
        words(s, points[20], text, SMALL, dy=18),
        words(s, points[20], f".{name}", _MONO, dy=36),
    ]


def modes_drawing() -> str:
    """The picture as SVG text."""
    s = Sketch((0, HEIGHT), 1.0)
    parts = [text for pair, way in _WAYS.items() for text in _straight(s, EVENTS[pair], way)]
    parts += _bow(s, (115, 132), (785, 132), 80.0)
    for name, (place, colour, law) in MODES.items():
        parts.append(s.box(place, *_BOX, 0.0, colour))
        parts.append(words(s, place, name, 'font-size="19"', dy=-8, edge=""))
        parts.append(words(s, place, law, dy=22, edge=""))
    return sheet(WIDTH, HEIGHT, "The four modes of a contact with friction, and the events between them", parts)
