"""Temporary folders that do not stay for good: a killed process cannot remove its own, but the next one does.

A folder is locked as long as its process lives. The system itself ends a lock with its process, however that ends; an
id of a process may by now be that of another one, or of another container's.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

#: The process that made it, for whoever wonders, and what no other has. Folders that are called otherwise were made by
#: others, or by an earlier version, which locked nothing.
_NAME = re.compile(r"mechanism-fmu-\d+-\w+")


@contextmanager
def temporary_folder(place: Path | None = None) -> Iterator[Path]:
    """A new empty folder; it is removed afterwards, and those of processes that are no more are removed before.

    Args:
        place: folder for it; None: where the system wants temporary files.

    Raises:
        OSError: it cannot be made.
    """
    place = Path(tempfile.gettempdir()) if place is None else place
    remove_abandoned(place)
    folder, lock = _made(place)
    try:
        yield folder
    finally:
        # On Windows a library stays locked until the process ends; a leftover there is not worth a failure.
        shutil.rmtree(folder, ignore_errors=True)
        if lock is not None:
            os.close(lock)


def remove_abandoned(place: Path) -> None:
    """Remove the temporary folders of this user's processes that are no more; none where folders cannot be locked."""
    with suppress(OSError), os.scandir(place) as entries:
        for path in [entry.path for entry in entries if _NAME.fullmatch(entry.name)]:
            with suppress(BlockingIOError):
                lock = _lock(path)
                if lock is not None:
                    shutil.rmtree(path, ignore_errors=True)
                    os.close(lock)


def _made(place: Path) -> tuple[Path, int | None]:
    """A new folder and its lock, None where there are no locks."""
    while True:
        folder = Path(tempfile.mkdtemp(prefix=f"mechanism-fmu-{os.getpid()}-", dir=place))
        with suppress(BlockingIOError):  # somebody takes it for abandoned, because it was not locked at once
            lock = _lock(str(folder))
            if folder.exists():
                return folder, lock
            if lock is not None:
                os.close(lock)


if sys.platform == "win32":

    def _lock(_folder: str) -> int | None:
        """A lock of a folder: there is none."""
        return None

else:
    import fcntl

    def _lock(folder: str) -> int | None:
        """The lock of a folder of this user; None where there are no locks, and where it is somebody else's.

        Raises:
            BlockingIOError: somebody has it.
        """
        try:
            handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
        except OSError:
            return None
        try:
            if os.fstat(handle).st_uid == os.geteuid():
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
                return handle
        except BlockingIOError:
            os.close(handle)
            raise
        except OSError:
            pass
        os.close(handle)
        return None
