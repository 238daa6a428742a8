"""What can be asked of a component, and how long an answer holds."""

from __future__ import annotations

from array import array
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from ...description import Variable
from ...wire import BrokenFrameError
from .plain import Numbers, Types, read_error

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
    """The variables whose setting changes some of these; None: nobody says, so any may."""
    names: set[str] = set()
    for variable in variables:
        if variable.settable:
            names.add(variable.name)
        elif variable.causality == "output" and variable.depends_on is not None:
            names |= variable.depends_on
        else:
            return None
    return frozenset(names)
