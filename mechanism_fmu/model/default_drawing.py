"""The drawing of a model that gives none: bodies through their joints, springs, guides, contacts, paths of markers."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import chain, count
from typing import Any

from ..tables.kinds import FORCES
from .body import GROUND
from .contacts import PointLineContact
from .curves import Curve
from .curves.check_curves import value_and_slope
from .drawing import Disc, Hinge, Link, Polyline, Quantity, Rod, Shape, Spring, Striker, Trace, Wheel
from .findings import length
from .functions import Number, is_plain, where_positive
from .mechanism import Mechanism
from .outline_contacts import OutlineFacts, drawn_outline
from .ports import Calculated, Input, Output
from .symbol import Symbol

#: Which fields of a part name a body and a point of it.
_ENDS = (("body_i", "point_i"), ("body_j", "point_j"), ("body", "point"), ("reaction", "reaction_point"))
#: Springs between two points, by their rows.
_SPRINGS = ("spring_damper", "nonlinear_spring")
#: Points of a profile that does not follow from parameters, and of one that does: each of these is a variable.
_FINE, _COARSE = 120, 36
#: Half the length of the straight line of a guide or contact, in parts of the mechanism's size.
_REACH = 0.5


@dataclass(frozen=True)
class Plan:
    """What is decided once for a model, whatever its parameters' values are.

    Attributes:
        follows: of each number of the drawing, in order, whether it follows from parameters; and what else is decided.
        size: of the mechanism at the default values [m].
    """

    follows: tuple[bool, ...]
    size: float


@dataclass
class Drawn:
    """What comes of a mechanism: shapes, and the variables that they need besides the model's own.

    Numbers that follow from parameters become calculated parameters; poses are outputs, those that are there already
    or new ones.

    Attributes:
        mechanism: it.
        size: of the mechanism [m].
        follows: of each number in order whether it is a calculated parameter; where the list ends, symbols are.
        taken: names of the model's parameters, which none of its variables may have.
        points: of each body, as variables or numbers of the drawing; and as they were given.
    """

    mechanism: Mechanism
    size: float
    follows: list[bool] = field(default_factory=list)
    taken: tuple[str, ...] = ()
    shapes: list[Shape] = field(default_factory=list)
    calculated: list[Calculated] = field(default_factory=list)
    outputs: list[Output] = field(default_factory=list)
    points: dict[str, list[tuple[Quantity, Quantity]]] = field(default_factory=dict)
    given: dict[str, list[tuple[Number, Number]]] = field(default_factory=dict)
    numbers: int = 0
    _taken: set[str] = field(init=False)  # names of parameters and ports, and of the drawing's numbers so far
    _known: set[str] = field(init=False)  # names of the mechanism's own calculated parameters

    def __post_init__(self) -> None:
        ports: tuple[Input | Output, ...] = (*self.mechanism.inputs, *self.mechanism.outputs)
        self._taken = {*self.taken, *(port.name for port in ports)}
        self._known = {port.name for port in self.mechanism.calculated}

    def number(self, value: Number, name: str) -> Quantity:
        """A number of the drawing: itself, or the name of the calculated parameter that holds it."""
        if self.numbers == len(self.follows):
            self.follows.append(not is_plain(value))
        self.numbers += 1
        if not self.follows[self.numbers - 1]:
            return float(value) if is_plain(value) else 0.0
        name = _free(f"drawing_{name}", self._taken)
        self._taken.add(name)
        if name in self._known:
            return name  # of a mechanism that another model has drawn
        self.calculated.append(Calculated(name, value, "Drawing: a number of its shape", "m"))
        return name

    def decided(self, holds: bool) -> bool:
        """What is decided once for all values of the parameters, as it was decided first."""
        if self.numbers == len(self.follows):
            self.follows.append(holds)
        self.numbers += 1
        return self.follows[self.numbers - 1]

    def vertex(self, body: str, point: tuple[Number, Number]) -> int:
        """The place of a point among those of a body; one that is there already is not drawn twice."""
        known, given = self.points.setdefault(body, []), self.given.setdefault(body, [])
        for place, other in enumerate(given):
            if not self.decided(not all(map(_is_same, other, point))):
                return place
        given.append(point)
        name = f"{body}_{len(known)}"
        known.append((self.number(point[0], f"{name}_x"), self.number(point[1], f"{name}_y")))
        return len(known) - 1

    def pose(self, body: str) -> tuple[tuple[Quantity, Quantity], Quantity]:
        """Place and angle of a body, as names of outputs."""
        if body == GROUND:
            return (0.0, 0.0), 0.0
        x, y, angle = (self._output(body, what, unit) for what, unit in (("x", "m"), ("y", "m"), ("angle", "rad")))
        return (x, y), angle

    def _output(self, body: str, what: str, unit: str) -> str:
        source = f"{body}.{what}"
        for output in (*self.mechanism.outputs, *self.outputs):
            if output.source == source:
                return output.name
        name = _free(f"{body}_{what}", self._taken | self._known)
        self._taken.add(name)
        self.outputs.append(Output(name, source, f"Drawing: {what} of {body}", unit))
        return name


def _free(name: str, taken: Collection[str]) -> str:
    """The name, or if that is taken, the first of <name>_2, <name>_3, ... that is not."""
    return next(n for n in chain([name], (f"{name}_{k}" for k in count(2))) if n not in taken)


def _is_same(one: Number, other: Number) -> bool:
    """Whether two numbers are the same whatever the parameters' values are."""
    if is_plain(one) and is_plain(other):
        return float(one) == float(other)
    return isinstance(one, Symbol) and isinstance(other, Symbol) and one.number == other.number


