"""Random heaps, tumbles and mechanisms of outlines, each from one number; `run_worlds` runs them."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from mechanism_fmu.model import (
    GROUND,
    Body,
    CircularCopies,
    Mechanism,
    Outline,
    OutlineContact,
    Output,
    Revolute,
    Settings,
    hook,
    slot_hole,
)
from tests.outlines_depth import Poses, depths

GRAVITY = 9.81
#: What starts nearer to something than this is put elsewhere [m].
_APART = 2e-3


@dataclass(frozen=True)
class World:
    """A mechanism, what its bodies consist of, and how long it is to run.

    Attributes:
        kind: which family it is of.
        mechanism: with contacts for all pairs that may touch.
        solids: closed outlines by the name of the body that carries them; what is on the ground under "ground".
        pairs: names of bodies that may touch.
        until: stop time [s].
        conserves: whether no energy may be lost.
    """

    kind: str
    mechanism: Mechanism
    solids: dict[str, tuple[Outline, ...]]
    pairs: tuple[tuple[str, str], ...]
    until: float
    conserves: bool


@dataclass(frozen=True)
class Surface:
    """What bodies of a world touch with: restitution and friction."""

    restitution: float
    friction: float

    @classmethod
    def of(cls, chance: random.Random) -> Surface:
        """Plastic, elastic or between; elastic without friction."""
        restitution = chance.choice((0.0, 1.0, chance.uniform(0.05, 0.95)))
        friction = chance.choice((0.0, chance.uniform(0.05, 0.9)))
        return cls(restitution, 0.0 if restitution == 1.0 else friction)

    def contact(
        self, name: str, one: Body, other: Body | str, of_one: Outline, of_other: Outline, points: int = 6
    ) -> OutlineContact:
        """Between two bodies."""
        return OutlineContact(
            name,
            one,
            other,
            outline_i=of_one,
            outline_j=of_other,
            restitution=self.restitution,
            friction=self.friction,
            points=points,
        )


SOLIDS = ("disc", "polygon", "rounded", "box", "star", "rounded star", "arcs", "hook")


def solid(chance: random.Random, size: float, kinds: Sequence[str] = SOLIDS) -> Outline:
    """A disc, a polygon with or without roundings, a star with hollow corners, one of arcs, a rectangle, a hook."""
    kind = chance.choice(kinds)
    if kind == "disc":
        return Outline.circle(size * chance.uniform(0.4, 0.9))
    if kind == "hook":
        made = hook(1.4 * size, 0.35 * size, 0.4 * size, 0.4 * size)
        return centred(made)
    if kind == "box":
        u, v = size * chance.uniform(0.3, 0.7), size * chance.uniform(0.3, 0.7)
        return Outline.polygon([(u, v), (-u, v), (-u, -v), (u, -v)])
    count = chance.randint(4, 6) if "star" in kind else chance.randint(3, 7)
    turn = chance.uniform(0.0, math.tau)
    points = []
    for k in range(count):
        angle = turn + math.tau * (k + chance.uniform(-0.15, 0.15)) / count
        radius = size * (chance.uniform(0.45, 1.0) if "star" in kind else 1.0)
        points.append((radius * math.cos(angle), radius * math.sin(angle)))
    if "rounded" in kind:
        return centred(Outline.polygon(points, corner_radius=0.08 * size))
    bulges = [chance.uniform(-0.25, 0.25) if kind == "arcs" else 0.0 for _ in points]
    return centred(Outline(tuple((*point, bulge) for point, bulge in zip(points, bulges, strict=True))))


def centred(outline: Outline) -> Outline:
    """The same about its centre of area."""
    area = outline.area()
    return outline.moved(-area.first[0] / area.area, -area.first[1] / area.area)


def body_of(name: str, outline: Outline, at: Sequence[float], rate: Sequence[float] = (0.0, 0.0, 0.0)) -> Body:
    """A plate of 100 kg/m2, whatever its size."""
    area = outline.area()
    return Body(name, 100.0 * area.area, 100.0 * area.polar, start=tuple(at), start_rate=tuple(rate))


def _places(chance: random.Random, count: int, pitch: float, across: int) -> list[tuple[float, float]]:
    """Middles of cells of a grid whose lower left corner is the origin, a little off."""
    cells = [(k % across, k // across) for k in range(count)]
    return [((u + 0.5) * pitch + chance.uniform(-1, 1) * 1e-3, (v + 0.5) * pitch) for u, v in cells]


def _pairs(bodies: Sequence[Body]) -> tuple[tuple[str, str], ...]:
    """All of them, and each with the ground."""
    return (*combinations([body.name for body in bodies], 2), *((body.name, "ground") for body in bodies))


#: For so many bodies: which there may be, and at how many places each touches the wall and each other.
_ROOM = {
    1: (SOLIDS, 8, 8),
    2: (SOLIDS, 8, 8),
    3: (SOLIDS, 6, 6),
    4: (SOLIDS, 6, 5),
    5: (("disc", "disc", "polygon", "box", "rounded"), 5, 4),
    6: (("disc",), 2, 1),
}


def _loose(
    chance: random.Random,
    kind: str,
    around: Outline,
    material: Outline,
    places: list[tuple[float, float]],
    **more: object,
) -> World:
    """Bodies that touch each other and what is around them, which has `material`."""
    surface = Surface.of(chance)
    fast, gravity, until = (float(more[key]) for key in ("fast", "gravity", "until"))
    # many bodies are such as touch at few places
    kinds, of_wall, of_pair = _ROOM[len(places)]
    bodies, outlines = [], {}
    for k, (x, y) in enumerate(places):
        outline = solid(chance, 0.1, kinds)
        rate = [chance.uniform(-fast, fast), chance.uniform(-fast, fast), chance.uniform(-10, 10) * fast]
        body = body_of(f"body_{k}", outline, (x, y, chance.uniform(0.0, math.tau)), rate)
        bodies.append(body)
        outlines[body.name] = outline
    contacts = [
        surface.contact(f"{body.name}_wall", body, GROUND, outlines[body.name], around, of_wall) for body in bodies
    ]
    for one, other in combinations(bodies, 2):
        name = f"{one.name}_{other.name}"
        contacts.append(surface.contact(name, one, other, outlines[one.name], outlines[other.name], of_pair))
    solids = {"ground": (material,)} | {name: (outline,) for name, outline in outlines.items()}
    made = _mechanism(tuple(bodies), (), tuple(contacts), gravity)
    return World(kind, made, solids, _pairs(bodies), until, surface.restitution == 1.0)


def _mechanism(bodies: tuple[Body, ...], joints: tuple[Revolute, ...], contacts: tuple, gravity: float) -> Mechanism:
    shown = [
        Output(f"{b.name}.{c}", f"{b.name}.{c}", "")
        for b in bodies
        for c in ("x", "y", "angle", "x_rate", "y_rate", "speed")
    ]
    shown += [Output(f"energy.{e}", f"energy.{e}", "") for e in ("kinetic", "work", "lost")]
    return Mechanism(
        bodies,
        joints,
        contacts=contacts,
        gravity=(0.0, -gravity),
        outputs=tuple(shown),
        settings=Settings(max_internal_steps=20_000),
        tangential_shock=True,  # where friction jams, an impact leads on
    )


def heap(chance: random.Random) -> World:
    """Two to six bodies fall into a box, on a floor, or into a hollow."""
    count = chance.randint(2, 6)
    where = chance.choice(("box", "floor", "bowl", "gutter"))
    places = [(x - 0.36, y + 0.3) for x, y in _places(chance, count, 0.24, 3)]
    if where == "box":
        around = Outline.polygon([(-0.4, 0.0), (-0.4, 2.0), (0.4, 2.0), (0.4, 0.0)], hole=True)
        material = around
    else:
        ways = {
            "floor": ((3.0, 0.0, 0.0), (-3.0, 0.0, 0.0)),
            "bowl": (
                (3.0, 0.8, 0.0),
                (0.8, 0.8, -math.tan(math.pi / 8)),
                (0.0, 0.0, -math.tan(math.pi / 8)),
                (-0.8, 0.8, 0.0),
                (-3.0, 0.8, 0.0),
            ),
            "gutter": ((3.0, 1.5, 0.0), (0.0, 0.0, 0.0), (-3.0, 1.5, 0.0)),
        }
        around = Outline(ways[where], closed=False)
        last = around.vertices[-1]
        material = Outline((*around.vertices[:-1], (last[0], last[1], 0.0), (-3.0, -3.0, 0.0), (3.0, -3.0, 0.0)))
    return _loose(chance, f"heap, {where}", around, material, places, fast=0.3, gravity=GRAVITY, until=0.8)


def tumble(chance: random.Random) -> World:
    """One to four bodies are thrown about in a ring or box, with or without gravity."""
    count = chance.randint(1, 4)
    where = chance.choice(("ring", "box", "rounded box", "star"))
    places = [(x - 0.25, y - 0.25) for x, y in _places(chance, count, 0.25, 2)]
    if where == "ring":
        around = Outline.circle(0.5, hole=True)
    elif where == "star":
        points = [
            (
                (0.75 if k % 2 else 0.55) * math.cos(math.tau * k / 10),
                (0.75 if k % 2 else 0.55) * math.sin(math.tau * k / 10),
            )
            for k in range(10)
        ]
        around = Outline.polygon(points[::-1], hole=True)
    else:
        corners = [(-0.45, -0.45), (-0.45, 0.45), (0.45, 0.45), (0.45, -0.45)]
        around = Outline.polygon(corners, 0.1 if where == "rounded box" else 0.0, hole=True)
    gravity = chance.choice((0.0, GRAVITY))
    return _loose(chance, f"tumble, {where}", around, around, places, fast=2.0, gravity=gravity, until=0.6)


def bar(length: float, width: float, start: float = 0.0) -> Outline:
    """A rectangle along x, from `start` [m] on."""
    return Outline.polygon([(start, -width / 2), (length, -width / 2), (length, width / 2), (start, width / 2)])


def pendulum(chance: random.Random) -> World:
    """One or two links in a row, with outlines at their ends, swing against two fixed ones."""
    surface = Surface.of(chance)
    links, radius = chance.randint(1, 2), 0.3
    bodies: list[Body] = []
    joints: list[Revolute] = []
    outlines: dict[str, Outline] = {}
    x = y = 0.0
    for k in range(links):
        angle = chance.uniform(-0.6, 0.6) + (math.pi if chance.random() < 0.5 else 0.0) * (k == 0)
        body = body_of(f"link_{k}", bar(radius / 2, 0.04, -radius / 2), (0.0, 0.0, 0.0))
        middle = (x + radius / 2 * math.cos(angle), y + radius / 2 * math.sin(angle))
        body = Body(body.name, body.mass, body.inertia, start=(*middle, angle))
        joints.append(
            Revolute(f"pin_{k}", body.at(-radius / 2, 0.0), bodies[-1].at(radius / 2, 0.0) if bodies else GROUND)
        )
        outlines[body.name] = solid(chance, 0.07).moved(radius / 2 * chance.uniform(0.7, 1.0), 0.0)
        bodies.append(body)
        x, y = x + radius * math.cos(angle), y + radius * math.sin(angle)
    pegs = []
    for _ in range(2):
        far, way = chance.uniform(0.2, 0.3 + 0.3 * links), -math.pi / 2 + chance.uniform(-1.0, 1.0)
        pegs.append(solid(chance, 0.08).moved(far * math.cos(way), far * math.sin(way)))
    contacts = [
        surface.contact(f"{body.name}_peg_{k}", body, GROUND, outlines[body.name], peg)
        for body in bodies
        for k, peg in enumerate(pegs)
    ]
    solids = {"ground": tuple(pegs)} | {name: (outline,) for name, outline in outlines.items()}
    made = _mechanism(tuple(bodies), tuple(joints), tuple(contacts), GRAVITY)
    pairs = tuple((body.name, "ground") for body in bodies)
    return World("pendulum", made, solids, pairs, 1.5, surface.restitution == 1.0)


def four_bar(chance: random.Random) -> World:
    """A crank-rocker that falls, whose coupler carries an outline that strikes two fixed ones."""
    surface = Surface.of(chance)
    long = {"crank": 0.12, "coupler": 0.4, "rocker": 0.3}
    base = 0.35
    turn = chance.uniform(0.0, math.tau)
    a = complex(0.12 * math.cos(turn), 0.12 * math.sin(turn))
    across = base - a
    cosine = (0.4**2 + abs(across) ** 2 - 0.3**2) / (2 * 0.4 * abs(across))
    b = a + 0.4 * across / abs(across) * complex(cosine, math.sqrt(1 - cosine**2))
    ends = {"crank": (0j, a), "coupler": (a, b), "rocker": (complex(base), b)}
    bodies = {}
    for name, (start, end) in ends.items():
        plain = body_of(name, bar(long[name] / 2, 0.03, -long[name] / 2), (0.0, 0.0, 0.0))
        middle, way = (start + end) / 2, end - start
        bodies[name] = Body(
            name, plain.mass, plain.inertia, start=(middle.real, middle.imag, math.atan2(way.imag, way.real))
        )
    crank, coupler, rocker = bodies.values()
    joints = (
        Revolute("a", crank.at(-0.06, 0.0), GROUND),
        Revolute("b", crank.at(0.06, 0.0), coupler.at(-0.2, 0.0)),
        Revolute("c", coupler.at(0.2, 0.0), rocker.at(0.15, 0.0)),
        Revolute("d", rocker.at(-0.15, 0.0), GROUND.at(base, 0.0)),
    )
    nose = solid(chance, 0.06).moved(chance.uniform(-0.1, 0.1), chance.uniform(0.05, 0.12))
    pegs = [solid(chance, 0.05).moved(chance.uniform(-0.1, 0.4), chance.uniform(0.0, 0.5)) for _ in range(2)]
    contacts = tuple(surface.contact(f"peg_{k}", coupler, GROUND, nose, peg) for k, peg in enumerate(pegs))
    made = _mechanism((crank, coupler, rocker), joints, contacts, GRAVITY)
    solids = {"ground": tuple(pegs), "coupler": (nose,)}
    return World("four-bar", made, solids, (("coupler", "ground"),), 1.5, surface.restitution == 1.0)


def wheel(chance: random.Random) -> World:
    """A wheel of copies, closed or joined ones, that turns against a pawl, a falling body, or another such wheel."""
    surface = Surface.of(chance)
    count = chance.randint(5, 12)
    pitch, inner, outer = math.tau / count, 0.2, chance.uniform(0.23, 0.27)
    first, share = (inner, 0.0), chance.uniform(0.1, 0.9)
    tip, last = (outer, share * pitch), (inner, pitch)

    def polar(radius: float, angle: float) -> tuple[float, float]:
        return radius * math.cos(angle), radius * math.sin(angle)

    rounding = chance.choice((0.0, 0.004))
    joined = chance.random() < 0.6
    if joined:
        tooth = Outline.chain([polar(*first), polar(*tip), polar(*last)], corner_radius=rounding)
        turned = [tooth.moved(angle=k * pitch).vertices[:-1] for k in range(count)]
        wheel_solids = (Outline(tuple(vertex for part in turned for vertex in part)),)
    else:
        tooth = Outline.polygon([polar(*first), polar(*tip), polar(inner, 0.8 * pitch)], corner_radius=rounding)
        wheel_solids = tuple(tooth.moved(angle=k * pitch) for k in range(count))
    inertia = 0.5 * 100.0 * math.pi * inner**4
    spin = chance.uniform(-8.0, 8.0)
    of_wheel = Body("wheel", 5.0, inertia, start=(0.0, 0.0, chance.uniform(0.0, pitch)), start_rate=(0.0, 0.0, spin))
    hinges = [Revolute("axle", of_wheel.at(0, 0), GROUND)]
    shape = solid(chance, 0.05)
    if chance.random() < 0.5:
        arm = 0.3
        angle = math.pi + chance.uniform(0.15, 0.6)
        at = (arm / 2 + 0.02, outer + 0.02)
        shape = shape.moved(arm / 2, 0.0)
        plain = body_of("pawl", bar(arm / 2, 0.03, -arm / 2), (0.0, 0.0, 0.0))
        start = (at[0] + arm / 2 * math.cos(angle), at[1] + arm / 2 * math.sin(angle), angle)
        pawl = Body("pawl", plain.mass, plain.inertia, start=start)
        hinges.append(Revolute("hinge", pawl.at(-arm / 2, 0.0), GROUND.at(*at)))
    else:
        pawl = body_of("pawl", shape, (chance.uniform(-0.15, 0.15), 0.35, chance.uniform(0.0, math.tau)))
    plain = surface.contact("tooth", pawl, of_wheel, shape, tooth)
    contact = OutlineContact(
        plain.name,
        pawl,
        of_wheel,
        outline_i=shape,
        outline_j=tooth,
        copies=CircularCopies(count),
        restitution=surface.restitution,
        friction=surface.friction,
        points=6,
    )
    made = _mechanism((of_wheel, pawl), tuple(hinges), (contact,), GRAVITY)
    solids = {"wheel": wheel_solids, "pawl": (shape,)}
    kind = f"wheel of {'joined' if joined else 'closed'} teeth"
    return World(kind, made, solids, (("wheel", "pawl"),), 0.8, surface.restitution == 1.0)


def slot(chance: random.Random) -> World:
    """A pin or block on one pendulum in the slot of another, or a free one in a fixed slot."""
    surface = Surface.of(chance)
    width = 0.06
    turn = chance.uniform(-0.5, 0.5)
    pin = Outline.circle(0.5 * width * chance.uniform(0.5, 0.95))
    if chance.random() < 0.4:
        half = 0.5 * width * chance.uniform(0.5, 0.9)
        pin = Outline.polygon(
            [(half, half), (-half, half), (-half, -half), (half, -half)], chance.choice((0.0, 0.3 * half))
        )
    if chance.random() < 0.5:
        hole = slot_hole(0.2, width, angle=turn)
        body = body_of(
            "pin", pin, (0.0, 0.0, turn), (chance.uniform(-2, 2), chance.uniform(-2, 2), chance.uniform(-9, 9))
        )
        made = _mechanism((body,), (), (surface.contact("slot", body, GROUND, pin, hole),), GRAVITY)
        return World(
            "slot", made, {"ground": (hole,), "pin": (pin,)}, (("pin", "ground"),), 1.0, surface.restitution == 1.0
        )
    arm, plate = 0.2, 0.25
    hole = slot_hole(0.2, width, centre=(0.0, 0.0))
    plain = body_of("arm", bar(arm / 2, 0.03, -arm / 2), (0.0, 0.0, 0.0))
    swung = Body("arm", plain.mass, plain.inertia, start=(arm / 2 * math.cos(turn), arm / 2 * math.sin(turn), turn))
    end = (arm * math.cos(turn), arm * math.sin(turn))
    other = Body("plate", 1.0, 0.02, start=(*end, turn), start_rate=(0.0, 0.0, 0.0))
    pivot = (end[0] + plate * math.cos(turn), end[1] + plate * math.sin(turn))
    hinges = (
        Revolute("a", swung.at(-arm / 2, 0.0), GROUND),
        Revolute("b", other.at(plate, 0.0), GROUND.at(*pivot)),
    )
    moved = pin.moved(arm / 2, 0.0)
    made = _mechanism((swung, other), hinges, (surface.contact("slot", swung, other, moved, hole),), GRAVITY)
    solids = {"arm": (moved,), "plate": (hole,)}
    return World("slot", made, solids, (("arm", "plate"),), 1.0, surface.restitution == 1.0)


FAMILIES: tuple[Callable[[random.Random], World], ...] = (heap, tumble, heap, tumble, pendulum, four_bar, wheel, slot)


def world(seed: int) -> World:
    """The one of this number: its family goes round, and what starts in or right beside something is drawn again."""
    family = FAMILIES[seed % len(FAMILIES)]
    for attempt in range(100):
        made = family(random.Random(f"{seed} {attempt}"))
        if _is_free(made):
            return made
    raise AssertionError(f"seed {seed}: a hundred attempts, and none is free.")


def _is_free(made: World) -> bool:
    """Whether nothing starts within `_APART` of anything, moved any of eight ways."""
    starts = {body.name: body.start for body in made.mechanism.bodies} | {"ground": (0.0, 0.0, 0.0)}
    away = np.array([0.0, *(_APART * np.exp(2j * math.pi * k / 8) for k in range(8))])
    for one, other in made.pairs:
        (x, y, angle), (u, v, beside) = starts[one], starts[other]
        first = Poses(complex(x, y) + away, np.full(len(away), np.exp(1j * angle)))
        second = Poses(np.full(len(away), complex(u, v)), np.full(len(away), np.exp(1j * beside)))
        if any(depths(a, first, b, second).max() > 0.0 for a in made.solids[one] for b in made.solids[other]):
            return False
    return True
