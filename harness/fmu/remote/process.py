"""The process of a component: its start and its end."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .. import Fmu
from ..description import Description
from ..instances.fmi3 import uses_event_mode
from ..instances.message_log import MessageHandler, discard_message
from ..processes import Wire, starting_from
from . import far_side
from .far_side import Opener
from .link import Link
from .near_side import RemoteComponent

#: How long a call may take [s].
TIME_LIMIT = 60.0


@contextmanager
def in_own_process(
    fmu: Fmu,
    name: str,
    on_message: MessageHandler = discard_message,
    time_limit: float = TIME_LIMIT,
    early_return: bool = False,
) -> Iterator[RemoteComponent]:
    """A new instance of an FMU in a new process; both are ended afterwards.

    Args:
        fmu: extracted; both processes read its folder.
        name: of the part.
        on_message: receives its messages.
        time_limit: of a call [s].
        early_return: as in `Fmu.instantiate`.

    Raises:
        FmuError: the library cannot be loaded, the FMU refuses, or the process ends.
    """
    opener = _FmuOpener(fmu, name, early_return)
    by_event = uses_event_mode(fmu.description, early_return)
    with remote(name, opener, on_message, time_limit, fmu.folder, by_event) as component:
        yield component


@dataclass(frozen=True)
class RemoteFmu:
    """An extracted FMU whose instances have a process of their own each (`slave.Instances`).

    Attributes:
        fmu: it.
        time_limit: of a call [s].
    """

    fmu: Fmu
    time_limit: float = TIME_LIMIT

    @property
    def path(self) -> Path:
        """The file it came from."""
        return self.fmu.path

    @property
    def description(self) -> Description:
        """What it says about itself."""
        return self.fmu.description

    @property
    def folder(self) -> Path:
        """Where it is extracted."""
        return self.fmu.folder

    def instantiate(
        self, name: str, on_message: MessageHandler = discard_message
    ) -> AbstractContextManager[RemoteComponent]:
        """A new instance in a new process; both are ended afterwards.

        Args:
            name: of the instance.
            on_message: called with each message of the FMU.
        """
        return in_own_process(self.fmu, name, on_message, self.time_limit)


@dataclass(frozen=True)
class _FmuOpener:
    """How the other process makes an instance of an FMU that this one has extracted."""

    fmu: Fmu
    name: str
    early_return: bool

    @property
    def description(self) -> Description:
        return self.fmu.description

    def __call__(self, on_message: MessageHandler) -> Any:
        return self.fmu.instantiate(self.name, on_message, self.early_return)


@contextmanager
def remote(
    name: str,
    opener: Opener,
    on_message: MessageHandler = discard_message,
    time_limit: float = TIME_LIMIT,
    folder: Path | None = None,
    has_event_mode: bool = False,
) -> Iterator[RemoteComponent]:
    """A component in a new process, which ends afterwards.

    Args:
        name: of the part.
        opener: makes the component there; must be such that it can be pickled, for the way there.
        on_message: receives its messages, with the reply to the call during which they came.
        time_limit: of a call [s]; ten times as much for the start and the initialization.
        folder: that the component lives in; the process removes it when this one is killed.
        has_event_mode: whether the component uses its event mode.

    Raises:
        FmuError: the component cannot be made, or the process ends.
    """
    context = starting_from(far_side.__name__)
    here, there = socket.socketpair()
    process = context.Process(target=far_side.serve, args=(there, name, opener, folder), name=name, daemon=True)  # type: ignore[attr-defined]
    try:
        process.start()
        there.close()  # so that the end of the process is the end of the connection
        link = Link(name, process, Wire(here), on_message)
        component = RemoteComponent(link, opener.description, time_limit, has_event_mode)
        try:
            yield component
        finally:
            link.end()
    finally:
        if process.is_alive():
            process.kill()
            process.join()
        here.close()
