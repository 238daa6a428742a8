"""Cost of an impact in a crowd: balls that fall on a floor from heights of their own until all rest.

    python -m benchmarks.crowd                      a minute
    python -m benchmarks.crowd --counts 30 100 300 1000

Two ways of the engine in turns: one communication step whose buffers keep 8 impacts, and `simulate`, which keeps every
impact with the rates of all bodies. The baseline is the closed form in plain Python: each ball's bounces by themselves,
merged by their times. Closing speeds and order of all impacts must agree before times count.
"""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mechanism_fmu import codes
from mechanism_fmu.engine.dynamics.scaling import LENGTH, RATE
from mechanism_fmu.model import GROUND, Mechanism, PointLineContact, rigid_body
from mechanism_fmu.simulation import Simulation, simulate
from mechanism_fmu.tolerances import STICK_SPEED

from .growth import exponent, require_compiler
from .timing import require_agreement

GRAVITY, RESTITUTION = 9.81, 0.5
#: Of balls with a radius of gyration of 0.1 m that fall (`engine.dynamics.scaling`) [m/s].
_STICKS_BELOW = STICK_SPEED * math.sqrt(GRAVITY * 0.1) / (LENGTH * RATE)
#: The last ball, from 1.5 m, rests after 1.66 s.
UNTIL = 2.0
COUNTS = (30, 100, 300)
#: Of 300 balls an impact may take so long [s], and the cost may grow so with their number.
LONGEST, STEEPEST, REQUIRED_OF = 1e-3, 1.2, 300
#: Closing speeds agree within this [m/s]; merged times are farther apart than the rounding of either way.
_WITHIN = 1e-9


def heights(count: int) -> list[float]:
    """Heights from which the balls fall [m], the same each time."""
    return [float(height) for height in np.random.default_rng(count).uniform(0.5, 1.5, count)]


def crowd(count: int) -> Mechanism:
    """Return a mechanism of `count` balls side by side, which share no body and no contact."""
    floor = GROUND.line((0.0, 0.0), (1.0, 0.0))
    balls = [rigid_body(f"ball{k}", (0.3 * k, y), mass=1.0, inertia=0.01) for k, y in enumerate(heights(count))]
    contacts = tuple(
        PointLineContact(f"floor{k}", ball.at(0.0, 0.0), floor, restitution=RESTITUTION) for k, ball in enumerate(balls)
    )
    return Mechanism(tuple(balls), contacts=contacts, gravity=(0.0, -GRAVITY))


def bounces(count: int) -> list[tuple[float, int, float]]:
    """Times [s], balls and closing speeds [m/s] of all impacts, in their order, in closed form."""
    found = []
    for k, height in enumerate(heights(count)):
        speed = math.sqrt(2.0 * GRAVITY * height)
        at = speed / GRAVITY
        found.append((at, k, speed))
        while RESTITUTION * speed >= _STICKS_BELOW:
            speed *= RESTITUTION
            at += 2.0 * speed / GRAVITY
            found.append((at, k, speed))
    return sorted(found)


@dataclass(frozen=True)
class Crowd:
    """Processor time of each impact of a crowd.

    Attributes:
        count: of balls.
        impacts: of all of them.
        stepped, kept, closed: time of an impact in one communication step, by `simulate`, and in closed form [s].
    """

    count: int
    impacts: int
    stepped: float
    kept: float
    closed: float


def measure(counts: Sequence[int] = COUNTS) -> Iterator[Crowd]:
    """The crowds of these numbers of balls.

    Args:
        counts: of balls.

    Raises:
        DisagreementError: impacts are not those of the closed form.
    """
    for count in counts:
        began = time.process_time()
        expected = bounces(count)
        closed = time.process_time() - began
        mechanism = crowd(count)
        simulation = Simulation(mechanism)
        began = time.process_time()
        simulation.advance(UNTIL)
        stepped = time.process_time() - began
        impacts = simulation.counters.item(codes.COUNT_IMPACTS)
        began = time.process_time()
        result = simulate(mechanism, UNTIL, outputs=["ball0.y"], step=UNTIL)
        kept = time.process_time() - began
        require_agreement(f"Impacts of {count} balls", impacts, len(expected), 0.0)
        require_agreement(f"Impacts of {count} balls that are kept", len(result.impacts), len(expected), 0.0)
        of_each: dict[str, list[float]] = {}
        for impact in result.impacts:
            of_each.setdefault(impact.contact, []).append(impact.closing_speed)
        for k in range(count):
            speeds = [speed for _, ball, speed in expected if ball == k]
            require_agreement(f"Closing speeds of ball {k} of {count}", of_each[f"floor{k}"], speeds, _WITHIN)
        yield Crowd(count, impacts, stepped / impacts, kept / impacts, closed / impacts)


def main() -> None:
    """Measure, print, and exit with 1 where a requirement is missed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--counts", type=int, nargs="+", default=COUNTS, help="of balls")
    require_compiler()
    found = list(measure(parser.parse_args().counts))
    print(f"{'balls':>6s} {'impacts':>8s} {'one step':>9s} {'simulate':>9s} {'closed form':>12s}   [ms an impact]")
    for one in found:
        times = f"{1e3 * one.stepped:9.3f} {1e3 * one.kept:9.3f} {1e3 * one.closed:12.5f}"
        print(f"{one.count:6d} {one.impacts:8d} {times}")
    met = all(one.kept <= LONGEST for one in found if one.count <= REQUIRED_OF)
    if len(found) > 1:
        powers = [exponent({one.count: seconds(one) for one in found}) for seconds in (_stepped, _kept)]
        print("grows as their number to the power of {:.2f} and {:.2f}".format(*powers))
        met = met and max(powers) < STEEPEST
    if not met:
        raise SystemExit(f"Required: {1e3 * LONGEST:g} ms for up to {REQUIRED_OF} balls, a power below {STEEPEST:g}.")


def _stepped(one: Crowd) -> float:
    return one.stepped


def _kept(one: Crowd) -> float:
    return one.kept


if __name__ == "__main__":
    main()
