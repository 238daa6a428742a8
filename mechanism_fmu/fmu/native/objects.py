"""The engine's object files and libraries: compiled once for each state of its sources, kept in the user's cache."""

from __future__ import annotations

import importlib.metadata
import importlib.util
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from ctypes import CDLL
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

from ...engine.run import library_path, load
from ...model import MechanismError
from ..disk.archive import content_hash
from ..disk.folders import temporary_folder
from ..disk.user_cache import alone, is_whole, keep
from ..start import private_cache
from .engine_header import advice_table, engine_header
from .link import (
    HEADERS,
    TARGETS,
    WEB,
    WEB_SURFACE,
    WRAPPED,
    Target,
    has_linker,
    link,
    linked_with,
    need_linker,
    standard,
    surface,
    warm_up,
)
from .sources import COMPILED, fingerprint, is_of_these_sources

# The engine's object files: compiled once for each state of its sources, and kept in the user's cache directory.

_LIBRARY = Path(__file__).parents[2]

#: What makes numba compile for any processor of a kind, without Intel's own vector functions.
_GENERIC = {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": "", "NUMBA_DISABLE_INTEL_SVML": "1"}


#: What compiles the engine, beside the linker.
_COMPILERS = ("numba", "llvmlite")

#: How to get what compiles and links it.
INSTALL = 'python -m pip install -e ".[dev]"'


def has_compiler() -> bool:
    """Whether numba is installed."""
    return importlib.util.find_spec("numba") is not None


def need_compiler() -> None:
    """Refuse to go on without numba.

    Raises:
        MechanismError: it is not installed.
    """
    if not has_compiler():
        raise MechanismError(
            "The engine is not there in compiled form, or its sources have changed since, and the package numba, which "
            f"compiles it, is not installed. In a clone of the repository: {INSTALL}"
        )


def _digest() -> str:
    """Fingerprint of the sources, and of what compiles them."""
    need_compiler()
    compilers = " ".join(f"{name} {importlib.metadata.version(name)}" for name in _COMPILERS)
    return content_hash({"sources": fingerprint(_LIBRARY, linked=False).encode(), "compilers": compilers.encode()})[:16]


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
        return all(map(is_whole, (*self.objects.values(), self.headers / "engine.bc", self.headers / "engine.h")))


def compiled_engine(report: Report = silently) -> Engine:
    """The engine's object files and header; compiled now if need be, in one or two minutes.

    Whoever asks while another process compiles it waits for what that makes.

    Args:
        report: is called with what comes next, and which part of the whole is done (0..1).

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
    return is_bundled() or (has_compiler() and _engine().complete)


def engine_folder() -> Path:
    """Where the files of this state of the sources are kept.

    Raises:
        MechanismError: the user's cache directory cannot be used, or numba is not installed.
    """
    try:
        return private_cache() / f"native_{_digest()}"
    except OSError as error:
        raise MechanismError(f"The cache directory cannot be used: {error}.") from error


def _engine() -> Engine:
    return _engine_in(_BUNDLED if is_bundled() else engine_folder())


def _engine_in(folder: Path) -> Engine:
    return Engine({target.name: folder / f"{target.name}.o" for target in TARGETS}, folder)


def _web_object(engine: Engine, report: Report) -> Path:
    """The engine's object file for the browser; made now if need be, in half a minute, from its bitcode."""
    path = engine.headers / f"{WEB.name}.o"
    if not is_whole(path):
        with alone(engine.headers, lambda: report("waiting for another process that does it", 0.0)):
            if not is_whole(path):
                _emit(engine.headers, report, "web")
    return path


def _emit(folder: Path, report: Report, *what: str) -> None:
    path = os.pathsep.join(filter(None, [str(_LIBRARY.parent), os.environ.get("PYTHONPATH", "")]))
    # Settings of numba that the user has for other work would change what is compiled.
    inherited = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")}
    environment = {**inherited, **_GENERIC, "PYTHONPATH": path}
    # -P: no file of the folder that it works in stands in for a module.
    command = [sys.executable, "-P", "-m", "mechanism_fmu.fmu.native.emit", str(folder.absolute()), *what]
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


# What is compiled when it is installed, so that nothing is later: objects, libraries, and of which sources.

_BUNDLED = _LIBRARY / COMPILED


@cache
def is_bundled() -> bool:
    """Whether the compiled engine lies here whole, and is that of the sources that lie here."""
    libraries = map(_bundled, (*TARGETS, WEB))
    return is_of_these_sources(_LIBRARY) and _engine_in(_BUNDLED).complete and all(map(is_whole, libraries))


def write_engine(folder: Path) -> None:
    """Write what a wheel and a clone carry, compiled now if need be.

    Args:
        folder: made if need be; `sources.COMPILED` of the package that it is for.

    Raises:
        MechanismError: the engine cannot be compiled or linked.
        OSError: the folder cannot be written.
    """
    with ThreadPoolExecutor() as pool:  # each a process of its own
        pool.map(warm_up, (WEB, *TARGETS))
        engine = compiled_engine()
        libraries = list(pool.map(partial(_linked, engine), (WEB, *TARGETS)))
    paths = [*engine.objects.values(), engine.headers / "engine.bc", engine.headers / "engine.h"]
    (folder / "libraries").mkdir(parents=True, exist_ok=True)
    (folder / "sources").unlink(missing_ok=True)  # until all is there, none of it counts
    for path in libraries:
        keep(folder / "libraries" / path.name, path.read_bytes(), program=True)
    for path in paths:
        keep(folder / path.name, path.read_bytes())
    (folder / "sources").write_text(f"{fingerprint(_LIBRARY)}\n", encoding="ascii")


def _bundled(target: Target) -> Path:
    return _BUNDLED / "libraries" / f"{target.name}{target.suffix}"


# The engine alone as shared libraries: with them FMUs start without numba, and many designs run in one call.

_SOURCES = ("library.c", "many.c")


def has_libraries() -> bool:
    """Whether `engine_libraries` has them, or can make them."""
    return is_bundled() or (has_linker() and has_compiler())


def engine_libraries(report: Report = silently) -> dict[str, bytes]:
    """The library of each platform of pythonfmu, by the file name under which `mechanism_fmu.engine.run` looks for it.

    Args:
        report: see `compiled_engine`.

    Raises:
        MechanismError: there is no linker, or the engine cannot be compiled.
    """
    engine = compiled_engine(report)
    paths = [_linked(engine, target) for target in TARGETS if target.fmi2 in WRAPPED]
    return {path.name: path.read_bytes() for path in paths}


def library_here(report: Report = silently) -> Path | None:
    """The library for this platform; None where there is no linker, or no such platform.

    Args:
        report: see `compiled_engine`.

    Raises:
        MechanismError: the engine cannot be compiled, neither ahead of time nor just in time.
    """
    if not is_bundled():
        need_compiler()
    place = library_path(Path())
    target = next((t for t in TARGETS if place is not None and f"{t.name}{t.suffix}" == place.name), None)
    if target is None or not has_libraries():
        return None
    return _linked(compiled_engine(report), target)


def library_of(report: Report = silently) -> CDLL | None:
    """That library, loaded; None where there is none, or the system cannot load it.

    Args:
        report: see `compiled_engine`.

    Raises:
        MechanismError: the engine cannot be compiled.
    """
    path = library_here(report)
    return None if path is None else load(path)


def need_web_library() -> None:
    """Refuse to go on where there is no module of all pages, and none can be made.

    Raises:
        MechanismError: there is no linker.
    """
    if not is_bundled():
        need_linker("A page without the compiled engine")


def web_library(report: Report = silently) -> bytes:
    """The WebAssembly module of all pages, with the surface of FMI 3.0: models are data that it loads.

    Args:
        report: see `compiled_engine`.

    Raises:
        MechanismError: there is no linker, or the engine cannot be compiled.
    """
    need_web_library()
    return _linked(compiled_engine(report), WEB, report).read_bytes()


def web_library_is_made() -> bool:
    """Whether `web_library` has it already, so that nothing is compiled for it now."""
    if not (is_bundled() or has_linker()):
        return False
    engine = _engine()
    return engine.complete and is_whole(_path_of(engine, WEB, WEB_SURFACE, HEADERS))


def _path_of(engine: Engine, target: Target, sources: tuple[str, ...], headers: tuple[str, ...]) -> Path:
    """Where the library of a platform is, or will be."""
    if engine.headers == _BUNDLED:
        return _bundled(target)
    made_from = content_hash(linked_with(*sources, *headers))[:8]
    return engine.headers / made_from / f"{target.name}{target.suffix}"


def _linked(engine: Engine, target: Target, report: Report = silently) -> Path:
    """The library of a platform, linked now if there is none, or none that is as it was made."""
    sources, headers = (WEB_SURFACE, HEADERS) if target is WEB else (_SOURCES, ())
    path = _path_of(engine, target, sources, headers)
    if engine.headers != _BUNDLED and not is_whole(path):
        path.parent.mkdir(exist_ok=True)
        with temporary_folder(path.parent) as temporary:
            made, advice = temporary / path.name, temporary / "advice.c"
            advice.write_text(f'#include "engine.h"\n{advice_table()}', encoding="ascii")
            with_model = [advice, _web_object(engine, report)] if target is WEB else [engine.objects[target.name]]
            link(target, [*surface(*sources), *with_model], [engine.headers, standard()], made)
            keep(path, made.read_bytes(), program=True)
    return path
