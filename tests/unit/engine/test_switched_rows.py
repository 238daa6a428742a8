"""Rows that logical functions switch, and events that cannot be resolved."""

import math

import pytest

from mechanism_fmu.model import (
    GROUND,
    AngleLock,
    Body,
    Force,
    LogicalFunction,
    Mechanism,
    MechanismError,
    Output,
    PointLineContact,
    Revolute,
)
from mechanism_fmu.simulation import Simulation, SimulationError


def locked_wheel(limit, *, angle=0.3, pitch=1.0, speed=0.5):
    """A wheel that turns freely and is locked at angle + k pitch once it has passed `limit`."""
    return Mechanism(
        bodies=(Body("wheel", 1.0, 0.2, (0.0, 0.0, 0.0), (0.0, 0.0, speed)),),
        joints=(Revolute("hinge", "wheel", (0.0, 0.0), GROUND, (0.0, 0.0)),),
        contacts=(AngleLock("lock", "wheel", GROUND, angle, pitch, closed_while="not free"),),
        functions=(LogicalFunction("free", of="wheel.angle", below=limit),),
        outputs=(
            Output("angle", "wheel.angle", ""),
            Output("lost", "energy.lost", ""),
            Output("k", "energy.kinetic", ""),
        ),
    )


def test_a_lock_closes_where_it_holds_and_takes_the_speed():
    simulation = Simulation(locked_wheel(1.3))
    simulation.advance(5.0)
    found = simulation.read()
    assert found["angle"] == pytest.approx(1.3, abs=1e-9)
    assert found["k"] == pytest.approx(0.0, abs=1e-15)
    assert found["lost"] == pytest.approx(0.5 * 0.2 * 0.5**2, rel=1e-12)
    (event,) = simulation.events_in_step()
    assert (event.guard, event.new_mode) == ("free", ("lock",))
    assert event.impulse == pytest.approx(0.2 * 0.5, rel=1e-9)


def test_a_lock_that_closes_elsewhere_is_refused_instead_of_jumping():
    simulation = Simulation(locked_wheel(0.9))
    with pytest.raises(SimulationError, match=r"t = 1.8 s: A logical function closes a row where.*Contacts: lock"):
        simulation.advance(5.0)
    assert simulation.read()["angle"] == pytest.approx(0.9, abs=1e-9)


def test_after_a_failed_event_only_a_restored_state_goes_on():
    simulation = Simulation(locked_wheel(0.9))
    simulation.advance(1.0)
    saved = simulation.state.copy()
    for until in (5.0, 5.0, 6.0):
        with pytest.raises(SimulationError, match="closes a row"):
            simulation.advance(until)
    assert simulation.time == pytest.approx(1.8, abs=1e-9)
    simulation.state[:] = saved
    simulation.advance(1.5)
    assert simulation.read()["angle"] == pytest.approx(0.75, abs=1e-12)


@pytest.mark.parametrize("target", [0.5, -1.0, math.nan, math.inf])
def test_the_motion_goes_forwards_only(target):
    simulation = Simulation(locked_wheel(9.0))
    simulation.advance(1.0)
    with pytest.raises(SimulationError, match=r"t = 1 s: the motion cannot go on to .*give a later time"):
        simulation.advance(target)
    assert simulation.time == 1.0


def test_chattering_is_an_error_with_time_and_names():
    """A ball at 1e6 m/s in a slit of 20 nm: 5e13 impacts a second, 2e7 in the time in which it passes its own size."""
    walls = [
        PointLineContact(name, "ball", (0, 0), GROUND, (0.0, y), (0.0, side), restitution=1.0)
        for name, y, side in (("floor", 0.0, 1.0), ("lid", 2e-8, -1.0))
    ]
    ball = Body("ball", 1.0, 1.0, (0.0, 1e-8, 0.0), (0.0, 1e6, 0.0))
    simulation = Simulation(Mechanism((ball,), forces=(Force("none", "ball"),), contacts=tuple(walls)))
    with pytest.raises(SimulationError, match=r"t = .* s: No progress"):
        simulation.advance(1.0)
    assert simulation.time < 1e-8


@pytest.mark.parametrize(
    "changes",
    [{"guided": True}, {"closed": True}, {"restitution": 0.5}, {"enabled": math.nan}, {"enabled": -1}],
)
def test_what_has_no_meaning_for_a_switched_row_is_refused(changes):
    slot = PointLineContact("slot", "arm", (1.0, 0.0), GROUND, (0, 0), (0.0, 1.0), closed_while="f", **changes)
    function = LogicalFunction("f", of="slot.along", below=0.5)
    with pytest.raises(MechanismError, match="'slot'"):
        Simulation(Mechanism((Body("arm", 1.0, 1.0),), contacts=(slot,), functions=(function,)))
