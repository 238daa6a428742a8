"""What the pythonfmu wrapper (0.7.0) leaves to the slave: surviving an exception.

When a slave's method raises, the wrapper reports fmi2Fatal and releases its references to the slave's class, instance
and log queue, and goes on using them: the next call, or freeing the instance, would crash the host. Giving it one
reference more for each that it will release keeps the instance usable, so that the host can read, reset and free it.
"""

from __future__ import annotations

import ctypes
import functools
import sys
from collections.abc import Callable
from typing import Any, TypeVar

_Method = TypeVar("_Method", bound=Callable[..., Any])


def survive_release(*objects: object) -> None:
    """Add a reference to each object, which the wrapper is about to release once too often."""
    for one in objects:
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(one))


def fmi_call(method: _Method) -> _Method:
    """Decorate a slave's method that the wrapper calls: any exception is logged, and survived."""

    @functools.wraps(method)
    def guarded(slave: Any, *args: Any) -> Any:
        try:
            return method(slave, *args)
        except Exception as error:
            slave.report(error)
            survive_release(type(slave), slave, slave.log_queue)
            raise

    return guarded  # type: ignore[return-value]


#: References to a text while `Told.release` looks at it: the list's, the variable's, the argument's.
_HELD_HERE = 3


class Told:
    """The texts that the wrapper has passed on to the host's log.

    The wrapper (pythonfmu 0.7.0) takes a reference to the text of each message and never releases it, so that a long
    run with many impacts would grow without end.
    """

    def __init__(self) -> None:
        self._texts: list[str] = []

    def add(self, text: str) -> None:
        """Remember a text that has been put into the wrapper's queue."""
        self._texts.append(text)

    def release(self) -> None:
        """Release the wrapper's references; the queue must be empty, which it is when the wrapper has read it."""
        for text in self._texts:
            if sys.getrefcount(text) > _HELD_HERE:
                ctypes.pythonapi.Py_DecRef(ctypes.py_object(text))
        self._texts.clear()
