"""What a contact that sticks costs, beside the same block held by joints.

python -m benchmarks.friction      prints microseconds for each internal step, and the ratio, of runs in turns

The block rests on a slope by friction, or is held by two guides with the same two rows; a disc on a torsion spring
swings beside it, so that there is something to integrate. The steps are the same.
"""

from __future__ import annotations

import time
from statistics import median
from typing import Any

from mechanism_fmu.model import (
    GROUND,
    Body,
    Mechanism,
    PointLineContact,
    Revolute,
    RevoluteTranslational,
    TorsionSpring,
)
from mechanism_fmu.simulation import Simulation

_ROUNDS = 15
_UNTIL = 400.0


def block(stuck: bool) -> Mechanism:
    """The block, that sticks or is held, and the disc."""
    body, disc = Body("block", 2.0, 1.0), Body("disc", 1.0, 1.0, (3.0, 0.0, 0.0), (0.0, 0.0, 5.0))
    shaft = Revolute("shaft", disc, GROUND.at(3, 0))
    along, across = GROUND.line((0, 0), (1, 0)), GROUND.line((0, 0), (0, 1))
    parts: dict[str, Any] = {"gravity": (-1.0, -9.8), "forces": (TorsionSpring("spring", disc, stiffness=3.0),)}
    if stuck:
        floor = PointLineContact("floor", body.at(0, 0), along, closed=True, friction=0.5)
        return Mechanism((body, disc), (shaft,), contacts=(floor,), **parts)
    guides = (RevoluteTranslational(name, line, body.at(0, 0)) for name, line in (("along", along), ("across", across)))
    return Mechanism((body, disc), (shaft, *guides), **parts)


def step_time(mechanism: Mechanism) -> float:
    """Processor time of an internal step [us]."""
    simulation = Simulation(mechanism)
    began = time.process_time()
    simulation.advance(_UNTIL)
    return (time.process_time() - began) / int(simulation.counters[3]) * 1e6


def main() -> None:
    """Measure both in turns."""
    pairs = [(step_time(block(stuck=True)), step_time(block(stuck=False))) for _ in range(_ROUNDS)]
    stuck, held = (median(times) for times in zip(*pairs, strict=True))
    print(f"stuck {stuck:.2f} us, held {held:.2f} us a step: {median(a / b for a, b in pairs):.3f} times")


if __name__ == "__main__":
    main()
