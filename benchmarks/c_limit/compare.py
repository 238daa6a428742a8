"""The engine against the same algorithm in C: whole runs of the paper's base case, and one acceleration."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import models
from mechanism_fmu import codes
from mechanism_fmu.engine import status
from mechanism_fmu.engine.acceleration import derivative
from mechanism_fmu.engine.assembly import begin
from mechanism_fmu.engine.layout import field_of, state_of
from mechanism_fmu.engine.pack import pack
from mechanism_fmu.engine.ports import feed
from mechanism_fmu.engine.room import Array
from mechanism_fmu.engine.stepper import advance, state_at_time
from mechanism_fmu.engine.subset import entry
from mechanism_fmu.engine.views import ports

from ..timing import Comparison, DisagreementError, batch, in_turns, require_agreement
from .library import Limit, build

STOP_TIME = 6.0
#: Drive torques [N m], in turns: what one step has computed ahead holds for the next, or it must be dropped.
DRIVES = {"constant input": (1e-3, 1e-3), "new input each step": (0.9e-3, 1.1e-3)}
#: The engine takes no more than this of the C program's time.
MOST_RATIO = 1.15
#: Sums are made in the same order, so that what differs comes from how compilers round products [rad, rad/s].
WITHIN = 1e-11

_STEP, _LOOK = 1e-3, 10
_REPEATS = {"constant input": 10, "new input each step": 1}
_CALLS = 20_000
#: Instants of the accelerations [s], and how many rows are active there.
_INSTANTS = {"7 rows": 0.2, "8 rows": 1.0}


class Engine:
    """The engine with the paper's base case, at time 0."""

    def __init__(self) -> None:
        model = models.load("ratchet").MODEL
        self.block: Array = pack(model.build(model.values()).compile())
        _require_ok(begin(self.block, 0.0) or advance(self.block, 0.0))
        self._unknowns = np.zeros(field_of(self.block, "y_end").size)

    @property
    def steps(self) -> int:
        """How many steps of its own it has accepted."""
        return int(field_of(self.block, "counters")[codes.COUNT_STEPS])

    @property
    def impact_time(self) -> float:
        """Time of the last impact [s]; -1 before the first."""
        return float(field_of(self.block, "last_impact")[codes.RECORD_TIME])

    def run(self, torques: Array, step: float, first: int, count: int) -> None:
        """Make `count` communication steps of `step` [s] to the ends of number `first` and on, torques in turns."""
        _require_ok(_run(self.block, torques, step, first, count))

    def unknowns(self) -> Array:
        """Y = (q, qd, work, loss) at the time reached."""
        _read(self.block, self._unknowns)
        return self._unknowns.copy()

    def derivatives(self, y: Array, dy: Array, count: int) -> None:
        """Evaluate the derivative of `y` `count` times, into `dy`."""
        _derivatives(self.block, y, dy, count)

    def save(self) -> Array:
        """The whole state."""
        return state_of(self.block).copy()

    def restore(self, state: Array) -> None:
        """Return to a saved state."""
        state_of(self.block)[:] = state


def compare(folder: Path, rounds: int) -> list[Comparison]:
    """Compile the C program into `folder` and compare.

    Raises:
        NoCompilerError: there is none.
        DisagreementError: the two do not take the same steps to the same places.
    """
    engine = Engine()
    limit = Limit(build(folder), engine.block)
    accelerations = [_acceleration(case, time, engine, limit, rounds) for case, time in _INSTANTS.items()]
    return [*(_whole_run(drive, engine, limit, rounds) for drive in DRIVES), *accelerations]


def require_same_motion(drive: str, engine: Engine, limit: Limit) -> None:
    """Go through the whole run side by side, with a look at y every 10 ms; both return to where they were.

    Raises:
        DisagreementError: they differ.
    """
    torques = np.array(DRIVES[drive])
    saved = engine.save(), limit.save()
    for first in range(1, round(STOP_TIME / _STEP), _LOOK):
        engine.run(torques, _STEP, first, _LOOK)
        limit.run(torques, _STEP, first, _LOOK)
        require_agreement(f"{drive}, step {first + _LOOK - 1}", engine.unknowns(), limit.unknowns(), WITHIN)
    require_agreement(f"{drive}, impact", engine.impact_time, limit.impact_time, WITHIN)
    if engine.steps != limit.steps:
        raise DisagreementError(f"{drive}: the engine takes {engine.steps} steps, the C program {limit.steps}.")
    engine.restore(saved[0])
    limit.restore(saved[1])


def _whole_run(drive: str, engine: Engine, limit: Limit, rounds: int) -> Comparison:
    """0 to 6 s, through the impact, in communication steps of 1 ms."""
    require_same_motion(drive, engine, limit)
    torques, count, repeats = np.array(DRIVES[drive]), round(STOP_TIME / _STEP), _REPEATS[drive]
    state, c_state = engine.save(), limit.save()

    def run_engine() -> None:
        engine.restore(state)
        engine.run(torques, _STEP, 1, count)

    def run_limit() -> None:
        limit.restore(c_state)
        limit.run(torques, _STEP, 1, count)

    times = in_turns(
        lambda: batch(run_limit, repeats) / count,
        lambda: batch(run_engine, repeats) / count,
        rounds,
    )
    run_engine(), engine.restore(state), limit.restore(c_state)
    return Comparison("one 1 ms step (baseline: hand-written C)", drive, *times, least_ratio=1 / MOST_RATIO)


def _acceleration(case: str, time: float, engine: Engine, limit: Limit, rounds: int) -> Comparison:
    torques = np.array(DRIVES["constant input"])
    state, c_state = engine.save(), limit.save()
    for program in (engine, limit):
        program.run(torques, _STEP, 1, round(time / _STEP))
    y = engine.unknowns()
    dy, c_dy = np.zeros(y.size), np.zeros(y.size)
    engine.derivatives(y, dy, 1)
    limit.derivatives(y, c_dy, 1)
    require_agreement(f"One acceleration, {case}", dy, c_dy, WITHIN)
    times = in_turns(
        lambda: batch(lambda: limit.derivatives(y, c_dy, _CALLS), 1) / _CALLS,
        lambda: batch(lambda: engine.derivatives(y, dy, _CALLS), 1) / _CALLS,
        rounds,
    )
    engine.restore(state)
    limit.restore(c_state)
    return Comparison("one acceleration (baseline: hand-written C)", case, *times, least_ratio=1 / MOST_RATIO)


@entry
def _run(block: Array, torques: Array, step: float, first: int, count: int) -> int:
    """Communication steps in a compiled loop, as `engine_run` of engine.c."""
    for k in range(first, first + count):
        ports(block).inputs[0] = torques[k % 2]
        outcome = advance(block, k * step)
        if outcome != status.OK:
            return outcome
    return status.OK


@entry
def _read(block: Array, y: Array) -> None:
    state_at_time(block, y)


@entry
def _derivatives(block: Array, y: Array, dy: Array, count: int) -> None:
    feed(block, ports(block).held_inputs)
    for _ in range(count):
        derivative(block, y, dy)


def _require_ok(outcome: int) -> None:
    if outcome != status.OK:
        raise RuntimeError(status.ADVICE[outcome])
