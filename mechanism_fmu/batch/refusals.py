"""Which designs cannot be, and why, before any of them moves: in the words of the FMU."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ..fmu.native.entries import Entry
from ..model import Finding, Input, MechanismError, Model, Parameter
from ..model.model import check_value
from ..model.trace import Trace
from .numbers import Array, Column, Numbers

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
