"""Log messages of a pythonfmu slave (0.7.0): plain texts, exceptions, and the references that the wrapper forgets."""

from __future__ import annotations

import ctypes
import sys
from typing import Any

from pythonfmu import Fmi2Slave
from pythonfmu.enums import Fmi2Status

from ...model import MechanismError
from ...simulation import SimulationError
from .protocol import FmiError
from .saved_state import SavedStateError

#: References to a text while `PassedTexts.release` looks at it: the list's, the variable's, the argument's.
_HELD_HERE = 3


class PassedTexts:
    """Log messages that the wrapper has passed on to the host.

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


class LoggingSlave(Fmi2Slave):
    """A slave that logs plain texts, and exceptions as their readers need them."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._passed = PassedTexts()

    def log(self, msg: str, status: Fmi2Status = Fmi2Status.ok, category: str | None = None, debug: Any = None) -> None:
        """Log a plain text: the FMI logger takes it for a printf format, in which % must be doubled."""
        if not self.log_queue:
            self._passed.release()
        # A string of its own, which nobody else holds: the wrapper's reference to it will be released.
        text = "".join((msg.replace("%", "%%"), " "))[:-1]
        super().log(text, status, category)
        self._passed.add(text)

    def report(self, error: Exception) -> None:
        """Log an exception: as it is when it was meant for the user, with its type and place when it was not."""
        if isinstance(error, (FmiError, MechanismError, SimulationError, SavedStateError)):
            self.log(f"{self.instance_name}: {error}", Fmi2Status.error)
            return
        trace = error.__traceback__
        while trace is not None and trace.tb_next is not None:
            trace = trace.tb_next
        place = "" if trace is None else f" at {trace.tb_frame.f_code.co_filename}:{trace.tb_lineno}"
        self.log(
            f"{self.instance_name}: internal error {type(error).__name__}: {error}{place}; please report it.",
            Fmi2Status.error,
        )
