"""FMU files by way of fmpy: extracted, instantiated, and always cleaned up."""

from __future__ import annotations

import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import fmpy

from ...errors import NO_ROOM, UsageError
from ..description import Description
from ..description_file import damaged, read_description
from .common import FmuSlave
from .fmi2 import Fmi2Slave
from .fmi3 import Fmi3Slave
from .integration import Integrator
from .message_log import MessageHandler, discard_message
from .model_exchange import Fmi2Model, Fmi3Model
from .workspace import require_library, temporary_folder


@dataclass(frozen=True)
class Fmu:
    """An extracted FMU.

    Attributes:
        path: the file it came from.
        description: what it says about itself.
        folder: where it is extracted.
        integrator: of instances for Model Exchange.
    """

    path: Path
    description: Description
    folder: Path
    integrator: Integrator = field(default_factory=Integrator)

    @contextmanager
    def instantiate(
        self, name: str, on_message: MessageHandler = discard_message, early_return: bool = False
    ) -> Iterator[FmuSlave]:
        """A new instance; it is freed afterwards.

        Args:
            name: of the instance.
            on_message: receives its messages.
            early_return: whether an FMU of FMI 3.0 may end steps at its events, for `FmuSlave.advance`. What it then
                reports of its last step, such as a list of impacts, is about the part of it that was taken last.

        Raises:
            UsageError: it has clocks that tick by time.
            FmuError: the library cannot be loaded, or the FMU refuses; with its messages.
        """
        for clock in self.description.variables.values():
            if clock.type == "Clock" and clock.causality == "input" and clock.interval != "triggered":
                raise UsageError(
                    f"'{self.path}' has the input clock {clock.name}, which ticks by time (intervalVariability = "
                    f"{clock.interval or 'none'}); the harness lets triggered clocks tick, and no others. Ask for an "
                    "FMU that keeps its own time, or run it in a tool for scheduled execution."
                )
        slave: FmuSlave
        if self.description.exchange:
            kind = Fmi3Model if self.description.fmi == 3 else Fmi2Model
            slave = kind(self.description, self.folder, name, on_message, self.integrator)
        elif self.description.fmi == 3:
            slave = Fmi3Slave(self.description, self.folder, name, on_message, early_return)
        else:
            slave = Fmi2Slave(self.description, self.folder, name, on_message)
        try:
            yield slave
        finally:
            slave.free()


@contextmanager
def open_fmu(path: Path, integrator: Integrator | None = None) -> Iterator[Fmu]:
    """Extract the FMU file `path` into a temporary folder; it is removed afterwards.

    For a `with`: `with open_fmu(Path("build/Ratchet.fmu")) as fmu, fmu.instantiate("ratchet") as ratchet:`.

    Args:
        path: of the FMU's file.
        integrator: for its interface for Model Exchange; None: it is used for co-simulation, if it can be.

    Raises:
        UsageError: not a file, not an FMU that can be run, made for other platforms only, or with names in it that lead
            out of the folder.
    """
    description = read_description(path, exchange=integrator is not None)
    try:
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
    except (OSError, zipfile.BadZipFile) as error:
        raise damaged(path, error) from error
    require_library(path, description, names)
    with temporary_folder() as folder:
        try:
            fmpy.extract(str(path), unzipdir=str(folder))
        except Exception as error:
            if isinstance(error, OSError) and error.errno in NO_ROOM:
                raise UsageError(
                    f"'{path}' cannot be unpacked into '{folder.parent}': {error.strerror}. Make space there, or set "
                    "the environment variable TMPDIR to another folder."
                ) from error
            raise damaged(path, error) from error
        yield Fmu(path, description, folder, integrator or Integrator())
