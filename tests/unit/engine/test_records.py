"""The event log: what made each event happen, the mode before and after, and what a long communication step keeps."""

import math

import numpy as np
import pytest
from rotor import ARM, INERTIA, Stop, rotor

from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    AngleLock,
    AngleStop,
    Body,
    CircularPattern,
    Force,
    Input,
    LogicalFunction,
    Mechanism,
    Output,
    PointLineContact,
    Revolute,
    Torque,
    TorsionSpring,
)
from mechanism_fmu.simulation import Event, Simulation

COUNT = (Output("events", "event.count", "", type="Integer"),)


def spinning(contacts=(), functions=(), patterns=(), *, speed=1.0, torque=0.0):
    """A rotor that turns at constant speed, or under a torque."""
    return Mechanism(
        bodies=(Body("rotor", 1.0, INERTIA, (0.0, 0.0, 0.0), (0.0, 0.0, speed)),),
        joints=(Revolute("hinge", "rotor", (0.0, 0.0), GROUND, (0.0, 0.0)),),
        forces=(Torque("drive", "rotor", torque=torque),),
        contacts=contacts,
        functions=functions,
        patterns=patterns,
        outputs=COUNT,
    )


def thrown_up(restitution=0.0):
    """Falls on a floor, at t = 1 first, with g = 2 from a height of 1."""
    floor = PointLineContact("floor", "ball", (0.0, 0.0), GROUND, (0.0, 0.0), (0.0, 1.0), restitution=restitution)
    wall = PointLineContact("wall", "ball", (0.0, 0.0), GROUND, (-5.0, 0.0), (1.0, 0.0))
    return Mechanism(
        bodies=(Body("ball", 3.0, 1.0, (0.0, 1.0, 0.0)),),
        forces=(Force("weight", "ball", (0.0, -6.0)),),
        contacts=(wall, floor),
        outputs=COUNT,
    )


def numbers(simulation):
    """The event records of the last communication step, as they stand in the block."""
    return simulation.field("events")[: simulation.counters[codes.EVENTS_IN_STEP]]


def test_before_the_first_event_the_log_is_empty():
    simulation = Simulation(thrown_up())
    assert simulation.events_in_step() == []
    simulation.advance(0.5)
    assert simulation.events_in_step() == []
    assert not simulation.field("events").any()
    assert simulation.read()["events"] == 0


def test_an_impact_that_sticks_is_one_event_with_its_impulse_and_modes():
    simulation = Simulation(thrown_up())
    simulation.advance(1.5)
    (event,) = simulation.events_in_step()
    assert event == Event(pytest.approx(1.0, abs=1e-12), "floor.gap", (), ("floor",), pytest.approx(6.0))
    (record,) = numbers(simulation)
    assert record[[codes.EVENT_GUARD, codes.EVENT_SUBJECT]].tolist() == [codes.GUARD_GAP, 1]
    assert record[[codes.EVENT_OLD_MODE, codes.EVENT_NEW_MODE]].tolist() == [0, 2]  # the floor is contact 1
    simulation.advance(1.6)
    assert simulation.events_in_step() == []
    assert simulation.read()["events"] == 1


def test_an_event_belongs_to_the_communication_step_that_ends_with_it():
    simulation = Simulation(thrown_up(0.5))
    simulation.advance(1.5)
    time = simulation.events_in_step()[0].time
    again = Simulation(thrown_up(0.5))
    again.advance(math.nextafter(time, 0.0))
    assert again.events_in_step() == []
    again.advance(time)
    assert [event.time for event in again.events_in_step()] == [time]
    again.advance(1.5)
    assert again.events_in_step() == []


def test_a_long_communication_step_keeps_the_newest_events_and_counts_all():
    """Between two elastic stops 1 rad apart the arm strikes every second."""
    arm = rotor([Stop(0.5, 1, 1.0), Stop(-0.5, -1, 1.0)], speed=1.0, outputs=COUNT)
    simulation = Simulation(arm)
    kept = codes.EVENT_BUFFER_LENGTH
    simulation.advance(kept)
    assert len(simulation.events_in_step()) == kept
    simulation = Simulation(arm)
    simulation.advance(kept + 5.0)
    events = simulation.events_in_step()
    assert len(events) == kept
    np.testing.assert_allclose([event.time for event in events], np.arange(5, kept + 5) + 0.5, atol=1e-10)
    assert [event.guard for event in events[:2]] == ["stop1.gap", "stop0.gap"]
    assert simulation.read()["events"] == kept + 5
    impulses = [event.impulse for event in events]
    np.testing.assert_allclose(impulses, 2 * INERTIA / ARM, rtol=1e-10)
    simulation.advance(kept + 6.0)
    assert [event.time for event in simulation.events_in_step()] == pytest.approx([kept + 5.5])
    assert not simulation.field("events")[1:].any()


