"""Three motions with friction, run by the engine: on a slope, on a belt, a disc; drawn by `friction_drawing`."""

from __future__ import annotations

import math
import runpy
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

from mechanism_fmu.model import GROUND, Input, Mechanism, Model, Output, PointForce, PointLineContact, rigid_body
from mechanism_fmu.simulation import Simulation

from .pictures import DIMENSION, INK, Point, sheet
from .plane import FIRST, SECOND, SMALL, Plane, words

EXAMPLES = Path(__file__).parents[1] / "examples" / "gallery"
_STICKS = "#e9c46a"

#: The block of the example of docs/explanation/friction.md: slope [rad], friction, gravity [m/s2], mass [kg]; what
# pulls [N/s].
SLOPE, MU, GRAVITY, MASS, PULL = math.radians(20), 0.5, 9.81, 2.0, 10.0
#: When the rope begins to pull, when the run ends [s].
PULLED, END = 0.8, 2.8

Samples = list[tuple[float, dict[str, float]]]


def sampled(
    simulation: Simulation, end: float, count: int, pull: float | None = None
) -> tuple[Samples, list[tuple[float, str]]]:
    """States at even times, and the events, their times [s] and names; `pull` [N/s] is the slope of an input."""
    states: Samples = [(simulation.time, simulation.read())]
    events: list[tuple[float, str]] = []
    start = simulation.time
    for k in range(1, count + 1):
        if pull is not None:
            simulation.set_slope("pull", pull)  # of one communication step
        simulation.advance(start + (end - start) * k / count)
        events += [(event.time, event.guard) for event in simulation.events_in_step() if event.guard != "input"]
        states.append((simulation.time, simulation.read()))
    return states, events


def slope_run() -> tuple[Samples, list[tuple[float, str]]]:
    """A block that is pushed up a slope, stops, and is pulled more and more."""
    block = rigid_body("block", (0, 0), mass=MASS, inertia=1.0, velocity=(3.0, 0.0))
    floor = GROUND.line((0, 0), (1, 0))
    sources = {"v": "slope.slip_speed", "friction": "slope.friction_force", "normal": "slope.force"}
    simulation = Simulation(
        Mechanism(
            (block,),
            contacts=(PointLineContact("slope", block.at(0, 0), floor, closed=True, friction=MU),),
            forces=(PointForce("rope", block.at(0, 0)),),
            inputs=(Input("pull", "rope.x", 0.0, "Up the slope", "N"),),
            outputs=tuple(Output(name, source, "", feedthrough=("pull",)) for name, source in sources.items()),
            gravity=(-GRAVITY * math.sin(SLOPE), -GRAVITY * math.cos(SLOPE)),
        )
    )
    before, stopped = sampled(simulation, PULLED, 160)
    behind, torn = sampled(simulation, END, 400, PULL)
    return before + behind, stopped + torn


def gallery_run(name: str, end: float, count: int) -> tuple[Samples, list[tuple[float, str]], dict[str, float]]:
    """A run of an example of the gallery, and its parameters."""
    model = runpy.run_path(str(EXAMPLES / f"{name}.py"))["MODEL"]
    assert isinstance(model, Model)
    values = model.values()
    return *sampled(Simulation(model.build(values)), end, count), vars(values)


def _series(states: Samples, name: str, factor: float = 1.0) -> list[Point]:
    return [(time, factor * state[name]) for time, state in states]


def _thinned(points: Sequence[Point], most: float) -> list[Point]:
    """Without points that are within `most` of the line through their neighbours."""
    kept = [points[0]]
    for here, after in pairwise(points[1:]):
        (x, y), (u, v), (p, q) = kept[-1], here, after
        if abs(y + (q - y) * (u - x) / (p - x) - v) > most:
            kept.append(here)
    return [*kept, points[-1]]


def _title(x: float, text: str) -> str:
    return words(Plane((0, 0), 1.0), (x, -22.0), text, SMALL)


