"""Runs of lattice worlds: nothing overlaps, no energy is gained, and they run to their end.

`python -m tests.analytic.run_lattice_worlds --count 10000` runs so many and says which fail, with seed and reason;
`--seed 17` replays one and says it at length.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter, defaultdict
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from mechanism_fmu.model import MechanismError
from mechanism_fmu.moving import SimulationError
from mechanism_fmu.simulation import Simulation
from tests.analytic.lattice_worlds import LatticeWorld, lattice_world
from tests.contact_modes import problem_at, solution_modes
from tests.separating_axes import Placed, depths

#: Deepest overlap that is none: what the engine itself allows [m].
DEEPEST = 1e-9
#: Energy gained that is none, as a part of its range: what steps of a relative error of 1e-9 add up to.
ENERGY = 1e-6
#: Communication steps of a run, and their size [s].
STEPS, STEP = 40, 0.02


@dataclass(frozen=True)
class Result:
    """What a run has shown.

    Attributes:
        fault: "overlap", "energy", "refused: ..." in a few words; "" for none.
        detail: the same with its numbers, and the message.
        time: reached [s].
        deepest: overlap [m].
        gained: energy, as a part of its range.
    """

    fault: str
    detail: str
    time: float
    deepest: float
    gained: float


def run(world: LatticeWorld) -> Result:
    """Run a world and measure it at each communication point."""
    rows, message, reached = [], "", 0.0
    simulation = None
    try:
        simulation = Simulation(world.mechanism)
        rows.append(simulation.read())
        for k in range(1, STEPS + 1):
            simulation.advance(STEP * k)
            reached = STEP * k
            rows.append(simulation.read())
    except (MechanismError, SimulationError) as error:
        message = str(error)
    if not rows or simulation is None:
        return Result(f"refused: {_kind(message)}", message, 0.0, 0.0, 0.0)
    readings = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    depth, pair = _deepest(world, readings)
    gained = _energy_gained(world, readings)
    if depth > DEEPEST:
        return Result("overlap", f"{pair} by {depth:.2e} m {message}", reached, depth, gained)
    if gained > ENERGY:
        return Result("energy", f"grows by {gained:.2e} of its range {message}", reached, depth, gained)
    proved = ""
    if "No set of pushing" in message:
        modes = solution_modes(problem_at(simulation, world.mechanism))
        proved = "(proved) " if modes is None else f"(although {modes} agree) "
    return Result(f"refused: {proved}{_kind(message)}" if message else "", message, reached, depth, gained)


def _kind(message: str) -> str:
    """First words of a message after its time and names."""
    return message.split("s: ", 1)[-1][:48]


def _deepest(world: LatticeWorld, readings: dict[str, np.ndarray]) -> tuple[float, str]:
    """Deepest overlap of any two bodies [m], and which."""
    placed = {}
    for name, solid in world.solids.items():
        if name == "ground":
            placed[name] = Placed(solid.pieces, 0j, 1.0 + 0j)
            continue
        x, y, angle = (readings[f"{name}.{c}"] for c in ("x", "y", "angle"))
        placed[name] = Placed(solid.pieces, x + 1j * y, np.exp(1j * angle))
    found = [(float(depths(placed[a], placed[b]).max()), f"{b} in {a}") for a, b in combinations(placed, 2)]
    return max(found)


def _energy_gained(world: LatticeWorld, readings: dict[str, np.ndarray]) -> float:
    """Energy above the least before, as a part of its range."""
    kinetic = potential = np.zeros(1)
    gravity = (world.mechanism.gravity or (0.0, 0.0))[1]
    for body in world.mechanism.bodies:
        u, v, w = (readings[f"{body.name}.{c}"] for c in ("x_rate", "y_rate", "speed"))
        kinetic = kinetic + 0.5 * body.mass * (u * u + v * v) + 0.5 * body.inertia * w * w
        potential = potential - body.mass * gravity * readings[f"{body.name}.y"]
    size = float(kinetic.max() + np.ptp(potential)) or 1.0
    energy = kinetic + potential
    return float((energy - np.minimum.accumulate(energy)).max() / size)


def main() -> None:
    """Run lattice worlds and report those that fail."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, help="replay one world")
    options = parser.parse_args()
    first, count = (options.first, options.count) if options.seed is None else (options.seed, 1)
    faults: defaultdict[str, list[int]] = defaultdict(list)
    worlds, refused = Counter[float](), Counter[float]()
    began, deepest, gained = time.perf_counter(), 0.0, 0.0
    for seed in range(first, first + count):
        world = lattice_world(seed)
        start = time.perf_counter()
        result = run(world)
        spent = time.perf_counter() - start
        worlds[world.friction] += 1
        deepest, gained = max(deepest, result.deepest), max(gained, result.gained)
        if result.fault or options.seed is not None:
            faults[result.fault].append(seed)
            refused[world.friction] += result.fault.startswith("refused")
            print(f"{seed} at {result.time:.4g} s: {result.fault}: {world.description}", flush=True)
            if options.seed is not None:
                print(result.detail)
        if spent > 5.0:
            print(f"{seed} takes {spent:.1f} s: {world.description}", flush=True)
        if (seed - first + 1) % 100 == 0:
            total = sum(map(len, faults.values()))
            print(f"{seed - first + 1} worlds, {time.perf_counter() - began:.0f} s, {total} faults", flush=True)
    print(f"{count} worlds; deepest overlap {deepest:.1e} m, energy gained {gained:.1e} of its range")
    for friction in sorted(worlds):
        print(f"    friction {friction}: {refused[friction]} of {worlds[friction]} refused")
    for fault, seeds in sorted(faults.items(), key=lambda item: -len(item[1])):
        print(f"{len(seeds)} x {fault or 'no fault'}: seeds {', '.join(map(str, seeds))}")


if __name__ == "__main__":
    main()
