"""The ratchet through its first impact: every output and the whole state, as numbers.

python ratchet_numbers.py        (prints JSON)
"""

from __future__ import annotations

import json

from mechanism_fmu.simulation import Simulation
from models.ratchet.model import MODEL

#: Coarser than usual: plain Python takes some 50 ms a step.
TOLERANCE = 1e-7


def ratchet_numbers() -> list[list[float]]:
    """Outputs and state at some times up to 1.2 s, with an input that changes in between."""
    simulation = Simulation(MODEL.mechanism(MODEL.values(relative_tolerance=TOLERANCE, restitution=0.2)))
    found = []
    for time in (0.0, 0.5, 0.9, 0.95, 1.2):
        simulation.advance(time)
        found.append([*simulation.read().values(), *simulation.field("y_end").tolist()])
        simulation.set_input("load_torque", 1e-3 * time)
    return found


if __name__ == "__main__":
    print(json.dumps(ratchet_numbers()))
