"""Groups of commands whose --help comes at once, and which end in order when the system asks them to."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from typer.core import TyperGroup

from ..errors import exhaustion_reported
from .output import as_wanted, in_front

# SIGTERM as Ctrl-C: what is on the way ends in order, and nothing temporary is left behind.


@contextmanager
def terminable() -> Iterator[None]:
    """Turn SIGTERM, which a system sends at its end, into what Ctrl-C is: `KeyboardInterrupt`.

    Its usual action ends the process on the spot, with its temporary folders. Where somebody else handles the signal
    or has it ignored, and outside the main thread, nothing changes. Runs turn it into a request
    (`execution.interruption`).
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


class Group(TyperGroup):
    """Commands whose --help comes at once.

    When a command is named, the group's own --help was not given; typer imports pydantic (0.2 s) to find that None is
    no Boolean, and does not when it is one.
    """

    def main(self, *arguments: Any, **options: Any) -> Any:
        """Run the command; SIGTERM ends it as Ctrl-C does, and what is full is reported in a line."""
        given = options.pop("args", None) if not arguments else arguments[0]
        words = [*(sys.argv[1:] if given is None else given)]
        with terminable(), exhaustion_reported(), as_wanted(words):
            return super().main(in_front(words), *arguments[1:], **options)

    def get_help_option(self, ctx: Any) -> Any:
        """The option --help, False unless it is given."""
        option = super().get_help_option(ctx)
        for flag in (option, *self.params):  # and those of completion, which typer adds
            if flag is not None and getattr(flag, "is_flag", False) and flag.default is None:
                flag.default = False
        return option
