"""A communication step in pieces: the motion is the same, bit for bit, wherever it is stopped."""

import math

import numpy as np
import pytest
from rotor import ARM, INERTIA, Stop, rotor

from mechanism_fmu import codes
from mechanism_fmu.model import Output
from mechanism_fmu.simulation import Simulation, SimulationError

OUTPUTS = (Output("angle", "rotor.angle", ""), Output("force", "stop0.force", ""), Output("lost", "energy.lost", ""))
END = 8.0


def bouncing():
    stops = [Stop(0.5, restitution=0.9), Stop(-0.4, sign=-1, restitution=0.8)]
    return Simulation(rotor(stops, speed=1.0, acceleration=0.3, frequency=2.0, outputs=OUTPUTS))


def stops_of(simulation, target, rule, *, begin=False):
    """Times at which the rule stops a step to `target`; each piece is a step of its own if `begin`."""
    found = []
    simulation.begin_step()
    while simulation.time < target:
        if begin and found:
            simulation.begin_step()
        simulation.go_on(target, rule)
        found.append(simulation.time)
    return found


def motion(simulation):
    """The state without its records and what it says of inputs."""
    fields = ("y_end", "dy_end", "dense", "contact_mode", "ledger", "last_impact")
    return np.concatenate([*(simulation.field(name).ravel() for name in fields), simulation.field("clock")[:6]])


@pytest.mark.parametrize("slope", [0.0, 0.2])
@pytest.mark.parametrize("rule", [codes.STOP_AT_TARGET, codes.STOP_AT_IMPACT, codes.STOP_AT_STEP])
def test_the_state_is_the_same_with_every_rule(rule, slope):
    whole, stopped = bouncing(), bouncing()
    for simulation in (whole, stopped):
        simulation.advance(0.1)
        simulation.set_slope("torque", slope)
    whole.advance(END)
    times = stops_of(stopped, END, rule)
    np.testing.assert_array_equal(stopped.state, whole.state)
    assert whole.counters[codes.COUNT_IMPACTS] > 3
    assert (len(times) == 1) == (rule == codes.STOP_AT_TARGET)


def test_a_new_step_may_begin_at_each_stop():
    whole, stopped = bouncing(), bouncing()
    whole.advance(END)
    stops_of(stopped, END, codes.STOP_AT_STEP, begin=True)
    np.testing.assert_array_equal(motion(stopped), motion(whole))


def test_stops_at_impacts_are_right_after_them_and_have_their_records():
    whole, stopped = bouncing(), bouncing()
    whole.advance(END)
    expected = whole.impacts_in_step()
    assert 3 < len(expected) < codes.IMPACT_BUFFER_LENGTH
    found = []
    while stopped.time < END:
        stopped.begin_step()
        assert stopped.impacts_in_step() == stopped.events_in_step() == []
        stopped.go_on(END, codes.STOP_AT_IMPACT)
        found += stopped.impacts_in_step()
        if stopped.time < END:
            (impact,) = stopped.impacts_in_step()
            assert impact.time == stopped.time == stopped.field("clock")[codes.STEP_END]
    assert found == expected
    np.testing.assert_array_equal(motion(stopped), motion(whole))


def test_the_state_at_a_stop_is_the_one_after_the_impact():
    simulation = Simulation(rotor([Stop(0.5, restitution=0.5)], acceleration=1.0))
    simulation.begin_step()
    simulation.go_on(10.0, codes.STOP_AT_IMPACT)
    assert simulation.time == pytest.approx(1.0, abs=1e-12)
    assert simulation.field("y_end")[[2, 5]] == pytest.approx([0.5, -0.5])