def test_outputs_of_a_full_buffer_are_the_newest_impacts_in_their_order():
    kept = codes.IMPACT_BUFFER_LENGTH
    slots = tuple(Output(f"hit{k}", f"impacts[{k + 1}].time", "", "s") for k in range(kept))
    simulation = Simulation(rotor([Stop(0.5, 1, 1.0), Stop(-0.5, -1, 1.0)], speed=1.0, outputs=slots))
    simulation.advance(kept + 5.0)
    times = np.arange(5, kept + 5) + 0.5
    np.testing.assert_allclose([hit.time for hit in simulation.impacts_in_step()], times, atol=1e-10)
    np.testing.assert_allclose(list(simulation.read().values()), times, atol=1e-10)
    assert [hit.time for hit in simulation.impacts_in_step(2)] == pytest.approx(times[-2:])


def test_the_communication_steps_do_not_change_the_log():
    mechanism = thrown_up(0.7)
    whole, pieces = Simulation(mechanism), Simulation(mechanism)
    whole.advance(4.0)
    found = []
    for time in np.linspace(0.01, 4.0, 400):
        pieces.advance(time)
        found += pieces.events_in_step()
    assert len(found) == pieces.read()["events"] == whole.read()["events"] > 2
    assert found[-codes.EVENT_BUFFER_LENGTH :] == whole.events_in_step()


def test_a_contact_that_lets_go_is_an_event_without_impulse():
    """A block that lies on the floor is lifted by an input."""
    floor = PointLineContact("floor", "block", (0.0, 0.0), GROUND, (0.0, 0.0), (0.0, 1.0))
    lift = Input("lift", "weight.y", -1.0, "", "N")
    block = Mechanism((Body("block", 1.0, 1.0),), forces=(Force("weight", "block"),), contacts=(floor,), inputs=(lift,))
    simulation = Simulation(block)
    simulation.advance(1.0)
    assert simulation.events_in_step() == []
    assert simulation.mode() == ("floor",)
    simulation.set_input("lift", 2.0)
    simulation.advance(2.0)
    assert simulation.events_in_step() == [Event(1.0, "input", ("floor",), (), 0.0)]
    assert simulation.field("y_end")[4] > 0


def test_an_input_that_changes_no_mode_is_no_event():
    simulation = Simulation(rotor([Stop(0.5)], outputs=COUNT))
    for time in np.linspace(0.1, 1.0, 10):
        simulation.set_input("torque", 1e-6 * time)
        simulation.advance(time)
        assert simulation.events_in_step() == []
    assert simulation.read()["events"] == 0


def test_a_force_that_ends_is_an_event_at_the_closed_form_instant():
    """A flap is pressed on its seat by a spring to a turning rotor, J phi'' = -k (phi - angle), until phi = angle."""
    speed, angle, stiffness = 0.5, 0.3, 0.1
    mechanism = Mechanism(
        bodies=(Body("rotor", 1.0, INERTIA, (0.0, 0.0, 0.0), (0.0, 0.0, speed)), Body("flap", 1.0, 0.1)),
        joints=(
            Revolute("hinge", "rotor", (0.0, 0.0), GROUND, (0.0, 0.0)),
            Revolute("flap_hinge", "flap", (0.0, 0.0), GROUND, (0.0, 0.0)),
        ),
        forces=(TorsionSpring("spring", "flap", "rotor", stiffness=stiffness, free_angle=-angle),),
        contacts=(PointLineContact("seat", "flap", (ARM, 0.0), GROUND, (0.0, 0.0), (0.0, 1.0)),),
        outputs=(Output("force", "seat.force", ""),),
    )
    frequency = math.sqrt(stiffness / INERTIA)
    expected = math.atan2(angle, speed / frequency) / frequency
    simulation = Simulation(mechanism)
    for share in (0.25, 0.5, 0.9):
        simulation.advance(share * expected)
        turned = frequency * share * expected
        left = angle * math.cos(turned) - speed / frequency * math.sin(turned)
        assert simulation.read()["force"] == pytest.approx(stiffness * left / ARM, rel=1e-7)
    simulation.advance(1.1 * expected)
    (event,) = simulation.events_in_step()
    assert event == Event(pytest.approx(expected, abs=1e-7), "seat.force", ("seat",), (), 0.0)


