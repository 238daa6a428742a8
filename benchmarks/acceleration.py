"""One acceleration: eqs (2) and (3) with numpy's pseudoinverse, and by the engine."""

from __future__ import annotations

import numpy as np

from mechanism_fmu.engine.compiler.subset import entry
from mechanism_fmu.engine.dynamics.acceleration import derivative
from mechanism_fmu.tables.declare import Array
from mechanism_fmu.tables.layout import field_of

from . import reference
from .instance import INSTANTS, Instance
from .plain import at_rest
from .timing import Comparison, batch, in_turns, require_agreement

_LEAST_RATIO = 50.0
#: The two differ by less [m/s2, rad/s2].
_WITHIN = 1e-9
_PLAIN_CALLS, _ENGINE_CALLS = 30, 3000


def compare(rounds: int) -> list[Comparison]:
    """Compare before and after the impact: 7 and 8 constraint rows of 9 coordinates."""
    return [_compare(case, Instance(time), rounds) for case, time in INSTANTS.items()]


def _compare(case: str, instance: Instance, rounds: int) -> Comparison:
    ratchet, _ = at_rest()
    state = instance.state
    closed = (reference.SLOPE, reference.FACE) if state.on_face else (reference.SLOPE,)
    unknowns = field_of(instance.block, "y_end").size  # compiled code does not look how long they are
    y, dy = np.zeros(unknowns), np.zeros(unknowns)
    y[:9], y[9:18] = state.q, state.qd

    def plain() -> Array:
        return reference.acceleration(ratchet, state.q, state.qd, closed)

    def engine(count: int) -> Array:
        _repeat(instance.block, y, dy, count)
        return dy[9:18]

    require_agreement(f"One acceleration {case}", plain(), engine(1), _WITHIN)
    slow, fast = in_turns(
        lambda: batch(plain, _PLAIN_CALLS),
        lambda: batch(lambda: engine(_ENGINE_CALLS), 1) / _ENGINE_CALLS,
        rounds,
    )
    return Comparison("one acceleration", case, slow, fast, _LEAST_RATIO)


@entry
def _repeat(block: Array, y: Array, dy: Array, count: int) -> None:
    """Evaluate the derivative `count` times, compiled, as the integrator does."""
    for _ in range(count):
        derivative(block, y, dy)
