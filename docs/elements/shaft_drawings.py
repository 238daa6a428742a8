"""Drawings of what drives or brakes a body: shaft, brake and motor."""

from __future__ import annotations

from docs.drawings.pictures import Point
from docs.joints.sketch import BODY_I, BODY_J, EDGE, LINE

from .pieces import ElementSketch, element_sheet, element_sketch


def _side_by_side(s: ElementSketch, left: float, right: float, y: float) -> list[str]:
    """A spring above a damper between two cross bars."""
    bars = [[(x, y - 0.3), (x, y + 0.3)] for x in (left, right)]
    return [
        *(s.path(bar, LINE) for bar in bars),
        s.spring((left, y + 0.3), (right, y + 0.3)),
        s.damper((left, y - 0.3), (right, y - 0.3)),
    ]


def compliant_shaft() -> str:
    """A driven end, spring and damper, a body; all in one line for angles."""
    s = element_sketch()
    y = 1.4
    return element_sheet(
        "CompliantShaft",
        [
            s.box((0.6, y), 0.25, 1.3, 0.0, BODY_J),
            s.box((3.8, y), 0.9, 1.3, 0.0, BODY_I),
            s.path([(0.72, y), (1.2, y)], LINE),
            s.path([(2.9, y), (3.35, y)], LINE),
            *_side_by_side(s, 1.2, 2.9, y),
            s.note((0.6, y + 1.05), "angle, speed"),
            s.note((3.8, y), "body"),
            s.note((2.05, y + 0.72), "stiffness"),
            s.note((2.05, y - 0.72), "damping"),
        ],
    )


def brake() -> str:
    """A disc on a shaft between two linings, which are pressed on it."""
    s = element_sketch()
    y, x = 1.4, 1.6
    return element_sheet(
        "Brake",
        [
            s.path([(x, y), (3.35, y)], LINE),
            s.box((x, y), 0.2, 1.9, 0.0, BODY_I),
            s.box((3.8, y), 0.9, 1.3, 0.0, BODY_I),
            *(s.box((x + side * 0.19, y + 0.62), 0.16, 0.5, 0.0, "#52606d") for side in (-1.0, 1.0)),
            *(s.box((x + side * 0.4, y + 0.62), 0.26, 0.7, 0.0, BODY_J) for side in (-1.0, 1.0)),
            s.path([(x - 0.4, y + 0.97), (x - 0.4, y + 1.25), (x + 0.4, y + 1.25), (x + 0.4, y + 0.97)], LINE),
            s.ground((x + 0.6, y + 1.25), (x - 0.6, y + 1.25)),
            s.note((3.8, y), "body"),
            s.note((0.25, y + 0.62), "reaction"),
            s.note((x, y - 1.2), "holds up to ± limit"),
        ],
    )


def dc_motor() -> str:
    """The armature's circuit, fed by the controller."""
    s = element_sketch()
    top, bottom = 2.1, 0.7
    motor: Point = (3.6, 1.4)
    wires = [[(1.2, top), (1.6, top)], [(2.2, top), (2.45, top)], [(3.05, top), (3.6, top), (3.6, 1.8)]]
    wires += [[(1.2, bottom), (3.6, bottom), (3.6, 1.0)], [(1.2, top), (1.2, bottom)]]
    return element_sheet(
        "DCMotor",
        [
            *(s.path(wire, LINE) for wire in wires),
            s.box((1.9, top), 0.6, 0.24, 0.0, "#ffffff"),
            s.box((2.75, top), 0.6, 0.24, 0.0, "#52606d"),
            s.disc(motor, 0.4, f'fill="{BODY_I}" {EDGE}'),
            s.box((0.55, 1.4), 1.3, 0.7, 0.0, BODY_J),
            s.note((0.55, 1.4), "controller"),
            s.text((1.9, top), "R", 0, -28),
            s.text((2.75, top), "L", 0, -28),
            s.text(motor, "K ω"),
            s.text((1.2, 0.9), "u", 16, 0),
            s.vector((3.15, top + 0.12), (3.5, top + 0.12), "i", 0, -14),
            s.vector((0.55, 2.5), (0.55, 1.78), "speed", 34, -6, 0.2),
            s.note((4.3, 1.4), "body"),
        ],
    )
