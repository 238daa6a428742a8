"""What the engine is compiled for; what the compiled engine needs: see tests/fmu/native/test_subset.py."""

import numba
import pytest

from mechanism_fmu.engine.starting.begin import begin
from mechanism_fmu.engine.stepping.stepper import advance
from mechanism_fmu.model import Body, Mechanism
from mechanism_fmu.simulation import Simulation


@pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="there is no compiler to ask")
def test_whole_numbers_of_seconds_compile_nothing_new():
    """Python's integers are another type to the compiler, which would take its time for each combination."""
    for start, end in ((1.0, 2.0), (1, 2)):
        simulation = Simulation(Mechanism(bodies=(Body("stone", 1.0, 1.0),)), start_time=start)
        simulation.advance(end)
    assert len(begin.signatures) == len(advance.signatures) == 1
