"""All parts take the same step, each knowing the others as they were at its beginning: their order does not matter."""

from __future__ import annotations

from ..machine import Machine


class Jacobi:
    """Fixed steps, all parts at once (an `Algorithm`)."""

    def advance(self, machine: Machine, begin: int, end: int) -> int:
        """Take the whole step."""
        machine.give_all(begin, end)
        for part in machine.parts.values():
            reached = part.advance(begin, end)
            if reached < end:
                part.step(reached, end)
        machine.exchange(end)
        return end
