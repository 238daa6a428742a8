"""The user's cache directory: files made once, by one process at a time, and which FMUs were built here."""

from __future__ import annotations

import hashlib
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

from ..start import private_cache

# Files that are made once and kept in the user's cache directory: each has its digest beside it.
#
# What is loaded into a process later may have been cut off by a full disk, emptied by a crash, or replaced. It is used
# only if it fits its digest, and made anew otherwise.


def keep(path: Path, contents: bytes, *, program: bool = False) -> None:
    """Write a file and its digest, each by one rename; the digest comes first, so that none fits by chance.

    Args:
        path: of the file.
        contents: of it.
        program: whether it may be executed.
    """
    _write(_beside(path), f"{hashlib.sha256(contents).hexdigest()}\n".encode(), 0o644)
    _write(path, contents, 0o755 if program else 0o644)


def is_whole(path: Path) -> bool:
    """Whether a file is as it was kept."""
    try:
        digest = _beside(path).read_text(encoding="ascii").strip()
        return hashlib.sha256(path.read_bytes()).hexdigest() == digest
    except (OSError, ValueError):
        return False


def _beside(path: Path) -> Path:
    return path.with_name(f"{path.name}.sha256")


def _write(path: Path, contents: bytes, mode: int) -> None:
    handle, temporary = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(contents)
        os.chmod(temporary, mode)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


# One process at a time: what is compiled into the user's cache takes minutes, and need not be compiled twice.

_PAUSE = 0.2


@contextmanager
def alone(folder: Path, on_wait: Callable[[], None]) -> Iterator[None]:
    """Be the only one, of all threads and processes, that works in a folder; others wait here until it is done.

    The system's own lock of a file, which ends with its process however that ends. Where the file system has no locks,
    all work at once, as they may: whatever they write appears by one rename.

    Args:
        folder: must exist; the file `.lock` in it stays.
        on_wait: called once if somebody else is at work.
    """
    with open(folder / ".lock", "ab") as file:
        if not _taken(file):
            on_wait()
            while not _taken(file):
                time.sleep(_PAUSE)
        yield


if sys.platform == "win32":
    import msvcrt

    def _taken(file: IO[bytes]) -> bool:
        """Whether the lock is ours now."""
        try:
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        except PermissionError:
            return False
        except OSError:
            return True  # no locks here
        return True

else:
    import fcntl

    def _taken(file: IO[bytes]) -> bool:
        """Whether the lock is ours now."""
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        except OSError:
            return True  # no locks here
        return True


# Which FMU files this user's builds have made: by their digests, kept in the user's cache directory.
#
# An FMU is code. Who asks whether one may run in the own process must not ask the FMU: it says what it likes of itself.

_FOLDER = "built"


def record_build(path: Path) -> Path:
    """Remember an FMU file that has just been built; without a cache, it counts as somebody else's. Returns `path`."""
    with suppress(OSError):
        folder = private_cache() / _FOLDER
        folder.mkdir(exist_ok=True)
        (folder / _digest(path)).touch()
    return path


def was_built_here(path: Path) -> bool:
    """Whether a file has the very bytes that a build of this user has made."""
    try:
        return (private_cache() / _FOLDER / _digest(path)).is_file()
    except OSError:
        return False


def record_source(path: Path, source: str) -> None:
    """Remember what an FMU file that `record_build` knows was built from.

    Args:
        path: of the FMU.
        source: name of a ready-made model or file of the user's own and, in a second line, a digest of its sources.
    """
    with suppress(OSError):
        _write(private_cache() / _FOLDER / _digest(path), source.encode(), 0o644)


def source_of(path: Path) -> str:
    """What `record_source` was given; "" where nothing is known, as of a file of somebody else."""
    try:
        return (private_cache() / _FOLDER / _digest(path)).read_text(encoding="utf-8")
    except (OSError, ValueError):
        return ""


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
