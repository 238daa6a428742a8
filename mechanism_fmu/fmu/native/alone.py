"""One process at a time: what is compiled into the user's cache takes minutes, and need not be compiled twice."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

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
