"""A model's tables, objections, problems and warnings as one recorded calculation: for targets without Python."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np

from .checks.check_numbers import number_findings
from .compile import Array, MechanismTables, compile_mechanism, compile_tables
from .errors import MechanismError, place_of
from .findings import Finding, where
from .functions import Number, where_positive
from .mechanism import Mechanism
from .model import Model
from .ports import Parameter
from .symbol import APPLY, Limits, Operation, Recorder, Symbol


@dataclass(frozen=True)
class Trace:
    """What a model calculates from its parameters.

    Numbers in `tables` and the findings are `Symbol`s where they depend on a parameter; the `number` of a
    symbol is that of the operation in `operations` that gives it.

    Attributes:
        model: what was traced.
        mechanism: the mechanism with symbolic numbers: its parts in the order of the tables' rows.
        operations: in an order in which they can be carried out; some may be needed for nothing.
        tables: of dtype object where a number is symbolic.
        objections: as the model gives them, and what helpers such as `dyad` refuse while the mechanism is made; each
            in its turn, so that those apply that the model itself would end with.
        warnings: as the model gives them.
        problems: those of the mechanism's numbers (`number_findings`) that depend on parameters and that no
            limits of a parameter exclude.
    """

    model: Model
    mechanism: Mechanism
    operations: tuple[Operation, ...]
    tables: MechanismTables
    objections: tuple[Finding, ...]
    problems: tuple[Finding, ...]
    warnings: tuple[Finding, ...]

    def evaluate(self, values: SimpleNamespace) -> MechanismTables:
        """The tables for parameter values, carried out operation by operation.

        Raises:
            ValueError, ZeroDivisionError: where the model's own functions do, because a result does not exist.
        """
        tables = {name: table for name, table in self.tables.columns.items() if table.dtype == object}
        numbers = iter(self.numbers([x for table in tables.values() for x in table.flat], values))
        plain: dict[str, Any] = {
            name: np.fromiter(numbers, np.float64, table.size).reshape(table.shape) for name, table in tables.items()
        }
        return replace(self.tables, columns={**self.tables.columns, **plain})

    def needed(self, numbers: Iterable[Number], known: Collection[int] = ()) -> list[int]:
        """The operations, in order, on which numbers depend; plain numbers depend on none.

        Args:
            numbers: recorded ones.
            known: operations whose results are there already; what only these depend on is left out, as they are.
        """
        needed = {x.number for x in numbers if isinstance(x, Symbol) and x.number not in known}
        for number in range(max(needed, default=-1), -1, -1):
            if number in needed:
                needed.update(operand for operand in self.operations[number].operands if operand not in known)
        return sorted(needed)

    def numbers(self, wanted: Iterable[Number], values: SimpleNamespace) -> list[float]:
        """Recorded numbers for parameter values; plain numbers are themselves.

        Raises:
            ValueError, ZeroDivisionError: as of `evaluate`.
        """
        wanted = list(wanted)
        given = [float(getattr(values, parameter.name)) for parameter in self.model.parameters]
        known: dict[int, float] = {}
        for number in self.needed(wanted):
            operation = self.operations[number]
            if operation.name == "parameter":
                known[number] = given[int(operation.value)]
            elif operation.name == "constant":
                known[number] = operation.value
            else:
                known[number] = APPLY[operation.name](*(known[i] for i in operation.operands))
        return [known[x.number] if isinstance(x, Symbol) else float(x) for x in wanted]


def trace(model: Model) -> Trace:
    """Record what a model calculates from its parameters.

    Raises:
        MechanismError: the model branches on a parameter, or an integer table or a table's shape depends on one.
    """
    recorder = Recorder()
    values = SimpleNamespace(
        **{p.name: recorder.parameter(i, _limits(p), p.start) for i, p in enumerate(model.parameters)}
    )
    plain = compile_mechanism(model.build(model.values()))
    try:
        mechanism = model.mechanism(values)
        tables = compile_tables(mechanism)
        made = len(recorder.refusals)
        own, warnings = tuple(model.objections(values)), tuple(model.warnings(values))
    except (ArithmeticError, AttributeError, MechanismError, TypeError, ValueError) as error:
        raise MechanismError(f"{model.name} cannot be traced, {place_of(error)}: {error}") from error
    _check_structure(model, tables.columns, plain.columns)
    # A model's objections are asked before its mechanism is made; what is refused within either is said alone.
    within, making = recorder.refusals[made:], recorder.refusals[:made]
    objections = _in_turn(*((f,) for f in within), own, *((f,) for f in making))
    # What depends on no parameter, or only on one whose limits exclude it, is not asked again.
    problems = tuple(f for f in number_findings(mechanism) if isinstance(f.applies, Symbol))
    traced = Trace(model, mechanism, tuple(recorder.operations), tables, objections, problems, warnings)
    _check_numbers(traced, plain)
    return traced


def _in_turn(*groups: tuple[Finding, ...]) -> tuple[Finding, ...]:
    """The findings of all groups, each applying only where none of an earlier group does."""
    silent: Number = 1.0
    before: tuple[Finding, ...] = ()
    found: list[Finding] = []
    for group in groups:
        for finding in before:
            silent = where_positive(finding.applies, 0.0, silent)
        found += where(silent, *group)
        before = group
    return tuple(found)


def _check_numbers(traced: Trace, plain: MechanismTables) -> None:
    """With the default values, the trace must give the model's numbers; else the model has looked at types."""
    again = traced.evaluate(traced.model.values()).columns
    for name, table in plain.columns.items():
        if not np.array_equal(again[name], table, equal_nan=table.dtype == np.float64):
            raise MechanismError(
                f"{traced.model.name}: with symbols instead of numbers the table {name} comes out differently; "
                "calculate it by plain arithmetic and mechanism_fmu.model.functions alone."
            )


def _limits(parameter: Parameter) -> Limits:
    if parameter.type == "Boolean":
        return Limits(0.0, 1.0, whole=True)
    low = -math.inf if parameter.minimum is None else parameter.minimum
    high = math.inf if parameter.maximum is None else parameter.maximum
    return Limits(low, high, whole=parameter.type == "Integer")


def _check_structure(model: Model, tables: Mapping[str, Array], plain: Mapping[str, Array]) -> None:
    for name, table in tables.items():
        integer = plain[name].dtype == np.int64
        if integer and table.dtype == object:
            raise MechanismError(
                f"{model.name}: the table {name} holds structure, but depends on a parameter; "
                "let parameters change numbers only (a part is switched off by its `enabled`)."
            )
        if table.shape != plain[name].shape or (integer and not np.array_equal(table, plain[name])):
            raise MechanismError(f"{model.name}: the table {name} is not the same at every call; build the same parts.")
