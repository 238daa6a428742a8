"""Nothing is passed unseen: by long steps, behind events within a step, after an input has changed, and in a row."""

import math

import numpy as np
import pytest

from mechanism_fmu.model import (
    GROUND,
    Body,
    Force,
    Input,
    LinearCopies,
    Mechanism,
    Outline,
    OutlineContact,
    Output,
)
from mechanism_fmu.simulation import Simulation

DISC = Outline.circle(0.1)


@pytest.mark.parametrize("start", [-8.775850567, *np.linspace(-12.0, -3.0, 20)])
def test_what_bounces_back_right_behind_a_close_pass_strikes(start: float) -> None:
    """A disc passes a round obstacle 1 mm away, and a plate throws it back towards the middle of that."""
    turns_at = np.array([0.3, 0.601])
    back = -turns_at / np.linalg.norm(turns_at)
    normal = (back - [1.0, 0.0]) / np.linalg.norm(back - [1.0, 0.0])
    foot, along = turns_at - 0.1 * normal, np.array([-normal[1], normal[0]])
    corners = [foot + 0.3 * along, foot - 0.3 * along]
    corners += [corners[1] - 0.3 * normal, corners[0] - 0.3 * normal]
    plate = Outline.polygon([(float(x), float(y)) for x, y in corners[::-1]])
    body = Body("a", 1.0, 0.01, start=(start, 0.601, 0.0), start_rate=(1.0, 0.0, 0.0))
    contacts = tuple(
        OutlineContact(name, body, GROUND, outline_i=DISC, outline_j=other, restitution=1.0, points=1)
        for name, other in (("round", Outline.circle(0.5)), ("plate", plate))
    )
    outputs = (Output("x", "a.x", ""), Output("y", "a.y", ""))
    simulation = Simulation(Mechanism((body,), contacts=contacts, outputs=outputs))
    arrives = 0.3 - start
    gap = math.hypot(*turns_at) - 0.6
    simulation.advance(arrives + gap + 0.01)
    events = simulation.events_in_step()
    assert [event.guard for event in events] == ["plate.gap", "round.gap"]
    assert [event.time for event in events] == pytest.approx([arrives, arrives + gap], abs=1e-9)


@pytest.mark.parametrize("push", [-20.0, -1000.0])
@pytest.mark.parametrize("time", [0.75, 0.89])
def test_a_disc_that_is_pushed_back_does_not_pass_a_plate(time: float, push: float) -> None:
    """It flies away from the plate; the engine is ahead of the instant at which a force begins to push it back."""
    plate = Outline.polygon([(-0.15, -1.0), (-0.1, -1.0), (-0.1, 1.0), (-0.15, 1.0)])
    body = Body("a", 1.0, 0.01, start=(0.05, 0.0, 0.0), start_rate=(1.0, 0.0, 0.0))
    touch = OutlineContact("touch", body, GROUND, outline_i=DISC, outline_j=plate, restitution=1.0, points=2)
    simulation = Simulation(
        Mechanism(
            (body,),
            forces=(Force("push", body),),
            contacts=(touch,),
            inputs=(Input("push", "push.x", 0.0, "", "N"),),
            outputs=(Output("x", "a.x", ""),),
        )
    )
    simulation.advance(time)
    simulation.set_input("push", push)
    least = math.inf
    for k in range(1, 60):
        simulation.set_slope("push", -1e-6)
        simulation.advance(time + 0.02 * k)
        least = min(least, simulation.read()["x"])
    assert simulation.counters[0] > 0
    assert least > -1e-9


@pytest.mark.parametrize("height", [10.0, 100.0, 1e3, 1e4])
@pytest.mark.parametrize("shape", ["disc", "slat"])
def test_a_thin_plate_stops_what_falls_on_it_from_high_up(shape: str, height: float) -> None:
    """A fall takes steps of any length: in 1/512 of one, the body moves by many times its size."""
    outlines = {"disc": DISC, "slat": Outline.polygon([(0.1, 0.01), (-0.1, 0.01), (-0.1, -0.01), (0.1, -0.01)])}
    low = {"disc": 0.1, "slat": 0.01}[shape]
    plate = Outline.polygon([(1.0, 0.0), (-1.0, 0.0), (-1.0, -0.05), (1.0, -0.05)])
    body = Body("a", 1.0, 0.01, start=(0.0, height, 0.0))
    touch = OutlineContact("touch", body, GROUND, outline_i=outlines[shape], outline_j=plate, points=4)
    outputs = (Output("y", "a.y", ""),)
    simulation = Simulation(Mechanism((body,), contacts=(touch,), gravity=(0.0, -9.81), outputs=outputs))
    lands = math.sqrt(2.0 * (height - low) / 9.81)
    simulation.advance(lands + 1.0)
    assert simulation.impacts_in_step()[0].time == pytest.approx(lands, rel=1e-9)
    assert simulation.read()["y"] == pytest.approx(low, abs=1e-9)


@pytest.mark.parametrize(("copy", "is_there"), [(-2, False), (-1, True), (0, True), (1, True), (2, True), (3, False)])
def test_a_row_has_as_many_copies_as_it_says(copy: int, is_there: bool) -> None:
    """Four: one before the outline that is given, and two behind it."""
    body = Body("a", 1.0, 0.01, start=(float(copy), 0.5, 0.0))
    row = LinearCopies((1.0, 0.0), count=4)
    post = Outline.circle(0.2)
    touch = OutlineContact("touch", body, GROUND, outline_i=DISC, outline_j=post, copies=row, restitution=0.0)
    simulation = Simulation(Mechanism((body,), contacts=(touch,), gravity=(0.0, -9.81)))
    simulation.advance(0.25)
    assert simulation.counters[0] == (1 if is_there else 0)
