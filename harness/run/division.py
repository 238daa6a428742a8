"""Division of a step that has more impacts or events than the FMU's buffers hold.

The step is taken back, and taken again in parts of which each holds fewer: so every impact is reported once. How the
mechanism moves does not depend on it. An FMU that cannot be put back reports what fits, and counts the others.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from ..analysis.impacts import Buffer
from ..errors import LogMessage
from ..fmu.description import Description
from ..fmu.instances.message_log import MessageHandler, discard_message
from ..fmu.interface import Instance

#: No part is shorter [s], nor than this share of the time that it has reached: rounding would decide what is in it.
_LEAST, _ROUNDINGS = 1e-12, 1e-14


class HeldMessages:
    """A `MessageHandler` that passes messages on, but for those of a step that may yet be taken back."""

    def __init__(self, on_message: MessageHandler = discard_message) -> None:
        self._on_message = on_message
        self._held: list[LogMessage] | None = None

    def __call__(self, message: LogMessage) -> None:
        """Take a message."""
        if self._held is None:
            self._on_message(message)
        else:
            self._held.append(message)

    def hold(self) -> None:
        """Keep messages from now on."""
        self._held = []

    def release(self) -> None:
        """Pass on what was kept, and what comes from now on."""
        held, self._held = self._held, None
        for message in held or ():
            self._on_message(message)

    def drop(self) -> None:
        """Forget what was kept."""
        self._held = None


class _Count:
    """What a buffer has lost in a step: the FMU counts all in one output, and says in another how many it holds."""

    def __init__(self, description: Description, buffer: str, count: str) -> None:
        self._times = Buffer(description, buffer, ("time",))
        self.names = (count, f"{buffer}_in_step")
        self.known = bool(self._times.fields) and count in description.variables

    def cut(self, unit: Instance, begin: float, end: float) -> float | None:
        """Where to divide a step [s] that had too many; None where they all are at one instant, or nearly so."""
        least = max(_LEAST, _ROUNDINGS * abs(end))
        times = sorted(float(time) for (time,) in self._times.read(unit))
        gaps = [(a + b) / 2 for a, b in pairwise(times) if b - a > 2 * least]
        if gaps:  # it holds the newest ones: behind the cut there are fewer than it has room for
            return gaps[0]
        # More at one instant than it has room for: those before them must not be lost as well.
        return times[0] - 2 * least if times and times[0] - 3 * least > begin else None


class Division:
    """Takes the steps of one instance, in parts where its buffers need it.

    Attributes:
        divided: how many steps were taken in parts.
    """

    def __init__(self, unit: Instance, messages: HeldMessages | None = None) -> None:
        """Look at what `unit` reports and can do; `messages` is what receives its messages."""
        own = unit.description
        counts = (_Count(own, "impacts", "impact_count"), _Count(own, "events", "event_count"))
        able = own.saves_state and own.varies_step
        self._counts = [count for count in counts if count.known] if able else []
        self._names = [name for count in self._counts for name in count.names]
        self._unit = unit
        self._messages = messages or HeldMessages()
        self._state: Any = None
        self.divided = 0

    def take(self, begin: float, size: float) -> Iterator[float]:
        """Take a step; each time within it [s] that is yielded is a communication point more, where the unit stands.

        Raises:
            FmuError: the unit refuses.
        """
        if not self._counts:
            self._unit.step(begin, size)
            return
        ends, whole = [begin + size], True
        while ends:
            cut = self._try(begin, ends[-1] - begin)
            if cut is None:
                begin = ends.pop()
                if ends:
                    yield begin
            else:
                ends.append(begin + (cut - begin))
                self.divided += whole
                whole = False

    def close(self) -> None:
        """Give back what the unit has kept for this."""
        if self._state is not None:
            self._unit.free_state(self._state)
            self._state = None

    def _try(self, begin: float, size: float) -> float | None:
        """Take a part; None if it is taken, else where to divide it: then it is taken back."""
        unit = self._unit
        before, said = unit.get(self._names), len(unit.messages)
        self._state = unit.save() if self._state is None else unit.save(self._state)
        self._messages.hold()
        try:
            unit.step(begin, size)
            cut = self._cut(unit.get(self._names), before, begin, begin + size)
        except BaseException:
            self._messages.release()
            raise
        if cut is None:
            self._messages.release()
            return None
        unit.restore(self._state)
        del unit.messages[said:]
        self._messages.drop()
        return cut

    def _cut(self, now: list[Any], before: list[Any], begin: float, end: float) -> float | None:
        for place, count in enumerate(self._counts):
            happened = int(now[2 * place]) - int(before[2 * place])
            if happened > int(now[2 * place + 1]):
                cut = count.cut(self._unit, begin, end)
                if cut is not None and begin < cut < end:
                    return cut
        return None
