"""Interface of force elements to the engine, and what they have in common."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from ... import codes
from ...tables.declare import Array
from ...tables.motion import Loads, Pose
from ...tables.parts import Forces, Thresholds
from ..compiler.subset import jit


class Element(NamedTuple):
    """The functions of a kind of force element `k`; `at` are the poses and rates of the unknowns y, shape (unknowns,).

    Attributes:
        act: (block, at, k, y, dy, given, lost) -> (given, lost): adds the generalised forces [N, N m] to `loads.force`
            and the powers [W] that come in from outside and that are lost to `given` and `lost`; writes the rates of
            own states to `dy`, shape (unknowns,).
        stored: (block, at, k, y) -> energy that it stores [J].
        storing: (block, at, k, y, dy) -> the derivative of that [W].
        read: (block, at, k, y, which) -> the value of an output, `which` counted as in the model's class.
        read_rate: (block, at, k, dy, which) -> its derivative with respect to time, not a number where unknown.
    """

    act: Callable[..., Any] | None = None
    stored: Callable[..., Any] | None = None
    storing: Callable[..., Any] | None = None
    read: Callable[..., Any] | None = None
    read_rate: Callable[..., Any] | None = None


@jit
def turn(block: Array, k: int, torque: float) -> None:
    """Let element `k` act on its body with a torque [N m], and on its reaction against it."""
    table = Forces(block)
    load = Loads(block)
    load.torque[k] = torque
    load.force[3 * table.body[k] + 2] += torque
    load.force[3 * table.reaction[k] + 2] -= torque
    load.size[3 * table.body[k] + 2] += abs(torque)
    load.size[3 * table.reaction[k] + 2] += abs(torque)


@jit
def push(block: Array, body: int, px: float, py: float, fx: float, fy: float) -> None:
    """Let a force act on a body at (px, py) from its centre of mass."""
    force = Loads(block).force
    force[3 * body] += fx
    force[3 * body + 1] += fy
    force[3 * body + 2] += px * fy - py * fx
    size = Loads(block).size
    size[3 * body] += abs(fx)
    size[3 * body + 1] += abs(fy)
    size[3 * body + 2] += abs(px * fy) + abs(py * fx)


@jit
def relative_angle(block: Array, at: Pose, k: int) -> float:
    """Angle of the body of element `k` from its reaction [rad]."""
    table = Forces(block)
    angle: float = at.phi[table.body[k]] - at.phi[table.reaction[k]]
    return angle


@jit
def relative_speed(block: Array, at: Pose, k: int) -> float:
    """Derivative of `relative_angle` [rad/s]."""
    table = Forces(block)
    speed: float = at.phi_rate[table.body[k]] - at.phi_rate[table.reaction[k]]
    return speed


@jit
def acting(side: float, stretch: float) -> float:
    """The stretch of a spring that may be one-sided: 0 where it is on the side on which the spring does nothing."""
    return 0.0 if side != 0.0 and side * stretch <= 0.0 else stretch


@jit
def is_above(block: Array, threshold: int, value: float) -> bool:
    """Whether a threshold is passed: by its side in the present step, else by its present value."""
    side = Thresholds(block).side[threshold]
    if side == codes.UNDECIDED:
        return value > 0.0
    above: bool = side > 0
    return above


@jit
def spring_force(
    block: Array, k: int, stiffness: float, damping: float, preload: float, side: float, stretch: float, rate: float
) -> tuple[float, float, float]:
    """Force or torque against the stretch of a spring-damper, and the powers that come in and are lost [W].

    A one-sided one does nothing on the other side, and never acts the other way.
    """
    if side != 0.0:
        first = Forces(block).threshold[k]
        if not is_above(block, first, side * stretch):
            return 0.0, 0.0, 0.0
        if not is_above(block, first + 1, side * (stiffness * stretch + damping * rate + preload)):
            return 0.0, 0.0, -stiffness * stretch * rate  # it would hold back: what it has stored is lost
    return stiffness * stretch + damping * rate + preload, -preload * rate, damping * rate * rate
