"""Named cases of a model: values of its parameters, and its inputs over time."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from .errors import MechanismError


def _require_numbers(signal: object, numbers: Sequence[object]) -> None:
    for number in numbers:
        if isinstance(number, bool) or not isinstance(number, int | float):
            raise MechanismError(f"{signal!r}: {number!r} is no plain number; give it in the unit of the input, or s.")


@dataclass(frozen=True)
class SineSignal:
    """An input over time, mean + amplitude sin(2 pi t / period + phase).

    Attributes:
        mean, amplitude: in the unit of the input.
        period: > 0 [s].
        phase: [rad].

    Raises:
        MechanismError: a number is not finite, or the period is not positive.

    Source: definition: a harmonic oscillation.
    """

    mean: float
    amplitude: float
    period: float
    phase: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is no sine."""
        _require_numbers(self, (self.mean, self.amplitude, self.period, self.phase))
        if not all(map(math.isfinite, (self.mean, self.amplitude, self.period, self.phase))) or self.period <= 0.0:
            raise MechanismError(f"{self!r}: all its numbers must be finite, and the period positive.")

    def at(self, time: float) -> float:
        """The value at a time, in the unit of the input.

        Args:
            time: [s].
        """
        return self.mean + self.amplitude * math.sin(2.0 * math.pi * time / self.period + self.phase)

    @property
    def span(self) -> tuple[float, float]:
        """Its least and greatest value."""
        return self.mean - abs(self.amplitude), self.mean + abs(self.amplitude)


@dataclass(frozen=True)
class TableSignal:
    """An input over time through points: straight between them, level before the first and behind the last.

    Attributes:
        times: ascending [s].
        values: at these times, in the unit of the input.

    Raises:
        MechanismError: as many times as values are needed, at least one, finite, the times ascending.

    Source: definition: linear interpolation.
    """

    times: tuple[float, ...]
    values: tuple[float, ...]

    def __post_init__(self) -> None:
        """Refuse what is no table."""
        if not isinstance(self.times, tuple | list) or not isinstance(self.values, tuple | list):
            raise MechanismError(f"{self!r}: times and values are two tuples of numbers, e.g. (0.0, 1.0), (0.0, 5.0).")
        _require_numbers(self, (*self.times, *self.values))
        finite = all(map(math.isfinite, (*self.times, *self.values)))
        ascending = all(a < b for a, b in zip(self.times, self.times[1:], strict=False))
        if not (len(self.times) == len(self.values) > 0 and finite and ascending):
            raise MechanismError(f"{self!r}: give as many finite values as times, which must ascend.")

    def at(self, time: float) -> float:
        """The value at a time, in the unit of the input.

        Args:
            time: [s].
        """
        if time <= self.times[0]:
            return self.values[0]
        for (t, x), (later, y) in zip(self._points, self._points[1:], strict=False):
            if time <= later:
                return x + (y - x) * (time - t) / (later - t)
        return self.values[-1]

    @property
    def span(self) -> tuple[float, float]:
        """Its least and greatest value."""
        return min(self.values), max(self.values)

    @property
    def _points(self) -> Sequence[tuple[float, float]]:
        return tuple(zip(self.times, self.values, strict=True))


#: An input over time.
Signal = SineSignal | TableSignal


@dataclass(frozen=True)
class Case:
    """What a model shows when it is given these values: a choice on its page.

    Attributes:
        name: short, of small letters, digits and underscores; it stands in addresses.
        description: one line for the user.
        values: parameters and inputs that are not at their start values, in their units; texts such as "45 mm", too.
        signals: inputs over time; each is held from one communication point to the next.
        stop_time, step_size: of this case [s]; None: those of the model.
    """

    name: str
    description: str
    values: Mapping[str, float | str] = field(default_factory=dict, hash=False)
    signals: Mapping[str, Signal] = field(default_factory=dict, hash=False)
    stop_time: float | None = None
    step_size: float | None = None
