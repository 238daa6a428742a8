"""Outlines as SVG paths: from drawing programs, and to them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from ..errors import MechanismError
from ..functions import is_plain
from .outline import Outline

#: What stands in a path: a letter, or a number.
_TOKEN = re.compile(r"([A-Za-z])|([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)")

#: A path ends where it begins when the ends are nearer than this part of the size of the coordinates.
_SAME = 1e-9
#: How many numbers belong to a command.
_NUMBERS = {"M": 2, "L": 2, "H": 1, "V": 1, "A": 7, "Z": 0}


def svg_path(outline: Outline, scale: float = 1e3) -> str:
    """The `d` of an SVG path: lines and circular arcs, y downwards as on a screen.

    Args:
        outline: of plain numbers.
        scale: units of the drawing per metre; 1000 for millimetres.

    Raises:
        MechanismError: its numbers are symbolic.
    """
    if not all(is_plain(number) for vertex in outline.vertices for number in vertex):
        raise MechanismError("An outline whose numbers follow from parameters has no path; give values first.")

    def said(point: tuple[float, float]) -> str:
        return f"{point[0] * scale:.17g},{0.0 - point[1] * scale:.17g}"

    parts = [f"M {said(outline.points[0])}"]
    for element in outline.elements:
        if element.is_straight:
            parts.append(f"L {said(element.end)}")
            continue
        r = f"{abs(element.radius) * scale:.17g}"
        parts.append(f"A {r} {r} 0 {int(abs(element.bulge) > 1)} {int(element.bulge < 0)} {said(element.end)}")
    return " ".join(parts) + (" Z" if outline.closed else "")


def from_svg_path(path: str, scale: float = 1e3, *, hole: bool = False) -> Outline:
    """An outline from the `d` of an SVG path of one chain: M, L, H, V, A with equal radii, Z; also in small letters.

    Args:
        path: y downwards, as on a screen.
        scale: units of the drawing per metre, > 0; 1000 for millimetres.
        hole: as of `Outline`.

    Raises:
        MechanismError: the scale is not positive, another command (curves are to be approximated by arcs first), an
            ellipse, or a number missing.

    Source: definition: W3C, Scalable Vector Graphics (SVG) 2, Paths; the bulge of an arc with a given radius, chord and
        flags: tan(sweep/4).
    """
    if not scale > 0.0:
        raise MechanismError(f"scale = {scale:g}, but it must be positive; give 1000 for a drawing in millimetres.")
    vertices: list[tuple[float, float, float]] = []
    x = y = 0.0
    closed = False
    for command, numbers in _commands(path):
        if closed:
            raise MechanismError("The path goes on behind Z: it is more than one chain; give one outline for each.")
        bulge = 0.0
        if command in "Zz":
            closed = True
            continue
        if command in "Mm" and vertices:
            raise MechanismError("The path has a second M: it is more than one chain; give one outline for each.")
        base = (x, y) if command.islower() else (0.0, 0.0)
        if command in "Hh":
            x = base[0] + numbers[0]
        elif command in "Vv":
            y = base[1] + numbers[0]
        else:
            end = base[0] + numbers[-2], base[1] + numbers[-1]
            if command in "Aa":
                bulge = _bulge(numbers, math.dist((x, y), end))
            x, y = end
        if bulge and vertices:
            vertices[-1] = (*vertices[-1][:2], bulge)
        vertices.append((x / scale, -y / scale, 0.0))
    size = max(abs(number) for x, y, _ in vertices for number in (x, y)) if vertices else 0.0
    if closed and len(vertices) > 1 and math.dist(vertices[0][:2], vertices[-1][:2]) <= _SAME * size:
        vertices.pop()
    return Outline(tuple(vertices), closed, hole)


def _commands(path: str) -> Iterator[tuple[str, list[float]]]:
    """Each command of a path with its numbers; what follows M without a letter is L."""
    tokens = _TOKEN.findall(path)
    rest = _TOKEN.sub("", path).strip(" ,\t\r\n")
    if rest:
        raise MechanismError(f"The path has {rest[:20]!r}, which is neither a letter nor a number.")
    k, command = 0, ""
    while k < len(tokens):
        if tokens[k][0]:
            command = tokens[k][0]
            k += 1
        count = _NUMBERS.get(command.upper())
        if count is None:
            what = repr(command) if command else "a number before its first letter"
            raise MechanismError(f"The path has {what}; it may have M, L, H, V, A, Z: make arcs of curves first.")
        numbers = [float(number) for _, number in tokens[k : k + count] if number]
        if len(numbers) < count:
            raise MechanismError(f"The path's command {command} needs {count} numbers, but has {len(numbers)}.")
        yield command, numbers
        k += count
        command = {"M": "L", "m": "l"}.get(command, command)
        if count == 0:
            command = "M"  # what numbers behind Z are taken for


def _bulge(numbers: list[float], chord: float) -> float:
    """Of an SVG arc: radii, rotation, large, sweep; a radius that is too small is the least that reaches."""
    rx, ry, _, large, sweep = numbers[:5]
    if {large, sweep} - {0.0, 1.0}:
        flags = f"{large:g} and {sweep:g}"
        raise MechanismError(f"The path has an arc with flags {flags}; write 0 or 1, and a space between.")
    if chord == 0.0:
        raise MechanismError("The path has an arc that ends where it begins; draw a circle as two arcs.")
    if rx == 0.0 or ry == 0.0:
        return 0.0  # a straight line, says SVG
    if not math.isclose(rx, ry, rel_tol=1e-9):
        raise MechanismError(f"The path has an arc of an ellipse, with radii {rx:g} and {ry:g}; give a circle's.")
    radius = max(abs(rx), chord / 2)
    half = math.asin(min(chord / (2 * radius), 1.0))  # of the sweep, for the small arc
    tangent = math.tan(half / 2)
    bulge = 1.0 / tangent if large else tangent
    return -bulge if sweep else bulge
