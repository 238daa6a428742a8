"""Calls of a component in another process, with as few round trips as can be: one a step."""

from __future__ import annotations

from collections.abc import Collection
from itertools import count
from typing import Any

from ...description import Description
from .link import Link
from .questions import Question, question

#: So many times longer may the start and the initialization take: an engine may be compiled.
_START = 10.0


class RoundTrips:
    """What is sent to a component, and what is known of it here.

    Orders go with the next call, which waits for a reply. What was read after one step is answered at once with the
    next, without being asked for.

    Attributes:
        description: of the component.
    """

    def __init__(self, link: Link, description: Description, time_limit: float) -> None:
        """Wait for the component; `time_limit` of a call [s]."""
        self._link = link
        self._limit = time_limit
        self._orders: list[tuple[Any, ...]] = []
        self._questions: dict[tuple[str, tuple[str, ...]], Question] = {}
        self._asked: dict[Question, None] = {}
        self._asked_before: dict[Question, None] = {}
        self._numbers = count(1)
        self.description = description
        link.receive("start", self._patience)

    def number(self) -> int:
        """A new one, by which both sides know something."""
        return next(self._numbers)

    def order(self, name: str, *arguments: Any) -> None:
        """Have something done before the next call."""
        self._orders.append((name, *arguments))

    def changed(self, names: Collection[str] | None) -> None:
        """The orders change some variables, or all (None): answers that follow them do not hold any more.

        Before the first step, no answer does: a state starts where an input is.
        """
        for asked in self._questions.values():
            asked.forget(None if self._link.time is None else names)

    def slopes_changed(self) -> None:
        """Slopes of inputs are changed by the orders."""
        for asked in self._questions.values():
            if asked.of_slopes:
                asked.answer = None

    def call(self, name: str, *arguments: Any) -> Any:
        """Have something done that changes all variables, and wait for what it returns."""
        self.changed(None)
        return self._call(name, arguments, ())

    def step(self, name: str, time: float, size: float) -> Any:
        """As `call`, of a step from `time` [s]; what was asked since the last one is answered at once."""
        self._link.time = time
        self._asked_before, self._asked = self._asked, {}
        self.changed(None)
        return self._call(name, (time, size), tuple(self._asked_before))

    def ask(self, kind: str, names: tuple[str, ...]) -> Any:
        """The answer of now, to "get", "read" or "read_slopes" of some variables.

        Raises:
            HarnessError: there is none.
        """
        asked = self._question(kind, names)
        self._asked[asked] = None
        if asked.answer is None:
            likely = self._asked_before | self._asked
            self._call("look", (), tuple(q for q in likely if q.answer is None))
        assert asked.answer is not None
        well, values = asked.answer
        if not well:
            raise values
        return values

    @property
    def _patience(self) -> float:
        return self._limit if self._link.time is not None else _START * self._limit

    def _call(self, name: str, arguments: tuple[Any, ...], wanted: tuple[Question, ...]) -> Any:
        orders, self._orders = self._orders, []
        request = orders, name, arguments, [q.number for q in wanted]
        return self._link.ask(request, self._patience, wanted)

    def _question(self, kind: str, names: tuple[str, ...]) -> Question:
        if (kind, names) not in self._questions:
            variables = [self.description.variable(name) for name in names]
            asked = question(self.number(), kind, variables)
            self.order("ask", asked.number, kind, names)
            self._questions[kind, names] = asked
        return self._questions[kind, names]