def test_an_event_without_an_impact_does_not_stop_at_impacts():
    """A torque that ramps through zero lifts the arm off its stop: an event, but no impact."""
    mechanism = rotor([Stop(0.0)], acceleration=1.0)
    for rule, end in ((codes.STOP_AT_IMPACT, 3.0), (codes.STOP_AT_TARGET, 3.0)):
        simulation = Simulation(mechanism)
        simulation.set_slope("torque", -INERTIA)
        simulation.begin_step()
        simulation.go_on(3.0, rule)
        assert simulation.time == end


def test_stops_at_steps_are_the_engines_own():
    simulation, times = bouncing(), []
    simulation.begin_step()
    while simulation.time < END:
        before = simulation.counters[codes.COUNT_STEPS]
        simulation.go_on(END, codes.STOP_AT_STEP)
        times.append(simulation.time)
        assert simulation.counters[codes.COUNT_STEPS] - before <= 1
        if simulation.time < END:
            assert simulation.time == simulation.field("clock")[codes.STEP_END]
    assert times == sorted(times)
    assert len(times) > 20


def test_a_stop_at_an_impact_exactly_at_the_target():
    mechanism = rotor([Stop(0.5, restitution=0.5)], acceleration=1.0)
    first = Simulation(mechanism)
    first.begin_step()
    first.go_on(10.0, codes.STOP_AT_IMPACT)
    second = Simulation(mechanism)
    second.begin_step()
    second.go_on(first.time, codes.STOP_AT_IMPACT)
    np.testing.assert_array_equal(second.state, first.state)
    second.go_on(first.time, codes.STOP_AT_IMPACT)  # there already
    np.testing.assert_array_equal(second.state, first.state)
    second.begin_step()
    assert second.impacts_in_step() == []


def test_what_is_set_at_a_stop_acts_from_the_next_step_on():
    simulation = Simulation(rotor([Stop(0.5, restitution=0.5)], acceleration=1.0, outputs=OUTPUTS))
    simulation.begin_step()
    simulation.go_on(10.0, codes.STOP_AT_IMPACT)
    simulation.set_input("torque", 0.0)
    simulation.begin_step()
    simulation.go_on(simulation.time + 1.0, codes.STOP_AT_IMPACT)
    assert simulation.read()["angle"] == pytest.approx(0.5 - 0.5)


def test_a_stopped_step_goes_on_from_a_saved_state_in_another_instance():
    first, second = bouncing(), bouncing()
    first.set_slope("torque", 0.2)
    first.begin_step()
    first.go_on(END, codes.STOP_AT_IMPACT)
    saved = first.state.copy()
    first.go_on(END, codes.STOP_AT_TARGET)
    second.set_input("torque", 1.0)
    second.advance(3.0)
    second.state[:] = saved
    second.go_on(END, codes.STOP_AT_STEP)
    second.go_on(END, codes.STOP_AT_TARGET)
    np.testing.assert_array_equal(second.state, first.state)


def test_after_a_failed_event_neither_a_step_begins_nor_goes_on():
    simulation = bouncing()
    simulation.counters[[codes.PENDING_GUARD, codes.PENDING_SUBJECT]] = codes.GUARD_FAILED, 7
    state = simulation.state.copy()
    for call in (simulation.begin_step, lambda: simulation.go_on(1.0, codes.STOP_AT_TARGET)):
        with pytest.raises(SimulationError, match="without progress in time"):
            call()
        np.testing.assert_array_equal(simulation.state, state)


def test_the_force_on_a_stop_is_that_of_the_value_reached():
    simulation = Simulation(rotor([Stop(0.0)], acceleration=1.0, outputs=OUTPUTS))
    simulation.set_slope("torque", 2.0 * INERTIA)
    simulation.begin_step()
    while simulation.time < 1.0:
        simulation.go_on(1.0, codes.STOP_AT_STEP)
        reached = INERTIA * (1.0 + 2.0 * simulation.time)
        assert simulation.inputs[0] == pytest.approx(reached)
        assert simulation.read()["force"] == pytest.approx(reached / ARM)
    assert math.isclose(simulation.inputs[0], 3.0 * INERTIA)
