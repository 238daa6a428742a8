"""Picture of two bodies that have gone into each other: both as a whole, and the place of overlap magnified."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from .. import codes
from .body import Point
from .contacts import AngleLock, AngleStop, Contact, PointLineContact
from .curves.check_curves import value_and_slope
from .outline_contacts import CircularCopies, LinearCopies
from .outlines import Outline
from .outlines.features import Feature, features
from .overlap_view import Line, Panel, Part, sheet

#: Position of a body's frame [m] and its angle [rad].
Pose = tuple[float, float, float]

#: The magnified picture reaches so many depths to each side.
_DEPTHS = 5.0
#: Copies of a row that are looked at, on either side of the first.
_IN_A_ROW = 50
#: A pair of features is where bodies overlap if its gap is the depth within this share of it.
_SAME = 1e-3
#: Points of a profile.
_SAMPLES = 720


class _Place(NamedTuple):
    """Where two bodies overlap: the deepest point of the one inside, and the way out of the other, of length 1."""

    point: Point
    normal: Point


def overlap_picture(
    contact: Contact, poses: Mapping[str, Pose], line: Sequence[float], depth: float, time: float
) -> str:
    """An SVG picture of two bodies that have gone into each other.

    On the left both are shown as a whole, on the right the place of overlap, so large that its depth is seen, with a
    red line that is as long. Of a contact of angles there is the left one only.

    Args:
        contact: that is inside.
        poses: of its two bodies, by name: where their frames stand [m, m, rad].
        line: of a contact of a line, its present point and normal in the frame of body j [m, 1]; of a contact of
            angles, the present angle of the stop [rad].
        depth: by how much they overlap [m or rad].
        time: of the motion [s].

    Returns:
        A whole SVG file.
    """
    title = f"{contact.name}: {contact.body_i} in {contact.body_j}, t = {time:.9g} s"
    before, behind = contact.too_deep()
    text = f"{before} {depth:.6g} {behind}"
    if isinstance(contact, AngleStop | AngleLock):
        return sheet(title, text, [Panel([*_angles(contact, poses, line[0])])])
    parts, place = _shapes(contact, poses, line, depth)
    whole = Panel(parts, None if place is None else Line((place.point, place.point), "overlap"))
    if place is None:
        return sheet(title, text, [whole])
    (x, y), (nx, ny) = place
    out = Line(((x, y), (x + depth * nx, y + depth * ny)), "overlap")
    return sheet(title, text, [whole, Panel(parts, out, place.point, _DEPTHS * depth)])


def _placed(pose: Pose, point: Point) -> Point:
    c, s = math.cos(pose[2]), math.sin(pose[2])
    return pose[0] + c * point[0] - s * point[1], pose[1] + s * point[0] + c * point[1]


def _turned(pose: Pose, way: Point) -> Point:
    return _placed((0.0, 0.0, pose[2]), way)


def _angles(contact: AngleStop | AngleLock, poses: Mapping[str, Pose], limit: float) -> Iterator[Part]:
    """Both bodies' directions as hands of a clock, and that of the stop between them."""
    at = poses[contact.body_i]
    for owner, angle, kind in (
        ("i", at[2], "line"),
        ("j", poses[contact.body_j][2] + limit, "line"),
    ):
        yield Part([at[:2], (at[0] + math.cos(angle), at[1] + math.sin(angle))], owner, kind)


def _shapes(
    contact: Any, poses: Mapping[str, Pose], line: Sequence[float], depth: float
) -> tuple[list[Part], _Place | None]:
    """What of the two bodies touches, and where they overlap."""
    one, other = poses[contact.body_i], poses[contact.body_j]
    if contact.has_outlines:
        copies = contact.copies
        parts = [*_drawn(contact.outline_i, None, one, "i"), *_drawn(contact.outline_j, copies, other, "j")]
        return parts, _deepest(contact.outline_i, one, contact.outline_j, copies, other, depth)
    if isinstance(contact, PointLineContact):
        point, normal = _placed(one, contact.point_i), _turned(other, (line[2], line[3]))
        arm = Part([one[:2], point], "i", "line")
        foot = (point[0] + depth * normal[0], point[1] + depth * normal[1])
        reach = max(math.dist(point, one[:2]), math.dist(foot, other[:2]), 2.0 * _DEPTHS * depth)
        return [arm, Part(_behind(foot, normal, reach), "j", "body")], _Place(point, normal)
    parts = []
    for side, pose in (("i", one), ("j", other)):
        profile = getattr(contact, f"profile_{side}", None)
        if profile is not None:
            points = [_placed(pose, p) for p in _profile(profile, getattr(contact, f"centre_{side}"))]
            parts.append(Part(points, side, "body" if profile.periodic else "line"))
        elif hasattr(contact, "direction_j"):
            x, y = _turned(pose, contact.direction_j)
            long = math.hypot(x, y) or 1.0
            reach = 2.0 * math.dist(one[:2], other[:2]) + depth
            u, v = _placed(pose, contact.point_j)
            ends = [(u + k * reach * x / long, v + k * reach * y / long) for k in (-1.0, 1.0)]
            parts.append(Part(ends, side, "line"))
        else:
            parts.append(Part([pose[:2], _placed(pose, contact.point_i)], side, "line"))
    return parts, None


