"""Ctrl-C as a polite request."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

from .master import never


@contextmanager
def interruption(on_request: Callable[[], None]) -> Iterator[Callable[[], bool]]:
    """Turn the first Ctrl-C into a request that the run can ask for; the second one acts as usual.

    An exception would not do: inside an FMU written in Python it would end up as a failure of the FMU.

    Args:
        on_request: called at the first Ctrl-C.

    Yields:
        A function that tells whether Ctrl-C was pressed. Outside the main thread, where Python delivers no
        signals, it is always false.
    """
    if threading.current_thread() is not threading.main_thread():
        yield never
        return
    requested = False
    usual = signal.getsignal(signal.SIGINT)

    def handle(_signal: int, _frame: FrameType | None) -> None:
        nonlocal requested
        requested = True
        signal.signal(signal.SIGINT, usual)
        on_request()

    signal.signal(signal.SIGINT, handle)
    try:
        yield lambda: requested
    finally:
        signal.signal(signal.SIGINT, usual)
