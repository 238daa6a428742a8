"""Protocol between client and server of a remote component: plain data, requests and replies."""

from __future__ import annotations

from array import array
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ...errors import FmuError, HarnessError, LogMessage, Status, UsageError
from ..description import Value, Variable
from ..processes import BrokenFrameError

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


# What can be asked of a component, and how long an answer holds.

#: What can be asked of variables: values by name, those of bound Reals, derivatives of outputs.
KINDS = ("get", "read", "read_slopes")


@dataclass(eq=False)
class Question:
    """Something to be read, with the answer as long as that holds.

    Attributes:
        number: by which the other side knows it.
        kind: one of `KINDS`.
        types: of the variables.
        follows: variables whose setting changes the answer; None: any may.
        answer: (whether it could be answered, values or exception); None: it must be asked for.
    """

    number: int
    kind: str
    types: Types
    follows: frozenset[str] | None
    answer: tuple[bool, Any] | None = None

    @property
    def of_slopes(self) -> bool:
        """Whether slopes of inputs change the answer, too."""
        return self.kind == "read_slopes"

    def forget(self, changed: Collection[str] | None) -> None:
        """Some variables have changed; None: all may have."""
        if changed is None or self.follows is None or not self.follows.isdisjoint(changed):
            self.answer = None

    def learn(self, data: Any, numbers: Numbers) -> None:
        """Take the answer from plain data.

        Raises:
            BrokenFrameError: it is none to this question.
        """
        if type(data) is not list or len(data) != 2 or type(data[0]) is not bool:
            raise BrokenFrameError("an answer in it is none")
        well, said = data
        self.answer = (True, self._values(said, numbers)) if well else (False, read_error(said))

    def _values(self, said: Any, numbers: Numbers) -> Any:
        if self.kind == "get":
            return self.types.unpacked(said, numbers)
        if self.kind == "read_slopes":
            if type(said) is not bool:
                raise BrokenFrameError("it does not say whether there are slopes")
            return said, numbers.take(len(self.types.types))
        if said is not None:
            raise BrokenFrameError("it says something where there are only numbers to be")
        return numbers.take(len(self.types.types))


def packed_answer(kind: str, types: Types, values: Any, tail: array[float]) -> Any:
    """The answer to a question as plain data, to be read by `Question.learn`; doubles are added to `tail`."""
    if kind == "get":
        return types.packed(values, tail)
    said, numbers = values if kind == "read_slopes" else (None, values)
    tail.extend(numbers)
    return said


def question(number: int, kind: str, variables: Sequence[Variable]) -> Question:
    """One of a kind about some variables."""
    follows = None if kind == "read_slopes" else _follows(variables)
    return Question(number, kind, Types.of(variables), follows)


def _follows(variables: Iterable[Variable]) -> frozenset[str] | None:
    """The variables whose setting changes some of these; None: not declared, so any may."""
    names: set[str] = set()
    for variable in variables:
        if variable.settable:
            names.add(variable.name)
        elif variable.causality == "output" and variable.depends_on is not None:
            names |= variable.depends_on
        else:
            return None
    return frozenset(names)