def plan_of(reference: Mechanism, symbolic: Mechanism | None) -> Plan:
    """What is decided once for a model.

    Args:
        reference: the mechanism for the default values.
        symbolic: the same with symbols for the parameters; None where the model's function does not take them: every
            number then counts as one that follows from parameters.
    """
    size = _size(reference)
    drawn = draw(symbolic or reference, size)
    return Plan(tuple(drawn.follows) if symbolic else (True,) * len(drawn.follows), size)


def draw(mechanism: Mechanism, size: float, follows: Sequence[bool] = (), taken: Sequence[str] = ()) -> Drawn:
    """Shapes for a mechanism, with the calculated parameters and outputs that they need besides those that are there.

    Args:
        mechanism: its numbers may be symbolic.
        size: of the mechanism [m].
        follows: see `Plan`; () asks the numbers themselves.
        taken: names of the model's parameters.
    """
    drawn = Drawn(mechanism, size, [*follows], tuple(taken))
    for body in mechanism.bodies:
        if len(body.outline) == 2:  # a bar reaches from end to end, whatever is joined to it
            for corner in body.corners:
                drawn.vertex(body.name, corner.point)
    hinges = [*_hinges(drawn)]
    springs = [*_springs(drawn)]
    traces = [Trace(m.name, _place(drawn, m.body, m.point, m.name)) for m in mechanism.markers]
    outlines = [*_outlines(drawn)]
    rims = [*_pitch_circles(drawn)]
    cams = [*_profiles(drawn)]
    links = []
    for body in mechanism.bodies:
        if body.name in drawn.points or not body.outline:
            at, angle = drawn.pose(body.name)
            links.append(Link(body.name, at, angle, tuple(drawn.points.get(body.name, [(0.0, 0.0)]))))
    # what others start from comes first; wheels and plates lie under links, hinges on them
    drawn.shapes = [*outlines, *rims, *links, *cams, *springs, *hinges, *traces]
    return drawn


def _ends(part: Any) -> Iterator[tuple[str, tuple[Number, Number]]]:
    for body, point in _ENDS:
        if hasattr(part, body) and hasattr(part, point):
            yield getattr(part, body), getattr(part, point)


def _place(drawn: Drawn, body: str, point: tuple[Number, Number], name: str) -> Any:
    """A place of a drawing: on the ground a point, on a body one of its link's."""
    if body == GROUND:
        return drawn.number(point[0], f"{name}_x"), drawn.number(point[1], f"{name}_y")
    return f"{body}.{drawn.vertex(body, point)}"


def _hinges(drawn: Drawn) -> Iterator[Shape]:
    """Pins, and the points of all other joints and contacts on their bodies."""
    for joint in drawn.mechanism.joints:
        ends = [*_ends(joint)]
        if joint.row == "revolute":
            yield Hinge(_pin(drawn, ends, joint.name))
        elif joint.row == "distance":
            yield Rod(joint.name, *(_place(drawn, *end, f"{joint.name}_{k}") for k, end in enumerate(ends)))
        else:
            for body, point in ends:
                if body != GROUND:
                    drawn.vertex(body, point)
    for contact in drawn.mechanism.contacts:
        if isinstance(contact, PointLineContact):
            yield Striker(_place(drawn, contact.body_i, contact.point_i, f"{contact.name}_point"))


def _pin(drawn: Drawn, ends: Sequence[tuple[str, tuple[Number, Number]]], name: str) -> Any:
    """Both ends of a pin are points of their bodies; it is drawn where it is fixed, or on the first of them."""
    places = [_place(drawn, body, point, name) for body, point in ends]
    return next((place for place in places if not isinstance(place, str)), places[0])


def _springs(drawn: Drawn) -> Iterator[Shape]:
    for force in drawn.mechanism.forces:
        if force.row in _SPRINGS:
            start, end = (_place(drawn, *e, f"{force.name}_{k}") for k, e in enumerate(_ends(force)))
            yield Spring(force.name, start, end)
        elif FORCES.columns(force.row)[:1] == ("point.x",):
            for body, point in _ends(force):
                if body != GROUND:
                    drawn.vertex(body, point)


