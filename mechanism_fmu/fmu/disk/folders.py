"""Temporary folders that do not stay for good, and which names of an archive may be unpacked.

A folder is locked as long as its process lives. The system itself ends a lock with its process, however that ends; an
id of a process may by now be that of another one, or of another container's.
"""

from __future__ import annotations

import os
import re
import shutil
import stat
import sys
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path, PurePosixPath
from zipfile import ZipInfo

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


# Which names of a zip archive may be unpacked: none that leads out of the folder, and none that a disk refuses.

#: Bytes of one part of a path, and of a whole one: what common file systems take, with space for a folder before it.
_LONGEST_PART, _LONGEST_PATH = 255, 2000
_SHOWN = 60


def unsafe_name(entries: Iterable[ZipInfo]) -> str | None:
    """Why an archive must not be unpacked; None when it may be.

    To be asked before the first byte is written, wherever an FMU or SSP file of others is unpacked. An FMU has plain
    relative paths with forward slashes (FMI 2.0, section 2.3; FMI 3.0, section 2.5).

    Args:
        entries: `ZipFile.infolist()`.

    Returns:
        A sentence without its full stop that names the entry, to stand behind a colon.
    """
    files: set[str] = set()
    folders: set[str] = set()
    for entry in entries:
        name = entry.orig_filename  # `filename` ends at the first NUL
        why = _objection(name) or _kind(entry)
        if why is not None:
            return f"its entry '{_shown(name)}' {why}"
        path = PurePosixPath(name)
        folders.update(map(str, path.parents))
        if entry.is_dir():
            folders.add(str(path))
            continue
        if str(path) in files:
            return f"its entry '{_shown(name)}' is there twice"
        files.add(str(path))
    both = sorted(files & folders)
    return f"its entry '{_shown(both[0])}' is a file and a folder at once" if both else None


def _objection(name: str) -> str | None:
    """What is wrong with a name, whatever it belongs to."""
    if name.startswith("/"):
        return "has an absolute path"
    if "\\" in name or ":" in name:
        return "has a backslash or a colon in its path"
    if any(ord(letter) < 32 or ord(letter) == 127 for letter in name):
        return "has a control character in its path"
    parts = name.removesuffix("/").split("/")
    if ".." in parts:
        return "leads out of its folder"
    if "" in parts or "." in parts:
        return "has an empty part in its path"
    encoded = name.encode("utf-8", "surrogatepass")
    if (
        len(encoded) > _LONGEST_PATH
        or max(len(part.encode("utf-8", "surrogatepass")) for part in parts) > _LONGEST_PART
    ):
        return f"is too long: {_LONGEST_PART} bytes are the limit between two slashes, {_LONGEST_PATH} in all"
    return None


def _kind(entry: ZipInfo) -> str | None:
    """What is wrong with an entry that is neither a file nor a folder."""
    kind = stat.S_IFMT(entry.external_attr >> 16)
    if kind == stat.S_IFLNK:
        return "is a symbolic link"
    return None if kind in (0, stat.S_IFREG, stat.S_IFDIR) else "is neither a file nor a folder"


def _shown(name: str) -> str:
    """A name that fits a line and a terminal."""
    plain = "".join(letter if letter.isprintable() else "?" for letter in name)
    return plain if len(plain) <= _SHOWN else f"{plain[:_SHOWN]}..."
