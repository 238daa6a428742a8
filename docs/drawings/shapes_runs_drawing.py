"""Outlines that touch, run by the engine: an edge, a pallet, a root; drawn by `shapes_drawing`."""

from __future__ import annotations

import math
from itertools import pairwise

from docs.joints.sketch import AXIS, BODY_I, BODY_J, EDGE, Sketch, add, turn
from mechanism_fmu.model import (
    GROUND,
    CircularCopies,
    Mechanism,
    Outline,
    OutlineContact,
    Output,
    Revolute,
    Torque,
    angle_output,
    deg,
    ratchet_tooth,
    rigid_body,
)
from mechanism_fmu.moving import Event
from mechanism_fmu.simulation import Simulation
from models.graham.model import MODEL as GRAHAM

from .pictures import Point, polar, sheet

_MOVES = f'fill="{BODY_I}" fill-opacity="0.55" {EDGE}'
_RESTS = f'fill="{BODY_J}" fill-opacity="0.75" {EDGE}'
_PATH = 'fill="none" stroke="#2b7a78" stroke-width="1.6"'

#: Of the disc: radius [m], speed [m/s]; gravity [m/s2].
RADIUS, SPEED, GRAVITY = 0.1, 0.3, 9.81


def placed(outline: Outline, at: Point = (0.0, 0.0), angle: float = 0.0) -> list[Point]:
    """Points along an outline, arcs in forty pieces, on a body that stands at a place [m] and an angle [rad]."""
    found: list[Point] = []
    for element in outline.elements:
        found += [element.point(k / 40) for k in range(1 if element.is_straight else 40)]
    if not outline.closed:
        found.append(outline.elements[-1].end)
    return [add(at, turn(point, angle)) for point in found]


def edge_run() -> tuple[list[Point], list[Event], list[Point]]:
    """A disc that slides over the edge of a table: its middle over time, what happened, and where it was then."""
    disc = rigid_body("disc", (-0.2, RADIUS), mass=1.0, inertia=0.005, velocity=(SPEED, 0.0))
    table = Outline.chain([(0.0, -1.0), (0.0, 0.0), (-1.0, 0.0)])
    top = OutlineContact("top", disc, GROUND, outline_i=Outline.circle(RADIUS), outline_j=table)
    outputs = (Output("x", disc.x, "", "m"), Output("y", disc.y, "", "m"))
    mechanism = Mechanism((disc,), contacts=(top,), outputs=outputs, gravity=(0.0, -GRAVITY))
    simulation, way, events = Simulation(mechanism), [(-0.2, RADIUS)], []
    for k in range(1, 97):
        simulation.advance(k * 0.01)
        events += simulation.events_in_step()
        way.append(_at(simulation))
    again, there = Simulation(mechanism), []
    for event in events:
        again.advance(event.time)
        there.append(_at(again))
    return way, events, there


def _at(simulation: Simulation) -> Point:
    shown = simulation.read()
    return shown["x"], shown["y"]


def edge_drawing() -> str:
    """The picture as SVG text."""
    way, events, there = edge_run()
    s = Sketch((330, 200), 700)
    parts = [
        s.path([(-0.42, 0.0), (0.0, 0.0), (0.0, -0.2), (-0.42, -0.2)], _RESTS, closed=True),
        *(s.disc(at, RADIUS, _MOVES) for at in (way[0], *there, way[-1])),
        s.path(way, _PATH),
        s.path([(0.0, 0.0), there[-1]], AXIS),
        s.path([(0.0, 0.0), (0.0, 0.16)], AXIS),
        s.dot((0.0, 0.0)),
        *(s.dot(at) for at in there),
        s.note(add(there[0], (-0.01, 0.115)), f"hand-over, {events[0].time:.4f} s"),
        s.note(add(there[-1], (0.2, 0.05)), f"leaves, {events[-1].time:.4f} s"),
        s.text((0.012, 0.075), "φ"),
        s.vector((-0.2, RADIUS), (-0.13, RADIUS), "v", -2, -12),
    ]
    return sheet(640, 350, "A disc passes over an edge and leaves it", parts)


#: A tick of the entry pallet of Graham's escapement, by its default data, is just over [s].
TICKED = 1.75


def graham_run() -> tuple[list[Event], list[dict[str, float]]]:
    """Graham's escapement from a tick to where its tooth leaves: events, and angles at them."""
    simulation, events = Simulation(GRAHAM.build(GRAHAM.values())), []
    simulation.advance(TICKED)
    simulation.advance(TICKED + 1.0)
    events = [event for event in simulation.events_in_step() if event.guard.startswith("entry")]
    again, shown = Simulation(GRAHAM.build(GRAHAM.values())), []
    for event in events:
        again.advance(event.time)
        shown.append(again.read())
    return events, shown


