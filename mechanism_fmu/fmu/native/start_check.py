"""A native FMU is started once where it is built, so that a mechanism that cannot start is found there."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

from ...engine.run import library_path
from ...model import MechanismError, Model
from ..self_check import require_numbers, start_explained
from ..temporary import temporary_folder
from ..variables import variables_of
from .targets import Target


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
