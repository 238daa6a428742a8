"""Machine code that numba keeps in files: each has its digest beside it, and one that does not fit is compiled again.

Numba would unpickle whatever it finds: what a full disk has cut off stops it, and what was changed runs.
"""

from __future__ import annotations

import hashlib
from contextlib import suppress
from pathlib import Path
from typing import Any

from numba.core.caching import IndexDataCacheFile


class CheckedFiles(IndexDataCacheFile):
    """Numba's index and data files of one function, read only as they were written."""

    def _load_index(self) -> Any:
        return super()._load_index() if _fits(self._index_path) else {}

    def _save_index(self, overloads: Any) -> None:
        super()._save_index(overloads)
        _sign(self._index_path)

    def _load_data(self, name: str) -> Any:
        path = self._data_path(name)
        if not _fits(path):
            raise OSError(f"{path} is not as it was written")  # numba then compiles
        return super()._load_data(name)

    def _save_data(self, name: str, data: Any) -> None:
        super()._save_data(name, data)
        _sign(self._data_path(name))


def check_files(function: Any) -> None:
    """Let a function that numba has been told to keep be read by `CheckedFiles`."""
    function._cache._cache_file.__class__ = CheckedFiles


def _digest(path: str) -> str:
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def _sign(path: str) -> None:
    Path(f"{path}.sha256").write_text(_digest(path), encoding="ascii")


def _fits(path: str) -> bool:
    with suppress(OSError, ValueError):
        return Path(f"{path}.sha256").read_text(encoding="ascii") == _digest(path)
    return False
