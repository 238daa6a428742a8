"""Whether a saved state from outside is one that its model can be in: asked before anything of it is used."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..admissible import Admissible
from ..model import MechanismError
from ..model.model import check_value
from .protocol import LATEST_START, SAME_TIME, Phase
from .saved_state import SavedState, SavedStateError
from .variables import Variable


class CheckedState(bytes):
    """A saved state that a slave has made itself, or whose contents have been checked."""


@dataclass(frozen=True)
class Contents:
    """What a model's saved states may hold.

    Attributes:
        parameters, inputs: of the model, in their order.
        state: what the engine's state may hold.
    """

    parameters: tuple[Variable, ...]
    inputs: tuple[Variable, ...]
    state: Admissible


def check_contents(state: SavedState, contents: Contents) -> None:
    """Check a decoded state.

    Raises:
        SavedStateError: it cannot have been saved, with what it holds where.
    """
    for variables, values in ((contents.parameters, state.parameters), (contents.inputs, state.inputs)):
        if len(variables) != len(values):
            raise _impossible(f"it has {len(values)} values for {len(variables)} variables")
    _check_head(state)
    for variable, value in zip(contents.parameters, state.parameters, strict=True):
        _check_parameter(variable, value)
    for variable, value in zip(contents.inputs, state.inputs, strict=True):
        _check_input(variable, value)
    fault = contents.state.fault(state.words) if state.words else None
    if fault is not None:
        raise _impossible(fault)


def _impossible(fault: str) -> SavedStateError:
    return SavedStateError(f"The saved state is not one that this model can be in: {fault}.")


def _check_head(state: SavedState) -> None:
    phase, times = state.phase.name.lower(), state.experiment
    if state.phase >= Phase.STEPPING and not state.words:
        raise _impossible(f"it is in phase {phase}, but did not begin")
    if state.phase is not Phase.INSTANTIATED and times is None:
        raise _impossible(f"it is in phase {phase}, but was not set up")
    if times is None:
        return
    if not (abs(times.start_time) <= LATEST_START and times.start_time <= times.stop_time and times.tolerance > 0):
        experiment = f"from {times.start_time:g} s to {times.stop_time:g} s with tolerance {times.tolerance:g}"
        raise _impossible(f"its experiment is {experiment}")


def _check_parameter(variable: Variable, value: float) -> None:
    try:
        check_value(variable, value)
    except MechanismError as error:
        raise _impossible(str(error).removesuffix(".")) from error
    if (variable.type == "Integer" and value != int(value)) or (variable.type == "Boolean" and value not in (0, 1)):
        raise _impossible(f"{variable.name} is {value:g}, which is no {variable.type}")


def _check_input(variable: Variable, value: float) -> None:
    low = -math.inf if variable.minimum is None else variable.minimum
    high = math.inf if variable.maximum is None else variable.maximum
    rounding = SAME_TIME * max(1.0, abs(value))  # an input with a slope may end beyond its limit by so much
    if not (math.isfinite(value) and low - rounding <= value <= high + rounding):
        raise _impossible(f"{variable.name} is {value:g}, which is not within its limits, {low:g} to {high:g}")
