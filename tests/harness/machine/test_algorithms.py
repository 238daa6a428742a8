"""Master algorithms against the exact solution of the coupled whole: measured orders, energy, and their rules."""

import math

import numpy as np
import pytest
from scipy.linalg import expm

from benchmarks.world.cases.two_masses import ONE, SCHEMES, START, TWO, C, K, Scheme, by_power, ran as ran_two_masses
from harness.errors import UsageError
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.part import Extrapolation
from harness.machine.running import run_machine
from harness.machine.stepping import Adaptive, Algorithm, EventAware, GaussSeidel, Jacobi
from harness.run.master import SECOND, Ending, TimeGrid
from tests.harness.machine.linear import Linear, mass, mass_and_spring

#: Coupling of a displacement one way and a force back.
TWO_MASSES = [Connection("one.x", "two.led", rate="one.v"), Connection("two.force", "one.force")]
STATE = ["one.x", "one.v", "two.x", "two.v"]
STOP = 4.0
STEPS = (0.08, 0.04, 0.02, 0.01)


def two_masses(extrapolation: Extrapolation, **how: bool) -> Machine:
    return Machine({"one": mass("one", **how), "two": mass_and_spring("two", **how)}, TWO_MASSES, extrapolation)


def exact(time: float) -> np.ndarray:
    """x and v of both masses."""
    k, kc = 1.0, 0.5
    a = [[0, 1, 0, 0], [-(k + kc), 0, kc, 0], [0, 0, 0, 1], [kc, 0, -(k + kc), 0]]
    return expm(np.array(a, float) * time) @ [1.0, 0.0, 0.0, 0.0]


def ran(machine: Machine, algorithm: Algorithm, step: float, stop: float = STOP) -> np.ndarray:
    outcome = run_machine(machine, algorithm, TimeGrid.of(stop, step), {})
    assert outcome.ending is Ending.COMPLETED
    return np.array(machine.get(STATE), float)


@pytest.mark.parametrize("how", [{}, {"told": False}, {"slopes": False}, {"slopes": False, "told": False}])
@pytest.mark.parametrize("extrapolation", Extrapolation)
def test_errors_of_jacobi_are_of_the_order_that_is_promised(extrapolation: Extrapolation, how: dict[str, bool]) -> None:
    errors = [np.abs(ran(two_masses(extrapolation, **how), Jacobi(), step) - exact(STOP)).max() for step in STEPS]
    slopes = np.diff(np.log(errors)) / np.diff(np.log(STEPS))
    assert slopes[-1] > extrapolation.order - 0.15


def test_gauss_seidel_needs_no_extrapolation_where_nothing_goes_round() -> None:
    """A chain: what leads is known when the others take their step, and they follow a straight line."""
    wave = ([[0, 1], [-9, 0]], [[0], [0]], [[1, 0]], [[0]])
    lag = ([[-2]], [[2]], [[1]], [[0]])

    def chain(order: list[str]) -> Machine:
        parts = {
            "wave": Linear("wave", wave, {"idle": "m"}, {"y": "m"}, (1.0, 0.0)),
            "lag": Linear("lag", lag, {"u": "m"}, {"y": "m"}, (0.0,)),
        }
        return Machine({name: parts[name] for name in order}, [Connection("wave.y", "lag.u")])

    def end(algorithm: Algorithm, step: float, order: list[str]) -> float:
        machine = chain(order)
        run_machine(machine, algorithm, TimeGrid.of(STOP, step), {})
        return float(machine.get(["lag.y"])[0])

    whole = np.array([[0, 1, 0], [-9, 0, 0], [2, 0, -2]], float)
    known = (expm(whole * STOP) @ [1.0, 0.0, 0.0])[2]
    for algorithm, order in ((Jacobi(), 1), (GaussSeidel(), 2)):
        errors = [abs(end(algorithm, step, ["wave", "lag"]) - known) for step in STEPS]
        assert math.log2(errors[-2] / errors[-1]) == pytest.approx(order, abs=0.1)
    assert end(GaussSeidel(), 0.04, ["lag", "wave"]) == end(GaussSeidel(), 0.04, ["wave", "lag"])


def test_what_goes_round_is_found_and_told() -> None:
    machine = two_masses(Extrapolation.CONSTANT)
    assert machine.structure.cycles == [["one", "two"]]
    assert Machine({"one": mass("one")}).structure.cycles == []


@pytest.mark.parametrize("extrapolation", Extrapolation)
def test_gauss_seidel_is_right_in_a_cycle_too(extrapolation: Extrapolation) -> None:
    """With derivatives on both sides, followers have the mean of the Hermite cubic: of third order, as Jacobi's."""
    errors = [np.abs(ran(two_masses(extrapolation), GaussSeidel(), step) - exact(STOP)).max() for step in STEPS]
    order = 3 if extrapolation is Extrapolation.DERIVATIVES else extrapolation.order
    assert np.log2(errors[-2] / errors[-1]) == pytest.approx(order, abs=0.15)


