"""Steps end where an impact happens, so that the neighbours feel it when it does."""

from __future__ import annotations

from collections.abc import Sequence

from ..extrapolation import Extrapolation
from ..impact_times import ImpactTimes
from ..machine import Machine
from ..part import Part

#: So often a step is taken again because a part then has an impact still earlier.
_MOST_REPEATS = 20
#: The step after an impact is so much shorter: nobody knows yet how outputs without a derivative go on.
_SHORTER = 16


class EventAware:
    """Jacobi's scheme with rollback (an `Algorithm`).

    All parts take the step. When one of them had an impact inside it, those that have gone farther are put back, and
    take the step to the impact. Parts that cannot be put back come last, when the end of the step is known; only
    their own impacts are then felt late, at the end of the step.

    Attributes:
        felt_late: parts with impacts that cannot be put back, for a warning.
    """

    def __init__(self, machine: Machine) -> None:
        """Look at which parts can be put back, and which report impacts."""
        self._first = [name for name, part in machine.parts.items() if part.can_restore]
        self._last = [name for name, part in machine.parts.items() if not part.can_restore]
        self._impacts = {name: ImpactTimes(part.component) for name, part in machine.parts.items()}
        self._struck = False
        self.felt_late = [name for name in self._last if self._impacts[name].reports]

    def advance(self, machine: Machine, begin: int, end: int) -> int:
        """Take a step to `end`, or to the first impact before it; the one after an impact is shorter."""
        if self._struck and machine.extrapolation is not Extrapolation.CONSTANT:
            end = begin + max((end - begin) // _SHORTER, 1)
        if machine.extrapolation is not Extrapolation.CONSTANT:
            machine.foresee(self._last)
        first = [machine.parts[name] for name in self._first]
        for name, part in zip(self._first, first, strict=True):
            machine.give(name, begin, end)
            part.save()
        end, struck = self._to_the_first_impact(machine, first, begin, end)
        for name in self._last:
            machine.give(name, begin, end)
            machine.parts[name].step(begin, end)
            struck = struck or self._impacts[name].first() is not None
        machine.exchange(end)
        self._struck = struck
        if struck:
            for part in machine.parts.values():
                part.outputs.jumped()
        return end

    def _to_the_first_impact(self, machine: Machine, parts: Sequence[Part], begin: int, end: int) -> tuple[int, bool]:
        """Take parts to the first impact or early return, or to `end`; where that is, and whether one happened."""
        reached, asked = [part.advance(begin, end) for part in parts], end
        for _ in range(_MOST_REPEATS):
            times = [self._impacts[name].first() for name in self._first]
            impacts = [time for time in times if time is not None]
            goal = max(min([end, *reached, *impacts]), begin + 1)
            if all(time == goal for time in reached):
                return goal, bool(impacts) or goal < asked
            for place, (name, part) in enumerate(zip(self._first, parts, strict=True)):
                if reached[place] != goal:
                    part.restore()
                    machine.restored(name)
                    machine.give(name, begin, goal)
                    reached[place] = part.advance(begin, goal)
            end = goal
        for place, part in enumerate(parts):
            part.step(reached[place], end)
        return end, True
