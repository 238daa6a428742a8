"""When closed contacts let go, and in which order with what else happens in the same step: closed forms."""

import math
from dataclasses import replace

import pytest
from carried import FREQUENCY, carried
from rotor import Stop, rotor

from mechanism_fmu import codes
from mechanism_fmu.model import GROUND, Body, Force, Input, Mechanism, Output, PointLineContact
from mechanism_fmu.simulation import Simulation

MASS = 2.0


def pressed(forces, *, closed=None, speed=0.0):
    """Bodies on the floor, each pressed on it by a force that is an input, and a ball that flies along x at 1 m/s.

    It starts at x = 0; a wall stops it at x = `closed`. The bodies start upwards at `speed`.
    """
    bodies = [Body(f"body{k}", MASS, 0.3, start_rate=(0.0, speed, 0.0)) for k in range(len(forces))]
    floors = [
        PointLineContact(f"floor{k}", f"body{k}", (0.0, 0.0), GROUND, (0.0, 0.0), (0.0, 1.0))
        for k in range(len(forces))
    ]
    if closed is not None:
        bodies.append(Body("ball", 1.0, 1.0, start_rate=(1.0, 0.0, 0.0)))
        floors.append(PointLineContact("wall", "ball", (0.0, 0.0), GROUND, (closed, 0.0), (-1.0, 0.0)))
    return Simulation(
        Mechanism(
            bodies=tuple(bodies),
            forces=tuple(Force(f"press{k}", f"body{k}") for k in range(len(forces))),
            contacts=tuple(floors),
            inputs=tuple(Input(f"press{k}", f"press{k}.y", -force, "", "N") for k, force in enumerate(forces)),
            outputs=tuple(Output(f"y{k}", f"body{k}.y", "") for k in range(len(forces))),
        )
    )


def guards_and_times(simulation, until, slope=1.0):
    """Events while every force falls by `slope` newtons a second."""
    for k in range(len(simulation.inputs)):
        simulation.set_slope(f"press{k}", slope)
    simulation.advance(until)
    events = simulation.events_in_step()
    return [event.guard for event in events], [event.time for event in events]


@pytest.mark.parametrize("opens", [0.02, 0.3, 0.77, 1.0 - 1e-6])
def test_a_contact_lets_go_when_its_force_has_gone(opens):
    """It may lack some 1e-9 of the force at the start, within which it still pushes: that is the only delay."""
    simulation = pressed([opens])
    guards, times = guards_and_times(simulation, 1.0)
    assert guards == ["floor0.force"]
    assert opens <= times[0] <= opens + 2e-9
    assert simulation.read()["y0"] == pytest.approx((1.0 - opens) ** 3 / 6 / MASS, abs=1e-9)


def test_a_contact_whose_force_only_falls_stays_closed():
    simulation = pressed([1.0 + 1e-6])
    assert guards_and_times(simulation, 1.0) == ([], [])
    assert simulation.mode() == ("floor0",)


@pytest.mark.parametrize("opens", [(0.3, 0.7), (0.7, 0.3), (0.51, 0.52), (0.52, 0.51), (0.2, 0.9), (0.9, 0.2)])
def test_of_two_contacts_the_one_whose_force_goes_first_opens_first(opens):
    guards, times = guards_and_times(pressed(opens), 1.0)
    assert guards == [f"floor{k}.force" for k in sorted((0, 1), key=lambda k: opens[k])]
    assert times == pytest.approx(sorted(opens), abs=1e-8)


@pytest.mark.parametrize(("opens", "strikes"), [(0.3, 0.6), (0.6, 0.3), (0.51, 0.515), (0.515, 0.51), (0.9, 0.05)])
def test_an_impact_and_an_opening_in_one_step_come_in_their_order(opens, strikes):
    guards, times = guards_and_times(pressed([opens], closed=strikes), 1.0)
    expected = sorted([(opens, "floor0.force"), (strikes, "wall.gap")])
    assert guards == [name for _, name in expected]
    assert times == pytest.approx([time for time, _ in expected], abs=1e-8)


def test_contacts_that_let_go_at_once_are_open_at_once():
    simulation = pressed([0.4, 0.4])
    guards, times = guards_and_times(simulation, 1.0)
    assert set(guards) <= {"floor0.force", "floor1.force"}
    assert times == pytest.approx([0.4] * len(times), abs=1e-8)
    assert simulation.mode() == ()


@pytest.mark.parametrize("press", [0.9, 0.5, 0.0])
@pytest.mark.parametrize("guided", [True, False])
def test_a_seat_that_begins_to_pull_lets_go_unless_it_is_guided(press, guided):
    """Its force is proportional to press + cos(FREQUENCY t)."""
    mechanism = carried(press, tolerance=1e-10)
    mechanism = replace(mechanism, contacts=(replace(mechanism.contacts[0], guided=guided),))
    simulation = Simulation(mechanism)
    opens = math.acos(-press) / FREQUENCY
    simulation.advance(opens + 1e-3)
    events = simulation.events_in_step()
    if guided:
        assert events == []
        assert simulation.mode() == ("seat",)
    else:
        (event,) = events
        assert (event.guard, event.new_mode) == ("seat.force", ())
        assert event.time == pytest.approx(opens, abs=1e-7)


@pytest.mark.parametrize("share", [-0.7, 0.1, 0.8])
def test_an_impact_is_on_the_line_however_coarse_the_step(share):
    """The root is one of the step itself, not of its interpolant, which is less accurate."""
    mechanism = rotor([Stop(0.5 * share, -1, 0.5)], angle=0.5, frequency=3.0, tolerance=1e-3)
    simulation = Simulation(mechanism)
    simulation.begin_step()
    simulation.go_on(1.2 * math.acos(share) / 3.0, codes.STOP_AT_IMPACT)
    (hit,) = simulation.impacts_in_step()
    assert simulation.time == hit.time
    assert simulation.field("y_end")[2] == pytest.approx(0.5 * share, abs=5e-13)


@pytest.mark.parametrize(("speed", "slope"), [(0.3, 5.0), (1.0, 2.0)])
def test_the_time_of_an_impact_under_a_force_that_changes(speed, slope):
    """Thrown up, without weight, against a force that grows from zero: y = v t - s t^3 / 6 m."""
    lands = math.sqrt(6 * MASS * speed / slope)
    guards, times = guards_and_times(pressed([0.0], speed=speed), 1.1 * lands, -slope)
    assert guards == ["floor0.gap"]
    assert times == pytest.approx([lands], rel=1e-12)
