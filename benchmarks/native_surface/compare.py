"""Steps, starts and saved states of the native FMU, and steps of the bare engine, timed by a C program."""

from __future__ import annotations

import shutil
import subprocess
import zipfile
from collections.abc import Sequence
from pathlib import Path

import fmpy
import numpy as np

import models
from mechanism_fmu.engine.run import library_path
from mechanism_fmu.fmu.native.objects import engine_libraries
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.model import Input, Output
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.tables.declare import Array
from mechanism_fmu.tables.layout import field_of, pack

from ..c_limit.library import NoCompilerError
from ..timing import Comparison, require_agreement

#: The engine's share of a step's time must be at least this: the FMU may take 1.15 times as long.
_LEAST_SHARE = 1 / 1.15
#: What the surface may add to a step, and what a start and a saved and restored state may take [s].
_MOST_SURFACE, _MOST_START, _MOST_STATE = 0.5e-6, 5e-3, 2e-6
#: What changes and what is compared at the end [rad/s]: both are the same engine, of two builds.
_INPUT, _OUTPUT, _AGREES = "drive_torque", "wheel_speed", 1e-9
_SUBJECT = "native FMU from C (baseline: the bare engine)"


def compare(folder: Path, rounds: int) -> list[Comparison]:
    """Compare in a process without Python.

    Raises:
        NoCompilerError: there is no C compiler, or the system is not Linux on x86-64.
        MechanismError: there is no linker.
        DisagreementError: they do not come to the same end.
    """
    compiler = shutil.which("cc")
    library = library_path(folder)
    if compiler is None or library is None or library.name != "x86_64-linux.so":
        raise NoCompilerError("it needs the C compiler cc, and Linux on x86-64.")
    model = models.load("ratchet").MODEL
    with zipfile.ZipFile(build_native_fmu(models.load("ratchet"), folder / "native")) as fmu:
        fmu.extractall(folder / "native")
    description = fmpy.read_model_description(str(folder / "native"))
    block = pack(compile_mechanism(model.build(model.values())))
    (folder / "block").write_bytes(block.tobytes())
    library.write_bytes(engine_libraries()[library.name])
    host = folder / "host"
    headers = Path(fmpy.__file__).with_name("c-code")
    source = Path(__file__).with_name("host.c")
    subprocess.run([compiler, "-O2", "-std=c11", f"-I{headers}", str(source), "-o", str(host), "-ldl"], check=True)
    mechanism = model.mechanism(model.values())
    number = {one.name: int(one.valueReference) for one in description.modelVariables}
    changes = (_word(block, "inputs", mechanism.inputs, _INPUT), number[_INPUT])
    compared = (_word(block, "outputs", mechanism.outputs, _OUTPUT), number[_OUTPUT])
    binary = next((folder / "native" / "binaries" / "linux64").glob("*.so"))
    command = [host, binary, description.guid, library, folder / "block", len(block), *changes, *compared, rounds + 1]
    done = subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True)
    lines = np.loadtxt(done.stdout.splitlines()[1:], ndmin=2)
    ends = lines[:, 6:]
    require_agreement("the FMU and the bare engine [rad/s]", ends[:, 0::2], ends[:, 1::2], _AGREES)
    engine, fmu_, engine_new, fmu_new, start, state = (tuple(map(float, 1e-9 * times)) for times in lines[:, :6].T)
    added = tuple(b - a for a, b in zip(engine, fmu_, strict=True))
    return [
        Comparison(_SUBJECT, "1 ms step, constant input", engine, fmu_, least_ratio=_LEAST_SHARE),
        Comparison(_SUBJECT, "1 ms step, new input each step", engine_new, fmu_new, least_ratio=_LEAST_SHARE),
        Comparison(_SUBJECT, "what the surface adds to a step", engine, added, longest=_MOST_SURFACE),
        Comparison(_SUBJECT, "instantiate .. exitInitializationMode", engine, start, longest=_MOST_START),
        Comparison(_SUBJECT, "state saved and restored", engine, state, longest=_MOST_STATE),
    ]


def _word(block: Array, field: str, ports: Sequence[Input] | Sequence[Output], name: str) -> int:
    """Where in the block the value of the input or output of this name is."""
    place = [port.name for port in ports].index(name)
    return (field_of(block, field).ctypes.data - block.ctypes.data) // 8 + place
