"""Emit compiled engine functions as an x86-64 Linux object file and list what they need from outside.

    python emit_object.py        (prints JSON; a process of its own, because numba reads its settings when imported)

The way to a native library: the engine behind a C signature, everything else internal, optimised as a whole.
"""

from __future__ import annotations

import json
import os
import struct
from typing import Any

if __name__ == "__main__":
    # code for any x86-64, without Intel's own vector mathematics
    os.environ |= {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": "", "NUMBA_DISABLE_INTEL_SVML": "1"}

import llvmlite.binding as llvm
import numba
import numpy as np
from numba import types

from mechanism_fmu.engine.assembly import begin
from mechanism_fmu.engine.output_rates import read_output_rates
from mechanism_fmu.engine.outputs import read_outputs
from mechanism_fmu.engine.stepper import advance, begin_step, go_on

TRIPLE = "x86_64-unknown-linux-gnu"
OPTIONS = {"error_model": "numpy", "boundscheck": False, "fastmath": False}
BLOCK = types.CPointer(types.float64)


def engine() -> Any:
    """All that the engine does, behind one C signature."""

    @numba.cfunc(types.int64(BLOCK, types.int64, types.int64, types.float64), **OPTIONS)
    def mechanism(block, words, which, time):
        memory = numba.carray(block, (words,))
        if which == 0:
            return begin(memory, time)
        if which == 1:
            return advance(memory, time)
        if which == 2:
            return begin_step(memory)
        if which == 3:
            read_outputs(memory)
            return 0
        if which == 4:
            read_output_rates(memory)
            return 0
        return go_on(memory, time, which - 5)

    return mechanism


def outside_the_subset() -> Any:
    """A function that allocates; not an `entry`, in which the compiler would refuse that."""

    @numba.njit(**OPTIONS)
    def allocating(block):
        block[0] = np.zeros(int(block[1])).sum()

    @numba.cfunc(types.void(BLOCK, types.int64), **OPTIONS)
    def outside(block, words):
        allocating(numba.carray(block, (words,)))

    return outside


def emit(function: Any) -> bytes:
    """The object file of a C function and all that it calls."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    module = llvm.parse_assembly(function.inspect_llvm().replace(function.native_name, function.__name__))
    for symbol in (*module.functions, *module.global_variables):
        if not symbol.is_declaration and symbol.name != function.__name__:
            symbol.linkage = "internal"
    machine = llvm.Target.from_triple(TRIPLE).create_target_machine(
        cpu="x86-64", features="", opt=3, reloc="pic", codemodel="default"
    )
    module.triple, module.data_layout = TRIPLE, str(machine.target_data)
    builder = llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options(speed_level=3))
    builder.getModulePassManager().run(module, builder)
    return bytes(machine.emit_object(module))


def undefined_symbols(elf: bytes) -> list[str]:
    """Names that an object file leaves to the linker, from its symbol table (ELF-64, System V ABI, chapter 4)."""
    sections = {section.name(): section.data() for section in llvm.ObjectFileRef.from_data(elf).sections()}
    table, names = sections[b".symtab"], sections[b".strtab"]
    found = []
    for name, _info, _other, section, _value, _size in struct.iter_unpack("<IBBHQQ", table):
        if section == 0 and name:
            found.append(names[name : names.index(b"\0", name)].decode())
    return sorted(found)


def main() -> None:
    """Print what the tests look at."""
    function = engine()
    first, second = emit(function), emit(function)
    report = {
        "size": len(first),
        "same": first == second,
        "engine": undefined_symbols(first),
        "outside": undefined_symbols(emit(outside_the_subset())),
    }
    print(json.dumps(report))


if __name__ == "__main__":
    main()
