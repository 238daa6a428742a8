"""Through singular configurations along the smooth branch: parallelograms that lie flat, by their one coordinate."""

import math
from dataclasses import replace

import numpy as np
import pytest

from benchmarks.world.cases.n_four_bar import GRAVITY, known, n_four_bar
from mechanism_fmu import codes
from mechanism_fmu.model import GROUND, Mechanism, PointLineContact, Settings
from mechanism_fmu.simulation import Simulation, SimulationError
from tests.driven_four_bar import MODEL as DRIVEN

# Turns once in some 1.92 s, and lies flat twice in each.
FIRST, BOTH = 1.0, 2.0


def passed(simulation: Simulation) -> int:
    return simulation.passed_configurations()[0]


def swing(count: int) -> float:
    """What the weight does from the top to the bottom [J]."""
    return 2 * GRAVITY * ((count + 1) / 2 + count)


@pytest.mark.parametrize("count", [1, 2, 10])
@pytest.mark.parametrize("tolerance", [1e-7, 1e-9])
def test_the_published_ten_seconds(count: int, tolerance: float) -> None:
    """IFToMM A02: what the steps lose of energy is in proportion to the tolerance, ten passes included."""
    simulation = Simulation(n_four_bar(count, tolerance))
    start = simulation.read()["kinetic"]
    simulation.advance(10.0)
    found = simulation.read()
    assert passed(simulation) == 10
    assert found["kinetic"] == pytest.approx(start + found["work"], abs=3 * tolerance * swing(count))
    assert [found["angle"], found["speed"]] == pytest.approx(known(count, 10.0), abs=1e3 * tolerance)
    assert found["last_angle"] == pytest.approx(found["angle"], abs=1e-9)  # on the branch of the parallelogram


@pytest.mark.parametrize("tolerance", [1e-7, 1e-9])
def test_energy_is_kept_in_each_pass(tolerance: float) -> None:
    """A hundred times as well as the tolerance asks, from one step's end to the next."""
    simulation = Simulation(n_four_bar(1, tolerance))
    y, jumps, before, count = simulation.field("y_end"), [], 0.0, 0
    simulation.begin_step()
    while simulation.time < BOTH:
        simulation.go_on(BOTH, codes.STOP_AT_STEP)
        if simulation.counters.item(codes.COUNT_PASSED) > count:
            count += 1
            jumps.append(energy(y) - before)
        before = energy(y)
    assert count == 2
    assert np.abs(jumps).max() < 0.01 * tolerance * swing(1)


def energy(y: np.ndarray) -> float:
    """Kinetic energy and that of the weight [J], of one parallelogram, from the engine's unknowns."""
    place, rate = y[:9].reshape(3, 3), y[9:18].reshape(3, 3)
    return float((0.5 * rate**2 @ [1.0, 1.0, 1 / 12] + GRAVITY * place[:, 1]).sum())


@pytest.mark.slow
@pytest.mark.parametrize(("count", "tolerance"), [(20, 1e-9), (40, 1e-9), (40, 1e-12), (60, 1e-9)])
def test_many_parallelograms_at_once(count: int, tolerance: float) -> None:
    """Up to 121 bodies: places far from the origin are rounded more, and the small sine makes motion of it."""
    simulation = Simulation(n_four_bar(count, tolerance))
    simulation.advance(10.0)
    found = simulation.read()
    assert passed(simulation) == 10
    assert [found["angle"], found["speed"]] == pytest.approx(known(count, 10.0), abs=1e3 * tolerance)


@pytest.mark.parametrize("tolerance", [1e-6, 1e-7, 1e-8, 1e-9, 1e-10])
def test_a_pass_is_as_accurate_as_a_step(tolerance: float) -> None:
    simulation = Simulation(n_four_bar(1, tolerance))
    simulation.advance(BOTH)
    found = simulation.read()
    assert passed(simulation) == 2
    assert [found["angle"], found["speed"]] == pytest.approx(known(1, BOTH), abs=100 * tolerance)


def test_the_instant_is_known() -> None:
    simulation = Simulation(n_four_bar(1))
    simulation.advance(FIRST)
    count, at = simulation.passed_configurations()
    assert count == 1
    angle, _ = known(1, at)
    assert math.cos(angle) == pytest.approx(-1.0, abs=1e-5) or math.cos(angle) == pytest.approx(1.0, abs=1e-5)
    assert simulation.counters.item(codes.COUNT_EVENTS) == 0


def test_the_default_stops_and_names_the_way_on() -> None:
    with pytest.raises(SimulationError, match=r"A singular configuration lies ahead.*through_singularities=True"):
        Simulation(n_four_bar(1, through=False)).advance(FIRST)


@pytest.mark.parametrize("step", [5e-4, 1e-3, 1.3e-3, 1.7e-3, 2.1e-3])
def test_driven_all_the_way(step: float) -> None:
    """A torque, held over each communication step, that changes where it lies flat, too, twice."""
    simulation = Simulation(n_four_bar(2))
    angle, speed = math.pi / 2, -1.0
    for k in range(math.ceil(1.5 / step)):
        torque = 5.0 * math.sin(0.02 * k)
        simulation.set_input("torque", torque)
        simulation.advance((k + 1) * step)
        angle, speed = known(2, step, torque, angle, speed)
    found = simulation.read()
    assert passed(simulation) == 2
    assert [found["angle"], found["speed"]] == pytest.approx([angle, speed], abs=1e-6)


