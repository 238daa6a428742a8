"""Object files for each platform from the engine's intermediate code (LLVM).

    python -m mechanism_fmu.fmu.native.emit FOLDER           writes FOLDER/engine.bc and FOLDER/<target>.o
    python -m mechanism_fmu.fmu.native.emit FOLDER web       writes FOLDER/wasm32.o, from FOLDER/engine.bc

It prints what it is about to do: how many parts are done, of how many, what is next.
To be run in a process of its own, because numba must be imported for a generic processor (see `objects`).
"""

from __future__ import annotations

import gc
import sys
from multiprocessing import Process
from pathlib import Path

import llvmlite.binding as llvm

from ...engine.library import EXPORTS, intermediate_code
from ..disk.user_cache import keep
from .link import TARGETS, WEB, Target

#: Of WebAssembly, what all browsers have had for years.
_WEB_FEATURES = "+bulk-memory,+mutable-globals,+nontrapping-fptoint,+sign-ext"

#: Modules of the engine whose functions every evaluation runs through some hundred times: in place of their calls.
_IN_PLACE = ("vectors", "constraints.entries", "stepping.runge_kutta", "dynamics.minimum_norm")
#: The same of the module of pages, which each page loads.
_IN_PLACE_OF_WEB = ("stepping.runge_kutta",)

#: What runs once in a step, or on few numbers only: rather short than fast.
_SHORT = (
    *("contacts", "outlines", "outputs", "exchange", "library"),
    *(f"stepping.{name}" for name in ("step_size", "looks", "stage", "stepper")),
)

#: What runs at events, at the start and on few models only: as short as can be.
_SHORTEST = (
    *("starting", "elastic", "library", "dynamics.sliding"),
    *(f"stepping.{name}" for name in ("rosenbrock", "passing", "singular", "reach", "closing", "meeting")),
    *(f"stepping.{name}" for name in ("letting_go", "crossing", "stiffness")),
    *("exchange", "outputs", "outlines", "constraints.wear", "profiles.overlap", "profiles.touch"),
    *(f"dynamics.{name}" for name in ("oscillation", "bushing", "torsional", "own_states", "laws", "thresholds")),
    *(f"stepping.{name}" for name in ("step", "step_size", "stepper")),
    *(f"contacts.{name}" for name in ("inside", "event_record", "friction_readings", "play_readings")),
    *(f"contacts.{name}" for name in ("binding", "complementarity", "doubts", "handover", "impact", "impact_laws")),
    *(f"contacts.{name}" for name in ("lemke", "participation", "proposal", "routh", "rubbing", "shared_forces")),
    *(f"contacts.{name}" for name in ("transition", "trial")),
)


def linked(codes: list[llvm.ModuleRef]) -> bytes:
    """The intermediate code of all exported functions in one module, as bitcode."""
    module = codes[0]
    for code in codes[1:]:
        module.link_in(code)
    whole: bytes = module.as_bitcode()
    return whole


def _say_how(module: llvm.ModuleRef, in_place: tuple[str, ...]) -> None:
    """Mark which functions are to be fast, and which short."""
    for parts, attribute in ((in_place, "inlinehint"), (_SHORT + _SHORTEST, "optsize"), (_SHORTEST, "minsize")):
        names = tuple(map(_mangled, parts))
        for function in module.functions:
            if not function.is_declaration and any(name in function.name for name in names):
                function.add_function_attribute(attribute)


def _mangled(part: str) -> str:
    """How the names of functions say that they belong to a part of the engine: each name behind its length."""
    return "".join(f"{len(name)}{name}" for name in ("engine", *part.split(".")))


def object_file(bitcode: bytes, target: Target) -> bytes:
    """One object of all exported functions, optimised as a whole; nothing else can be linked to.

    With everything but the exports internal, the optimiser proves that no error path exists, and nothing of numba or
    Python is left.
    """
    module = llvm.parse_bitcode(bitcode)
    kind = {"reloc": "static", "features": _WEB_FEATURES} if target is WEB else {"reloc": "pic"}
    machine = llvm.Target.from_triple(target.triple).create_target_machine(opt=3, codemodel="default", **kind)
    module.triple = target.triple
    module.data_layout = str(machine.target_data)
    for symbol in (*module.functions, *module.global_variables):
        if symbol.name in EXPORTS:
            symbol.visibility = "hidden"  # several FMUs in one process must not see each other's engine
        elif not symbol.is_declaration:
            symbol.linkage = "private"  # as internal, and without a name: 20 kB of the FMU
    _say_how(module, _IN_PLACE_OF_WEB if target is WEB else _IN_PLACE)
    # The first, cheap pass shows which calls never report an error; the second leaves nothing of reporting them. With
    # LLVM's own threshold of 225 in the first, and nothing said of any function, it is 10 % longer, and no faster.
    for level in (1, 3):
        tuning = llvm.create_pipeline_tuning_options(speed_level=level)
        tuning.loop_interleaving = False  # the engine's loops go over a handful of rows
        tuning.loop_unrolling = target is not WEB  # of which a page loads every byte
        tuning.inlining_threshold = 50
        passes = llvm.create_pass_builder(machine, tuning)
        passes.getModulePassManager().run(module, passes)
    emitted: bytes = machine.emit_object(module)
    return emitted


def _write_object(bitcode: bytes, target: Target, folder: Path) -> None:
    """Write the object of a target, with its digest; to be run in a process of its own, too."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    keep(folder / f"{target.name}.o", object_file(bitcode, target))


def write_web(folder: Path) -> None:
    """Write the object of the browser, from the bitcode that is there."""
    print(0, 1, f"optimising for {WEB.name}", flush=True)
    _write_object((folder / "engine.bc").read_bytes(), WEB, folder)


def main(folder: Path) -> None:
    """Write the bitcode and the objects of all platforms, on as many processors as there are."""
    gc.disable()  # numba makes millions of objects here, of which hardly any go: looking for them takes long
    parts = len(EXPORTS) + len(TARGETS)
    codes: list[llvm.ModuleRef] = []
    for done, name in enumerate(EXPORTS):
        print(done, parts, f"compiling {name}", flush=True)
        codes.append(intermediate_code(name))
    bitcode = linked(codes)
    keep(folder / "engine.bc", bitcode)
    # Each ends by itself, even if this process is killed.
    writers = [Process(target=_write_object, args=(bitcode, target, folder)) for target in TARGETS]
    for writer in writers:
        writer.start()
    for done, (target, writer) in enumerate(zip(TARGETS, writers, strict=True), len(EXPORTS)):
        print(done, parts, f"optimising for {target.name}", flush=True)
        writer.join()
        if writer.exitcode != 0:
            raise SystemExit(f"Optimising for {target.name} ended with exit code {writer.exitcode}.")


if __name__ == "__main__":
    (write_web if sys.argv[2:] == ["web"] else main)(Path(sys.argv[1]))
