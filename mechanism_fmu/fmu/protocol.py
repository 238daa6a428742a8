"""The rules of the FMI calls: which are allowed when, and what a communication step may be (FMI 2.0.4, 4.2.4)."""

from __future__ import annotations

import math
from enum import IntEnum

#: A communication point may differ from the time reached by this fraction of max(1 s, |t|): rounding of the host.
_SAME_TIME = 1e-9


class Phase(IntEnum):
    """The states of a slave."""

    INSTANTIATED = 0
    INITIALIZATION = 1
    STEPPING = 2
    TERMINATED = 3


class FmiError(RuntimeError):
    """A call or a value that is refused; the message is for the user."""


def require(phase: Phase, allowed: tuple[Phase, ...], call: str) -> None:
    """Check that `call` is allowed in `phase`.

    Raises:
        FmiError: it is not.
    """
    if phase not in allowed:
        names = " or ".join(one.name.lower() for one in allowed)
        raise FmiError(f"{call} is not allowed now: the instance is in state {phase.name.lower()}, not {names}.")


def step_target(reached: float, current_time: float, step_size: float) -> float:
    """The end of a communication step [s].

    Args:
        reached: end of the last step [s].
        current_time: where the host says the step begins [s].
        step_size: its length [s].

    Raises:
        FmiError: the step does not begin where the last one ended, or does not lead forward.
    """
    if not math.isfinite(current_time) or not math.isfinite(step_size):
        raise FmiError(f"fmi2DoStep: time {current_time} s or step size {step_size} s is not a finite number.")
    if not step_size > 0:
        raise FmiError(f"fmi2DoStep: step size {step_size:g} s must be positive; to go back, restore a saved state.")
    if abs(current_time - reached) > _SAME_TIME * max(1.0, abs(reached)):
        raise FmiError(
            f"fmi2DoStep: the communication point {current_time:.12g} s is not the time reached, {reached:.12g} s; "
            "steps follow each other without gap, and a step back needs a saved state."
        )
    target = current_time + step_size
    if not target > reached:
        raise FmiError(
            f"fmi2DoStep: step size {step_size:g} s is lost in rounding at {reached:.12g} s; take larger steps."
        )
    return target
