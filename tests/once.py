"""What all processes of a test run need is done by one of them."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from mechanism_fmu.fmu.disk.user_cache import alone


def once(folders: pytest.TempPathFactory, name: str, work: Callable[[Path], object]) -> Path:
    """A folder in which some work has been done: now, or by another process of this run, which is waited for.

    Args:
        folders: of this process.
        name: of the folder; no two works share one.
        work: is given the folder. When it fails, the next to ask tries again.
    """
    base = folders.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "once" / name
    folder.mkdir(parents=True, exist_ok=True)
    with alone(folder, lambda: None):
        if not (folder / "done").exists():
            work(folder)
            (folder / "done").touch()
    return folder
