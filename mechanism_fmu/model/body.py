"""Bodies, and bodies whose numbers are parameters."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import SimpleNamespace

from .errors import MechanismError
from .functions import Number, cos, sin
from .quantities import pair, quantity, with_texts

#: A point or a vector (x, y) [m] in the frame of a body, from its centre of mass, or in the global frame.
Point = tuple[Number, Number]

# Ends: where parts are attached.


@dataclass(frozen=True)
class End:
    """A point of a body, or a straight line of it, that a part is attached to: `body.at(x, y)`, `body.line(...)`.

    Attributes:
        body: name of the body (or `GROUND`).
        point: from the centre of mass, in directions that turn with the body [m].
        direction: of the line, likewise, of any length > 0; None of a point. Its left is the open side of a contact.
    """

    body: str
    point: Point
    direction: Point | None = None


class Frame(ABC):
    """What can be built on: a frame of a body, or the fixed one, in which points are given."""

    __slots__ = ()

    @abstractmethod
    def _end(self, point: Point, direction: Point | None = None) -> End:
        """The end at a point of the frame [m], along a direction."""

    def at(self, x: Number, y: Number) -> End:
        """The point (x, y) [m] of the frame in which the body was drawn, as numbers or texts such as "5 mm".

        Args:
            x: [m], or a text such as "5 mm".
            y: [m], likewise.

        Raises:
            MechanismError: a text is no length.
        """
        return self._end((quantity(x, "m", "at: x"), quantity(y, "m", "at: y")))

    def line(self, point: Point, direction: Point | None = None, *, angle: Number | None = None) -> End:
        """The straight line through a point [m] along a direction, of any length > 0, or at an angle [rad].

        Args:
            point: (x, y) of the frame [m], or texts.
            direction: (dx, dy), of one unit and any length > 0; its left is the open side of a contact.
            angle: of the direction, in its place [rad], or a text.

        Raises:
            MechanismError: a text is no length or angle, point or direction is no pair, or not one of direction and
                angle is given.
        """
        if (direction is None) == (angle is None):
            raise MechanismError("line: it takes a direction (dx, dy) or an angle, one of the two.")
        if direction is None:
            angle = quantity(angle, "rad", "line: angle")
            direction = (cos(angle), sin(angle))
        else:
            direction = pair(direction, "1", "line: direction (of an angle, write angle=...)")
        return self._end(pair(point, "m", "line: point"), direction)


class Ground(str, Frame):
    """The name of the fixed frame, whose points are global: `GROUND.at(x, y)`."""

    __slots__ = ()

    def _end(self, point: Point, direction: Point | None = None) -> End:
        return End(self, point, direction)


#: The fixed frame: use it wherever a body is asked for. It is a text, "ground".
GROUND = Ground("ground")

# Names of what is read.


class NamedPoint:
    """The names of place and velocity of a point: of a body its centre of mass, of a marker its own.

    Attributes:
        name: of the body or marker.
    """

    __slots__ = ()

    name: str

    @property
    def x(self) -> str:
        """The name of the coordinate x of the point [m], for outputs; of a body also for `held`."""
        return f"{self.name}.x"

    @property
    def y(self) -> str:
        """The name of the coordinate y of the point [m], for outputs; of a body also for `held`."""
        return f"{self.name}.y"

    @property
    def x_rate(self) -> str:
        """The name of the velocity of the point along x [m/s], for outputs."""
        return f"{self.name}.x_rate"

    @property
    def y_rate(self) -> str:
        """The name of the velocity of the point along y [m/s], for outputs."""
        return f"{self.name}.y_rate"


# Rigid bodies.

#: Units of the numbers of a body, or of each of several.
_UNITS: Mapping[str, str | Sequence[str]] = {
    "mass": "kg",
    "inertia": "kg.m2",
    "start": ("m", "m", "rad"),
    "start_rate": ("m/s", "m/s", "rad/s"),
    "tooth_length": "m",
    "centre": "m",
    "radius": "m",
}


@dataclass(frozen=True)
class Body(Frame, NamedPoint):
    """A rigid body of the plane; its coordinates are (x, y) of the centre of mass and the angle phi.

    The frame in which it is drawn, that of `at`, turns with it; `centre` says where its centre of mass is there. By
    what one knows of a body: `bar`, `plate`, `disc`, `rigid_body`.

    Attributes:
        name: unique within the mechanism.
        mass: [kg], > 0.
        inertia: about the centre of mass [kg m2], > 0.
        start: guess of (x [m], y [m], phi [rad]) that `assemble` closes.
        start_rate: (xd [m/s], yd [m/s], phid [rad/s]) at the start. They must agree with the joints; where there are
            held coordinates, their rates are kept and the others follow.
        tooth_length: length l of its teeth as beams [m], > 0, if it has any. Every impact that changes its speed then
            has the impact velocity of the stress recovery, v_I = l (phid after - phid before). Only one body of a
            mechanism that reports v_I has teeth.
        centre: the centre of mass in the frame in which the body is drawn [m].
        outline: corners of its shape in that frame [m], for drawings; of a bar its two ends.
        radius: by which its shape reaches beyond the outline [m]; the outline of a disc is its centre.

    Numbers may be texts with units, such as "20 g".

    Raises:
        MechanismError: a text is no such quantity.
    """

    name: str
    mass: Number
    inertia: Number
    start: tuple[Number, Number, Number] = (0.0, 0.0, 0.0)
    start_rate: tuple[Number, Number, Number] = (0.0, 0.0, 0.0)
    tooth_length: Number | None = None
    centre: Point = field(default=(0.0, 0.0), compare=False, kw_only=True)
    outline: tuple[Point, ...] = field(default=(), compare=False, kw_only=True)
    radius: Number = field(default=0.0, compare=False, kw_only=True)

    def __post_init__(self) -> None:
        """Make numbers of texts with units."""
        for name, unit in _UNITS.items():
            value = getattr(self, name)
            found = with_texts(value, unit, f"Body {self.name!r}: {name}")
            if found is not value:
                object.__setattr__(self, name, found)

    def _end(self, point: Point, direction: Point | None = None) -> End:
        x, y = self.centre
        return End(self.name, (point[0] - x, point[1] - y), direction)

    @property
    def corners(self) -> tuple[End, ...]:
        """The corners of its outline."""
        return tuple(self._end(point) for point in self.outline)

    @property
    def a(self) -> End:
        """The first corner of its outline: of a bar, the end where it begins."""
        return self._corner(0, "a")

    @property
    def b(self) -> End:
        """The second corner of its outline: of a bar, its other end."""
        return self._corner(1, "b")

    def _corner(self, number: int, what: str) -> End:
        if len(self.outline) <= number:
            raise MechanismError(f"Body {self.name!r} has no end {what}: it was not made by bar; write at(x, y).")
        return self._end(self.outline[number])

    @property
    def angle(self) -> str:
        """The name of its angle [rad], for `held` and outputs."""
        return f"{self.name}.angle"

    @property
    def speed(self) -> str:
        """The name of its angular speed [rad/s], for outputs."""
        return f"{self.name}.speed"


# Bodies whose numbers are the parameters of `port_builders.part_parameters`: where they start, and how fast.


def rotor_body(values: SimpleNamespace, name: str, hinge: Point, angle: Number, speed: Number = 0.0) -> Body:
    """A body on a hinge in its centre of mass, with <name>_mass and <name>_inertia.

    Args:
        values: of the parameters.
        name: of the body.
        hinge: its place [m].
        angle: at the start [rad].
        speed: at the start [rad/s].
    """
    mass, inertia = getattr(values, f"{name}_mass"), getattr(values, f"{name}_inertia")
    return Body(name, mass, inertia, (*hinge, angle), (0.0, 0.0, speed))


@dataclass(frozen=True)
class MovingPoint:
    """A point [m] and its velocity [m/s]."""

    x: Number
    y: Number
    x_rate: Number = 0.0
    y_rate: Number = 0.0

    def along(self, distance: Number, angle: Number, speed: Number) -> MovingPoint:
        """The point at a distance [m] along a link that begins here, with its angle [rad] and speed [rad/s]."""
        x, y = distance * cos(angle), distance * sin(angle)
        return MovingPoint(self.x + x, self.y + y, self.x_rate - y * speed, self.y_rate + x * speed)


def link_body(values: SimpleNamespace, name: str, begin: MovingPoint, angle: Number, speed: Number) -> Body:
    """A bar with <name>_mass, <name>_inertia and <name>_centre.

    Args:
        values: of the parameters.
        name: of the body.
        begin: its pin from which <name>_centre counts.
        angle: at the start [rad].
        speed: at the start [rad/s].
    """
    mass, inertia, distance = (getattr(values, f"{name}_{what}") for what in ("mass", "inertia", "centre"))
    centre = begin.along(distance, angle, speed)
    return Body(name, mass, inertia, (centre.x, centre.y, angle), (centre.x_rate, centre.y_rate, speed))
