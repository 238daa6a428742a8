"""Names in a zip archive, judged before anything of it is unpacked: none may lead out of its folder."""

from __future__ import annotations

import stat
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

#: Longest name of an entry, and of one part of its path: what common file systems take.
_LONGEST, _LONGEST_PART = 1000, 255


class UnsafeNameError(ValueError):
    """An archive has an entry that must not be unpacked; the message says which, and why."""


@contextmanager
def checked_archive(path: Path) -> Iterator[zipfile.ZipFile]:
    """A zip archive whose names have been checked (`check_names`).

    Raises:
        UnsafeNameError: one must not be unpacked.
        OSError, zipfile.BadZipFile: it cannot be read.
    """
    with zipfile.ZipFile(path) as archive:
        check_names(archive)
        yield archive


def check_names(archive: zipfile.ZipFile) -> None:
    """Refuse an archive with an entry that would be written outside the folder, or be more than a file or folder.

    Raises:
        UnsafeNameError: there is one.
    """
    for entry in archive.infolist():
        # zipfile has replaced the system's own separator, and cut the name at a zero: what the archive says counts.
        for name in (entry.filename, entry.orig_filename):
            if objection := _objection(name):
                shown = name if len(name) <= 80 else f"{name[:80]}..."
                raise UnsafeNameError(f"its entry {shown!r} {objection}; nothing of it was unpacked")
        mode = entry.external_attr >> 16
        if entry.create_system == 3 and stat.S_IFMT(mode) not in (0, stat.S_IFREG, stat.S_IFDIR):
            raise UnsafeNameError(
                f"its entry {entry.filename!r} is a link or a device, not a file; nothing of it was unpacked"
            )


def _objection(name: str) -> str:
    parts = name.split("/")
    if "\\" in name:
        return "has a backslash in its name, where a zip archive has / only"
    if "\0" in name:
        return "has a zero byte in its name"
    if ":" in name:
        return "has a colon in its name, as drives and devices have"
    if name.startswith("/"):
        return "has an absolute path"
    if ".." in parts:
        return "leads out of the folder (..)"
    if len(name) > _LONGEST or max(map(_bytes, parts)) > _LONGEST_PART:
        return f"has too long a name (limits: {_LONGEST} letters, {_LONGEST_PART} bytes between two /)"
    return ""


def _bytes(part: str) -> int:
    return len(part.encode("utf-8", "surrogatepass"))
