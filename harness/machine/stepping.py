"""Co-simulation master algorithms of a machine: Jacobi, Gauss-Seidel, event-aware and adaptive."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from ..errors import UsageError
from ..fmu.interface import Component
from ..run.master import SECOND
from .file.machine_plan import Policy, Scheme
from .machine import Machine
from .observers.component_impacts import ImpactTimes
from .part import Extrapolation, Memory, Part

# The interface of master algorithms.


class Algorithm(Protocol):
    """Takes a machine from one communication point to the next.

    When it is called, the outputs were exchanged at `begin`; when it returns, they were at the time that it returns.
    """

    def advance(self, machine: Machine, begin: int, end: int) -> int:
        """Take one step from `begin`, not beyond `end`; the time reached [ns], later than `begin`.

        Args:
            machine: that takes the step, its outputs exchanged at `begin`.
            begin: of the step [ns].
            end: of the step [ns], later than `begin`.

        Raises:
            FmuError: a component refuses or fails.
        """


# All parts take the same step, each knowing the others as they were at its beginning: their order does not matter.


class Jacobi:
    """Fixed steps, all parts at once (an `Algorithm`)."""

    def advance(self, machine: Machine, begin: int, end: int) -> int:
        """Take the whole step, to `end`; arguments and errors as of `Algorithm.advance`."""
        machine.give_all(begin, end)
        for part in machine.parts.values():
            reached = part.advance(begin, end)
            if reached < end:
                part.step(reached, end)
        machine.exchange(end)
        return end


# Parts take the step one after the other, and know those before them as they are at its end.


class GaussSeidel:
    """Fixed steps, each part behind those that it follows (an `Algorithm`).

    What a part has come to is known to those behind it, so their inputs go straight from what it was to what it is:
    interpolation instead of extrapolation, also with `Extrapolation.CONSTANT`. Where derivatives are wanted and known,
    the straight line has the mean of the cubic through values and derivatives (Hermite), which makes the error one of
    third order, as that of Jacobi's scheme. In a cycle, the first part extrapolates, in the order of `Machine.parts`.
    """

    def advance(self, machine: Machine, begin: int, end: int) -> int:
        """Take the whole step, to `end`; arguments and errors as of `Algorithm.advance`."""
        size = (end - begin) / SECOND
        by_rates = machine.extrapolation is Extrapolation.DERIVATIVES
        slopes: dict[str, list[float]] = {}
        for name, part in machine.parts.items():
            machine.give(name, begin, end, slopes)
            outputs = part.outputs
            before = tuple(outputs.values)
            rates = outputs.rates(before) if by_rates else {}
            part.step(begin, end)
            after = outputs.peek()
            slopes[name] = [(now - then) / size for now, then in zip(after, before, strict=True)]
            if rates:
                for k, rate in outputs.rates(after).items():
                    if k in rates:
                        slopes[name][k] += (rates[k] - rate) / 6.0
        machine.exchange(end)
        return end


# Steps end where an impact happens, so that the neighbours feel it when it does.

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
        """Look at which parts can be put back, and which report impacts.

        Args:
            machine: that it is to step.
        """
        self._first = [name for name, part in machine.parts.items() if part.can_restore]
        self._last = [name for name, part in machine.parts.items() if not part.can_restore]
        self._impacts = {name: ImpactTimes(part.component) for name, part in machine.parts.items()}
        self._struck = False
        self.felt_late = [name for name in self._last if self._impacts[name].reports]

    def advance(self, machine: Machine, begin: int, end: int) -> int:
        """Take a step to `end`, or to the first impact before it, shorter after an impact.

        Arguments and errors as of `Algorithm.advance`.
        """
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


# Steps as large as a tolerance allows, by doubling.

_SAFETY, _SHRINK, _GROW = 0.9, 0.2, 4.0
#: The smallest step [ns].
LEAST_STEP = 1_000


class Adaptive:
    """Jacobi's scheme once with a step and once with its halves; their difference decides (an `Algorithm`).

    The halves count. A step is taken again, shorter, when any continuous output differs by more than the tolerance,
    relative to its size or its nominal value, whichever is larger (E. Hairer, S. Norsett, G. Wanner, Solving Ordinary
    Differential Equations I, II.4). All outputs are looked at, not only connected ones: the error of a force is first
    one of speeds, and of angles only a step later.

    Attributes:
        tolerance: relative [1].
        too_small: how many steps were at `LEAST_STEP` and missed the tolerance all the same.
    """

    def __init__(self, machine: Machine, tolerance: float) -> None:
        """Begin with the largest step that is asked for.

        Args:
            machine: that it is to step; all parts must be able to be put back.
            tolerance: relative [1], above 0 and below 1.

        Raises:
            UsageError: a part cannot be put back, or the tolerance is not between 0 and 1.
        """
        stiff = [name for name, part in machine.parts.items() if not part.can_restore]
        if stiff:
            raise UsageError(
                f"Steps by tolerance need components that can be put back (canGetAndSetFMUstate), but "
                f'{", ".join(stiff)} cannot; take algorithm = "jacobi" or "gauss_seidel" with a step.'
            )
        if not 0.0 < tolerance < 1.0:
            raise UsageError(f"The tolerance is {tolerance:g}; give a number above 0 and below 1, as in 1e-4.")
        self.tolerance = tolerance
        self.too_small = 0
        self._size = 0
        self._watched = [_Watched(part.component) for part in machine.parts.values()]

    def advance(self, machine: Machine, begin: int, end: int) -> int:
        """Take one step within the tolerance; arguments and errors as of `Algorithm.advance`."""
        size = min(self._size or end - begin, end - begin)
        memory = {name: part.outputs.memory() for name, part in machine.parts.items()}
        for part in machine.parts.values():
            part.save()
        while True:
            half, goal = begin + size // 2, begin + size
            _take(machine, begin, goal)
            for watched in self._watched:
                watched.keep()
            _back(machine, memory)
            _take(machine, begin, half)
            _take(machine, half, goal)
            error = max((watched.difference() for watched in self._watched), default=0.0) / self.tolerance
            factor = _SAFETY * error ** (-1.0 / (machine.extrapolation.order + 1)) if error > 0.0 else _GROW
            proposed = round(size * min(max(factor, _SHRINK), _GROW))
            if error <= 1.0 or size <= LEAST_STEP:
                self.too_small += error > 1.0
                # A step cut short by the communication point says little about the next one.
                self._size = max(proposed, LEAST_STEP, self._size if goal == end and error <= 1.0 else 0)
                return goal
            _back(machine, memory)
            size = max(proposed, LEAST_STEP)


class _Watched:
    """The continuous outputs of a component, and what they were after the whole step."""

    def __init__(self, component: Component) -> None:
        outputs = [v for v in component.description.of("output") if v.continuous and "[" not in v.name]
        self._nominal = [variable.nominal for variable in outputs]
        self._reals = component.reals([variable.name for variable in outputs])
        self._whole: list[float] = []

    def keep(self) -> None:
        self._reals.read()
        self._whole = list(self._reals.values)

    def difference(self) -> float:
        """The largest one now, relative to size or nominal value."""
        self._reals.read()
        triples = zip(self._whole, self._reals.values, self._nominal, strict=True)
        return max((abs(whole - halves) / max(abs(halves), nominal) for whole, halves, nominal in triples), default=0.0)


def _take(machine: Machine, begin: int, end: int) -> None:
    machine.give_all(begin, end)
    for part in machine.parts.values():
        part.step(begin, end)
    machine.exchange(end)


def _back(machine: Machine, memory: dict[str, Memory]) -> None:
    for name, part in machine.parts.items():
        part.restore()
        machine.restored(name)
        part.outputs.remember(memory[name])


# Algorithms by name.


def algorithm_of(policy: Policy, machine: Machine) -> Algorithm:
    """The algorithm that a plan asks for.

    Raises:
        UsageError: the machine cannot be stepped so.
    """
    match policy.scheme:
        case Scheme.JACOBI:
            return Jacobi()
        case Scheme.GAUSS_SEIDEL:
            return GaussSeidel()
        case Scheme.EVENT_AWARE:
            return EventAware(machine)
        case Scheme.ADAPTIVE:
            return Adaptive(machine, 1e-4 if policy.tolerance is None else policy.tolerance)
