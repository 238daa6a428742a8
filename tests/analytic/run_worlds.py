"""Runs of random worlds, and what must hold in all of them: nothing goes in, and energy never grows.

`python -m tests.analytic.run_worlds --count 1000` runs so many and says which kinds of fault there are, and where.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mechanism_fmu.model import MechanismError
from mechanism_fmu.moving import SimulationError
from mechanism_fmu.simulation import Simulation
from tests.analytic.random_worlds import World, world
from tests.outlines_depth import Poses, depths, resting

#: How deep material may be in other material [m].
DEEPEST = 1e-9
#: By which part of its range energy may grow, or with e = 1 change, in all.
ENERGY = 1e-6
#: Looks into a world.
LOOKS = 240


@dataclass(frozen=True)
class Outcome:
    """What came of a world.

    Attributes:
        fault: what went wrong, in a few words; "" for nothing.
        detail: the same with its numbers.
        time: as far as it came [s].
        impacts: how many there were.
        deepest: material in material [m].
        grown: energy above the least before, in parts of its range.
        changed: energy off from that at the start, likewise.
    """

    fault: str
    detail: str
    time: float
    impacts: int
    deepest: float
    grown: float
    changed: float


def run(made: World, looks: int = LOOKS) -> Outcome:
    """Run a world, and look at it at equal times.

    Args:
        made: the world.
        looks: at how many times.
    """
    rows, fault, detail = [], "", ""
    simulation = None
    try:
        simulation = Simulation(made.mechanism)
        rows.append(simulation.read())
        for k in range(1, looks + 1):
            simulation.advance(made.until * k / looks)
            rows.append(simulation.read())
    except (MechanismError, SimulationError) as error:
        fault, detail = _kind_of(str(error)), str(error)
    if not rows or simulation is None:
        return Outcome(fault, detail, 0.0, 0, 0.0, 0.0, 0.0)
    seen = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    deepest = max(_depths_of(made, seen), default=0.0)
    energy, size = _energy(made, seen)
    grown = float((energy - np.minimum.accumulate(energy)).max() / size)
    changed = float(np.abs(energy - energy[0]).max() / size)
    if not fault and deepest > DEEPEST:
        fault, detail = "penetration", f"{deepest:.2e} m deep"
    elif not fault and grown > ENERGY:
        fault, detail = "energy grows", f"by {grown:.2e} of {size:.3g} J"
    elif not fault and made.conserves and changed > ENERGY:
        fault, detail = "energy is not conserved", f"off by {changed:.2e} of {size:.3g} J"
    return Outcome(fault, detail, simulation.time, int(simulation.counters[0]), deepest, grown, changed)


#: What messages of faults are told by.
_KINDS = {
    "gone into each other": "outlines have gone into each other",
    "More contacts touch": "more contacts touch than can be resolved",
    "No set of pushing": "no set of pushing contacts",
    "open and close without end": "contacts open and close without end",
    "step size has shrunk": "step size shrinks",
    "singular configuration": "singular",
    "No progress": "no progress",
    "more internal steps": "too many steps",
    "no finite forces": "no finite forces (Painleve)",
    "No finite forces": "no finite forces (Painleve)",
    "starts with a contact point inside": "starts inside",
}


def _kind_of(message: str) -> str:
    return next((kind for part, kind in _KINDS.items() if part in message), message[:60])


def _depths_of(made: World, seen: dict[str, np.ndarray]) -> Iterator[float]:
    count = len(next(iter(seen.values())))
    poses = {"ground": resting(count)}
    for body in made.mechanism.bodies:
        x, y, angle = (seen[f"{body.name}.{c}"] for c in ("x", "y", "angle"))
        poses[body.name] = Poses(x + 1j * y, np.exp(1j * angle))
    for one, other in made.pairs:
        for a in made.solids[one]:
            for b in made.solids[other]:
                yield float(depths(a, poses[one], b, poses[other]).max())


def _energy(made: World, seen: dict[str, np.ndarray]) -> tuple[np.ndarray, float]:
    """Kinetic and potential energy at each time, and how large the two are [J]."""
    kinetic = potential = np.zeros(1)
    for body in made.mechanism.bodies:
        u, v, w = (seen[f"{body.name}.{c}"] for c in ("x_rate", "y_rate", "speed"))
        kinetic = kinetic + 0.5 * body.mass * (u * u + v * v) + 0.5 * body.inertia * w * w
        potential = potential - body.mass * made.mechanism.gravity[1] * seen[f"{body.name}.y"]
    return kinetic + potential, float(kinetic.max() + np.ptp(potential)) or 1.0


def main() -> None:
    """Run worlds, and say what became of them."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0)
    asked = parser.parse_args()
    faults: defaultdict[str, list[int]] = defaultdict(list)
    impacts, kinds, began, deepest, grown = 0, Counter[str](), time.perf_counter(), 0.0, 0.0
    for k in range(asked.count):
        seed = asked.first + k
        made = world(seed)
        start = time.perf_counter()
        outcome = run(made)
        spent = time.perf_counter() - start
        kinds[made.kind] += 1
        impacts += outcome.impacts
        deepest, grown = max(deepest, outcome.deepest), max(grown, outcome.grown)
        if outcome.fault or spent > 20.0:
            faults[outcome.fault or "slow"].append(seed)
            text = f"{seed} ({made.kind}) at {outcome.time:.4g} s: {outcome.fault}, {outcome.detail}, {spent:.1f} s"
            print(text, flush=True)
        if (k + 1) % 50 == 0:
            spent = time.perf_counter() - began
            print(f"{k + 1} of {asked.count}, {spent:.0f} s, {sum(map(len, faults.values()))} faults", flush=True)
    print(f"{asked.count} worlds, {impacts} impacts; at most {deepest:.1e} m deep, energy grown by {grown:.1e}")
    for kind, count in kinds.most_common():
        print(f"    {count} {kind}")
    for fault, seeds in sorted(faults.items(), key=lambda item: -len(item[1])):
        print(f"{len(seeds)} x {fault}: seeds {', '.join(map(str, seeds))}")


if __name__ == "__main__":
    main()
