"""A communication step that needs too many internal steps ends early, says why, and can be continued."""

import math
import re
from dataclasses import replace

import pytest

from mechanism_fmu import codes
from mechanism_fmu.model import GROUND, Body, CompliantShaft, Mechanism, MechanismError, Revolute, Settings, Torque
from mechanism_fmu.simulation import Simulation, SimulationError, StepBudgetError

INERTIA, STIFFNESS = 1e-3, 1e3
FREQUENCY = math.sqrt(STIFFNESS / INERTIA)  # 1000 rad/s


def spring_and_rotor(budget, stiffness=STIFFNESS):
    """A rotor on a shaft that stands still, turned away by 0.1 rad."""
    return Mechanism(
        bodies=(Body("rotor", 1.0, INERTIA, (0.0, 0.0, 0.1)),),
        joints=(Revolute("bearing", "rotor", (0.0, 0.0), GROUND, (0.0, 0.0)),),
        forces=(CompliantShaft("shaft", "rotor", stiffness=stiffness), Torque("load", "rotor")),
        settings=Settings(max_internal_steps=budget),
    )


def test_the_default_is_what_it_always_was():
    assert Settings().max_internal_steps == 200_000


def test_a_step_within_its_budget_is_the_same_whatever_the_budget():
    states = []
    for budget in (200_000, 5_000):
        simulation = Simulation(spring_and_rotor(budget))
        simulation.advance(0.05)
        states.append(simulation.state.tobytes())

    assert states[0] == states[1]


def test_a_step_beyond_its_budget_ends_early_and_names_time_size_and_part():
    simulation = Simulation(spring_and_rotor(400))
    with pytest.raises(StepBudgetError) as caught:
        simulation.advance(0.05)

    said = str(caught.value)
    assert 0 < simulation.time < 0.05
    assert f"t = {simulation.time:.9g} s" in said
    assert "more internal steps than max_internal_steps" in said
    assert "Internal steps: 400, the last of" in said
    assert re.search(r"limited by the (speed|position) of rotor \(shaft, load act on it\)", said)
    assert f"{simulation.field('tried').item(1):.3g} s" in said


def test_the_next_step_goes_on_to_the_same_motion():
    whole = Simulation(spring_and_rotor(200_000))
    whole.advance(0.05)
    pieces = Simulation(spring_and_rotor(400))
    early = 0
    while pieces.time < 0.05:
        try:
            pieces.advance(0.05)
        except StepBudgetError:
            early += 1

    assert early > 1
    # The same internal steps one after the other; only what was spent within the last communication step differs.
    for simulation in (whole, pieces):
        simulation.counters[codes.STEPS_IN_STEP] = 0
        simulation.field("clock")[codes.STEP_BEGUN] = 0.0
    assert pieces.state.tobytes() == whole.state.tobytes()


def test_no_progress_is_noticed_at_a_tenth_of_the_budget():
    simulation = Simulation(spring_and_rotor(1000, stiffness=1e9))
    with pytest.raises(StepBudgetError, match=r"No progress: .*limited by the (speed|position) of rotor"):
        simulation.advance(10.0)

    assert simulation.counters[codes.STEPS_IN_STEP] == 100
    assert simulation.time < 0.1


def test_the_count_is_that_of_a_communication_step_however_often_it_stops():
    simulation = Simulation(spring_and_rotor(400))
    simulation.begin_step()
    for _ in range(400):
        simulation.go_on(0.05, codes.STOP_AT_STEP)
    with pytest.raises(StepBudgetError):
        simulation.go_on(0.05, codes.STOP_AT_STEP)


@pytest.mark.parametrize("budget", [9, 2e9, math.nan, math.inf, -1])
def test_a_budget_beyond_its_limits_is_refused(budget):
    with pytest.raises(MechanismError, match=r"max_internal_steps = .* is outside 10\.\.1e9"):
        Simulation(spring_and_rotor(budget))


def test_a_step_that_shrinks_to_nothing_names_the_part():
    mechanism = spring_and_rotor(200_000)
    simulation = Simulation(replace(mechanism, forces=(*mechanism.forces[:1], Torque("load", "rotor", torque=1e300))))
    with pytest.raises(SimulationError, match=r"shrunk to nothing.*Internal steps: .*limited by .*rotor"):
        simulation.advance(1.0)


def with_next_step(size):
    """A simulation at 0.01 s that would try a step of `size` first: it may come from a saved state."""
    simulation = Simulation(spring_and_rotor(200_000))
    simulation.advance(0.01)
    simulation.field("clock")[codes.NEXT_STEP] = size
    return simulation


@pytest.mark.parametrize("size", [math.inf, 1e308])
def test_a_step_of_any_size_comes_to_its_end(size):
    """An infinite one never got smaller."""
    simulation = with_next_step(size)
    simulation.advance(0.02)

    assert simulation.time == 0.02


@pytest.mark.parametrize("size", [math.nan, 0.0, 1e-300])
def test_a_step_of_no_size_is_an_error(size):
    with pytest.raises(SimulationError, match="shrunk to nothing"):
        with_next_step(size).advance(0.02)


def test_a_mechanism_at_rest_strides_on():
    mechanism = replace(spring_and_rotor(200_000), bodies=(Body("rotor", 1.0, INERTIA),))
    simulation = Simulation(mechanism)
    simulation.advance(1e100)
    simulation.advance(1e101)

    assert simulation.time == 1e101
