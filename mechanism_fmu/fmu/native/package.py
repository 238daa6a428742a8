"""Packaging of a model as a native FMU, started once where it is built: no Python on the target."""

from __future__ import annotations

import uuid
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

from ...engine.run import library_path
from ...model import MechanismError, Model, compile_mechanism
from ...model.baked import NOTHING_BAKED, Baked
from ...model.trace import trace
from ...tables.layout import pack
from ..disk.archive import DESCRIPTION, content_hash, write_archive
from ..disk.folders import temporary_folder
from ..disk.user_cache import record_build
from ..instance.self_check import require_numbers, start_explained
from ..parts.contents import common_entries, file_in, model_of
from ..parts.model_description import model_description, to_bytes
from ..parts.reference_results import reference_results
from ..parts.variables import variables_of
from .description3 import model_description3
from .formulas import Formulas, formulas
from .link import HEADERS, SURFACE, TARGETS, Target, link, linked_with, need_linker, standard, surface, universal
from .model_source import model_source
from .objects import Engine, Report, compiled_engine, library_of, silently

# A native FMU is started once where it is built, so that a mechanism that cannot start is found there.


def check_start(model: Model, guid: str, libraries: Mapping[Target, bytes]) -> None:
    """Start the library for this platform with the default values, and take its outputs.

    Where there is none for this platform, nothing is checked.

    Args:
        model: the model.
        guid: of the FMU.
        libraries: of each platform; each speaks FMI 2.0, whatever the FMU does.

    Raises:
        StartError: the mechanism cannot start.
    """
    with temporary_folder() as folder:
        path = library_path(folder)
        by_name = {target.name + target.suffix: binary for target, binary in libraries.items()}
        if path is None or path.name not in by_name:
            return
        path.write_bytes(by_name[path.name])
        slave = FMU2Slave(
            guid=guid, modelIdentifier=model.name, unzipDirectory=str(folder), instanceName="", libraryPath=str(path)
        )
        outputs = [
            v for v in variables_of(model) if v.type == "Real" and v.causality in ("output", "calculatedParameter")
        ]
        with start_explained(), _instance(slave):
            slave.setupExperiment()
            slave.enterInitializationMode()
            slave.exitInitializationMode()
            values = slave.getReal([v.value_reference for v in outputs])
            require_numbers(dict(zip((v.name for v in outputs), values, strict=True)))


@contextmanager
def _instance(slave: Any) -> Iterator[None]:
    """An instance that is freed in the end; what it says of a refused call becomes the error."""
    said: list[str] = []

    def log(_environment: object, _name: bytes, status: int, _category: bytes, text: bytes) -> None:
        if status > 1:
            said.append(text.decode("utf-8", errors="replace").replace("%%", "%").removeprefix(": "))

    callbacks = fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(log)
    callbacks.allocateMemory = defaultCallbacks.allocateMemory
    callbacks.freeMemory = defaultCallbacks.freeMemory
    slave.instantiate(callbacks=callbacks, loggingOn=True)
    try:
        yield
    except FMICallException as error:
        raise MechanismError(" ".join(said) or str(error)) from error
    finally:
        slave.freeInstance()  # and unloads the library


# From a model to a native FMU: no Python on the target.

#: The headers of both standards.
STANDARD = standard()

#: Where FMI 3.0 wants what has another name in FMI 2.0 (sections 2.5.1.2 and 2.5.1.5).
_PLACES3 = {
    "model.png": "terminalsAndIcons/icon.png",
    "documentation/licenses/mechanism_fmu.txt": "documentation/licenses/license.txt",
}

_FACTS = (
    "The FMU needs nothing where it runs: no Python, no library but the system's own C library. Binaries for "
    f"{', '.join(target.name for target in TARGETS)} are inside; they run with glibc 2.17 or later, on macOS from 11 "
    "on, and on Windows with the Universal CRT.",
    "A value or a call that is refused gives a message in the log and the status <em>error</em>; nothing has changed "
    "then, and the instance goes on. Messages arrive only if the host switched logging on.",
    "Any number of instances, also of different FMUs of this project, may run in one process, each in its own thread; "
    "one instance must not be called by two threads at once.",
    "Memory comes from the host's callbacks where it gives any (FMI 2.0).",
    "An input with a derivative (fmi2SetRealInputDerivatives) changes at that rate during the next step, and then "
    "keeps the value that it has reached.",
)


