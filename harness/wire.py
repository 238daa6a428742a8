"""Frames between two processes: a text and some bytes, and nothing in them that could run.

A frame is two lengths (unsigned, 4 bytes, little-endian), a JSON text, and a tail of bytes. What the other side writes
is data to be judged: a frame has a largest size, one deadline for the whole of it, and what is no JSON is refused. A
pickle would run whatever its writer likes in the process that reads it.
"""

from __future__ import annotations

import json
import socket
import struct
import time
from typing import Any

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
