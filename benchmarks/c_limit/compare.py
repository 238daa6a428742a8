"""The engine against the same algorithm in C: whole runs of the paper's base case, and one acceleration."""

from __future__ import annotations

import ctypes
from pathlib import Path

import numpy as np

import models
from mechanism_fmu import codes
from mechanism_fmu.engine import status
from mechanism_fmu.engine.compiler.subset import entry
from mechanism_fmu.engine.dynamics.acceleration import derivative
from mechanism_fmu.engine.dynamics.forces import feed
from mechanism_fmu.engine.run import library_path
from mechanism_fmu.engine.starting.begin import begin
from mechanism_fmu.engine.stepping.stepper import advance, state_at_time
from mechanism_fmu.fmu.native.objects import engine_libraries
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.tables.declare import Array
from mechanism_fmu.tables.layout import field_of, pack, state_of
from mechanism_fmu.tables.parts import Ports

from ..timing import Comparison, DisagreementError, batch, in_turns, require_agreement
from .library import STEP, Limit, NoCompilerError, build

#: Communication steps: 6 s of the paper's base case.
STEPS = 6000
#: Drive torques [N m], used in turns: one that stays, and two, so that the engine must drop what it has computed ahead.
DRIVES = {"constant input": (1e-3, 1e-3), "new input each step": (0.9e-3, 1.1e-3)}
#: The engine may take this many times as long as the C program.
MOST_RATIO = 1.15
#: The two differ by no more [SI units]. They sum in the same order, so that it is nothing where compilers agree.
WITHIN = 1e-11

#: Pairs of runs for each round of the other benchmarks: the ratio is asked for to a few percent.
_PAIRS = 10
_LOOK = 10
#: Steps in a run that is timed: some 3 ms, which a busy machine seldom interrupts.
_RUN = {"constant input": STEPS, "new input each step": 200}
_CALLS = 2000
#: Number of the communication step after which an acceleration is timed.
_INSTANTS = {"before impact": 200, "after impact": 1000}


class Engine:
    """The engine with the paper's base case, at time 0."""

    def __init__(self) -> None:
        model = models.load("ratchet").MODEL
        self.block: Array = pack(compile_mechanism(model.build(model.values())))
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

    def run(self, torques: Array, first: int, count: int) -> None:
        """Make `count` communication steps, from number `first` on, with two drive torques in turns."""
        _require_ok(_run(self.block, torques, STEP, first, count))

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


class EngineOfFmus(Engine):
    """The same engine as FMUs have it: compiled ahead of time, for any processor of this kind.

    Args:
        folder: to write its library into.
        limit: the C program, which has the loop that calls it.

    Raises:
        NoCompilerError: FMUs have none for this platform.
        MechanismError: it cannot be made here.
    """

    def __init__(self, folder: Path, limit: ctypes.CDLL) -> None:
        super().__init__()
        path = library_path(folder)
        if path is None:
            raise NoCompilerError("FMUs have no compiled engine for this platform.")
        path.write_bytes(engine_libraries()[path.name])
        self._advance = ctypes.cast(ctypes.CDLL(str(path)).engine_advance, ctypes.c_void_p)
        self._run = limit.other_run
        self._input = (field_of(self.block, "inputs").ctypes.data - self.block.ctypes.data) // self.block.itemsize

    def run(self, torques: Array, first: int, count: int) -> None:
        """Make `count` communication steps, from number `first` on, with two drive torques in turns."""
        at, words = self.block.ctypes.data, self.block.size
        _require_ok(self._run(self._advance, at, words, self._input, torques.ctypes.data, STEP, first, count))


def compare(folder: Path, rounds: int) -> list[Comparison]:
    """Compile the C program into `folder` and compare with the engine as numba compiles it here.

    Raises:
        NoCompilerError: there is no C compiler.
        DisagreementError: the two do not take the same steps to the same places.
    """
    library = build(folder)
    engine = Engine()
    limit = Limit(library, engine.block)
    steps = _steps("one 1 ms step", engine, limit, _PAIRS * rounds)
    return [*steps, *(_acceleration(when, engine, limit, _PAIRS * rounds) for when in _INSTANTS)]


