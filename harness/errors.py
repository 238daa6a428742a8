"""What can go wrong, in words for the user."""

from __future__ import annotations

from collections.abc import Sequence

from .messages import LogMessage, Status


class HarnessError(Exception):
    """Something the user can put right; the message says what is wrong and what to do."""


class UsageError(HarnessError):
    """A name, value, unit or file that cannot be used: nothing has been simulated yet."""


class FmuError(HarnessError):
    """The FMU refused or failed.

    Attributes:
        instance: name of the FMU instance.
        time: communication point at which it happened [s]; None before the initialization.
        status: what the FMU answered.
        messages: what the FMU itself said while it did so.
    """

    def __init__(
        self,
        text: str,
        *,
        instance: str = "",
        time: float | None = None,
        status: Status = Status.ERROR,
        messages: Sequence[LogMessage] = (),
    ) -> None:
        super().__init__(text)
        self.instance = instance
        self.time = time
        self.status = status
        self.messages = tuple(messages)