def pallet_drawing() -> str:
    """The picture as SVG text."""
    contact = GRAHAM.build(GRAHAM.values()).contacts[0]
    events, shown = graham_run()
    parts: list[str] = []
    said = ("dead arc to corner", "corner to impulse face", "end of the face to corner")
    for panel, text in enumerate(said):
        state = shown[panel]
        s = Sketch((125 + 220 * panel - 0.0207 * 27000, 150 + 0.0216 * 27000), 27000)
        parts.append(
            s.path(
                placed(contact.outline_i, (state["pendulum_x"], state["pendulum_y"]), state["pendulum_angle"]),
                _MOVES,
                closed=True,
            )
        )
        for tooth in range(contact.copies.count):
            angle = state["wheel_angle"] + math.tau * tooth / contact.copies.count
            middle = polar((0.0, 0.0), 0.030, angle)
            if math.hypot(middle[0] - 0.0207, middle[1] - 0.0216) < 0.003:
                parts.append(s.disc(middle, 0.0002, _RESTS))
                parts.append(s.vector(middle, polar((0.0, 0.0), 0.030, angle + 0.045), ""))
        parts.append(s.note((0.0207, 0.0216 - 0.0052), text))
        parts.append(s.note((0.0207, 0.0216 - 0.0052), f"{events[panel].time:.4f} s", dy=20))
    return sheet(680, 320, "A tooth on the entry pallet of Graham's escapement", parts)


#: Of the pawl: where its hinge is [m], radius of its tip [m], and where that is on it.
HINGE, TIP, AT = (0.09, 0.15), 3e-3, (0.1, 0.0)


def places_run() -> tuple[Outline, dict[str, float], list[str]]:
    """A pawl that falls into a root of a ratchet wheel, which is pushed against it: the tooth, both at rest, events."""
    wheel = rigid_body("wheel", mass=1.0, inertia=1e-3, angle=deg(92))
    pawl = rigid_body("pawl", HINGE, mass=0.1, inertia=1e-4, angle=deg(192))
    tooth = ratchet_tooth(10, deg(90), 0.1, 1.115, tip_radius="1 mm")
    tip, copies = Outline.circle(TIP, AT), CircularCopies(10)
    contact = OutlineContact("tooth", pawl, wheel, outline_i=tip, outline_j=tooth, copies=copies)
    joints = (Revolute("a", wheel.at(0, 0), GROUND), Revolute("b", pawl.at(0, 0), GROUND.at(*HINGE)))
    forces = (Torque("spring", pawl, torque=0.05), Torque("load", wheel, torque=PUSH))
    outputs = (angle_output("wheel", wheel.angle, ""), angle_output("pawl", pawl.angle, ""))
    outputs += tuple(Output(f"force_{k}", f"tooth{end}.force", "", "N") for k, end in ((1, ""), (2, "_2")))
    simulation = Simulation(Mechanism((wheel, pawl), joints, forces, (contact,), outputs=outputs))
    simulation.advance(1.0)
    return tooth, simulation.read(), [event.guard for event in simulation.events_in_step()]


#: On the wheel, against its pawl [N.m].
PUSH = -0.2


def places_drawing() -> str:
    """The picture as SVG text."""
    tooth, shown, _ = places_run()
    middle = add(HINGE, turn(AT, shown["pawl"]))
    s = Sketch((200 - 5600 * middle[0], 190 + 5600 * middle[1]), 5600)
    wheel = [p for k in range(10) for p in placed(tooth, angle=shown["wheel"] + math.tau * k / 10)]
    near = [p for p in wheel if math.hypot(p[0] - middle[0], p[1] - middle[1]) < 0.12]
    parts = [s.path([*near, (0.0, 0.0)], _RESTS, closed=True), s.path([middle, HINGE], AXIS)]
    parts.append(s.disc(middle, TIP, _MOVES))
    for start, end in pairwise(near):
        way = complex(*end) - complex(*start)
        along = (complex(*middle) - complex(*start)) / way if way else 0j
        if 0.0 < along.real < 1.0 and abs(abs(along.imag) * abs(way) - TIP) < 1e-6:
            foot = complex(*start) + along.real * way
            out = (complex(*middle) - foot) / TIP
            parts.append(s.dot((foot.real, foot.imag)))
            tail = foot - 0.014 * out
            parts.append(s.vector((tail.real, tail.imag), (foot.real, foot.imag), ""))
    return sheet(480, 320, "A pawl's round tip between slope and face of two teeth", parts)
