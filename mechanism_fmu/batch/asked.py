"""What is asked of a batch, checked: names, lengths, times."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..model import MechanismError
from .numbers import Array
from .prepared import Prepared
from .refusals import out_of_limits


def columns_of(ready: Prepared, designs: Mapping[str, ArrayLike]) -> dict[str, Array]:
    """The designs as columns of shape (designs,).

    Raises:
        MechanismError: an unknown name, or columns that are not of one length.
    """
    model = ready.traced.model
    known = {parameter.name for parameter in model.parameters} | ready.inputs.keys()
    columns = {name: np.array(column, float) for name, column in dict(designs).items()}
    for name, column in columns.items():
        if name not in known:
            raise MechanismError(
                f"{model.name} has no parameter or input {name!r}; it has: {', '.join(sorted(known))}."
            )
        if column.ndim != 1:
            raise MechanismError(f"{name} has the shape {column.shape}; give one number for each design.")
    lengths = {name: len(column) for name, column in columns.items()}
    if len(set(lengths.values())) != 1:
        told = ", ".join(f"{name} has {length}" for name, length in lengths.items())
        raise MechanismError(f"All columns must be of one length, but {told or 'there are none'}.")
    return columns


def signals_of(ready: Prepared, signals: Mapping[str, ArrayLike], steps: int) -> dict[str, Array]:
    """Signals of inputs as columns of shape (steps,).

    Raises:
        MechanismError: an unknown name, another length, or a value out of the input's limits.
    """
    name_of_model = ready.traced.model.name
    columns = {name: np.array(column, float) for name, column in signals.items()}
    for name, column in columns.items():
        if name not in ready.inputs:
            raise MechanismError(f"{name_of_model} has no input {name!r}; it has: {', '.join(ready.inputs)}.")
        if column.shape != (steps,):
            raise MechanismError(f"Signal {name} has the shape {column.shape}; give {steps} values, one a step.")
    refused = out_of_limits(ready.traced.model, ready.mechanism.inputs, columns)
    if refused:
        raise MechanismError(next(iter(refused.values())))
    return columns


def outputs_of(ready: Prepared, outputs: Iterable[str] | None) -> list[str]:
    """Names of the outputs and calculated parameters that are wanted; all, if None are named.

    Raises:
        MechanismError: an unknown name.
    """
    wanted = list(ready.outputs if outputs is None else outputs)
    for name in wanted:
        if name not in ready.outputs:
            raise MechanismError(
                f"{ready.traced.model.name} has no output {name!r}; it has: {', '.join(ready.outputs)}."
            )
    return wanted


def points_of(times: Sequence[float]) -> Array:
    """Start and ends of the communication steps [s], shape (steps + 1,).

    Raises:
        MechanismError: they are not finite and increasing, or fewer than two.
    """
    points = np.array(times, float)
    if points.ndim != 1 or len(points) < 2 or not np.all(np.isfinite(points)) or not np.all(np.diff(points) > 0):
        raise MechanismError(f"The times {times} must be finite, at least two, and each later than the one before.")
    return points
