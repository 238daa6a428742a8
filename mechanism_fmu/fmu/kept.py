"""Files that are made once and kept in the user's cache directory: each has its digest beside it.

What is loaded into a process later may have been cut off by a full disk, emptied by a crash, or replaced. It is used
only if it fits its digest, and made anew otherwise.
"""

from __future__ import annotations

import hashlib
import os
import tempfile
from pathlib import Path


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
        told = _beside(path).read_text(encoding="ascii").strip()
        return hashlib.sha256(path.read_bytes()).hexdigest() == told
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
