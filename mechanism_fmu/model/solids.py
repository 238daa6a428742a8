"""Bodies by what one knows of them: a bar between two points, a plate with holes, a disc, or any body where it stands.

Points and dimensions are those of a drawing: each body has a frame of its own, in which `at` counts, and which lies
where the sketch has it at the start. Mass, centre of mass and inertia follow. Numbers may be symbolic, or texts with
units, such as "5 mm".
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

from .areas import CircularHole, circle_area, polygon
from .body import Body, Point
from .errors import MechanismError
from .findings import length as length_of, literal, refuse, refuse_unless
from .functions import Number, atan2, cos, is_plain, sin
from .members import Section
from .outlines import Outline
from .quantities import pair, quantity

# Materials.


class Dense(Protocol):
    """What a body may be made of: anything with a density."""

    @property
    def density(self) -> Number:
        """[kg/m3]."""


@dataclass(frozen=True)
class Material:
    """What bodies are made of.

    Attributes:
        density: [kg/m3], > 0.
        young: modulus of elasticity E [Pa], > 0, for `Member`.
    """

    density: Number
    young: Number


#: Steel, usual handbook values, those of `mechanism_fmu.stress`.
STEEL = Material(7850.0, 2.06e11)
#: Wrought aluminium alloys, EN 1999-1-1, 3.2.5.
ALUMINIUM = Material(2700.0, 7.0e10)
#: Brass CuZn39Pb3, usual handbook values.
BRASS = Material(8470.0, 9.7e10)
#: Polyoxymethylene (POM-C), usual handbook values.
POM = Material(1410.0, 2.8e9)

# Bodies.


def bar(
    name: str,
    a: Point,
    b: Point | None = None,
    *,
    mass: Number | None = None,
    section: Section | None = None,
    material: Dense | None = None,
    length: Number | None = None,
    angle: Number | None = None,
    centre: Point | None = None,
    inertia: Number | None = None,
    velocity: tuple[Number, Number] = (0.0, 0.0),
    speed: Number = 0.0,
    tooth_length: Number | None = None,
) -> Body:
    """A straight bar; its frame stands at `a` with the x axis towards `b`, its ends are `.a` and `.b`.

    Args:
        name: unique within the mechanism.
        a: where it begins at the start, in the global frame [m]: a sketch, from which assembly closes the joints.
        b: where it ends, likewise [m]; or, in its place, `length` and `angle`.
        mass: [kg]; or, in its place, `section` and `material`.
        section: its cross section, with a `material`.
        material: of the bar, with a `section`.
        length: between its ends [m]; beside b, where the sketch is not to scale.
        angle: at the start [rad], in place of b.
        centre: of mass, in its frame [m]; in the middle unless given.
        inertia: about its centre of mass [kg m2]; mass length^2/12 unless given, with a section also that one's own,
            density second_moment length.
        velocity: of its end a at the start [m/s]; where a coordinate is held, the rates of all others follow.
        speed: angular, at the start [rad/s].
        tooth_length: as of `Body`.

    Raises:
        MechanismError: neither a mass nor section and material are given, or both; likewise of b and an angle with a
            length; a plain length is negative; or a text is no such quantity.

    Source: textbook: mass moments of inertia, thin rod m L^2/12, and of a section rho I L more; J. L. Meriam, L. G.
        Kraige, Engineering Mechanics: Dynamics.
    """
    label = f"bar {name!r}"
    begin = _point(a, label, "a")
    long = quantity(length, "m", f"{label}: length")
    if b is None and angle is not None and length is not None:
        turned = angle
    elif b is not None and angle is None:
        end = _point(b, label, "b")
        way = (end[0] - begin[0], end[1] - begin[1])
        turned, long = atan2(way[1], way[0]), length_of(way) if length is None else long
    else:
        raise MechanismError(f"{label}: say where it ends, by b, or else by length and angle.")
    if is_plain(long) and not 0.0 <= long < math.inf:  # of parameters, their own limits are asked for
        raise MechanismError(f"{label}: length = {long:g} m, but it must be finite and not negative.")
    if (mass is None) == (section is None) or (section is None) != (material is None):
        raise MechanismError(f"{label}: give its mass, or else section and material, from which the mass follows.")
    own: Number | None = None
    if section is not None and material is not None:
        mass = material.density * section.area * long
        own = material.density * section.second_moment * long
    mass = quantity(mass, "kg", f"{label}: mass")
    if inertia is None:
        inertia = mass * long * long / 12 if own is None else mass * long * long / 12 + own
    return _body(
        name,
        mass,
        quantity(inertia, "kg.m2", f"{label}: inertia"),
        (long / 2, 0.0) if centre is None else _point(centre, label, "centre"),
        _Start(begin, turned, velocity, speed, label),
        ((0.0, 0.0), (long, 0.0)),
        tooth_length=tooth_length,
    )


def plate(
    name: str,
    outline: Sequence[Point] | Outline,
    *,
    holes: Iterable[CircularHole | Sequence[Point] | Outline] = (),
    thickness: Number | None = None,
    material: Dense | None = None,
    mass: Number | None = None,
    at: Point = (0.0, 0.0),
    angle: Number = 0.0,
    velocity: tuple[Number, Number] = (0.0, 0.0),
    speed: Number = 0.0,
    tooth_length: Number | None = None,
) -> Body:
    """A plate of constant thickness, drawn in a frame of its own; `.corners` are those of its outline.

    Args:
        name: unique within the mechanism.
        outline: its corners in its frame, in either sense [m], or an `Outline`, which may have arcs; the edges must not
            cross each other.
        holes: what is cut out, inside the outline and apart from each other: a `CircularHole`, corners [m], or an
            `Outline` that is a hole.
        thickness: [m], with a `material`; or, in place of both, `mass`.
        material: of the plate.
        mass: of the plate with its holes [kg].
        at: where the origin of its frame is at the start, in the global frame [m].
        angle: of its frame, at the start [rad].
        velocity: of the origin of its frame at the start [m/s]; as of `bar`.
        speed: angular, at the start [rad/s].
        tooth_length: as of `Body`.

    Raises:
        MechanismError: there is no area; neither or both of mass and thickness with material are given; or a text is no
            such quantity.

    Source: textbook: moments of a polygon's area by Green's theorem, sums over its edges; the centre of mass by
        Steiner's theorem, J = m (polar/A - x^2 - y^2).
    """
    label = f"plate {name!r}"
    corners = outline.drawn() if isinstance(outline, Outline) else _corners(outline, label, "outline")
    # Integrals count from a corner: from an origin far away, differences of large numbers would take the digits.
    (x_first, y_first) = corners[0]

    def seen(point: Point) -> Point:
        return point[0] - x_first, point[1] - y_first

    if isinstance(outline, Outline):
        left = outline.seen_from(corners[0], f"{label}: its outline")
    else:
        left = polygon([seen(corner) for corner in corners])
    for number, hole in enumerate(holes, start=1):
        what = f"hole {number}"
        if isinstance(hole, Outline):
            if not hole.hole:
                raise MechanismError(f"{label}: {what} is not a hole; make it with hole=True, clockwise.")
            left = left.without(hole.seen_from(corners[0], f"{label}: {what}"))
        elif isinstance(hole, CircularHole):
            middle = seen(_point(hole.centre, label, f"centre of {what}"))
            left = left.without(circle_area(middle, quantity(hole.radius, "m", f"{label}: radius of {what}")))
        else:
            left = left.without(polygon([seen(corner) for corner in _corners(hole, label, what)]))
    text = f"{literal(label)} has an area of {{:g}} m2, but it must be positive; look at its corners."
    refuse(refuse_unless(left.area, text, left.area + 0.0))
    total = _mass(label, mass, thickness, material, left.area)
    x, y = left.first[0] / left.area, left.first[1] / left.area
    inertia = total * (left.polar / left.area - (x * x + y * y))
    start = _Start(at, angle, velocity, speed, label)
    centre = x + x_first, y + y_first
    return _body(name, total, inertia, centre, start, tuple(corners), tooth_length=tooth_length)


def disc(
    name: str,
    at: Point = (0.0, 0.0),
    *,
    radius: Number,
    bore: Number = 0.0,
    thickness: Number | None = None,
    material: Dense | None = None,
    mass: Number | None = None,
    angle: Number = 0.0,
    velocity: tuple[Number, Number] = (0.0, 0.0),
    speed: Number = 0.0,
    tooth_length: Number | None = None,
) -> Body:
    """A disc or ring; its frame stands in its centre.

    Args:
        name: unique within the mechanism.
        at: where its centre is at the start, in the global frame [m].
        radius: R of its rim [m].
        bore: r, radius of the round hole in its middle [m]; the inertia is mass (R^2 + r^2)/2.
        thickness: [m], with a `material`; or, in place of both, `mass`.
        material: of the disc.
        mass: [kg].
        angle: of its frame, at the start [rad].
        velocity: of its centre at the start [m/s]; as of `bar`.
        speed: angular, at the start [rad/s].
        tooth_length: as of `Body`.

    Raises:
        MechanismError: as of `plate`; or, of plain numbers, the radius is not positive, or the bore is negative or not
            less than the radius.

    Source: textbook: mass moment of inertia of a hollow cylinder about its axis, m (R^2 + r^2)/2.
    """
    label = f"disc {name!r}"
    rim, inner = quantity(radius, "m", f"{label}: radius"), quantity(bore, "m", f"{label}: bore")
    if is_plain(rim) and not 0.0 < rim < math.inf:
        raise MechanismError(f"{label}: radius = {rim:g} m, but it must be finite and positive.")
    if is_plain(inner) and not 0.0 <= inner < (rim if is_plain(rim) else math.inf):
        raise MechanismError(f"{label}: bore = {inner:g} m, but it must not be negative, and less than the radius.")
    squares = rim * rim + inner * inner
    total = _mass(label, mass, thickness, material, math.pi * (rim * rim - inner * inner))
    start = _Start(at, angle, velocity, speed, label)
    return _body(name, total, total * squares / 2, (0.0, 0.0), start, ((0.0, 0.0),), rim, tooth_length)


def rigid_body(
    name: str,
    at: Point = (0.0, 0.0),
    *,
    mass: Number,
    inertia: Number,
    centre: Point = (0.0, 0.0),
    angle: Number = 0.0,
    velocity: tuple[Number, Number] = (0.0, 0.0),
    speed: Number = 0.0,
    outline: Sequence[Point] = (),
    tooth_length: Number | None = None,
) -> Body:
    """A body of any shape, with a frame where it suits.

    Args:
        name: unique within the mechanism.
        at: where the origin of its frame is at the start, in the global frame [m].
        mass: [kg].
        inertia: about its centre of mass [kg m2].
        centre: of mass, in its frame [m].
        angle: of its frame, at the start [rad].
        velocity: of the origin of its frame at the start [m/s]; as of `bar`.
        speed: angular, at the start [rad/s].
        outline: corners of its shape in its frame [m], for drawings.
        tooth_length: as of `Body`.

    Raises:
        MechanismError: a text is no such quantity.

    Source: textbook: kinematics of a point of a rigid body, r = at + A(angle) centre, v = velocity + speed R A(angle)
        centre.
    """
    label = f"rigid_body {name!r}"
    corners = tuple(_point(corner, label, "outline") for corner in outline)
    start = _Start(at, angle, velocity, speed, label)
    total, about = quantity(mass, "kg", f"{label}: mass"), quantity(inertia, "kg.m2", f"{label}: inertia")
    return _body(name, total, about, _point(centre, label, "centre"), start, corners, tooth_length=tooth_length)


class _Start(NamedTuple):
    """Where the frame of a body is at the start, and how fast it moves."""

    at: Point
    angle: Number
    velocity: tuple[Number, Number]
    speed: Number
    label: str


def _body(
    name: str,
    mass: Number,
    inertia: Number,
    centre: Point,
    start: _Start,
    outline: tuple[Point, ...],
    radius: Number = 0.0,
    tooth_length: Number | None = None,
) -> Body:
    """The body with a frame that lies as `start` says."""
    x, y = _point(start.at, start.label, "at")
    angle = quantity(start.angle, "rad", f"{start.label}: angle")
    speed = quantity(start.speed, "rad/s", f"{start.label}: speed")
    u, v = pair(start.velocity, "m/s", f"{start.label}: velocity")
    c, s = cos(angle), sin(angle)
    dx, dy = c * centre[0] - s * centre[1], s * centre[0] + c * centre[1]
    return Body(
        name,
        mass,
        inertia,
        (x + dx, y + dy, angle),
        (u - speed * dy, v + speed * dx, speed),
        tooth_length,
        centre=centre,
        outline=outline,
        radius=radius,
    )


def _mass(label: str, mass: Number | None, thickness: Number | None, material: Dense | None, area: Number) -> Number:
    if (mass is None) == (thickness is None) or (thickness is None) != (material is None):
        raise MechanismError(f"{label}: give its mass, or else thickness and material, from which the mass follows.")
    if material is None:
        return quantity(mass, "kg", f"{label}: mass")
    return material.density * quantity(thickness, "m", f"{label}: thickness") * area


def _point(point: Point, label: str, what: str) -> Point:
    return pair(point, "m", f"{label}: {what}")


def _corners(points: Sequence[Point], label: str, what: str) -> list[Point]:
    corners = [_point(point, label, what) for point in points]
    if len(corners) < 3:
        raise MechanismError(f"{label}: {what} has {len(corners)} corners, but it takes at least 3.")
    return corners
