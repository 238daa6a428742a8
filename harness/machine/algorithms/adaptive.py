"""Steps as large as a tolerance allows, by doubling."""

from __future__ import annotations

from ...errors import UsageError
from ..component import Component
from ..machine import Machine
from ..signals import Memory

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
        tolerance: relative.
        too_small: how many steps were at `LEAST_STEP` and missed the tolerance all the same.
    """

    def __init__(self, machine: Machine, tolerance: float) -> None:
        """Begin with the largest step that is asked for.

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
        """Take one step within the tolerance."""
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
