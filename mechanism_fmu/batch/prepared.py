"""Preparation of a batch: what is the same for all designs, what is asked of them, and which are refused."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .. import codes
from ..fmu.native.formulas import Entry, entries
from ..model import Finding, Input, Mechanism, MechanismError, Model, Parameter, compile_mechanism
from ..model.model import check_value
from ..model.trace import Trace, trace
from ..tables.layout import field_of, pack, slot
from .numbers import Array, Column, Numbers

_FIRST_IMPACT = re.compile(r"impacts\[1\]\.(.+)")


@dataclass(frozen=True)
class Prepared:
    """A model's structure, and how its tables follow from parameters.

    Attributes:
        traced: from parameters to tables.
        mechanism: with the default values.
        given: its block before the first call, shape (words,).
        entries: the words of it that depend on a parameter.
        inputs: the word of each input, by name.
        outputs: the number of each output and calculated parameter, by name.
        impact_fields: the column of an impact record of each `impacts[1].<field>`, by field.
    """

    traced: Trace
    mechanism: Mechanism
    given: Array
    entries: tuple[Entry, ...]
    inputs: Mapping[str, int]
    outputs: Mapping[str, int]
    impact_fields: Mapping[str, int]


def prepared(model: Model) -> Prepared:
    """Make a model ready.

    Raises:
        MechanismError: its default values are refused, or it cannot be traced.
    """
    mechanism = model.build(model.values())
    block = pack(compile_mechanism(mechanism))
    traced = trace(model)
    first_input = int(block.view("int64")[slot("inputs")])
    names = [*(output.name for output in mechanism.outputs), *(value.name for value in mechanism.calculated)]
    outputs = {name: k for k, name in enumerate(names)}
    kinds, columns = (field_of(block, name).tolist() for name in ("output_kind", "output_index"))
    fields = {}
    for name, k in outputs.items():
        found = _FIRST_IMPACT.fullmatch(name)
        if found and kinds[k] == codes.BUFFERED_IMPACT:
            fields[found[1]] = columns[k]
    return Prepared(
        traced,
        mechanism,
        block,
        tuple(entries(traced, block)),
        {port.name: first_input + k for k, port in enumerate(mechanism.inputs)},
        outputs,
        fields,
    )


# Which designs cannot be, and why, before any of them moves: in the words of the FMU.

#: Message of each design that is refused, by its number.
Refusals = dict[int, str]


def out_of_limits(model: Model, inputs: Sequence[Input], designs: Mapping[str, Array]) -> Refusals:
    """Designs with a value that its parameter or input does not take.

    Args:
        model: with the limits of its parameters.
        inputs: of its mechanism.
        designs: columns by name; each is that of a parameter or an input.
    """
    refused: Refusals = {}
    ports: dict[str, Parameter | Input] = {p.name: p for p in model.parameters} | {i.name: i for i in inputs}
    for name, column in designs.items():
        port = ports[name]
        low = -np.inf if port.minimum is None else port.minimum
        high = np.inf if port.maximum is None else port.maximum
        wrong = ~((low <= column) & (column <= high) & np.isfinite(column))
        if isinstance(port, Parameter):
            whole, flag = port.type == "Integer", port.type == "Boolean"
            wrong |= (whole & (column != np.round(column))) | (flag & (column != 0.0) & (column != 1.0))
        for design in np.flatnonzero(wrong).tolist():
            refused.setdefault(design, _refusal(model, port, float(column[design])))
    return refused


def _refusal(model: Model, port: Parameter | Input, value: float) -> str:
    try:
        if isinstance(port, Parameter):
            model.checked({port.name: value})
        else:
            check_value(port, value)
    except MechanismError as error:
        return str(error)
    raise AssertionError(f"{port.name} = {value} is no mistake after all")


def impossible(traced: Trace, numbers: Numbers, entries: Sequence[Entry], designs: int) -> Refusals:
    """Designs to which the model objects, that a mechanism's check refuses, or that have no finite tables.

    Args:
        traced: the model's calculation.
        numbers: of the designs.
        entries: the tables' words that depend on a parameter.
        designs: how many there are.
    """
    objected = said_of(traced.objections, numbers, designs)
    return _not_finite(numbers, entries, designs) | said_of(traced.problems, numbers, designs) | objected


def said_of(findings: Sequence[Finding], numbers: Numbers, designs: int, between: str = " ") -> Refusals:
    """What findings say of designs, a text for each that any applies to, with `between` its parts."""
    said: dict[int, list[str]] = {}
    for finding, applies in zip(findings, numbers.of(f.applies for f in findings), strict=True):
        concerned = _where(np.greater(applies, 0.0), designs)
        if concerned:
            columns = [_spread(column, designs) for column in numbers.of(finding.numbers)]
            for design in concerned:
                shown = finding.text.format(*(float(column[design]) for column in columns))
                said.setdefault(design, []).append(shown)
    return {design: between.join(texts) for design, texts in said.items()}


def _not_finite(numbers: Numbers, entries: Sequence[Entry], designs: int) -> Refusals:
    refused: Refusals = {}
    columns = numbers.of(entry.value for entry in entries)
    if np.all(np.isfinite(np.concatenate([np.atleast_1d(column) for column in columns] or [np.empty(0)]))):
        return refused
    for entry, column in zip(entries, columns, strict=True):
        for design in _where(~np.isfinite(column), designs):
            refused.setdefault(design, f"The parameters make {entry.label} a number that is not finite; change them.")
    return refused


def _where(holds: Column, designs: int) -> Sequence[int]:
    """The designs for which something holds, which may be the same for all."""
    if np.ndim(holds):
        return np.flatnonzero(holds).tolist()
    return range(designs) if holds else ()


def _spread(column: Column, designs: int) -> Array:
    return np.broadcast_to(column, (designs,))


# What is asked of a batch, checked: names, lengths, times.


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
        sizes_given = ", ".join(f"{name} has {length}" for name, length in lengths.items())
        raise MechanismError(f"All columns must be of one length, but {sizes_given or 'there are none'}.")
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
