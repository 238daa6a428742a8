"""One acceleration: eqs (2) and (3) with numpy's pseudoinverse, and by the engine."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mechanism_fmu.engine.acceleration import derivative
from mechanism_fmu.engine.room import Array
from mechanism_fmu.engine.subset import entry

from . import reference
from .instance import INSTANTS, Instance
from .plain import at_rest
from .timing import Comparison, batch, in_turns, require_agreement

LEAST_RATIO = 50.0
_WITHIN = 1e-9
_PLAIN_CALLS, _ENGINE_CALLS = 30, 3000


def compare(rounds: int) -> Iterator[Comparison]:
    """Compare before and after the impact: 7 and 8 constraint rows of 9 coordinates."""
    ratchet, _ = at_rest()
    for case, time in INSTANTS.items():
        instance = Instance(time)
        state = instance.state
        closed = (reference.SLOPE, reference.FACE) if state.on_face else (reference.SLOPE,)
        y, dy = np.concatenate([state.q, state.qd, [0.0]]), np.zeros(19)

        def plain() -> object:
            return reference.acceleration(ratchet, state.q, state.qd, closed)  # noqa: B023

        def engine(count: int) -> None:
            repeat(instance.block, y, dy, count)  # noqa: B023

        engine(1)
        require_agreement(f"One acceleration {case}", plain(), dy[9:18], _WITHIN)
        slow, fast = in_turns(
            lambda: batch(plain, _PLAIN_CALLS),
            lambda: batch(lambda: engine(_ENGINE_CALLS), 1) / _ENGINE_CALLS,
            rounds,
        )
        yield Comparison("one acceleration", case, slow, fast, LEAST_RATIO)


@entry
def repeat(block: Array, y: Array, dy: Array, count: int) -> None:
    """Evaluate the derivative `count` times, compiled, as the integrator does."""
    for _ in range(count):
        derivative(block, y, dy)
