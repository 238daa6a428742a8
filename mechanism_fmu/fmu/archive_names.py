"""Which names of a zip archive may be unpacked: none that leads out of the folder, and none that a disk refuses."""

from __future__ import annotations

import stat
from collections.abc import Iterable
from pathlib import PurePosixPath
from zipfile import ZipInfo

#: Bytes of one part of a path, and of a whole one: what common file systems take, with room for a folder before it.
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
