"""The engine alone as shared libraries: with them FMUs start without numba, and many designs run in one call."""

from __future__ import annotations

from ctypes import CDLL
from pathlib import Path

from ...engine.run import library_path, load
from ..archive import content_hash
from ..kept import is_whole, keep
from ..temporary import temporary_folder
from .link import has_linker, link, linked_with, surface
from .objects import Engine, Report, compiled_engine, silently
from .targets import TARGETS, WRAPPED, Target

_SOURCES = ("library.c", "many.c")


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
    """The library for this platform, in the user's cache; None where there is no linker, or no such platform.

    Args:
        report: see `compiled_engine`.

    Raises:
        MechanismError: the engine cannot be compiled.
    """
    place = library_path(Path())
    target = next((t for t in TARGETS if place is not None and f"{t.name}{t.suffix}" == place.name), None)
    if target is None or not has_linker():
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


def _linked(engine: Engine, target: Target) -> Path:
    """The library of a platform, linked now if there is none, or none that is as it was made."""
    made_from = content_hash(linked_with(*_SOURCES))[:8]
    path = engine.headers / made_from / f"{target.name}{target.suffix}"
    if not is_whole(path):
        path.parent.mkdir(exist_ok=True)
        with temporary_folder(path.parent) as temporary:
            made = temporary / path.name
            link(target, [*surface(*_SOURCES), engine.objects[target.name]], [engine.headers], made)
            keep(path, made.read_bytes(), program=True)
    return path
