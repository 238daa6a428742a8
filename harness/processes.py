"""Processes beside this one: how they start, and that none outlives it."""

from __future__ import annotations

import os
import shutil
import signal
import tempfile
import threading
from multiprocessing import connection, get_all_start_methods, get_context, parent_process
from multiprocessing.context import BaseContext
from pathlib import Path

#: How numpy's libraries are told how many threads to have, when they are loaded.
_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")

#: The path of a socket has some 100 letters at the most, of which Python takes 36 behind that of the temporary folder.
_LONGEST_FOLDER = 60


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
    if copies:
        context.set_forkserver_preload([module])
    return context


def serve_only(folder: Path | None) -> threading.Thread:
    """To be called first in such a process: Ctrl-C is for the one that leads, and without that one nobody goes on.

    Args:
        folder: to be removed when the one that leads was killed, and cannot do so any more.

    Returns:
        What ends this process after the one that leads. Who finds that one gone must wait for it (`join`): a process
        that ends by itself leaves the folder half removed.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
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
