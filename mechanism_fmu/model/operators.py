"""Operators of numbers that are recorded while somebody calculates with them: symbols, and arguments of laws."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any

from .functions import Number

_Operator = Callable[[Any, Number], Any]


def _operator(name: str) -> tuple[_Operator, _Operator]:
    """The methods of an operator for a recorded number on its left, and on its right."""

    def on_left(self: Recorded, other: Number) -> Any:
        return self._binary(name, self, other)

    def on_right(self: Recorded, other: Number) -> Any:
        return self._binary(name, other, self)

    return on_left, on_right


class Recorded(ABC):
    """A number that notes +, -, * and / with it, and which of the two operands it was."""

    __slots__ = ()

    @abstractmethod
    def _binary(self, name: str, left: Number, right: Number) -> Any:
        """The result of the operation `name`, one of whose operands is this number."""

    __add__, __radd__ = _operator("add")
    __sub__, __rsub__ = _operator("subtract")
    __mul__, __rmul__ = _operator("multiply")
    __truediv__, __rtruediv__ = _operator("divide")