def test_any_communication_step_gives_the_same_bits() -> None:
    at_once = Simulation(n_four_bar(2))
    at_once.advance(BOTH)
    in_parts = Simulation(n_four_bar(2))
    for time in np.linspace(0.0, BOTH, 778)[1:]:
        in_parts.advance(float(time))
    np.testing.assert_array_equal(in_parts.read_array(), at_once.read_array())
    assert passed(in_parts) == passed(at_once) == 2


def inside(before: float = 1e-5) -> Simulation:
    """At an instant within the step that leads through the first one, so many seconds before it."""
    simulation = Simulation(n_four_bar(1))
    simulation.advance(FIRST)
    time = simulation.passed_configurations()[1] - before
    simulation = Simulation(n_four_bar(1))
    simulation.advance(time)
    assert passed(simulation) == 0
    assert simulation.counters.item(codes.COUNT_PASSED) == 1
    return simulation


def test_a_state_saved_inside_goes_on_to_the_same_bits() -> None:
    simulation = inside()
    saved = simulation.state.copy()
    simulation.advance(BOTH)
    expected = simulation.read_array()
    other = Simulation(n_four_bar(1))
    other.state[:] = saved
    other.advance(BOTH)
    np.testing.assert_array_equal(other.read_array(), expected)


@pytest.mark.parametrize("before", [1e-3, 3e-4, 1e-4, 5e-5, 3e-5, 2e-5, 1.5e-5, 1e-5, 7e-6, 5e-6, 4e-6])
def test_an_input_changes_inside(before: float) -> None:
    """Just before the instant, where the engine has passed it already."""
    simulation = inside(before)
    time = simulation.time
    simulation.set_input("torque", 3.0)
    simulation.advance(FIRST)
    found = simulation.read()
    assert passed(simulation) == 1
    assert [found["angle"], found["speed"]] == pytest.approx(known(1, FIRST - time, 3.0, *known(1, time)), abs=1e-8)


def test_stiff_motions_are_refused_by_name() -> None:
    mechanism = replace(n_four_bar(1), settings=Settings(integration_method=codes.IMPLICIT_METHOD))
    with pytest.raises(SimulationError, match="A singular configuration lies ahead"):
        Simulation(mechanism).advance(FIRST)


def test_a_toggle_position_is_refused_by_name() -> None:
    """A driver beyond the end of its range: forces grow without limit, so that there is no smooth branch."""
    mechanism = replace(DRIVEN.build(DRIVEN.values(coupler=0.18, drive_speed=3.0)), through_singularities=True)
    simulation = Simulation(mechanism)
    with pytest.raises(SimulationError, match="a driver has come to the end of its range"):
        simulation.advance(2.0)
    assert passed(simulation) == 0


LOW = -math.pi / 2
TO_FLAT = math.sqrt(12.0 / 5.0 * GRAVITY)  # one parallelogram rises from below to the line, and no further


def test_rest_in_a_singular_configuration_is_refused_by_name() -> None:
    simulation = Simulation(n_four_bar(1, angle=LOW, speed=TO_FLAT))
    with pytest.raises(SimulationError, match=r"A singular configuration lies ahead.*no smooth branch was found"):
        simulation.advance(FIRST)
    assert passed(simulation) == 0


@pytest.mark.parametrize(("factor", "times"), [(0.999, 0), (1.01, 2)])
def test_turning_back_just_before_or_behind(factor: float, times: int) -> None:
    simulation = Simulation(n_four_bar(1, angle=LOW, speed=factor * TO_FLAT))
    simulation.advance(FIRST)
    found = simulation.read()
    assert passed(simulation) == times
    expected = known(1, FIRST, angle=LOW, speed=factor * TO_FLAT)
    assert [found["angle"], found["speed"]] == pytest.approx(expected, abs=1e-7)


@pytest.mark.parametrize(("after", "times"), [(-1e-3, 0), (-1e-6, 0), (1e-3, 2), (1e-2, 2)])
def test_an_elastic_stop_beside_it_turns_the_motion_back(after: float, times: int) -> None:
    """Hit so many seconds after the instant, the coupler goes back as it came: the same motion, mirrored in time."""
    simulation = Simulation(n_four_bar(1))
    simulation.advance(FIRST)
    hit = simulation.passed_configurations()[1] + after
    simulation = Simulation(with_stop(math.sin(known(1, hit)[0])))
    simulation.advance(FIRST)
    found = simulation.read()
    angle, speed = known(1, 2.0 * hit - FIRST)
    assert simulation.counters.item(codes.COUNT_IMPACTS) == 1
    assert passed(simulation) == times
    assert [found["angle"], found["speed"]] == pytest.approx([angle, -speed], abs=1e-8)


def test_an_impact_nearer_than_any_step_behind_it_is_refused_by_name() -> None:
    with pytest.raises(SimulationError, match="A singular configuration lies ahead"):
        Simulation(with_stop(-3e-5)).advance(FIRST)


def with_stop(height: float) -> Mechanism:
    """One parallelogram, and an elastic stop under its coupler."""
    stop = PointLineContact("stop", "coupler0", (0.0, 0.0), GROUND, (0.0, height), (0.0, 1.0), restitution=1.0)
    return replace(n_four_bar(1), contacts=(stop,))
