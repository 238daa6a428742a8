"""Processes beside this one: how they start, and that none outlives it."""

from __future__ import annotations

import atexit
import os
import shutil
import signal
import tempfile
import threading
from contextlib import ExitStack
from functools import cache
from multiprocessing import connection, current_process, get_all_start_methods, get_context, parent_process
from multiprocessing.context import BaseContext
from pathlib import Path
from typing import Any

from mechanism_fmu.fmu.temporary import temporary_folder

#: How numpy's libraries are told how many threads to have, when they are loaded.
_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")

#: The path of a socket has 103 letters at the most, of which 49 stand behind that of the temporary folder.
_LONGEST_FOLDER = 54


def starting_from(module: str) -> BaseContext:
    """How to start processes that need a module.

    Where the system can, they are copies of one that has nothing but this module: copies of this process might hold
    half of a lock, and a start from nothing takes a second each. Threads of numpy's own would only be in each other's
    way: twice the time. In a temporary folder with a long path such copies cannot be called: each starts from nothing
    there.
    """
    for name in _THREADS:
        os.environ.setdefault(name, "1")
    copies = "forkserver" in get_all_start_methods() and len(tempfile.gettempdir()) <= _LONGEST_FOLDER
    context = get_context("forkserver" if copies else "spawn")
    _own_folder()
    if copies:
        context.set_forkserver_preload([module])
    return context


@cache
def _own_folder() -> None:
    """Let Python keep the socket of the process that is copied in a folder that others remove if this one is killed.

    Its own would stay, and nobody could say whose it was.
    """
    settings = _settings()
    if "tempdir" not in settings:
        stack = ExitStack()
        atexit.register(stack.close)
        settings["tempdir"] = str(stack.enter_context(temporary_folder()))


def _settings() -> dict[str, Any]:
    """What processes have from the one that starts them; "tempdir" is a folder for temporary files."""
    settings: dict[str, Any] = getattr(current_process(), "_config", {})
    return settings


def serve_only(folder: Path | None) -> threading.Thread:
    """To be called first in such a process: Ctrl-C is for the one that leads, and without that one nobody goes on.

    Args:
        folder: to be removed when the one that leads was killed, and cannot do so any more.

    Returns:
        What ends this process after the one that leads. Who finds that one gone must wait for it (`join`): a process
        that ends by itself leaves the folder half removed.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # What an FMU leaves here when this process is ended goes with the folder of the one that leads.
    tempfile.tempdir = _settings().get("tempdir") or tempfile.tempdir
    end = threading.Thread(target=_end_with_parent, args=(folder,), daemon=True)
    end.start()
    return end


def _end_with_parent(folder: Path | None) -> None:
    parent = parent_process()
    assert parent is not None
    connection.wait([parent.sentinel])
    if folder is not None:
        shutil.rmtree(folder, ignore_errors=True)
    os._exit(1)
