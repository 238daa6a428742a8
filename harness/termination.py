"""SIGTERM as Ctrl-C: what is on the way ends in order, and nothing temporary is left behind."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def terminable() -> Iterator[None]:
    """Turn SIGTERM, which a system sends at its end, into what Ctrl-C is: `KeyboardInterrupt`.

    Its usual action ends the process on the spot, with its temporary folders. Where somebody else handles the signal
    or has it ignored, and outside the main thread, nothing changes. Runs turn it into a request (`interrupt`).
    """
    if threading.current_thread() is not threading.main_thread() or signal.getsignal(signal.SIGTERM) != signal.SIG_DFL:
        yield
        return

    def end(_signal: int, _frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
