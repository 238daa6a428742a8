"""Worlds on a lattice, each from one number: equal sizes, right angles and gaps of zero, as people draw machines.

Each solid is a union of convex pieces, so that an independent separating-axis test can say how deep two of them overlap
(`tests.separating_axes`). `python -m tests.analytic.run_lattice_worlds` runs them.
"""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from mechanism_fmu.model import GROUND, Body, Mechanism, Outline, OutlineContact, Output, Settings
from tests.separating_axes import Piece, Placed, deepest

GRAVITY = 9.81
#: Every place and every gap is a whole multiple of this [m].
LATTICE = 0.05
SIZES = (0.1, 0.2, 0.3)
ANGLES = (0.0, 0.0, 0.0, math.pi / 4, math.pi / 2, 0.1)
VELOCITIES = (0.0, 0.5, -1.0)
#: Surface density of all plates [kg/m2].
DENSITY = 100.0
#: Overlap by which two solids count as overlapping at the start: rounding of places below 10 m leaves less [m].
ROUNDING = 1e-14


@dataclass(frozen=True)
class Solid:
    """An outline, and the convex pieces of the material that it bounds.

    Attributes:
        kind: "box", "triangle", "trapezoid", "teeth", "ring", or the kind of floor.
        outline: in the frame of the body [m].
        pieces: convex polygons, anticlockwise, in the same frame.
        mass: [kg].
        inertia: about the origin of the frame, which is the centre of mass [kg m2].
    """

    kind: str
    outline: Outline
    pieces: tuple[Piece, ...]
    mass: float = 0.0
    inertia: float = 0.0


@dataclass(frozen=True)
class LatticeWorld:
    """A mechanism on the lattice.

    Attributes:
        description: what it consists of, in one line.
        mechanism: with a contact for each pair that may touch.
        solids: by the name of the body; "ground" for the floor.
        friction: coefficient of all contacts.
        restitution: of all contacts.
    """

    description: str
    mechanism: Mechanism
    solids: dict[str, Solid]
    friction: float
    restitution: float


def _plate(kind: str, points: list[tuple[float, float]], parts: list[list[tuple[float, float]]]) -> Solid:
    """Return a closed outline with its centre of mass at the origin."""
    outline = Outline.polygon(points)
    area = outline.area()
    dx, dy = -area.first[0] / area.area, -area.first[1] / area.area
    outline = outline.moved(dx, dy)
    pieces = tuple(np.array([complex(x + dx, y + dy) for x, y in part]) for part in parts)
    area = outline.area()
    return Solid(kind, outline, pieces, DENSITY * area.area, DENSITY * area.polar)


def _chain(kind: str, points: list[tuple[float, float]], parts: list[list[tuple[float, float]]]) -> Solid:
    """Return a fixed open chain with the material below it."""
    return Solid(kind, Outline.chain(points), tuple(np.array([complex(*p) for p in part]) for part in parts))


def box(width: float, height: float) -> Solid:
    """Return a rectangle."""
    corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
    return _plate("box", corners, [corners])


def triangle(width: float, height: float, apex: float) -> Solid:
    """Return a triangle on its base, with its apex at the abscissa `apex`."""
    corners = [(0.0, 0.0), (width, 0.0), (apex, height)]
    return _plate("triangle", corners, [corners])


def trapezoid(width: float, height: float, inset: float) -> Solid:
    """Return a trapezoid on its longer side."""
    corners = [(0.0, 0.0), (width, 0.0), (width - inset, height), (inset, height)]
    return _plate("trapezoid", corners, [corners])


def teeth(width: float, height: float) -> Solid:
    """Return a rack of two teeth as wide as the space between them and half as high as the whole."""
    third, low = width / 3, height / 2
    corners = [
        (0.0, 0.0),
        (width, 0.0),
        (width, height),
        (2 * third, height),
        (2 * third, low),
        (third, low),
        (third, height),
        (0.0, height),
    ]
    base = [(0.0, 0.0), (width, 0.0), (width, low), (0.0, low)]
    left = [(0.0, 0.0), (third, 0.0), (third, height), (0.0, height)]
    right = [(2 * third, 0.0), (width, 0.0), (width, height), (2 * third, height)]
    return _plate("teeth", corners, [base, left, right])


def ring(width: float, height: float) -> Solid:
    """Return a rectangle whose outline is an open chain that begins and ends within its lowest side."""
    u, v = width / 2, height / 2
    outline = Outline.chain([(0.0, -v), (u, -v), (u, v), (-u, v), (-u, -v), (0.0, -v)])
    whole = box(width, height)
    return Solid("ring", outline, whole.pieces, whole.mass, whole.inertia)