@pytest.mark.parametrize("extrapolation", Extrapolation)
def test_steps_by_tolerance_are_as_many_as_their_order_says(extrapolation: Extrapolation) -> None:
    """A step's error is of one order more: a hundredth of it takes 100^(1/(p+1)) times the steps, with p = 1 or 2."""
    errors, steps = [], []
    for tolerance in (1e-4, 1e-6):
        machine = two_masses(extrapolation)
        algorithm = Adaptive(machine, tolerance)
        outcome = run_machine(machine, algorithm, TimeGrid.of(STOP, STOP), {})
        errors.append(np.abs(np.array(machine.get(STATE), float) - exact(STOP)).max())
        steps.append(outcome.steps)
        assert algorithm.too_small == 0
    p = 3 if extrapolation is Extrapolation.DERIVATIVES else extrapolation.order  # all parts take slopes
    assert steps[1] / steps[0] == pytest.approx(100 ** (1 / (p + 1)), rel=0.1)
    assert errors[0] / errors[1] == pytest.approx(100 ** (p / (p + 1)), rel=0.25)
    assert errors[0] < 100e-4


def test_steps_by_tolerance_end_at_communication_points() -> None:
    machine = two_masses(Extrapolation.LINEAR)
    seen: list[float] = []

    class Watch:
        def started(self, unit: object, time: float) -> None:
            seen.append(time)

        def stepped(self, unit: object, time: float) -> None:
            seen.append(time)

    run_machine(machine, Adaptive(machine, 1e-4), TimeGrid.of(1.0, 0.25), {}, [Watch()])
    assert {0.0, 0.25, 0.5, 0.75, 1.0} <= set(seen)
    assert len(seen) > 5
    assert seen == sorted(set(seen))


def test_steps_by_tolerance_need_parts_that_can_be_put_back() -> None:
    machine = two_masses(Extrapolation.LINEAR, restores=False)
    with pytest.raises(UsageError, match=r"need components that can be put back .* but one, two cannot"):
        Adaptive(machine, 1e-4)
    with pytest.raises(UsageError, match="The tolerance is 2; give a number above 0 and below 1"):
        Adaptive(two_masses(Extrapolation.LINEAR), 2.0)


@pytest.mark.parametrize("algorithm", ["jacobi", "event_aware"])
def test_without_impacts_to_be_aware_of_it_is_jacobi(algorithm: str) -> None:
    plain = ran(two_masses(Extrapolation.LINEAR), Jacobi(), 0.05)
    machine = two_masses(Extrapolation.LINEAR)
    assert (ran(machine, EventAware(machine), 0.05) == plain).all()
    assert machine.parts["one"].statistics.rollbacks == 0


def test_time_does_not_drift_over_a_thousand_million_steps() -> None:
    """The clock counts; nothing is ever added up."""
    step = round(0.1 * SECOND)
    grid = TimeGrid(0, 10**9 * step, step)
    assert len(grid) == 10**9
    assert (grid.stop - grid.step, grid.stop) == (99_999_999_900_000_000, 10**17)


def test_steps_by_tolerance_grow_where_little_happens() -> None:
    """A fast wave that dies away: small steps at first, then whole ones."""
    damped = ([[0, 1], [-400, -20]], [[0], [0]], [[1, 0]], [[0]])
    lag = ([[-2]], [[2]], [[1]], [[0]])
    parts = {
        "wave": Linear("wave", damped, {"idle": "m"}, {"y": "m"}, (1.0, 0.0)),
        "lag": Linear("lag", lag, {"u": "m"}, {"y": "m"}, (0.0,)),
    }
    machine = Machine(parts, [Connection("wave.y", "lag.u"), Connection("lag.y", "wave.idle")], Extrapolation.LINEAR)
    times: list[float] = []

    class Watch:
        def started(self, unit: object, time: float) -> None:
            times.append(time)

        stepped = started

    run_machine(machine, Adaptive(machine, 1e-3), TimeGrid.of(8.0, 4.0), {}, [Watch()])
    sizes = np.diff(times)
    assert sizes[:5].max() < 0.05
    assert sizes.max() > 0.4


@pytest.mark.parametrize("scheme", SCHEMES, ids=[scheme.name for scheme in SCHEMES])
@pytest.mark.parametrize("step", [0.1, 0.02])
def test_a_run_of_exact_components_is_a_power_of_the_schemes_matrix(scheme: Scheme, step: float) -> None:
    (a, b), (c, d) = ONE, TWO  # mass 1 is told the torque with the sign of its connection
    shaft = [[1, 0], [0, 1], [-K, -C]], [[0, 0], [0, 0], [K, C]]
    one = Linear("one", (a, -b, np.eye(2), np.zeros((2, 1))), {"torque": ""}, _states("one"), START[:2])
    two = Linear("two", (c, d, *shaft), {"angle": "", "speed": ""}, {**_states("two"), "torque": ""}, START[2:])
    np.testing.assert_allclose(ran_two_masses(one, two, scheme, step), by_power(scheme, step), rtol=0, atol=1e-12)


def _states(name: str) -> dict[str, str]:
    return {f"{name}_angle": "", f"{name}_speed": ""}