def _behind(through: Point, normal: Point, reach: float) -> list[Point]:
    """The material behind a line, as far as the picture may show."""
    (x, y), (nx, ny) = through, normal
    corners = ((-1.0, 0.0), (1.0, 0.0), (1.0, -1.0), (-1.0, -1.0))
    return [(x + reach * (nx * b + ny * a), y + reach * (ny * b - nx * a)) for a, b in corners]


def _profile(profile: Any, centre: Point) -> list[Point]:
    found = []
    pieces = list(profile.pieces)
    for k in range(_SAMPLES):
        alpha = profile.start + profile.span * k / _SAMPLES
        piece = [p for p in pieces if p.start <= alpha or p is pieces[0]][-1]
        rho = value_and_slope(piece, alpha)[0]
        found.append((centre[0] + rho * math.cos(alpha), centre[1] + rho * math.sin(alpha)))
    return found


# Outlines.


def _copied(outline: Outline, copies: CircularCopies | LinearCopies | None) -> list[Outline]:
    if isinstance(copies, CircularCopies):
        return [outline.moved(angle=2.0 * math.pi * k / copies.count) for k in range(copies.count)]
    if isinstance(copies, LinearCopies):
        first, last = max(-((copies.count - 1) // 2), -_IN_A_ROW), min(copies.count // 2, _IN_A_ROW)
        return [outline.moved(k * copies.step[0], k * copies.step[1]) for k in range(first, last + 1)]
    return [outline]


def _drawn(outline: Outline, copies: CircularCopies | LinearCopies | None, pose: Pose, owner: str) -> Iterator[Part]:
    """Outline and copies, whose arcs stay arcs: magnified, straight lines through them would miss the overlap."""
    chains = [
        [(_placed(pose, e.start), _placed(pose, e.end), 0.0 if e.is_straight else float(e.bulge)) for e in one.elements]
        for one in _copied(outline, copies)
    ]
    if not outline.closed and isinstance(copies, CircularCopies):
        chains = [[element for chain in chains for element in chain]]  # teeth all around are one closed chain
        yield Part.of(chains[0], owner, "body")
        return
    for chain in chains:
        yield Part.of(chain, owner, "line" if outline.hole or not outline.closed else "body")


def _deepest(
    one: Outline, pose: Pose, other: Outline, copies: CircularCopies | LinearCopies | None, at: Pose, depth: float
) -> _Place | None:
    """The place of the two features whose gap is the depth; None where elements cross and no feature is inside."""
    found, least = None, _SAME * depth
    own = [*features(one)]
    for copy in _copied(other, copies):
        for its in features(copy):
            for mine in own:
                for place, gap in _touch(mine, pose, its, at):
                    off = abs(gap + depth)
                    if off <= least:
                        found, least = place, off
    return found


def _touch(mine: Feature, pose: Pose, its: Feature, at: Pose) -> Iterator[tuple[_Place, float]]:
    """Gap of two features, and where they touch: of a disc against a segment, or against another disc."""
    for (kind, data), frame, (partner, numbers), its_frame, flips in (
        (mine, pose, its, at, False),
        (its, at, mine, pose, True),
    ):
        if kind == codes.SEGMENT:
            continue
        (cx, cy), radius = _placed(frame, data[:2]), float(data[4]) if kind == codes.ARC else 0.0
        (qx, qy) = _placed(its_frame, numbers[:2])
        if partner == codes.SEGMENT:
            dx, dy = _turned(its_frame, (numbers[2], numbers[3]))
            along = dx * (cx - qx) + dy * (cy - qy)
            if 0.0 <= along <= numbers[4]:
                nx, ny = dy, -dx
                gap = nx * (cx - qx) + ny * (cy - qy) - radius
                yield _Place((cx - radius * nx, cy - radius * ny), (nx, ny)), gap
        elif not flips:
            second = float(numbers[4]) if partner == codes.ARC else 0.0
            apart = math.dist((cx, cy), (qx, qy))
            if apart > 0.0:
                way = -1.0 if min(radius, second) < 0.0 else 1.0
                nx, ny = (cx - qx) / apart * way, (cy - qy) / apart * way
                yield _Place((cx - radius * nx, cy - radius * ny), (nx, ny)), way * apart - radius - second
