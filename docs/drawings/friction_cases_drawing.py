"""The eight kinds of cases of `tests/data/friction.json`, one small panel each; drawn by `friction_drawing`."""

from __future__ import annotations

import math
from collections.abc import Callable

from docs.elements.pieces import ElementSketch
from docs.joints.sketch import AXIS, BODY_I, BODY_J, EDGE, LINE, add, scale

from .pictures import INK, Point, polar, sheet
from .plane import SMALL, words

_BRAKE = f'fill="none" stroke="{INK}" stroke-width="1.6"'
_FLOOR = 0.2


def _floor(s: ElementSketch, start: float = 0.1, end: float = 1.9) -> str:
    return s.ground((start, _FLOOR), (end, _FLOOR))


def _arrow(s: ElementSketch, start: Point, way: Point, text: str, dx: float = 0.0, dy: float = 0.0) -> str:
    """An arrow with its letter beside its head."""
    end = add(start, way)
    return s.vector(start, end, "") + words(s, end, text, dx=dx, dy=dy)


def _slope(s: ElementSketch) -> list[str]:
    angle = math.radians(20)
    foot: Point = (0.15, 0.15)
    along, across = polar((0, 0), 1.0, angle), polar((0, 0), 1.0, angle + 0.5 * math.pi)
    middle = add(foot, scale(along, 0.85), scale(across, 0.17))
    return [
        s.ground(foot, add(foot, scale(along, 1.75))),
        s.path([foot, add(foot, (1.5, 0.0))], AXIS),
        s.angle(foot, 1.25, 0.0, angle, "α"),
        s.box(middle, 0.5, 0.34, angle, BODY_I),
        _arrow(s, add(middle, scale(along, 0.27)), scale(along, 0.45), "v, F", -8, -8),
    ]


def _belt(s: ElementSketch) -> list[str]:
    radius, left, right, high = 0.17, 0.55, 1.65, 0.32
    top = high + radius
    rim = [polar((right, high), radius, math.pi * (0.5 - k / 16)) for k in range(17)]
    rim += [polar((left, high), radius, math.pi * (1.5 - k / 16)) for k in range(17)]
    return [
        s.path(rim, f'fill="{BODY_J}" fill-opacity="0.75" {EDGE}', closed=True),
        *(s.disc((x, high), 0.06, f'fill="#fff" {EDGE}') for x in (left, right)),
        s.ground((0.12, top + 0.5), (0.12, top - 0.1)),
        s.spring((0.12, top + 0.2), (0.8, top + 0.2), 5, 0.08),
        s.box((1.05, top + 0.2), 0.5, 0.4, 0.0, BODY_I),
        _arrow(s, (1.4, top + 0.1), (0.4, 0.0), "v", 0, -8),
    ]


def _disc(s: ElementSketch) -> list[str]:
    radius = 0.42
    middle: Point = (0.75, _FLOOR + radius)
    return [
        _floor(s),
        s.disc(middle, radius, f'fill="{BODY_I}" fill-opacity="0.75" {EDGE}'),
        s.angle(middle, 0.26, math.radians(-30), math.radians(200), "ω", -8),
        _arrow(s, add(middle, (radius + 0.05, 0.0)), (0.45, 0.0), "v", 0, -8),
    ]


def _sliding_rod(s: ElementSketch) -> list[str]:
    foot: Point = (0.75, _FLOOR)
    angle = math.radians(52)
    return [
        _floor(s),
        s.box(polar(foot, 0.5, angle), 1.0, 0.07, angle, BODY_I),
        s.angle(foot, 0.4, 0.0, angle, "θ", 10),
        _arrow(s, foot, (-0.5, 0.0), "v_T", 4, -9),
        s.dot(foot),
    ]


def _striking_rod(s: ElementSketch) -> list[str]:
    foot: Point = (0.6, _FLOOR + 0.16)
    angle = math.radians(53)
    middle = polar(foot, 0.45, angle)
    return [
        _floor(s),
        s.box(middle, 0.9, 0.07, angle, BODY_I),
        _arrow(s, add(middle, (0.1, 0.0)), (0.25, -0.45), "v", 12, 0),
        s.dot(foot),
    ]


def _rocking(s: ElementSketch) -> list[str]:
    corner: Point = (0.75, _FLOOR)
    wide, high, angle = 0.4, 0.95, math.radians(14)
    along, up = polar((0, 0), wide, angle), polar((0, 0), high, angle + 0.5 * math.pi)
    middle = add(corner, scale(add(along, up), 0.5))
    return [
        _floor(s),
        s.box(middle, wide, high, angle, BODY_I),
        s.angle(corner, 0.75, 0.0, angle, "θ", 12),
        s.dot(corner),
        s.dot(add(corner, along)),
    ]


def _stack(s: ElementSketch) -> list[str]:
    return [
        _floor(s),
        s.box((0.85, _FLOOR + 0.17), 0.95, 0.34, 0.0, BODY_J),
        s.box((0.85, _FLOOR + 0.49), 0.6, 0.3, 0.0, BODY_I),
        _arrow(s, (1.16, _FLOOR + 0.49), (0.5, 0.0), "F(t)", 0, -9),
    ]


def _pendulum(s: ElementSketch) -> list[str]:
    pin: Point = (0.8, 0.95)
    down, angle = -0.5 * math.pi, math.radians(48)
    bob = polar(pin, 0.62, down + angle)
    shoe = [polar(pin, 0.2, math.radians(90 + 4 * k)) for k in range(-12, 13)]
    return [
        s.ground((1.05, 1.22), (0.55, 1.22)),
        s.path([pin, (0.8, 1.22)], LINE),
        s.path([pin, (pin[0], 0.2)], AXIS),
        s.path([pin, bob], f'fill="none" stroke="{INK}" stroke-width="3"'),
        s.disc(bob, 0.16, f'fill="{BODY_I}" {EDGE}'),
        s.disc(pin, 0.16, f'fill="#fff" {EDGE}'),
        s.path(shoe, f'fill="none" stroke="{INK}" stroke-width="5"'),
        s.disc(pin, 0.04, f'fill="{INK}"'),
        s.angle(pin, 0.5, down, down + angle, "θ", 12),
    ]


#: Of each kind: what it is called on its panel, and what is drawn.
PANELS: dict[int, tuple[str, Callable[[ElementSketch], list[str]]]] = {
    1: ("block on a slope", _slope),
    2: ("mass on a belt", _belt),
    3: ("slip becomes rolling", _disc),
    4: ("rod slides on its end", _sliding_rod),
    5: ("rod strikes the floor", _striking_rod),
    6: ("rocking block", _rocking),
    7: ("two blocks", _stack),
    8: ("pendulum with a brake", _pendulum),
}


def cases_drawing() -> str:
    """The picture as SVG text."""
    wide, high, size = 215, 180, 100.0
    parts: list[str] = []
    for kind, (name, draw) in PANELS.items():
        row, column = divmod(kind - 1, 4)
        s = ElementSketch((15 + wide * column, 145 + high * row), size)
        parts += draw(s)
        parts.append(words(s, (1.0, 0.0), f"{kind}  {name}", SMALL, dy=16))
    return sheet(4 * wide + 15, 2 * high, "The eight kinds of cases with known answers", parts)
