"""The engine's object files: compiled once for each state of its sources, and kept in the user's cache directory."""

from __future__ import annotations

import importlib.metadata
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from ...model import MechanismError
from ..archive import content_hash
from ..kept import is_whole, keep
from ..start import private_cache
from .alone import alone
from .headers import engine_header
from .targets import TARGETS

_LIBRARY = Path(__file__).parents[2]

#: What makes numba compile for any processor of a kind, without Intel's own vector functions.
_GENERIC = {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": "", "NUMBA_DISABLE_INTEL_SVML": "1"}


def _digest() -> str:
    """Fingerprint of the engine's sources, of its header and targets, and of what compiles them."""
    own = [Path(__file__).with_name(name) for name in ("emit.py", "targets.py", "objects.py")]
    folders = [path for name in ("engine", "tables") for path in (_LIBRARY / name).rglob("*.py")]
    sources = [*folders, _LIBRARY / "codes.py", _LIBRARY / "tolerances.py", *own]
    contents = {str(path.relative_to(_LIBRARY)): path.read_bytes() for path in sources}
    compilers = " ".join(f"{name} {importlib.metadata.version(name)}" for name in ("numba", "llvmlite"))
    return content_hash({**contents, "engine.h": engine_header().encode(), "compilers": compilers.encode()})[:16]


#: Takes what comes next, and which part of the whole is done (0..1).
Report = Callable[[str, float], None]


def silently(_next: str, _done: float) -> None:
    """Report nothing."""


@dataclass(frozen=True)
class Engine:
    """The compiled engine.

    Attributes:
        objects: the object file for each target, by the target's name.
        headers: folder of engine.h.
    """

    objects: dict[str, Path]
    headers: Path

    @property
    def complete(self) -> bool:
        """Whether all files are there, as they were made; the header comes last."""
        return all(map(is_whole, (*self.objects.values(), self.headers / "engine.h")))


def compiled_engine(report: Report = silently) -> Engine:
    """The engine's object files and header; compiled now if need be, in one or two minutes.

    Whoever asks while another process compiles it waits for what that makes.

    Args:
        report: is told what comes next, and which part of the whole is done (0..1).

    Raises:
        MechanismError: the compilation failed, with what it printed.
    """
    engine = _engine()
    if not engine.complete:
        folder = engine.headers
        folder.mkdir(parents=True, exist_ok=True)
        with alone(folder, lambda: report("waiting for another process that does it", 0.0)):
            if not engine.complete:
                _emit(folder, report)
                # Always in the same place, so that the compiler of the C files finds again what it has compiled.
                keep(folder / "engine.h", engine_header().encode("ascii"))
    return engine


def engine_is_compiled() -> bool:
    """Whether `compiled_engine` has its files already."""
    return _engine().complete


def engine_folder() -> Path:
    """Where the files of this state of the sources are kept.

    Raises:
        MechanismError: the user's cache directory cannot be used.
    """
    try:
        return private_cache() / f"native_{_digest()}"
    except OSError as error:
        raise MechanismError(f"The cache directory cannot be used: {error}.") from error


def _engine() -> Engine:
    folder = engine_folder()
    return Engine({target.name: folder / f"{target.name}.o" for target in TARGETS}, folder)


def _emit(folder: Path, report: Report) -> None:
    path = os.pathsep.join(filter(None, [str(_LIBRARY.parent), os.environ.get("PYTHONPATH", "")]))
    # Settings of numba that the user has for other work would change what is compiled.
    inherited = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")}
    environment = {**inherited, **_GENERIC, "PYTHONPATH": path}
    # -P: no file of the folder that it works in stands in for a module.
    command = [sys.executable, "-P", "-m", "mechanism_fmu.fmu.native.emit", str(folder.absolute())]
    with (
        tempfile.TemporaryFile("w+") as complaints,
        subprocess.Popen(
            command, env=environment, cwd=folder, stdout=subprocess.PIPE, stderr=complaints, text=True
        ) as process,
    ):
        assert process.stdout is not None
        for line in process.stdout:
            done, whole, text = line.strip().split(" ", 2)
            report(text, int(done) / int(whole))
        if process.wait() != 0:
            complaints.seek(0)
            raise MechanismError(f"The engine could not be compiled ahead of time:\n{complaints.read().strip()}")