def _floor(chance: random.Random, size: float) -> Solid | None:
    """Return what is fixed, whose top is at zero; None for nothing."""
    kind = chance.choice(("none", "floor", "floor", "pedestal", "step", "trench"))
    if kind == "floor":
        return _chain("floor", [(5.0, 0.0), (-5.0, 0.0)], [[(-5.0, -1.0), (5.0, -1.0), (5.0, 0.0), (-5.0, 0.0)]])
    if kind == "pedestal":
        corners = [(0.0, -size), (size, -size), (size, 0.0), (0.0, 0.0)]
        return Solid("pedestal", Outline.polygon(corners), (np.array([complex(*p) for p in corners]),))
    below = [(-5.0, -1.0), (5.0, -1.0), (5.0, 0.0), (-5.0, 0.0)]
    right = [(size, -1.0), (5.0, -1.0), (5.0, size), (size, size)]
    if kind == "step":
        return _chain(kind, [(5.0, size), (size, size), (size, 0.0), (-5.0, 0.0)], [below, right])
    if kind == "trench":
        left = [(-5.0, -1.0), (0.0, -1.0), (0.0, size), (-5.0, size)]
        points = [(5.0, size), (size, size), (size, 0.0), (0.0, 0.0), (0.0, size), (-5.0, size)]
        return _chain(kind, points, [below, right, left])
    return None


def _solid(chance: random.Random, width: float, height: float) -> Solid:
    kind = chance.choice(("box", "box", "box", "triangle", "trapezoid", "teeth", "ring"))
    if kind == "triangle":
        return triangle(width, height, chance.choice((0.0, width / 2)))
    if kind == "trapezoid":
        return trapezoid(width, height, chance.choice((0.25, -0.25)) * width)
    if kind == "teeth":
        return teeth(width, height)
    return ring(width, height) if kind == "ring" else box(width, height)


def _multiple(chance: random.Random) -> float:
    """Return a whole multiple of the lattice [m], most often zero."""
    return LATTICE * chance.choice((0, 0, 0, 0, 0, 1, 1, 2, -1, -2))


def _draw(seed: str) -> LatticeWorld | None:
    """Draw a world, or None where its bodies begin within each other."""
    chance = random.Random(seed)
    equal = chance.random() < 0.6
    size = chance.choice(SIZES)
    floor = _floor(chance, size)
    restitution, friction = chance.choice((0.0, 0.2, 1.0)), chance.choice((0.0, 0.4, 0.8))
    solids: dict[str, Solid] = {} if floor is None else {"ground": floor}
    placed = [] if floor is None else [Placed(floor.pieces, 0j, 1.0 + 0j)]
    bodies: list[Body] = []
    left, right, base, top = 0.0, 0.0, 0.0, 0.0  # of the rectangle around the body before; highest of all
    for k in range(chance.randint(2, 6)):
        width, height = (size, size) if equal else (chance.choice(SIZES), chance.choice(SIZES))
        solid = _solid(chance, width, height)
        angle = chance.choice(ANGLES)
        turn = complex(math.cos(angle), math.sin(angle))
        corners = turn * np.concatenate(solid.pieces)
        low = complex(corners.real.min(), corners.imag.min())  # lower left corner of the rectangle around it
        beside = k > 0 and chance.random() < 0.3
        x = right + abs(_multiple(chance)) if beside else left + _multiple(chance)
        y = base if beside else top + abs(_multiple(chance))
        origin = complex(x, y) - low
        where = Placed(solid.pieces, origin, turn)
        if any(deepest(where, other) > ROUNDING for other in placed):
            return None
        name = f"body_{k}"
        rate = (chance.choice((0.0, chance.choice(VELOCITIES))), chance.choice((0.0, chance.choice(VELOCITIES))), 0.0)
        bodies.append(Body(name, solid.mass, solid.inertia, start=(origin.real, origin.imag, angle), start_rate=rate))
        solids[name] = solid
        placed.append(where)
        left, right, base = x, x + float(np.ptp(corners.real)), y
        top = max(top, y + float(np.ptp(corners.imag)))
    contacts = [
        OutlineContact(
            f"{one}_{other}",
            next(body for body in bodies if body.name == one),
            GROUND if other == "ground" else next(body for body in bodies if body.name == other),
            outline_i=solids[one].outline,
            outline_j=solids[other].outline,
            restitution=restitution,
            friction=friction,
        )
        for other, one in combinations(solids, 2)
    ]
    gravity = GRAVITY if floor is not None or chance.random() < 0.3 else 0.0
    shown = [
        Output(f"{body.name}.{c}", f"{body.name}.{c}", "")
        for body in bodies
        for c in ("x", "y", "angle", "x_rate", "y_rate", "speed")
    ]
    mechanism = Mechanism(
        tuple(bodies),
        contacts=tuple(contacts),
        gravity=(0.0, -gravity),
        outputs=tuple(shown),
        settings=Settings(max_internal_steps=20_000),
    )
    kinds = " ".join(
        f"{solids[body.name].kind}({body.start[0]:.3g} {body.start[1]:.3g} {body.start[2]:.2g})" for body in bodies
    )
    sizes, below = "equal" if equal else "mixed", floor.kind if floor else "nothing"
    text = f"{sizes} on {below}: {kinds}; e={restitution} mu={friction} g={gravity}"
    return LatticeWorld(text, mechanism, solids, friction, restitution)


def lattice_world(seed: int) -> LatticeWorld:
    """Return the world of this number: what begins with an overlap is drawn again."""
    for attempt in range(200):
        drawn = _draw(f"{seed} {attempt}")
        if drawn is not None:
            return drawn
    raise AssertionError(f"seed {seed}: two hundred draws, and all begin with an overlap.")
