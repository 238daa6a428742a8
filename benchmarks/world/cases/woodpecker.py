"""Woodpecker toy: its limit cycle with small angles, beside what Leine, Glocker and van Campen have printed of it."""

from __future__ import annotations

import importlib.util
import sys
from functools import cache
from typing import Any

from mechanism_fmu.simulation import Simulation

from ..case import Case, Known, Run, example_path, steps_of

#: Lengths over those of the toy, with its clearances as they are: so angles are small.
SIZE = 1e5


def run(tolerance: float) -> Run:
    """Angle of the bird at rest and period, and the steps of the one cycle that returns."""
    program = _program()
    found, _, _ = program.limit_cycle("newton", tolerance, SIZE)
    simulation = Simulation(program.toy(found.start, "newton", tolerance, SIZE))
    simulation.advance(found.period)
    return Run((found.start, found.period), steps_of(simulation))


@cache
def _program() -> Any:
    """The example that looks for the cycle by the secant method."""
    path = example_path("woodpecker").parents[1] / "woodpecker_cycle.py"
    spec = importlib.util.spec_from_file_location("world_woodpecker_cycle", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[module.__name__] = module  # where its records are looked up
    spec.loader.exec_module(module)
    return module


CASE = Case(
    name="woodpecker",
    title="Woodpecker toy",
    statement=(
        "A sleeve with clearance on a pole, a bird on a torsion spring, a beak with restitution 0.5, friction of 0.3, "
        "Newton's law of impact, angles of first order; the motion that repeats itself."
    ),
    source=(
        "R. I. Leine, Ch. Glocker, D. H. van Campen, Nonlinear dynamics of the woodpecker toy, "
        "DETC2001/VIB-21608 (2001)"
    ),
    known=(
        Known("angle of the bird at rest", "rad", "-0.53", "published"),
        Known("period", "s", "0.1452", "published"),
    ),
    run=run,
    model=example_path("woodpecker"),
    within=6e-3,
    remark=(
        "The printed period is 0.5 % shorter than ours. A second computation, in three coordinates by hand "
        "without this "
        "engine, integrated by scipy at 1e-12, gives ours to 4e-7 s; where the difference comes from is not known. "
        "The cycle attracts slowly, so that what it is off is nearly doubled. More: "
        "[the woodpecker toy](../explanation/woodpecker.md)."
    ),
)