def build_native_fmu(
    module: ModuleType,
    destination: Path,
    fmi: int = 2,
    report: Report = silently,
    *,
    clocks: bool = False,
    baked: Baked = NOTHING_BAKED,
) -> Path:
    """Build the native FMU of a model: the same bytes from the same sources and versions of the tools.

    Args:
        module: what holds `MODEL`, e.g. `models.ratchet.model`.
        destination: folder, made if need be, for "<model name>.fmu".
        fmi: major version of the standard, 2 or 3.
        report: see `compiled_engine`.
        clocks: FMI 3.0 with a clock of impacts and arrays, for importers that use them; it runs in event mode only.
        baked: numbers that this FMU has as its own.

    Returns:
        Path of the FMU.

    Raises:
        MechanismError: there is no linker, the module has no model, or one that cannot be traced or cannot start.
        OSError: the destination cannot be written.
    """
    need_linker()
    origin = model_of(module, baked)
    model = origin.model
    path = file_in(destination, f"{model.name}.fmu")
    traced = formulas(trace(model), pack(compile_mechanism(model.build(model.values()))))
    entries = common_entries(origin, _FACTS, ("mechanism_fmu",), fmi)
    if fmi == 3:
        entries = {_PLACES3.get(name, name): contents for name, contents in entries.items()}
    engine = compiled_engine(report)
    describe = partial(model_description3, clocks=clocks) if fmi == 3 else partial(model_description, native=True)
    guid = _fingerprint(model, traced, entries | {DESCRIPTION: to_bytes(describe(model, ""))}, engine)
    entries[DESCRIPTION] = to_bytes(describe(model, f"{{{guid}}}"))
    source = model_source(model, traced, f"{{{guid}}}", guid.bytes, clocks)
    made = _binaries(model, source, engine)
    check_start(model, f"{{{guid}}}", made)
    binaries: dict[str, list[bytes]] = {}
    for target, binary in made.items():
        folder_name = target.fmi2 if fmi == 2 else target.name
        binaries.setdefault(f"binaries/{folder_name}/{model.name}{target.suffix}", []).append(binary)
    for name, libraries in binaries.items():
        entries[name] = universal(libraries) if len(libraries) > 1 else libraries[0]
    # They follow from all that the fingerprint is of; last digits may be those of this machine.
    entries |= reference_results(model, library_of(report))
    write_archive(entries, path, compressed=True)
    return record_build(path)


def _fingerprint(model: Model, traced: Formulas, entries: Mapping[str, bytes], engine: Engine) -> uuid.UUID:
    """A hash of everything that the FMU is made from: the GUID of FMI 2.0, the instantiation token of FMI 3.0."""
    parts = {
        **entries,
        "model.c": model_source(model, traced, "", bytes(16)).encode(),
        **linked_with(*SURFACE, *HEADERS),
        **{file.name: file.read_bytes() for file in sorted(STANDARD.glob("fmi[23]*.h"))},
        **{name: object_file.read_bytes() for name, object_file in engine.objects.items()},
    }
    return uuid.UUID(content_hash(parts)[:32])


def _binaries(model: Model, source: str, engine: Engine) -> dict[Target, bytes]:
    """The shared library of each platform."""
    with temporary_folder() as folder:
        (folder / "model.c").write_text(source, encoding="ascii")

        def binary(target: Target) -> bytes:
            place = folder / target.name
            place.mkdir()
            inputs = [*surface(*SURFACE), folder / "model.c", engine.objects[target.name]]
            library = place / f"{model.name}{target.suffix}"
            link(target, inputs, [engine.headers, STANDARD], library)
            return library.read_bytes()

        with ThreadPoolExecutor() as pool:
            return dict(zip(TARGETS, pool.map(binary, TARGETS), strict=True))
