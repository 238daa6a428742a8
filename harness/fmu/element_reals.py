"""Real variables of an FMU that are elements of arrays, or not of double precision: bound without haste."""

from __future__ import annotations

import math
from collections.abc import Mapping, MutableSequence, Sequence
from typing import Protocol

from ..description import Value
from ..errors import FmuError, UsageError


class Accessible(Protocol):
    """The instance whose variables they are."""

    def get(self, names: Sequence[str]) -> list[Value]:
        """Values of variables."""

    def set(self, values: Mapping[str, Value]) -> None:
        """Set variables."""

    def failure(self, function: str, reason: str) -> FmuError:
        """What to raise for an answer that cannot be used."""

    def no_slopes(self, names: Sequence[str]) -> UsageError:
        """What to raise for slopes of inputs that it does not take."""


class ElementReals:
    """Variables of an instance (a `machine.component.Reals`).

    Attributes:
        values: what `read` found and `write` takes.
    """

    def __init__(self, owner: Accessible, names: Sequence[str]) -> None:
        """Bind variables by name."""
        self._owner = owner
        self._names = tuple(names)
        self.values: MutableSequence[float] = [0.0] * len(names)

    def read(self) -> None:
        """Fill `values` with those of now.

        Raises:
            FmuError: the FMU refuses, or a value is not finite.
        """
        self.values[:] = map(float, self._owner.get(self._names))
        for name, value in zip(self._names, self.values, strict=True):
            if not math.isfinite(value):
                raise self._owner.failure("fmi3Get", f"{name} is {value}, which is no finite number")

    def write(self) -> None:
        """Set the variables to `values`."""
        self._owner.set(dict(zip(self._names, self.values, strict=True)))

    def read_slopes(self) -> bool:
        """Nothing is known of them."""
        return False

    def write_slopes(self) -> None:
        """FMUs with such variables take no slopes.

        Raises:
            UsageError: always.
        """
        raise self._owner.no_slopes(self._names)
