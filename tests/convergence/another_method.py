"""Bogacki-Shampine's 3(2) in place of the engine's method; nothing else is replaced.

As a script it prints as JSON what it measures; as a plugin of pytest it lets any test run with the other method:

    NUMBA_DISABLE_JIT=1 python tests/convergence/another_method.py
    NUMBA_DISABLE_JIT=1 python -m pytest -p tests.convergence.another_method tests/analytic/test_refused_step.py

It must be loaded before the tables and the engine. Without the compiler a few hundred steps are done sooner.
"""

import json
import math
import sys
from dataclasses import replace

import numpy as np

from mechanism_fmu.tables import method

#: Hairer, Nørsett, Wanner: Solving ODEs I, II.4; its dense output is the cubic that every method has.
BOGACKI_SHAMPINE = method.method(
    "Bogacki-Shampine 3(2)",
    c=(0.0, 1 / 2, 3 / 4, 1.0),
    a=((), (1 / 2,), (0.0, 3 / 4), (2 / 9, 1 / 3, 4 / 9)),
    error=(-5 / 72, 1 / 12, 1 / 9, -1 / 8),
    orders=(3, 2, 3),
)
if "mechanism_fmu.tables.motion" in sys.modules:
    raise RuntimeError("The tables have the sizes of the engine's own method already: replace it before.")
method.METHOD = BOGACKI_SHAMPINE

#: Relative tolerances of whole runs, and steps of one size to the same end.
TOLERANCES = 10.0 ** -np.arange(6.0, 8.1, 0.5)
COUNTS = (32, 64, 128)
#: Steps whose inside is looked at, from an instant at which the next derivative does not vanish.
INSIDE, FROM = (0.08, 0.04, 0.02), 0.5


#: A stop that the swing meets at this angle [rad].
STOP = 0.3


def measured():
    """Orders, and slopes over the tolerance, by name; see `test_another_method`."""
    import test_orders as swing

    from mechanism_fmu import codes
    from mechanism_fmu.model import GROUND, AngleStop
    from mechanism_fmu.simulation import Simulation

    found = {name: len(Simulation(swing.swing()).field(name)) for name in ("derivatives", "dense", "new_dense")}
    for cause in swing.CAUSES:
        ends = [swing.errors_of_steps(cause, 0.0, swing.END / count, count)[0] for count in COUNTS]
        inside = [swing.errors_of_steps(cause, FROM, step, 1)[1] for step in INSIDE]
        found[f"step, {cause}"] = swing.orders(ends).tolist()
        found[f"dense output, {cause}"] = swing.orders(inside).tolist()
    meets = math.acos(STOP / swing.AMPLITUDE) / swing.FREQUENCY
    stop = AngleStop("stop", "bob", GROUND, STOP, restitution=1.0)
    errors, steps, instants = [], [], []
    for tolerance in TOLERANCES:
        simulation = Simulation(swing.swing(tolerance))
        simulation.advance(swing.END)
        errors.append(np.abs([simulation.read()[name] for name in swing.NAMES] - swing.exact(swing.END)).max())
        steps.append(int(simulation.field("counters")[codes.COUNT_STEPS]))
        simulation = Simulation(replace(swing.swing(tolerance), contacts=(stop,)))
        simulation.advance(swing.END)
        (impact,) = simulation.impacts_in_step()
        instants.append(abs(impact.time - meets))
    return found | {"error": slope(errors), "steps": slope(steps), "instant of the impact": slope(instants)}


def slope(values):
    """Exponent with which `values` grow with the tolerance."""
    return float(np.polyfit(np.log(TOLERANCES), np.log(values), 1)[0])


if __name__ == "__main__":
    json.dump(measured(), sys.stdout)
