"""What goes between the process of a component and the one that leads, as plain data: checked when it comes."""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ...description import Value, Variable
from ...errors import FmuError, HarnessError, UsageError
from ...messages import LogMessage, Status
from ...wire import BrokenFrameError

_KINDS: dict[str, type[HarnessError]] = {"usage": UsageError, "fmu": FmuError, "harness": HarnessError}
_TYPES: dict[str, type[Value]] = {"Real": float, "Integer": int, "Boolean": bool, "String": str, "Binary": str}


class Numbers:
    """Doubles in the tail of a frame, taken one part after the other."""

    def __init__(self, tail: bytes) -> None:
        if len(tail) % 8:
            raise BrokenFrameError(f"its tail of {len(tail)} bytes is no list of doubles")
        self._all = array("d", tail)
        self._next = 0

    def take(self, count: int) -> list[float]:
        """The next ones."""
        first, self._next = self._next, self._next + count
        if self._next > len(self._all):
            raise BrokenFrameError(f"it has {len(self._all)} doubles, fewer than were asked for")
        return self._all[first : self._next].tolist()

    def finish(self) -> None:
        """There shall be no more."""
        if self._next != len(self._all):
            raise BrokenFrameError(f"it has {len(self._all)} doubles, but {self._next} were asked for")


@dataclass(frozen=True)
class Types:
    """Values of some variables: those of Reals go as doubles in the tail, the others in the text.

    Attributes:
        types: of the variables, in their order.
    """

    types: tuple[str, ...]

    @classmethod
    def of(cls, variables: Sequence[Variable]) -> Types:
        """Those of some variables."""
        return cls(tuple(variable.type for variable in variables))

    @cached_property
    def _reals(self) -> tuple[int, ...]:
        return tuple(place for place, kind in enumerate(self.types) if kind == "Real")

    @cached_property
    def _others(self) -> tuple[tuple[int, type[Value]], ...]:
        return tuple((place, _TYPES[kind]) for place, kind in enumerate(self.types) if kind != "Real")

    def packed(self, values: Sequence[Value], tail: array[float]) -> list[Value]:
        """What goes in the text; the doubles are added to `tail`."""
        if not self._others:
            tail.extend(values)  # type: ignore[arg-type]
            return []
        tail.extend([values[place] for place in self._reals])  # type: ignore[misc]
        return [values[place] for place, _ in self._others]

    def unpacked(self, texts: Any, numbers: Numbers) -> list[Value]:
        """All values in their order.

        Raises:
            BrokenFrameError: they are not of these types.
        """
        others = self._others
        if type(texts) is not list or len(texts) != len(others):
            raise BrokenFrameError(f"it does not have the {len(others)} values that are no Reals")
        if not others:
            return numbers.take(len(self._reals))  # type: ignore[return-value]
        values: list[Value] = [0.0] * len(self.types)
        for place, real in zip(self._reals, numbers.take(len(self._reals)), strict=True):
            values[place] = real
        for (place, kind), value in zip(others, texts, strict=True):
            if type(value) is not kind:
                raise BrokenFrameError(f"it has a value of type {type(value).__name__} where one of {kind.__name__} is")
            values[place] = value
        return values


def packed_messages(messages: Sequence[LogMessage]) -> list[list[Any]]:
    """Messages as plain data."""
    return [[m.instance, m.time, int(m.status), m.category, m.text] for m in messages]


def read_messages(data: Any) -> list[LogMessage]:
    """Messages from plain data.

    Raises:
        BrokenFrameError: these are none.
    """
    if type(data) is not list:
        raise BrokenFrameError("its messages are no list")
    return [_message(one) for one in data]


def _message(data: Any) -> LogMessage:
    if type(data) is not list or len(data) != 5:
        raise BrokenFrameError("one of its messages has not five parts")
    instance, time, status, category, text = data
    _require(instance, str)
    _require(status, int)
    _require(category, str)
    _require(text, str)
    return LogMessage(instance, number(time), Status(status), category, text)


def packed_error(error: Exception, name: str) -> list[Any]:
    """An exception as plain data; one that is none of the harness's becomes the failure of component `name`."""
    if isinstance(error, FmuError):
        return ["fmu", str(error), error.instance, error.time, int(error.status), packed_messages(error.messages)]
    if isinstance(error, HarnessError):
        return ["usage" if isinstance(error, UsageError) else "harness", str(error), "", None, 0, []]
    text = f"{name} failed in its process: {type(error).__name__}: {error}"
    return ["fmu", text, name, None, int(Status.ERROR), []]


def read_error(data: Any) -> HarnessError:
    """An exception from plain data.

    Raises:
        BrokenFrameError: this is none.
    """
    if type(data) is not list or len(data) != 6:
        raise BrokenFrameError("what it refuses with has not six parts")
    kind, text, instance, time, status, messages = data
    for one in (kind, text, instance):
        _require(one, str)
    _require(status, int)
    if kind not in _KINDS:
        raise BrokenFrameError("it refuses in a way that there is not")
    if kind != "fmu":
        return _KINDS[kind](text)
    return FmuError(
        text,
        instance=instance,
        time=None if time is None else number(time),
        status=Status(status),
        messages=read_messages(messages),
    )


def number(data: Any) -> float:
    """A number from plain data.

    Raises:
        BrokenFrameError: this is none.
    """
    if type(data) not in (float, int):
        raise BrokenFrameError(f"it has a value of type {type(data).__name__} where a number is to be")
    try:
        return float(data)
    except OverflowError:
        raise BrokenFrameError("it has a number that is too large") from None


def _require(value: Any, kind: type) -> None:
    if type(value) is not kind:
        raise BrokenFrameError(f"it has a value of type {type(value).__name__} where one of {kind.__name__} is to be")
