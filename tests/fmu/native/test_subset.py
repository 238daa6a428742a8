"""The compiled engine needs exact functions and memory from outside, and nothing else: no sine, no Python."""

from types import FunctionType

import llvmlite.binding as llvm
import numba
import numpy as np
import pytest
from numba import carray, types

from mechanism_fmu import engine
from mechanism_fmu.engine.library import EXPORTS, program
from mechanism_fmu.fmu.native.emit import linked, object_file
from mechanism_fmu.fmu.native.link import TARGETS
from mechanism_fmu.fmu.native.objects import compiled_engine
from tests.fmu.native.symbols import undefined_symbols

#: Functions whose results IEEE 754 determines: the same bits from any C library. No other may come in.
EXACT = {"ceil", "fabs", "floor", "fmod", "round", "sqrt", "trunc"}
MEMORY = {"memcpy", "memmove", "memset", "bzero", "__bzero"}
#: A mark of floating-point numbers on Windows, which is no function.
MARKS = {"_fltused"}


def strangers(data: bytes) -> set[str]:
    return undefined_symbols(data) - EXACT - MEMORY - MARKS


@pytest.fixture(scope="module")
def objects():
    return {name: path.read_bytes() for name, path in compiled_engine().objects.items()}


@pytest.mark.parametrize("target", [target.name for target in TARGETS])
def test_the_engine_needs_exact_functions_and_memory_only(objects, target):
    found = strangers(objects[target])
    assert not found, f"{', '.join(sorted(found))}: a line of the engine has left the subset of docs/decisions/001."
    assert "floor" in undefined_symbols(objects[target]) or target.startswith("aarch64")


def allocating(block, words):
    carray(block, (words,))[0] = np.zeros(words).sum()


def raising(block, words):
    if words > 3:
        raise ValueError("too many")


def code(function):
    """As that of the engine is made, under the name of an exported function."""
    return linked([program(function, types.void(types.CPointer(types.float64), types.int64), next(iter(EXPORTS)))])


@pytest.fixture(scope="module")
def compiler():
    if numba.config.DISABLE_JIT:
        pytest.skip("there is no compiler to ask")
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()


@pytest.mark.usefixtures("compiler")
@pytest.mark.parametrize(("function", "prefix"), [(allocating, "NRT_"), (raising, "numba_")])
def test_a_function_that_leaves_the_subset_is_found_out(function, prefix):
    found = strangers(object_file(code(function), TARGETS[0]))
    assert any(name.startswith(prefix) for name in found), found


@pytest.mark.usefixtures("compiler")
def test_the_object_is_the_same_every_time():
    made = code(allocating)
    assert object_file(made, TARGETS[0]) == object_file(made, TARGETS[0])


def indexed(block, place):
    carray(block, (8,))[place] = 1.0


@pytest.mark.usefixtures("compiler")
def test_an_index_of_the_engine_is_taken_as_it_is():
    """numba's own function, which counts negative ones from the end, is replaced: it must be the one that is called."""
    counting = str(llvm.parse_bitcode(code(indexed)))
    of_engine = FunctionType(indexed.__code__, globals(), "indexed")
    of_engine.__module__ = f"{engine.__name__}.stepping.new"
    plain = str(llvm.parse_bitcode(code(of_engine)))
    assert "icmp slt i64" in counting
    assert "icmp slt i64" not in plain
