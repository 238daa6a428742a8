"""Log messages of an FMU's instance: kept within limits, shown as they come, and the reason of a refusal in them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace

from ...errors import LogMessage, Status

#: Receives every message of an FMU at once.
MessageHandler = Callable[[LogMessage], None]

#: What pythonfmu adds to the FMU's own message when it turns a Python exception into the status Fatal.
_WRAPPER_SAYS = "Fatal py exception encountered"
#: Of messages that report no problem no more are kept: some FMUs log every call.
_MOST_CHATTER = 1000
#: Nor more of each status that reports one; what comes behind them is counted.
_MOST_COMPLAINTS = 1000
#: So many of them are the reason of a refusal.
_MOST_REASONS = 20
#: No more letters of a message are kept.
_LONGEST_TEXT = 5000


def discard_message(_message: LogMessage) -> None:
    """Leave a message to those who read `FmuSlave.messages`."""


class MessageLog:
    """The messages of one instance.

    Attributes:
        messages: those that are kept, in their order.
    """

    def __init__(self, instance: str, on_message: MessageHandler) -> None:
        """An empty log of the instance of this name, that shows messages by `on_message`."""
        self.messages: list[LogMessage] = []
        self._instance = instance
        self._on_message = on_message
        self._held_since: int | None = None
        self._chatter = 0
        self._complaints: Counter[int] = Counter()
        self._left_out = 0

    def add(self, time: float, status: int, category: bytes | None, raw: bytes | None, escaped: str) -> None:
        """Keep and show a message, unless there have been too many.

        Args:
            time: of the instance [s].
            status: of FMI.
            category: of FMI.
            raw: the text.
            escaped: what is doubled in the text.
        """
        if status not in (Status.OK, Status.PENDING):
            if self._complaints[Status(status)] >= _MOST_COMPLAINTS:
                self._left_out += 1
                return
            self._complaints[Status(status)] += 1
        name = (category or b"")[:_LONGEST_TEXT].decode("utf-8", errors="replace")
        text = _shortened(raw or b"").replace(2 * escaped, escaped)
        message = LogMessage(instance=self._instance, time=time, status=Status(status), category=name, text=text)
        if not message.needs_attention:
            self._chatter += 1
            if self._chatter == _MOST_CHATTER:
                message = replace(message, text=f"{text} (More messages of this kind are not kept.)")
            elif self._chatter > _MOST_CHATTER:
                return
        self.messages.append(message)
        if self._held_since is None:
            self._on_message(message)

    def report_left_out(self, time: float) -> None:
        """Add how many messages were not kept since this was last said."""
        count, self._left_out = self._left_out, 0
        if count:
            kept = f"the first {_MOST_COMPLAINTS} of a kind are kept"
            text = f"{count} more messages of this instance were left out; {kept}."
            message = LogMessage(self._instance, time, Status.WARNING, "", text)
            self.messages.append(message)
            self._on_message(message)

    def hold(self) -> None:
        """Keep messages from now on without showing them."""
        self._held_since = len(self.messages)

    def show_held(self) -> None:
        """Show what has been held, and what comes from now on."""
        since = self._held_since
        self.end_hold()
        for message in self.messages[since:]:
            self._on_message(message)

    def end_hold(self) -> None:
        """Show messages from now on, but none that has been held."""
        self._held_since = None

    def forget_held(self, said: int) -> None:
        """Forget messages from number `said` on, if they are held."""
        if self._held_since is not None:
            del self.messages[said:]

    def quietly(self, call: Callable[[], int]) -> int:
        """Call a function of the FMU; what it says is kept, but not shown."""
        on_message, self._on_message = self._on_message, discard_message
        try:
            return call()
        finally:
            self._on_message = on_message


def reason_in(messages: Sequence[LogMessage]) -> str:
    """What messages give as the reason of a refusal: the worst first where there are many."""
    worst_first = sorted((m for m in messages if m.needs_attention), key=lambda m: -m.status)
    ordered = worst_first if len(worst_first) > _MOST_REASONS else [m for m in messages if m.needs_attention]
    said = [message.text.strip() for message in ordered]
    own = [text for text in said if not text.startswith(_WRAPPER_SAYS)] or said
    if len(own) > _MOST_REASONS:
        own = [*own[:_MOST_REASONS], f"(And {len(own) - _MOST_REASONS} messages more.)"]
    return " ".join(own) or "it gave no reason."


def _shortened(raw: bytes) -> str:
    """The text of a message; of a very long one the beginning, with how much is left out."""
    text = raw[: 4 * _LONGEST_TEXT].decode("utf-8", errors="replace")
    if len(raw) <= _LONGEST_TEXT or (len(text) <= _LONGEST_TEXT and len(raw) <= 4 * _LONGEST_TEXT):
        return text
    kept = text[:_LONGEST_TEXT]
    return f"{kept} (... {len(raw) - len(kept.encode())} more bytes of this message are left out.)"
