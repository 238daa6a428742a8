"""What can be asked of a component, and how long an answer holds."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from typing import Any

from ...description import Variable


@dataclass(eq=False)
class Question:
    """Something to be read, with the answer as long as that holds.

    Attributes:
        number: by which the other side knows it.
        of_slopes: whether slopes of inputs change the answer, too.
        follows: variables whose setting changes the answer; None: any may.
        answer: (whether it could be answered, values or exception); None: it must be asked for.
    """

    number: int
    of_slopes: bool
    follows: frozenset[str] | None
    answer: tuple[bool, Any] | None = None

    def forget(self, changed: Collection[str] | None) -> None:
        """Some variables have changed; None: all may have."""
        if changed is None or self.follows is None or not self.follows.isdisjoint(changed):
            self.answer = None


def question(number: int, kind: str, variables: Iterable[Variable]) -> Question:
    """One of a kind, "get", "read" or "read_slopes", about some variables."""
    of_slopes = kind == "read_slopes"
    return Question(number, of_slopes, None if of_slopes else _follows(variables))


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
