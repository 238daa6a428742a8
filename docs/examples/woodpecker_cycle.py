"""The limit cycle of the woodpecker toy, by three laws of impact: period, states, events, and whether it attracts.

    python docs/examples/woodpecker_cycle.py

Once a cycle the sleeve is jammed and the bird stands still; then its angle is all there is to know, and the motion
leads from one such angle to the next: a map of one number to another, whose fixed point is sought by the secant method.
What comes out: docs/explanation/woodpecker.md. Source of the map: Leine, Glocker, van Campen, Nonlinear dynamics of the
woodpecker toy, DETC2001/VIB-21608 (2001), eq (13).
"""

from __future__ import annotations

import runpy
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, get_args

from mechanism_fmu.model import Mechanism
from mechanism_fmu.simulation import Simulation

MODEL = runpy.run_path(str(Path(__file__).parent / "gallery" / "woodpecker.py"))["MODEL"]

Law = Literal["newton", "poisson", "stronge"]
LAWS: tuple[Law, ...] = get_args(Law)
TOLERANCES = (1e-9, 1e-11)
#: The paper's model has small angles only: so has a toy that is so many times as large.
SMALL_ANGLES = 1e5

#: A first guess of the fixed point [rad], and how far from it the second one is.
GUESS: dict[Law, float] = {"newton": -0.478, "poisson": -0.4555, "stronge": -0.454}
GUESS_OF_SMALL_ANGLES: dict[Law, float] = {"newton": -0.5295, "poisson": -0.5295, "stronge": -0.5487}
APART = 1e-4

#: The step in which the end of a cycle is looked for [s], and the longest cycle.
STEP, LONGEST = 1e-3, 1.0

WORDS = {
    "beak.gap": "the beak strikes",
    "bottom.gap": "the sleeve strikes at its bottom",
    "top.gap": "the sleeve strikes at its top",
    "bottom.slips": "the sleeve slips down, turned as it was",
    "bottom.force": "the bottom comes off",
    "top.force": "the top comes off",
    "bottom.sticks": "the sleeve is jammed",
}


@dataclass(frozen=True)
class Cycle:
    """From the bird at rest to the bird at rest.

    Attributes:
        start: angle of the bird [rad].
        period: [s].
        end: all outputs at the end.
        events: time [s], name, and closing speed [m/s] of those that are impacts, else 0.
    """

    start: float
    period: float
    end: dict[str, float]
    events: tuple[tuple[float, str, float], ...]


def toy(start: float, law: Law, tolerance: float, size: float = 1.0) -> Mechanism:
    """The toy of the gallery with another law of impacts."""
    built = MODEL.build(MODEL.values(start=start, relative_tolerance=tolerance, size=size))
    assert isinstance(built, Mechanism)
    return replace(built, impact_law=law)


def cycle(start: float, law: Law, tolerance: float, size: float = 1.0) -> Cycle:
    """One cycle from an angle of the bird [rad, times the size].

    Raises:
        ValueError: it does not return within a second: it falls.
    """
    mechanism = toy(start, law, tolerance, size)
    simulation = Simulation(mechanism)
    speeds, events = {}, []
    time, struck, rises = 0.0, False, False
    while not (struck and rises):
        if time > LONGEST:
            raise ValueError(f"From {start:g} rad the sleeve is not jammed again within {LONGEST:g} s.")
        time += STEP
        simulation.advance(time)
        speeds.update({impact.time: impact.closing_speed for impact in simulation.impacts_in_step()})
        events += [(event.time, event.guard) for event in simulation.events_in_step()]
        struck = struck or any(name == "beak.gap" for _, name in events)
        now = simulation.read()
        rises = now["jams"] == 1.0 and now["bird_rate"] >= 0.0
    period = _zero(mechanism, time - STEP, time)
    end = state_at(mechanism, period)
    end["bird"] *= size
    return Cycle(start, period, end, tuple((t, name, speeds.get(t, 0.0)) for t, name in events))


def state_at(mechanism: Mechanism, time: float) -> dict[str, float]:
    """All outputs at a time [s]."""
    simulation = Simulation(mechanism)
    simulation.advance(time)
    return simulation.read()


def _zero(mechanism: Mechanism, before: float, after: float) -> float:
    """When the bird stands still, by the secant method; its acceleration hardly changes in so short a time."""
    low, high = (state_at(mechanism, time)["bird_rate"] for time in (before, after))
    while abs(after - before) > 1e-13 and high != low:
        before, after, low = after, after - high * (after - before) / (high - low), high
        high = state_at(mechanism, after)["bird_rate"]
    return after


def limit_cycle(law: Law, tolerance: float, size: float = 1.0) -> tuple[Cycle, float, float]:
    """The cycle that repeats itself, by the secant method.

    Returns:
        The cycle; how far the bird is from where it began [rad]; the derivative of the map, within -1 and 1 if the
        cycle attracts.
    """
    guess = (GUESS if size == 1.0 else GUESS_OF_SMALL_ANGLES)[law]
    first, second = (cycle(start, law, tolerance, size) for start in (guess, guess + APART))
    while abs(second.start - first.start) > 1e-10:
        slope = (second.end["bird"] - first.end["bird"]) / (second.start - first.start)
        start = second.start + (second.end["bird"] - second.start) / (1.0 - slope)
        first, second = second, cycle(start, law, tolerance, size)
    # the last of those two are so near to each other that rounding tells
    before, behind = (cycle(second.start + side * APART, law, tolerance, size).end["bird"] for side in (-0.5, 0.5))
    return second, second.end["bird"] - second.start, (behind - before) / APART


def _rows() -> Iterator[str]:
    yield "| angles | law | tolerance | period [s] | bird at rest [rad] | fall [mm] | residual [rad] | derivative |"
    yield "| --- | --- | --- | --- | --- | --- | --- | --- |"
    for size, tolerance in ((1.0, TOLERANCES[0]), (1.0, TOLERANCES[1]), (SMALL_ANGLES, TOLERANCES[1])):
        for law in LAWS:
            found, residual, slope = limit_cycle(law, tolerance, size)
            yield (
                f"| {'as they are' if size == 1.0 else 'small'} | {law} | {tolerance:.0e} | {found.period:.11f} | "
                f"{found.start:.11f} | {-1e3 * found.end['height']:.8f} | {abs(residual):.0e} | {slope:+.4f} |"
            )


def _events(law: Law, size: float) -> Iterator[str]:
    found, *_ = limit_cycle(law, TOLERANCES[1], size)
    yield f"\n{law}, angles {'as they are' if size == 1.0 else 'small'}:\n"
    for time, name, speed in found.events:
        yield f"    {time:.9f} s  {WORDS[name]}{f', {speed:.6f} m/s' if speed else ''}"
    yield f"    {found.period:.9f} s  the bird stands still"


def main() -> None:
    """Print the limit cycles."""
    for line in _rows():
        print(line)
    for law in LAWS:
        print(*_events(law, 1.0), sep="\n")
    print(*_events("newton", SMALL_ANGLES), sep="\n")


if __name__ == "__main__":
    main()
