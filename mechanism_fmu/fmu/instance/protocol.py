"""The rules of the FMI calls (FMI 2.0.4, 4.2.4), and what the pythonfmu wrapper (0.7.0) leaves to the slave."""

from __future__ import annotations

import ctypes
import functools
import math
import sys
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, TypeVar

# The rules of the FMI calls: which are allowed when, and what a communication step may be (FMI 2.0.4, 4.2.4).

#: A communication point may differ from the time reached by this [s], by 1 % of the step, and by some rounding.
SAME_TIME = 1e-9
SAME_TIME_OF_STEP = 0.01
ROUNDINGS = 8
#: Beyond this the clock itself resolves no more than 2e-6 s.
LATEST_START = 1e10
#: The engine's tightest relative tolerance.
TIGHTEST = 1e-13


class Phase(IntEnum):
    """The states of a slave."""

    INSTANTIATED = 0
    INITIALIZATION = 1
    STEPPING = 2
    TERMINATED = 3


class FmiError(RuntimeError):
    """A call or a value that is refused; the message is for the user."""


@dataclass(frozen=True)
class Experiment:
    """What fmi2SetupExperiment says.

    Attributes:
        start_time: [s].
        stop_time: [s], infinite when not defined; no step may end later.
        tolerance: relative, infinite when not defined.
    """

    start_time: float
    stop_time: float = math.inf
    tolerance: float = math.inf


def experiment(start_time: float, stop_time: float | None, tolerance: float | None) -> Experiment:
    """The experiment for the arguments of fmi2SetupExperiment: times [s], relative tolerance; None where undefined.

    Raises:
        FmiError: an argument that cannot be.
    """
    if not abs(start_time) <= LATEST_START:
        raise FmiError(
            f"fmi2SetupExperiment: the start time {start_time:g} s must be finite and within +-{LATEST_START:g} s, "
            "where the clock still resolves microseconds."
        )
    if stop_time is not None and not start_time <= stop_time < math.inf:
        raise FmiError(
            f"fmi2SetupExperiment: the stop time {stop_time:g} s must be finite and not before the start time "
            f"{start_time:g} s."
        )
    if tolerance is not None and not 0 < tolerance < math.inf:
        raise FmiError(f"fmi2SetupExperiment: the tolerance {tolerance:g} must be positive and finite.")
    return Experiment(
        start_time,
        math.inf if stop_time is None else stop_time,
        math.inf if tolerance is None else tolerance,
    )


def require(phase: Phase, allowed: tuple[Phase, ...], call: str) -> None:
    """Check that `call` is allowed in `phase`.

    Raises:
        FmiError: it is not.
    """
    if phase not in allowed:
        names = " or ".join(one.name.lower() for one in allowed)
        raise FmiError(f"{call} is not allowed now: the instance is in state {phase.name.lower()}, not {names}.")


def step_target(reached: float, current_time: float, step_size: float, stop_time: float) -> float:
    """The end of a communication step [s].

    Args:
        reached: end of the last step [s].
        current_time: where the host says the step begins [s].
        step_size: its length [s].
        stop_time: of the experiment [s].

    Raises:
        FmiError: the step does not begin where the last one ended, does not lead forward, or leads past the stop time.
    """
    if not math.isfinite(current_time) or not math.isfinite(step_size):
        raise FmiError(f"fmi2DoStep: time {current_time:g} s or step size {step_size:g} s is not a finite number.")
    if not step_size > 0:
        raise FmiError(f"fmi2DoStep: step size {step_size:g} s must be positive; to go back, restore a saved state.")
    rounding = ROUNDINGS * math.ulp(reached)
    if abs(current_time - reached) > rounding + min(SAME_TIME, SAME_TIME_OF_STEP * step_size):
        raise FmiError(
            f"fmi2DoStep: the communication point {current_time:.12g} s is not the time reached, {reached:.12g} s; "
            "steps follow each other without gap, and a step back needs a saved state."
        )
    target = current_time + step_size
    if not target > reached:
        raise FmiError(
            f"fmi2DoStep: step size {step_size:g} s is lost in rounding at {reached:.12g} s; take larger steps."
        )
    if target > stop_time + SAME_TIME * max(1.0, abs(stop_time)):
        raise FmiError(
            f"fmi2DoStep: the step to {target:.12g} s leads past the stop time {stop_time:.12g} s that the "
            "host has given; end there, or give a later stop time or none."
        )
    return target


# What the pythonfmu wrapper (0.7.0) leaves to the slave: surviving an exception.
#
# When a slave's method raises, the wrapper reports fmi2Fatal and releases its references to the slave's class, instance
# and log queue, and goes on using them: the next call, or freeing the instance, would crash the host. Giving it one
# reference more for each that it will release keeps the instance usable, so that the host can read, reset and free it.

_Method = TypeVar("_Method", bound=Callable[..., Any])


def survive_release(*objects: object) -> None:
    """Add a reference to each object, which the wrapper is about to release once too often."""
    for one in objects:
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(one))


def fmi_call(method: _Method) -> _Method:
    """Decorate a slave's method that the wrapper calls: any exception is logged, and survived."""

    @functools.wraps(method)
    def guarded(slave: Any, *args: Any) -> Any:
        try:
            return method(slave, *args)
        except Exception as error:
            slave.report(error)
            survive_release(type(slave), slave, slave.log_queue)
            raise

    return guarded  # type: ignore[return-value]


def place_of(error: Exception) -> str:
    """Where an exception was raised, as " at file:line"; "" where that is not known."""
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    return "" if trace is None else f" at {trace.tb_frame.f_code.co_filename}:{trace.tb_lineno}"


#: References to a text while `PassedTexts.release` looks at it: the list's, the variable's, the argument's.
_HELD_HERE = 3


class PassedTexts:
    """Log messages that the wrapper has passed on to the host.

    The wrapper (pythonfmu 0.7.0) takes a reference to the text of each message and never releases it, so that a long
    run with many impacts would grow without end.
    """

    def __init__(self) -> None:
        self._texts: list[str] = []

    def add(self, text: str) -> None:
        """Remember a text that has been put into the wrapper's queue."""
        self._texts.append(text)

    def release(self) -> None:
        """Release the wrapper's references; the queue must be empty, which it is when the wrapper has read it."""
        for text in self._texts:
            if sys.getrefcount(text) > _HELD_HERE:
                ctypes.pythonapi.Py_DecRef(ctypes.py_object(text))
        self._texts.clear()