def test_a_stop_with_memory_clicks_once_a_pitch():
    simulation = Simulation(spinning((AngleStop("stop", "rotor", GROUND, -0.1, 0.25),)))
    simulation.advance(1.0)
    events = simulation.events_in_step()
    np.testing.assert_allclose([event.time for event in events], [0.15, 0.4, 0.65, 0.9], atol=1e-9)
    assert {(event.guard, event.old_mode, event.new_mode, event.impulse) for event in events} == {
        ("stop.click", (), (), 0.0)
    }
    assert simulation.field("contact_clicks").tolist() == [4]
    assert simulation.field("contact_line")[0, 0] == pytest.approx(-0.1 + 4 * 0.25)


def test_a_logical_function_that_changes_names_itself_and_both_modes():
    """The lock that it closes stops the rotor at the nearest locked angle."""
    lock = AngleLock("lock", "rotor", GROUND, 0.0, 0.5, "not low")
    simulation = Simulation(spinning((lock,), (LogicalFunction("low", "rotor.angle", 1.0),), speed=2.0))
    simulation.advance(1.0)
    (event,) = simulation.events_in_step()
    assert event[:4] == (pytest.approx(0.5, abs=1e-9), "low", (), ("lock",))
    assert simulation.field("y_end")[5] == pytest.approx(0.0, abs=1e-9)
    # held at the nearest locked angle
    assert simulation.field("contact_line")[0, 0] == pytest.approx(1.0)
    assert simulation.field("y_end")[2] == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("pitch", [0.5, -0.5])
def test_a_pattern_that_goes_on_to_the_next_or_previous_copy(pitch):
    """A point turns about the wheel, whose boundaries are radial lines at -pitch/2 + k pitch."""
    half = abs(pitch) / 2
    turn = math.copysign(1.0, pitch)
    pattern = CircularPattern(
        "slots",
        "rotor",
        (1.0, 0.0),
        "wheel",
        pitch,
        (0.0, 0.0),
        (-turn * math.sin(turn * half), turn * math.cos(turn * half)),
    )
    mechanism = Mechanism(
        bodies=(Body("rotor", 1.0, INERTIA, (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)), Body("wheel", 1.0, 1.0)),
        joints=(
            Revolute("hinge", "rotor", (0.0, 0.0), GROUND, (0.0, 0.0)),
            Revolute("wheel_hinge", "wheel", (0.0, 0.0), GROUND, (0.0, 0.0)),
        ),
        patterns=(pattern,),
        outputs=(Output("index", "slots.index", "", type="Integer"),),
    )
    simulation = Simulation(mechanism)
    simulation.advance(2.0)
    events = simulation.events_in_step()
    np.testing.assert_allclose([event.time for event in events], [0.25, 0.75, 1.25, 1.75], atol=1e-9)
    assert {event.guard for event in events} == {"slots.next" if pitch > 0 else "slots.previous"}
    assert simulation.read()["index"] == (4 if pitch > 0 else -4)


def test_mode_numbers_are_sums_of_powers_of_two():
    """Stops 0 and 2 hold the arm, 1 does not: 1 + 4."""
    simulation = Simulation(rotor([Stop(0.3), Stop(-0.3, -1), Stop(0.3)], acceleration=1.0))
    simulation.advance(2.0)
    (record,) = numbers(simulation)
    assert record[[codes.EVENT_OLD_MODE, codes.EVENT_NEW_MODE]].tolist() == [0, 5]
    assert simulation.mode() == simulation.events_in_step()[0].new_mode == ("stop0", "stop2")


def test_the_number_of_fifty_contacts_is_exact():
    stops = [Stop(0.3)] + [Stop(0.4 + 0.01 * k) for k in range(48)] + [Stop(0.3)]
    simulation = Simulation(rotor(stops, acceleration=1.0))
    simulation.advance(1.0)
    (record,) = numbers(simulation)
    assert int(record[codes.EVENT_NEW_MODE]) == 1 + 2**49
    assert simulation.events_in_step()[0].new_mode == ("stop0", "stop49")
