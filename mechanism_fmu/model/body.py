"""Bodies, and bodies whose numbers are parameters."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace

from .functions import Number, cos, sin

# Rigid bodies.

#: The name of the fixed frame: use it wherever a body is asked for.
GROUND = "ground"

#: A point or a vector (x, y) [m] in the frame of a body, from its centre of mass, or in the global frame.
Point = tuple[Number, Number]


@dataclass(frozen=True)
class Body:
    """A rigid body of the plane; its coordinates are (x, y) of the centre of mass and the angle phi.

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
    """

    name: str
    mass: Number
    inertia: Number
    start: tuple[Number, Number, Number] = (0.0, 0.0, 0.0)
    start_rate: tuple[Number, Number, Number] = (0.0, 0.0, 0.0)
    tooth_length: Number | None = None


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