def _outlines(drawn: Drawn) -> Iterator[Shape]:
    """Discs, plates, the straight lines of guides and contacts, and outlines, each once though several touch it."""
    known: list[tuple[str, Any, Any]] = []
    for body in drawn.mechanism.bodies:
        corners = [corner.point for corner in body.corners]
        if len(corners) == 1:
            at, _ = drawn.pose(body.name)
            yield Disc(f"{body.name} (disc)", at, drawn.number(body.radius, f"{body.name}_radius"))
        elif len(corners) > 2:
            at, angle = drawn.pose(body.name)
            yield Polyline(f"{body.name} (plate)", at, angle, tuple(_points(drawn, corners, f"{body.name}_outline")))
    for contact in drawn.mechanism.contacts:
        if isinstance(contact, PointLineContact):
            nx, ny = contact.normal
            yield _line(drawn, contact.name, contact.body_j, contact.line_point, (-ny, nx))
        if isinstance(contact, OutlineFacts) and contact.place == 0:
            sides = (
                (contact.body_i, contact.outline_i, None),
                (contact.body_j, contact.outline_j, contact.copies),
            )
            for owner, outline, copies in sides:
                if any(one == owner and of is outline and by is copies for one, of, by in known):
                    continue
                known.append((owner, outline, copies))
                at, angle = drawn.pose(owner)
                points, others = drawn_outline(outline, copies)
                name = f"{contact.name}_{owner}"
                chain = tuple(_points(drawn, points, name))
                yield Polyline(name, at, angle, chain, tuple(_copies(drawn, others, f"{name}_copy")))
    for joint in drawn.mechanism.joints:
        for side in ("i", "j"):
            axis, body = getattr(joint, f"axis_{side}", None), getattr(joint, f"body_{side}")
            if axis is not None and (body == GROUND or joint.row == "revolute_translational"):
                yield _line(drawn, joint.name, body, getattr(joint, f"point_{side}"), axis)
                break


def _line(drawn: Drawn, name: str, body: str, point: tuple[Number, Number], along: tuple[Number, Number]) -> Polyline:
    long = length(along)  # a direction is given in any length; of one without, its joint says so
    reach = _REACH * drawn.size / where_positive(long, long, 1.0)
    ends = [(point[0] + k * reach * along[0], point[1] + k * reach * along[1]) for k in (-1.0, 1.0)]
    at, angle = drawn.pose(body)
    return Polyline(name, at, angle, tuple(_points(drawn, ends, name)))


def _points(drawn: Drawn, points: Sequence[tuple[Number, Number]], name: str) -> Iterator[tuple[Quantity, Quantity]]:
    for k, (x, y) in enumerate(points):
        yield drawn.number(x, f"{name}_{k}_x"), drawn.number(y, f"{name}_{k}_y")


def _copies(
    drawn: Drawn, copies: Sequence[tuple[Number, Number, Number]], name: str
) -> Iterator[tuple[Quantity, Quantity, Quantity]]:
    for k, (x, y, angle) in enumerate(copies, start=1):
        yield drawn.number(x, f"{name}_{k}_x"), drawn.number(y, f"{name}_{k}_y"), float(angle)


def _pitch_circles(drawn: Drawn) -> Iterator[Shape]:
    for joint in drawn.mechanism.joints:
        for side in ("i", "j"):
            radius, body = getattr(joint, f"radius_{side}", None), getattr(joint, f"body_{side}")
            if radius is not None and body != GROUND:
                at, _ = drawn.pose(body)
                yield Disc(f"{body} ({joint.name})", at, drawn.number(radius, f"{joint.name}_radius_{side}"))


def _profiles(drawn: Drawn) -> Iterator[Shape]:
    """Closed profiles of cams and rollers, through some of their points."""
    for contact in drawn.mechanism.contacts:
        for side, profile in zip("ij", contact.profiles, strict=True):
            body = getattr(contact, f"body_{side}")
            if profile is None or body == GROUND or not profile.periodic:
                continue
            if drawn.decided(all(map(is_plain, (profile.start, profile.span, *(p.start for p in profile.pieces))))):
                at = _place(drawn, body, getattr(contact, f"centre_{side}"), f"{contact.name}_{side}")
                _, angle = drawn.pose(body)
                rim = tuple(_rim(drawn, profile, f"{contact.name}_{side}"))
                yield Wheel(f"{body} ({contact.name})", at, angle, 1.0, rim)


def _rim(drawn: Drawn, profile: Curve, name: str) -> Iterator[tuple[Quantity, Quantity]]:
    numbers = [n for p in profile.pieces for t in p.terms for n in (*t.polynomial, t.amplitude, t.frequency, t.phase)]
    count = _FINE if drawn.decided(all(map(is_plain, numbers))) else _COARSE
    starts = [float(piece.start) for piece in profile.pieces]
    for k in range(count):
        alpha = float(profile.start) + float(profile.span) * k / count
        piece = profile.pieces[max(bisect_right(starts, alpha) - 1, 0)]
        yield drawn.number(value_and_slope(piece, alpha)[0], f"{name}_radius_{k}"), alpha


def _size(mechanism: Mechanism) -> float:
    """How far a mechanism of plain numbers reaches [m]; 1 where it shows no length."""
    parts = (*mechanism.joints, *mechanism.forces, *mechanism.markers, *mechanism.contacts)
    points = [point for part in parts for _, point in _ends(part)]
    numbers = [float(x) for point in points for x in point]
    numbers += [float(x) for body in mechanism.bodies for x in body.start[:2]]
    return max(map(abs, numbers), default=0.0) or 1.0