def compare_with_fmus(folder: Path, rounds: int) -> list[Comparison]:
    """The same with the engine as FMUs have it; errors also as `EngineOfFmus`."""
    library = build(folder)
    engine = EngineOfFmus(folder, library)
    return _steps("one 1 ms step by the engine of FMUs", engine, Limit(library, engine.block), _PAIRS * rounds)


def require_same_motion(drive: str, engine: Engine, limit: Limit) -> None:
    """Go through the whole run side by side, with a look at all unknowns every 10 ms.

    Raises:
        DisagreementError: they differ, or have not made the same number of steps of their own.
    """
    torques = np.array(DRIVES[drive])
    for first in range(1, STEPS, _LOOK):
        engine.run(torques, first, _LOOK)
        limit.run(torques, first, _LOOK)
        when = f"Engine and C program, {drive}, {(first + _LOOK - 1) * STEP:g} s"
        require_agreement(when, engine.unknowns(), limit.unknowns(), WITHIN)
    require_agreement(f"Engine and C program, {drive}, impact", engine.impact_time, limit.impact_time, WITHIN)
    if engine.steps != limit.steps:
        raise DisagreementError(
            f"{drive}: the engine takes {engine.steps} steps of its own, the C program {limit.steps}."
        )


def _steps(subject: str, engine: Engine, limit: Limit, pairs: int) -> list[Comparison]:
    """The whole run, through the impact, side by side, with each drive."""
    return [_steps_with(drive, f"{subject} (baseline: hand-written C)", engine, limit, pairs) for drive in DRIVES]


def _steps_with(drive: str, subject: str, engine: Engine, limit: Limit, pairs: int) -> Comparison:
    torques, count = np.array(DRIVES[drive]), _RUN[drive]
    starts = engine.save(), limit.save()

    def span(program: Engine | Limit, first: int) -> float:
        return batch(lambda: program.run(torques, first, count), 1) / count

    require_same_motion(drive, engine, limit)
    times = []
    for _ in range(max(1, pairs * count // STEPS)):
        engine.restore(starts[0])
        limit.restore(starts[1])
        times += [(span(limit, first), span(engine, first)) for first in range(1, STEPS, count)]
    engine.restore(starts[0])
    limit.restore(starts[1])
    slow, fast = zip(*times, strict=True)
    return Comparison(subject, drive, slow, fast, least_ratio=1 / MOST_RATIO)


def _acceleration(when: str, engine: Engine, limit: Limit, pairs: int) -> Comparison:
    """The derivative at an instant: 7 rows before the impact, 8 after it."""
    torques = np.array(DRIVES["constant input"])
    starts = engine.save(), limit.save()
    for program in (engine, limit):
        program.run(torques, 1, _INSTANTS[when])
    y = engine.unknowns()
    dy, dy_limit = np.zeros(y.size), np.zeros(y.size)
    engine.derivatives(y, dy, 1)
    limit.derivatives(y, dy_limit, 1)
    require_agreement(f"One acceleration of engine and C program {when}", dy, dy_limit, WITHIN)
    times = in_turns(
        lambda: batch(lambda: limit.derivatives(y, dy_limit, _CALLS), 1) / _CALLS,
        lambda: batch(lambda: engine.derivatives(y, dy, _CALLS), 1) / _CALLS,
        pairs,
    )
    engine.restore(starts[0])
    limit.restore(starts[1])
    return Comparison("one acceleration (baseline: hand-written C)", when, *times, least_ratio=1 / MOST_RATIO)


@entry
def _run(block: Array, torques: Array, step: float, first: int, count: int) -> int:
    """Communication steps in a compiled loop, as `engine_run` of engine.c."""
    for k in range(first, first + count):
        Ports(block).inputs[0] = torques[k % 2]
        outcome = advance(block, k * step)
        if outcome != status.OK:
            return outcome
    return status.OK


@entry
def _read(block: Array, y: Array) -> None:
    state_at_time(block, y)


@entry
def _derivatives(block: Array, y: Array, dy: Array, count: int) -> None:
    feed(block, Ports(block).held_inputs)
    for _ in range(count):
        derivative(block, y, dy)


def _require_ok(outcome: int) -> None:
    if outcome != status.OK:
        raise RuntimeError(status.ADVICE[outcome])
