"""Ctrl-C and SIGTERM as polite requests."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

from .master import never

#: Ctrl-C, and what a system sends to what it ends.
_SIGNALS = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def interruption(on_request: Callable[[], None]) -> Iterator[Callable[[], bool]]:
    """Turn the first Ctrl-C or SIGTERM into a request that the run can ask for; the second one acts as usual.

    An exception would not do: inside an FMU written in Python it would end up as a failure of the FMU.

    Args:
        on_request: called at the first of them.

    Yields:
        A function that says whether there was one. Outside the main thread, where Python delivers no
        signals, it is always false.
    """
    if threading.current_thread() is not threading.main_thread():
        yield never
        return
    requested = False
    usual = {number: signal.getsignal(number) for number in _SIGNALS}

    def as_usual() -> None:
        for number, handler in usual.items():
            signal.signal(number, handler)

    def handle(_signal: int, _frame: FrameType | None) -> None:
        nonlocal requested
        requested = True
        as_usual()
        on_request()

    for number in _SIGNALS:
        signal.signal(number, handle)
    try:
        yield lambda: requested
    finally:
        as_usual()
