"""Errors for the user, log messages of an FMU, packages that are missing, exhausted resources (memory, disk)."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path

# Log messages of an FMU.


class Status(IntEnum):
    """The status codes of FMI 2.0, section 2.1.3."""

    OK = 0
    WARNING = 1
    DISCARD = 2
    ERROR = 3
    FATAL = 4
    PENDING = 5

    @classmethod
    def _missing_(cls, value: object) -> Status:
        """A number that is no status of FMI is an error."""
        return cls.ERROR


@dataclass(frozen=True)
class LogMessage:
    """One message of an FMU.

    Attributes:
        instance: name of the FMU instance.
        time: last communication point before the message [s].
        status: how bad it is.
        category: the FMU's own, one of the LogCategories of its modelDescription.xml; "" when it gave none.
        text: what it says.
    """

    instance: str
    time: float
    status: Status
    category: str
    text: str

    @property
    def needs_attention(self) -> bool:
        """Whether the user should see it."""
        return self.status in (Status.WARNING, Status.DISCARD, Status.ERROR, Status.FATAL)


class HarnessError(Exception):
    """Something the user can put right; the message says what is wrong and what to do."""


class UsageError(HarnessError):
    """A name, value, unit or file that cannot be used: nothing has been simulated yet."""


class FmuError(HarnessError):
    """The FMU refused or failed.

    Attributes:
        instance: name of the FMU instance.
        time: communication point at which it happened [s]; None before the initialization.
        status: what the FMU answered.
        messages: what the FMU itself said while it did so.
    """

    def __init__(
        self,
        text: str,
        *,
        instance: str = "",
        time: float | None = None,
        status: Status = Status.ERROR,
        messages: Sequence[LogMessage] = (),
    ) -> None:
        super().__init__(text)
        self.instance = instance
        self.time = time
        self.status = status
        self.messages = tuple(messages)


# Packages that only some commands need.

#: The extra that brings each, by the name that is imported.
EXTRAS = {
    "scipy": "analysis",
    "pyarrow": "designs",
    "PIL": "designs",
    "plotly": "plot",
    "distributed": "cluster",
    "optuna": "optimise",
    "libcosimpy": "importers",
    "numba": "dev",
}


def way_to_get(extra: str) -> str:
    """The command that installs an extra: in a clone from it, as there is no package on an index."""
    clone = (Path(__file__).parents[1] / "pyproject.toml").is_file()
    return f'python -m pip install -e ".[{extra}]"' if clone else f'python -m pip install "mechanism_fmu[{extra}]"'


# What a machine runs out of at any place: memory, and space where something is printed.

#: What systems call a full disk, a file that may not become longer, and a full share of a disk.
NO_ROOM = frozenset(getattr(errno, name) for name in ("ENOSPC", "EFBIG", "EDQUOT") if hasattr(errno, name))
#: How the system says in the loading of a library that it has no memory for it.
_NOT_LOADED = ("failed to map segment", "cannot allocate memory")
_FAILED, _WRONG_USE = 1, 2


@contextmanager
def exhaustion_reported() -> Iterator[None]:
    """Say in a line that memory or a disk is full, or a package of an extra is missing, and end with an exit code.

    Nothing for it is imported. Files that are written say so themselves (`results`).

    Raises:
        SystemExit: it is.
    """
    try:
        try:
            yield
        finally:
            _print_the_rest()
    except MemoryError:
        _end("The memory is full.")
    except ImportError as error:
        if _has_no_memory(error):
            _end(f"The memory is full: {error}.")
        package = (error.name or "").partition(".")[0]
        if not isinstance(error, ModuleNotFoundError) or package not in EXTRAS:
            raise
        print(
            f"Error: This needs the package {package.replace('PIL', 'pillow')}, which is not installed. Install it: "
            f"{way_to_get(EXTRAS[package])}",
            file=sys.stderr,
        )
        raise SystemExit(_WRONG_USE) from None
    except OSError as error:
        if error.errno == errno.ENOMEM or _has_no_memory(error):
            _end(f"The memory is full: {error}.")
        if error.errno in NO_ROOM:
            _end(f"There is no space for what is printed or written: {error}.")
        raise


def _print_the_rest() -> None:
    """What waits in the buffer is printed now: where it cannot be, that is known before the exit code is."""
    try:
        if sys.stdout is not None:
            sys.stdout.flush()
    except OSError as error:
        if error.errno in NO_ROOM:
            with suppress(OSError):  # else the interpreter tries again at its end, with an exit code of its own
                os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            raise


def _has_no_memory(error: BaseException | None) -> bool:
    """Whether an error, or one in whose handling it was raised, says that a library found no memory."""
    while error is not None:
        if any(words in str(error).lower() for words in _NOT_LOADED):
            return True
        error = error.__context__
    return False


def _end(reason: str) -> None:
    with suppress(OSError):
        print(f"Error: {reason} What was recorded before is kept.", file=sys.stderr)
    raise SystemExit(_FAILED) from None
