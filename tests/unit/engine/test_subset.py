"""The engine stays in the part of Python that compiles to free-standing code."""

import numba
import pytest
from own_process import run_script

from mechanism_fmu.engine.assembly import begin
from mechanism_fmu.engine.stepper import advance
from mechanism_fmu.model import Body, Mechanism
from mechanism_fmu.simulation import Simulation

#: Functions of double precision that any platform's C library has (C99, 7.12, and sincos), and nothing else.
MATHEMATICS = {
    "acos",
    "asin",
    "atan",
    "atan2",
    "ceil",
    "cos",
    "cosh",
    "exp",
    "fabs",
    "floor",
    "fmod",
    "hypot",
    "log",
    "pow",
    "round",
    "sin",
    "sincos",
    "sinh",
    "sqrt",
    "tan",
    "tanh",
    "trunc",
}
MEMORY = {"memcpy", "memmove", "memset"}


@pytest.fixture(scope="module")
def emitted():
    return run_script("emit_object.py")


def test_the_engine_needs_only_mathematics_and_memory(emitted):
    assert set(emitted["engine"]) <= MATHEMATICS | MEMORY


def test_the_symbols_looked_at_are_those_of_the_engine(emitted):
    assert {"sin", "cos"} <= set(emitted["engine"])
    assert emitted["size"] > 10_000


def test_a_function_that_leaves_the_subset_is_found_out(emitted):
    assert any(name.startswith("NRT_") for name in emitted["outside"])
    assert not set(emitted["outside"]) <= MATHEMATICS | MEMORY


def test_the_object_is_the_same_every_time(emitted):
    assert emitted["same"]


@pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="there is no compiler to ask")
def test_whole_numbers_of_seconds_compile_nothing_new():
    """Python's integers are another type to the compiler, which would take its time for each combination."""
    for start, end in ((1.0, 2.0), (1, 2)):
        simulation = Simulation(Mechanism(bodies=(Body("stone", 1.0, 1.0),)), start_time=start)
        simulation.advance(end)
    assert len(begin.signatures) == len(advance.signatures) == 1
