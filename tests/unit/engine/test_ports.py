"""Inputs between steps, and outputs of every kind against closed forms."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from rotor import ARM, INERTIA, Stop, rotor

from mechanism_fmu import codes
from mechanism_fmu.model import Output
from mechanism_fmu.simulation import Simulation

MOTION = (Output("angle", "rotor.angle", ""), Output("speed", "rotor.speed", ""), Output("work", "energy.work", ""))


@settings(deadline=None, max_examples=25)
@given(st.lists(st.tuples(st.floats(1e-4, 2.0), st.floats(-3.0, 3.0)), min_size=1, max_size=8))
def test_motion_under_a_torque_that_changes_between_steps(pieces):
    simulation = Simulation(rotor(outputs=MOTION))
    time, angle, speed, work = 0.0, 0.0, 0.0, 0.0
    for duration, acceleration in pieces:
        turned = speed * duration + acceleration * duration**2 / 2
        angle, speed = angle + turned, speed + acceleration * duration
        work += INERTIA * acceleration * turned
        time += duration
        simulation.set_input("torque", INERTIA * acceleration)
        simulation.advance(time)
        expected = {"angle": angle, "speed": speed, "work": work}
        assert simulation.read() == pytest.approx(expected, rel=1e-10, abs=1e-10)


def swinging(**changes):
    options = {"angle": 0.3, "speed": 0.2, "acceleration": 0.5, "frequency": 2.0}
    return Simulation(rotor([Stop(0.35, restitution=0.6)], **options | changes))


@settings(deadline=None, max_examples=25)
@given(st.lists(st.floats(0.0, 4.0), max_size=10).map(sorted))
def test_an_input_that_does_not_change_leaves_no_trace(times):
    interrupted, whole = swinging(), swinging()
    for time in times:
        interrupted.set_input("torque", 0.5 * INERTIA)
        interrupted.advance(time)
    for simulation in (interrupted, whole):
        simulation.advance(4.0)
        simulation.advance(4.0)  # empties the buffer of impacts
    np.testing.assert_array_equal(interrupted.state, whole.state)


def test_an_input_that_changes_makes_the_motion_start_anew_from_there():
    """What the engine had computed ahead is dropped: bit for bit, as if it had never been."""
    simulation = swinging()
    simulation.advance(0.05)
    ahead = simulation.field("clock")[codes.STEP_END]
    assert ahead > 0.05
    simulation.set_input("torque", 0.0)
    simulation.advance(0.05)
    assert simulation.field("clock")[codes.STEP_END] == 0.05


def test_start_values_of_inputs_can_be_replaced():
    simulation = Simulation(rotor(acceleration=5.0), inputs=[INERTIA * 1.0, INERTIA * 3.0])
    simulation.advance(1.0)
    simulation.set_input("torque", 0.0)
    simulation.advance(1.0)
    assert simulation.field("y_end")[[2, 5]] == pytest.approx([-1.0, -2.0])


OUTPUTS = {
    "angle": "rotor.angle",
    "speed": "rotor.speed",
    "x": "rotor.x",
    "y_rate": "rotor.y_rate",
    "force": "stop0.force",
    "gap": "stop0.gap",
    "kinetic": "energy.kinetic",
    "spring": "energy.spring",
    "work": "energy.work",
    "lost": "energy.lost",
    "count": "impact.count",
    "in_step": "impact.in_step",
    "lost_count": "impact.lost",
    "any": "impact.any",
    "when": "impact.time",
    "contact": "impact.contact",
    "tooth": "impact.tooth",
    "closing": "impact.closing_speed",
    "impulse": "impact.impulse:stop0",
    "before": "impact.speed_before:rotor",
    "after": "impact.speed:rotor",
    "buffered": "impacts[1].time",
    "empty": "impacts[2].time",
}


def read_at(simulation, *times):
    for time in times:
        simulation.advance(time)
    return simulation.read()


def test_outputs_of_every_kind():
    """From rest at 0 with 1 rad/s2; the stop at 0.5 rad is struck at 1 s with e = 1/2, and again at 2 s."""
    outputs = tuple(Output(name, source, "") for name, source in OUTPUTS.items())
    simulation = Simulation(rotor([Stop(0.5, restitution=0.5)], acceleration=1.0, outputs=outputs))

    before = read_at(simulation, 0.5)
    expected = {"angle": 0.125, "speed": 0.5, "x": 0.0, "y_rate": 0.0, "force": 0.0, "gap": ARM * math.sin(0.375)}
    expected |= {"kinetic": INERTIA / 8, "work": INERTIA / 8, "spring": 0.0, "lost": 0.0}
    expected |= {
        "count": 0,
        "in_step": 0,
        "lost_count": 0,
        "any": 0,
        "closing": 0,
        "impulse": 0,
        "before": 0,
        "after": 0,
    }
    expected |= {"when": -1, "contact": -1, "tooth": -1, "buffered": -1, "empty": -1}
    assert before == pytest.approx(expected, abs=1e-12)

    after = read_at(simulation, 1.5)
    expected |= {"angle": 0.375, "speed": 0.0, "gap": ARM * math.sin(0.125)}
    expected |= {"kinetic": 0.0, "work": INERTIA * 0.375, "lost": INERTIA * 0.375}
    expected |= {"count": 1, "in_step": 1, "any": 1, "closing": ARM, "impulse": 1.5 * INERTIA / ARM}
    expected |= {"before": 1.0, "after": -0.5, "when": 1.0, "contact": 0, "tooth": 0, "buffered": 1.0}
    assert after == pytest.approx(expected, abs=1e-12)

    later = read_at(simulation, 1.6)
    assert (later["count"], later["in_step"], later["any"], later["buffered"], later["when"]) == (
        1,
        0,
        0,
        -1,
        after["when"],
    )

    at_rest = read_at(simulation, 4.0)
    assert at_rest["force"] == pytest.approx(INERTIA / ARM)
    assert (at_rest["gap"], at_rest["in_step"]) == (0.0, 8)
    assert at_rest["lost_count"] == at_rest["count"] - 1 - 8


def test_a_contact_force_follows_an_input_at_once():
    """Direct feedthrough: at a communication point, the output is that of the input set there."""
    simulation = Simulation(rotor([Stop(0.0)], acceleration=1.0, outputs=(Output("force", "stop0.force", ""),)))
    simulation.advance(1.0)
    simulation.set_input("torque", 3 * INERTIA)
    assert simulation.read()["force"] == pytest.approx(3 * INERTIA / ARM)
    simulation.set_input("torque", INERTIA)
    state = simulation.state.copy()
    assert simulation.read()["force"] == pytest.approx(INERTIA / ARM)
    np.testing.assert_array_equal(simulation.state, state)


def test_reading_does_not_disturb_the_motion():
    read, unread = (
        Simulation(rotor([Stop(0.35)], angle=0.3, frequency=2.0, outputs=(Output("force", "stop0.force", ""),)))
        for _ in range(2)
    )
    for time in np.linspace(0.1, 3.0, 30):
        read.advance(time)
        read.read()
        unread.advance(time)
    np.testing.assert_array_equal(read.state, unread.state)


def test_spring_energy_leaves_out_the_preload_whose_work_is_counted():
    outputs = (Output("spring", "energy.spring", ""), Output("work", "energy.work", ""))
    simulation = Simulation(rotor(speed=1.0, frequency=2.0, outputs=outputs), inputs=[0.0, 0.7])
    simulation.advance(0.4)
    simulation.set_input("preload", 0.0)
    simulation.advance(0.4)
    angle = simulation.field("y_end")[2]
    assert simulation.read()["spring"] == pytest.approx(INERTIA * 2.0**2 / 2 * angle**2)
    assert simulation.read()["work"] == pytest.approx(-0.7 * angle)
