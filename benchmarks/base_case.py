"""The paper's base case to half a second behind the impact, at equal error: the engine, and a plain program with scipy.

    python -m benchmarks.base_case [--rounds 9]

Both run at the largest tolerance, of 1, 2 and 5 times powers of ten, with which the time of the impact and the speed of
the wheel at the end are right to 1e-8 (s, rad/s); what is right, the engine says at 1e-12.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace
from statistics import median

from mechanism_fmu.simulation import Simulation
from models.ratchet.model import MODEL

from .ratchet import Parameters, build
from .reference import WHEEL_ANGLE, simulate
from .timing import batch, in_turns

#: Half a second behind the impact of the base case [s].
STOP = 1.43
ACCURACY = 1e-8
_EXACT = 1e-12
_TOLERANCES = [factor * 10.0**power for power in range(-5, -10, -1) for factor in (5, 2, 1)]


class Engine:
    """A simulation that begins again from its start.

    Args:
        tolerance: relative, of the integrator.
    """

    def __init__(self, tolerance: float) -> None:
        made = MODEL.build(MODEL.values())
        self._simulation = Simulation(replace(made, settings=replace(made.settings, relative_tolerance=tolerance)))
        self._start = self._simulation._block.copy()

    def run(self) -> tuple[float, float]:
        """Time of the impact [s], and the speed of the wheel at the end [rad/s]."""
        self._simulation._block[...] = self._start
        self._simulation.advance(STOP)
        (impact,) = self._simulation.impacts_in_step()
        return impact.time, self._simulation.read()["wheel_speed"]


def plain(tolerance: float) -> tuple[float, float]:
    """The same by the plain program."""
    found = simulate(build(Parameters()), STOP, tolerance, 1e-3 * tolerance)
    return found.impacts[0].time, float(found.at(STOP)[1][WHEEL_ANGLE])


@dataclass(frozen=True)
class Measured:
    """Tolerances at which the two are right to `ACCURACY`, times of the rounds [s], and errors at the end."""

    slow_at: float
    fast_at: float
    slow: tuple[float, ...]
    fast: tuple[float, ...]
    slow_error: float
    fast_error: float

    @property
    def ratio(self) -> float:
        """Time of the engine over that of the plain program."""
        return median(self.fast) / median(self.slow)


def measure(rounds: int) -> Measured:
    """Find the tolerances, and time both.

    Args:
        rounds: in which the two take turns.
    """
    exact = Engine(_EXACT).run()

    def error(found: tuple[float, float]) -> float:
        return max(abs(one - other) for one, other in zip(found, exact, strict=True))

    fast_at = next(tolerance for tolerance in _TOLERANCES if error(Engine(tolerance).run()) <= ACCURACY)
    slow_at = next(tolerance for tolerance in _TOLERANCES if error(plain(tolerance)) <= ACCURACY)
    engine = Engine(fast_at)
    slow, fast = in_turns(lambda: batch(lambda: plain(slow_at), 1), lambda: batch(engine.run, 20), rounds)
    return Measured(slow_at, fast_at, slow, fast, error(plain(slow_at)), error(engine.run()))


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=9, help="in which the two take turns")
    found = measure(parser.parse_args().rounds)
    print(f"solve_ivp (RK45) at {found.slow_at:.0e}: {1e3 * median(found.slow):.2f} ms, error {found.slow_error:.1e}")
    print(f"the engine at {found.fast_at:.0e}: {1e3 * median(found.fast):.3f} ms, error {found.fast_error:.1e}")
    print(f"{found.ratio:.4f} of its time")


if __name__ == "__main__":
    main()
