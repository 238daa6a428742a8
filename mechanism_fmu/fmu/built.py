"""Which FMU files this user's builds have made: by their digests, kept in the user's cache directory.

An FMU is code. Who asks whether one may run in the own process must not ask the FMU: it says what it likes of itself.
"""

from __future__ import annotations

import hashlib
from contextlib import suppress
from pathlib import Path

from .start import private_cache

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


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
