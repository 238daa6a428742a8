"""What passes through one side of a bond: the integral of its input times its output.

What is assumed: within a step of a part, its own output goes on a straight line, as its inputs do; that is a trapezoid
rule, with an error of second order in the step. Where the part had an impact in the step, its output goes on as in
the step before, jumps at the (first) impact, and goes on in parallel. Where a displacement jumps at a communication
point, the effort is the mean of before and after.
"""

from __future__ import annotations

from collections.abc import Callable

from ..clock import SECOND
from .events import event_mode_of
from .impact_times import ImpactTimes
from .part import Part

#: Energy of a straight piece: duration, input at both ends, output at both ends.
Piece = Callable[[float, float, float, float, float], float]


def power(size: float, u0: float, u1: float, y0: float, y1: float) -> float:
    """Integral of the product of input and output."""
    return size * ((u0 * y0 + u1 * y1) / 3 + (u0 * y1 + u1 * y0) / 6)


def effort_taken(_size: float, u0: float, u1: float, y0: float, y1: float) -> float:
    """The input is an effort, the output a displacement."""
    return (u0 + u1) / 2 * (y1 - y0)


def effort_told(_size: float, u0: float, u1: float, y0: float, y1: float) -> float:
    """The input is a displacement, the output an effort."""
    return (y0 + y1) / 2 * (u1 - u0)


class Port:
    """One side of a bond (a `watched.Watcher`): input and output of one part.

    Attributes:
        energy: so far [J].
    """

    def __init__(self, part: Part, taken: str, told: str, piece: Piece, scale: float) -> None:
        """Look at a part's input `taken` and its output `told`; a piece of energy times `scale` is in J."""
        self._place = part.targets.index(taken)
        self._inputs = part.inputs.values
        self._slopes = part.slopes.values if part.takes_slopes else None
        self._output = part.component.reals([told])
        # Inputs that are set may change it at once, unless the component says that none does.
        # So may an event, which is handled at a communication point.
        by_event = event_mode_of(part.component) is not None
        self._follows = by_event or part.component.description.variables[told].depends_on != frozenset()
        self._impacts = ImpactTimes(part.component)
        self._jumps = self._impacts.reports and piece is not effort_taken  # a displacement does not jump
        self._piece, self._scale = piece, scale
        self._point: tuple[float, float, float] | None = None
        self._slope = 0.0
        self.energy = 0.0

    def exchanged(self, time: float) -> None:
        """Inputs were set at a communication point; where a displacement jumps, energy passes at once."""
        if self._piece is not power:
            self.begins(time)

    def begins(self, time: float) -> None:
        """The input may have jumped."""
        if self._point is None or self._follows:
            self._output.read()
        self._go_to(time, self._inputs[self._place], self._output.values[0])

    def ended(self, time: float) -> None:
        """Add what has passed in a step."""
        assert self._point is not None
        begin, u, y = self._point
        size = time - begin
        rate = 0.0 if self._slopes is None else self._slopes[self._place]
        self._output.read()
        end = self._output.values[0]
        first = self._impacts.first() if self._jumps else None
        if first is not None:
            impact = min(max(first / SECOND - begin, 0.0), size)
            self._go_to(begin + impact, u + rate * impact, y + self._slope * impact)
            self._point = begin + impact, u + rate * impact, end - self._slope * (size - impact)
        elif size > 0.0:
            self._slope = (end - y) / size
        self._go_to(time, u + rate * size, end)

    def memory(self) -> tuple[float, tuple[float, float, float] | None, float, float]:
        """All that changes."""
        return self.energy, self._point, self._slope, self._output.values[0]

    def remember(self, memory: tuple[float, tuple[float, float, float] | None, float, float]) -> None:
        """Be as then."""
        self.energy, self._point, self._slope, self._output.values[0] = memory

    def _go_to(self, time: float, u: float, y: float) -> None:
        """Add what passes on straight lines of input and output."""
        if self._point is not None:
            begin, u0, y0 = self._point
            self.energy += self._scale * self._piece(time - begin, u0, u, y0, y)
        self._point = time, u, y