def _slope() -> list[str]:
    states, events = slope_run()
    above, below = Plane((55, 138), 95.0, up=26.0), Plane((55, 242), 95.0, up=5.8)
    (stop, _), (torn, _) = events
    bound = MU * states[0][1]["normal"]
    shades = [
        s.region([(stop, low), (torn, low), (torn, high), (stop, high)], _STICKS, 0.35)
        for s, low, high in ((above, 0.0, 3.2), (below, -11.0, 11.0))
    ]
    return [
        *shades,
        *above.across(0.0, END + 0.1, (), ""),
        *above.upwards(0.0, 3.5, (1, 2, 3), "v_T [m/s]"),
        *below.across(0.0, END + 0.1, (), ""),
        *below.across(0.0, END + 0.1, (1, 2), "t [s]", at=-14.0),
        *below.upwards(-14.0, 12.0, (-5, 0, 5), "λ_T [N]"),
        *(below.curve([(0.0, side * bound), (END, side * bound)], DIMENSION, 1, "5 4") for side in (-1.0, 1.0)),
        above.curve(_thinned(_series(states, "v"), 1e-3), FIRST, 2.2),
        below.curve(_thinned(_series(states, "friction"), 1e-3), SECOND, 2.2),
        words(above, (0.5 * (stop + torn), 1.4), "sticks", SMALL),
        words(below, (END, bound), "μ λ_N", SMALL, dy=15, anchor="end"),
        words(below, (1.2, -bound), "−μ λ_N", SMALL, dy=-8),
        _title(190, "block on a slope"),
    ]


def _belt() -> list[str]:
    states, _, values = gallery_run("stick_slip", 6.0, 1000)
    s = Plane((415, 176), 1050.0, up=340.0)
    speed = values["belt_speed"]
    points = [(state["x"], state["slip"] + speed) for _, state in states]
    return [
        *s.across(0.0, 0.225, (), ""),
        *s.across(0.0, 0.225, (0.0, 0.1, 0.2), "x [m]", at=-0.42),
        *s.upwards(-0.42, 0.33, (-0.4, -0.2, 0, 0.2), "x' [m/s]"),
        s.curve([(0.0, speed), (0.225, speed)], DIMENSION, 1, "5 4"),
        s.curve(_thinned(points, 2e-4), FIRST, 2.2),
        words(s, (0.225, speed), "speed of the belt", SMALL, dy=-8, anchor="end", colour=DIMENSION),
        words(s, (0.05, speed), "sticks", SMALL, dy=-8),
        words(s, (0.115, min(y for _, y in points)), "slips", SMALL, dy=-8),
        _title(535, "block on a belt, held by a spring"),
    ]


def _rolling() -> list[str]:
    states, events, values = gallery_run("backspin", 2.0, 200)
    s = Plane((725, 189), 95.0, up=15.7)
    ((rolls, _),) = events
    lines = (("velocity", 1.0, FIRST, "v"), ("speed", -values["radius"], SECOND, "−r ω"), ("slip", 1.0, INK, "v_T"))
    parts = [s.region([(rolls, -8.2), (2.0, -8.2), (2.0, 8.0), (rolls, 8.0)], _STICKS, 0.35)]
    parts += s.across(0.0, 2.15, (), "") + s.across(0.0, 2.15, (1, 2), "t [s]", at=-8.2)
    parts += s.upwards(-8.2, 8.7, (-6, -3, 0, 3, 6), "[m/s]")
    for name, factor, colour, text in lines:
        points = _thinned(_series(states, name, factor), 1e-3)
        parts.append(s.curve(points, colour, 2.2))
        (x, y), (u, v) = points[0], points[1]
        beside = (20, -6) if factor > 0.0 else (-6, -16)
        at = (0.3, y + (v - y) * (0.3 - x) / (u - x))
        parts.append(words(s, at, text, dx=beside[0], dy=beside[1], colour=colour))
    parts.append(words(s, (0.5 * (rolls + 2.0), 4.0), "rolls", SMALL))
    return [*parts, _title(825, "disc with backspin")]


def runs_drawing() -> str:
    """The picture as SVG text."""
    return sheet(955, 350, "Three motions with friction", [*_slope(), *_belt(), *_rolling()])
