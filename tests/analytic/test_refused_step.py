"""A step that is refused leaves the state as it was: the next try is the same one."""

from dataclasses import replace

import pytest

from mechanism_fmu import codes
from mechanism_fmu.model import Mechanism
from mechanism_fmu.simulation import Simulation, SimulationError
from tests.parallel_cranks import parallel_cranks


def turning_cranks() -> Mechanism:
    """A parallelogram that will lie flat: its cranks turn at 2 rad/s towards the line of their hinges."""
    still = parallel_cranks(2)
    bodies = tuple(replace(body, start_rate=rates(body.name, body.start)) for body in still.bodies)
    return replace(still, bodies=bodies)


def rates(name: str, start: tuple[float, float, float]) -> tuple[float, float, float]:
    """Of a crank about its hinge, of the coupler on a circle about the first one; the angular speed is -2 rad/s."""
    speed = -2.0
    if name == "coupler":
        x, y, _ = start
        return (-speed * y, speed * x, 0.0)
    hinge = float(name.removeprefix("crank"))
    x, y, _ = start
    return (-speed * y, speed * (x - hinge), speed)


def test_a_singular_configuration_is_refused_again_and_again() -> None:
    simulation = Simulation(turning_cranks())
    seen = []
    for _ in range(4):
        with pytest.raises(SimulationError, match="A singular configuration lies ahead"):
            simulation.advance(2.0)
        # But for what is noted of the communication step itself, and the count of what was tried.
        simulation.counters[[codes.STEPS_IN_STEP, codes.COUNT_REJECTED, codes.COUNT_TRIES]] = 0
        simulation.field("clock")[codes.STEP_BEGUN] = 0.0
        seen.append((simulation.time, simulation.state.tobytes()))
    assert 0.0 < seen[0][0] < 0.21  # 0.4 rad at 2 rad/s and more
    assert len(set(seen)) == 1
