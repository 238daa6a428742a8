"""Worker processes: start and end, none outlives its parent, and the frames (messages) between them."""

from __future__ import annotations

import atexit
import json
import os
import shutil
import signal
import socket
import struct
import tempfile
import threading
import time
from contextlib import ExitStack
from functools import cache
from multiprocessing import connection, current_process, get_all_start_methods, get_context, parent_process
from multiprocessing.context import BaseContext
from pathlib import Path
from typing import Any

from mechanism_fmu.fmu.disk.folders import temporary_folder

#: Environment variables that give numpy's libraries their number of threads when they are loaded.
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


# Frames between two processes: a text and some bytes, and nothing in them that could run.
#
# A frame is two lengths (unsigned, 4 bytes, little-endian), a JSON text, and a tail of bytes. What the other side
# writes is data to be judged: a frame has a largest size, one deadline for the whole of it, and what is no JSON is
# refused. A pickle would run whatever its writer likes in the process that reads it.

#: Most bytes of a frame, text and tail together.
MOST_BYTES = 64 * 2**20

_LENGTHS = struct.Struct("<II")
_ROOM = 2**16
_encoder = json.JSONEncoder(separators=(",", ":"), check_circular=False)
_decode = json.JSONDecoder().raw_decode


def _made_once() -> Any:
    """What `_encoder.encode` makes anew for each text, which takes as long as the text itself."""
    make = getattr(json.encoder, "c_make_encoder", None)
    if make is None:  # not CPython
        return lambda data, _level: _encoder.iterencode(data)
    return make(None, _encoder.default, json.encoder.encode_basestring_ascii, None, ":", ",", False, False, True)


_chunks = _made_once()


class BrokenFrameError(Exception):
    """What has come is no frame, or not one that was to come; the message says what is wrong with it."""


class LateFrameError(Exception):
    """The deadline has passed before the whole frame was there."""


class Wire:
    """One end of a connection.

    Attributes:
        pending: whether something of a further frame has come along with the last one.
    """

    def __init__(self, end: socket.socket, *, turns: bool = True) -> None:
        """`turns`: whether the two sides take turns, so that a second frame behind one that has come is wrong."""
        self._end = end
        self._turns = turns
        self._left = b""
        self._limit: float | None = -1.0  # of the socket
        self._room = memoryview(bytearray(_ROOM))

    def send(self, data: Any, tail: bytes = b"", limit: float | None = None) -> None:
        """Send lists, texts, numbers, truth values and None, and a tail.

        Args:
            data: what JSON can say.
            tail: bytes behind it.
            limit: how long the other side may take to fetch them [s]; None: for ever.

        Raises:
            LateFrameError: it has not done so.
            BrokenFrameError: they are too many.
            OSError: nobody is there.
        """
        text = "".join(_chunks(data, 0)).encode("ascii")
        if len(text) + len(tail) > MOST_BYTES:
            raise BrokenFrameError(f"{len(text) + len(tail)} bytes at once, more than {MOST_BYTES}")
        self._wait_for(limit)
        try:
            self._end.sendall(b"".join((_LENGTHS.pack(len(text), len(tail)), text, tail)))
        except TimeoutError:
            raise LateFrameError from None

    def receive(self, limit: float | None = None) -> tuple[Any, bytes]:
        """Wait for a frame, up to `limit` [s] for the whole of it; its data and its tail.

        Raises:
            LateFrameError: it was not there in time.
            BrokenFrameError: it is too large, or none.
            EOFError: the other side has closed the connection.
            OSError: likewise.
        """
        self._wait_for(limit)
        began = time.monotonic()
        left, self._left = self._left, b""
        frame = memoryview(left) if left else self._some()
        if len(frame) < _LENGTHS.size or len(frame) != _LENGTHS.size + sum(_LENGTHS.unpack_from(frame)):
            frame = self._rest(bytearray(frame), None if limit is None else began + limit)
        length, _ = _LENGTHS.unpack_from(frame)
        tail = _LENGTHS.size + length
        try:
            text = str(frame[_LENGTHS.size : tail], "ascii")
            data, end = _decode(text)
        except (ValueError, RecursionError) as error:
            raise BrokenFrameError(f"its text is no JSON ({error})") from None
        if end != length:
            raise BrokenFrameError("its text goes on behind the JSON")
        return data, bytes(frame[tail:])

    @property
    def pending(self) -> bool:
        """See the class."""
        return bool(self._left)

    def fileno(self) -> int:
        """Of the socket, for those who wait for several."""
        return self._end.fileno()

    def close(self) -> None:
        """Let go of this end."""
        self._end.close()

    def _rest(self, have: bytearray, deadline: float | None) -> memoryview:
        """All bytes of a frame that has begun. Memory is taken for what has come, not for what is announced."""
        while len(have) < _LENGTHS.size:
            have += self._more(deadline)
        size = _LENGTHS.size + sum(_LENGTHS.unpack_from(have))
        if size - _LENGTHS.size > MOST_BYTES:
            raise BrokenFrameError(f"it announces {size - _LENGTHS.size} bytes, more than {MOST_BYTES}")
        while len(have) < size:
            have += self._more(deadline)
        if len(have) > size and self._turns:
            raise BrokenFrameError("there is more behind it than was asked for")
        self._left = bytes(have[size:])
        return memoryview(have)[:size]

    def _more(self, deadline: float | None) -> memoryview:
        if deadline is not None:
            left = deadline - time.monotonic()
            if left <= 0.0:
                raise LateFrameError
            self._wait_for(left)
        return self._some()

    def _some(self) -> memoryview:
        try:
            count = self._end.recv_into(self._room)
        except TimeoutError:
            raise LateFrameError from None
        if not count:
            raise EOFError
        return self._room[:count]

    def _wait_for(self, limit: float | None) -> None:
        if limit != self._limit:
            self._end.settimeout(limit)
            self._limit = limit
