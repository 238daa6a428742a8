"""The engine alone as shared libraries, for FMUs by pythonfmu: they then start without numba and its compilation."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from ..archive import content_hash
from .link import link, linked_with, surface
from .objects import Report, compiled_engine, silently
from .targets import TARGETS, WRAPPED


def engine_libraries(report: Report = silently) -> dict[str, bytes]:
    """The library of each platform of pythonfmu, by the file name under which `mechanism_fmu.engine.run` looks for it.

    Args:
        report: see `compiled_engine`.

    Raises:
        MechanismError: there is no linker, or the engine cannot be compiled.
    """
    engine = compiled_engine(report)
    made_from = content_hash(linked_with("library.c"))[:8]
    found = {}
    for target in (target for target in TARGETS if target.fmi2 in WRAPPED):
        path = engine.headers / made_from / f"{target.name}{target.suffix}"
        if not path.is_file():
            path.parent.mkdir(exist_ok=True)
            with tempfile.TemporaryDirectory(dir=path.parent) as temporary:
                made = Path(temporary, path.name)
                link(target, [*surface("library.c"), engine.objects[target.name]], [engine.headers], made)
                os.replace(made, path)
        found[path.name] = path.read_bytes()
    return found
