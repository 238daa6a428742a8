"""Parts take the step one after the other, and know those before them as they are at its end."""

from __future__ import annotations

from ...clock import SECOND
from ..machine import Machine


class GaussSeidel:
    """Fixed steps, each part behind those that it follows (an `Algorithm`).

    What a part has come to is known to those behind it, so their inputs go straight from what it was to what it is:
    interpolation instead of extrapolation. In a cycle, the first part extrapolates, in the order of `Machine.parts`.
    """

    def advance(self, machine: Machine, begin: int, end: int) -> int:
        """Take the whole step."""
        size = (end - begin) / SECOND
        slopes: dict[str, list[float]] = {}
        for name, part in machine.parts.items():
            machine.give(name, begin, end, slopes)
            part.step(begin, end)
            before = tuple(part.outputs.values)
            slopes[name] = [(now - then) / size for now, then in zip(part.outputs.peek(), before, strict=True)]
        machine.exchange(end)
        return end
