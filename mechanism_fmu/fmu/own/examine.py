"""Examination of a user's model before its FMU is built: mistakes, and what looks like one."""

from __future__ import annotations

import math
import re
import types
import warnings
from collections.abc import Callable, Iterable, Iterator
from dataclasses import fields, is_dataclass
from pathlib import Path
from types import ModuleType
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

from ...model import Calculated, Input, Mechanism, MechanismError, Model, Output, Parameter, compile_mechanism
from ...model.attached import OldFormWarning
from ...model.case_values import case_values
from ...model.curves.measured import remark_on
from ...model.functions import is_plain
from ...model.trace import trace
from ..parts.contents import model_of
from ..parts.fmi_units import UnitError, parse_unit
from ..parts.model_description import model_description
from ..parts.resources import drawing, logic
from ..parts.variables import variables_of
from .mistakes import explained

# Whether the parts of a user's mechanism are of the right kind: a tuple, a text, a number, a point.
#
# The records of the package `model` do not ask, because type checkers do; a user's file comes without one.

#: Longest value that is shown in full.
_LONGEST = 60


def check_model(model: Model) -> None:
    """Check the fields of a model and its parameters.

    Raises:
        MechanismError: one is of the wrong kind.
    """
    _refuse(_whole(model))
    _refuse(problem for parameter in model.parameters for problem in _part(parameter))
    _refuse(problem for case in model.cases for problem in _part(case))


def check_mechanism(mechanism: object) -> None:
    """Check what a model's function gives for plain numbers, with the fields of all parts.

    Raises:
        MechanismError: it is no mechanism, or one of its parts is of the wrong kind.
    """
    if not isinstance(mechanism, Mechanism):
        what = "nothing" if mechanism is None else f"a {type(mechanism).__name__}"
        raise MechanismError(f"the function of MODEL returns {what}; end it with: return Mechanism(bodies=..., ...)")
    _refuse(_whole(mechanism))
    values = (getattr(mechanism, field.name) for field in fields(mechanism))
    parts = (part for value in values if isinstance(value, tuple) for part in value if is_dataclass(part))
    _refuse(problem for part in parts for problem in _part(part))


def _refuse(problems: Iterable[str]) -> None:
    """The first problem is enough: the others often follow from it."""
    for problem in problems:
        raise MechanismError(problem)


def _whole(record: Model | Mechanism) -> Iterator[str]:
    """What is wrong with the fields of a model or a mechanism: single values, and tuples of parts."""
    label = type(record).__name__
    for name, hint in get_type_hints(type(record)).items():
        value = getattr(record, name)
        if get_origin(hint) is not tuple:
            if not _fits(value, hint):
                yield f"{label}: {name} is {_shown(value)}, but it must be {_words(hint)}."
        elif not isinstance(value, tuple):
            what = type(value).__name__
            yield (
                f"{label}: {name} is a {what}, but it must be a tuple: write {name}=(..., ...) in round brackets, and "
                f"of a single entry {name}=(...,) with a comma."
            )
        else:
            kind = get_args(hint)[0]
            for entry in value:
                if not _fits(entry, kind):
                    yield f"{label}: {name} holds {_shown(entry)}, but each entry must be {_words(kind)}."


def _part(part: Any) -> Iterator[str]:
    """What is wrong with the fields of one part."""
    hints = get_type_hints(type(part))
    names = [field.name for field in fields(part)]
    for name in names:
        value = getattr(part, name)
        if not _fits(value, hints[name]):
            yield (
                f"{type(part).__name__} {getattr(part, 'name', '')!r}: {name} is {_shown(value)}, but it must be "
                f"{_words(hints[name])}. The order is: {', '.join(names)}."
            )


def _fits(value: Any, hint: Any) -> bool:
    """Whether a value is of the kind that an annotation asks for; it is of any kind that is not known here."""
    kind, arguments = get_origin(hint), get_args(hint)
    if hint in (Any, float):
        return is_plain(value)
    if kind in (Union, types.UnionType):
        return any(_fits(value, argument) for argument in arguments)
    if kind is Literal:
        return value in arguments
    if kind is Callable:
        return callable(value)
    if kind is tuple:
        if isinstance(value, str) or not hasattr(value, "__len__"):
            return False
        kinds = [arguments[0]] * len(value) if arguments[1:] == (Ellipsis,) else arguments
        return len(value) == len(kinds) and all(map(_fits, value, kinds))
    return not isinstance(hint, type) or isinstance(value, hint)


def _words(hint: Any) -> str:
    """What an annotation asks for."""
    kind, arguments = get_origin(hint), get_args(hint)
    if hint in (Any, float):
        return "a number"
    if hint in (str, type(None)):
        return "a text" if hint is str else "None"
    if kind in (Union, types.UnionType):
        return " or ".join(map(_words, arguments))
    if kind is Literal:
        return " or ".join(map(repr, arguments))
    if kind is Callable:
        return "a function"
    if kind is tuple and arguments[1:] == (Ellipsis,):
        return f"a tuple, in which each entry is {_words(arguments[0])}"
    if kind is tuple:
        return f"{len(arguments)} numbers in brackets, ({', '.join(['0.0'] * len(arguments))})"
    return f"a {getattr(hint, '__name__', hint)}"


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= _LONGEST else f"{type(value).__name__} {getattr(value, 'name', '')!r}"


#: A name of a variable as FMI structures them: "angle", "impacts[1].time".
_VARIABLE = re.compile(r"[A-Za-z_]\w*(\[\d+\])?(\.[A-Za-z_]\w*(\[\d+\])?)*", re.ASCII)

#: More than a turn is more likely meant in degrees.
_TURN = 2 * math.pi

_Port = Parameter | Input | Output | Calculated


def examine(module: ModuleType, path: Path, native: bool) -> list[str]:
    """Examine the model of a user's file with the default values of its parameters.

    Args:
        module: of `load`.
        path: of the file.
        native: the FMU is to be a native one, which refuses what pythonfmu's takes: what cannot be traced.

    Returns:
        Warnings.

    Raises:
        MechanismError: a mistake, with file and, where it is known, line.
    """
    with explained(path):
        model: Model = module.MODEL
        check_model(model)
        model_of(module)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always", OldFormWarning)
            mechanism = model.build(model.values())
        check_mechanism(mechanism)
        compile_mechanism(mechanism)
        for case in model.cases:
            case_values(model, case)
        _check_variables(model)
        model_description(model, "")
        drawing(model)
        logic(model)  # which calls the model's functions with other values than the default ones
        remarks = [*_degrees(model, mechanism), *_units(model, mechanism), *_measured(mechanism)]
    try:
        with explained(path):
            trace(model)
    except MechanismError as error:
        if native:
            raise
        remarks.append(f"as it is, it cannot be shown by `page`, nor built with --flavour native. {error}")
    remarks += _old_form(said, path)
    return [f"{path}: {remark}" for remark in remarks]


def _check_variables(model: Model) -> None:
    """Check the names of all variables: the FMU's, and its importers', have rules of their own."""
    seen: dict[str, str] = {}
    for variable in variables_of(model):
        label = f"{variable.causality.capitalize()} {variable.name!r}"
        if not _VARIABLE.fullmatch(variable.name):
            raise MechanismError(f"{label}: a variable's name must be of letters, digits and '_'; rename it.")
        if variable.name == "time":
            raise MechanismError(f"{label}: tables and FMUs have a column of time by that name; rename it.")
        if variable.name in seen:
            raise MechanismError(f"{label} has the name of another {seen[variable.name]}; rename one of the two.")
        seen[variable.name] = variable.causality


def _old_form(said: list[warnings.WarningMessage], path: Path) -> Iterator[str]:
    """The first part of the file that is written in the old form; other warnings go on as they came."""
    old: dict[str, int] = {}  # each part once, though the model's function is called for symbols, too
    for one in said:
        if not issubclass(one.category, OldFormWarning):
            warnings.warn_explicit(one.message, one.category, one.filename, one.lineno)
        elif one.filename == str(path):
            old.setdefault(str(one.message), one.lineno)
    if old:
        more = f" So are {len(old) - 1} more." if len(old) > 1 else ""
        message, line = next(iter(old.items()))
        yield f"line {line}: {message}{more}"


def _degrees(model: Model, mechanism: Mechanism) -> Iterator[str]:
    """Angles that look like degrees."""
    angles: list[tuple[str, Any]] = [
        (f"Body {body.name!r}: its start angle", body.start[2]) for body in mechanism.bodies
    ]
    for part in (*mechanism.forces, *mechanism.contacts):
        for name in ("angle", "free_angle"):
            angles.append((f"{type(part).__name__} {part.name!r}: its {name}", getattr(part, name, 0.0)))
    starts: tuple[Parameter | Input, ...] = (*model.parameters, *mechanism.inputs)
    for port in starts:
        angles += [(f"{port.name}: its start value", port.start)] if port.unit == "rad" else []
    for what, angle in angles:
        if abs(angle) > _TURN:
            yield (
                f"{what} is {angle:g} rad, more than a turn. Angles are in radians: if you mean {angle:g} degrees, "
                f"write math.radians({angle:g})."
            )


def _units(model: Model, mechanism: Mechanism) -> Iterator[str]:
    """Units that are none of the SI, and descriptions that look like a unit."""
    given: tuple[_Port, ...] = (*model.parameters, *mechanism.inputs)
    for port in (*given, *mechanism.outputs, *mechanism.calculated):
        if parse_unit(port.unit).factor != 1.0:
            yield (
                f"{port.name} has the unit {port.unit!r}, but the mechanism calculates in SI units and does not "
                "convert. Give the SI unit (rad, m, kg, N.m, ...), and this one as display_unit."
            )
        if port.unit == "1" and port.description and not isinstance(port, Output) and _is_unit(port.description):
            yield (
                f"{port.name} has the description {port.description!r}, which looks like a unit; the description "
                "comes before the unit."
            )


def _measured(mechanism: Mechanism) -> Iterator[str]:
    """Motions and profiles through measured points whose curvature is noise."""
    joints = [(joint, joint.motion) for joint in mechanism.joints]
    contacts = [(contact, profile) for contact in mechanism.contacts for profile in contact.profiles]
    for part, curve in (*joints, *contacts):
        remark = None if curve is None else remark_on(curve)
        if remark is not None:
            yield f"{type(part).__name__} {part.name!r}: its curve {remark}"


def _is_unit(text: str) -> bool:
    try:
        return bool(parse_unit(text))
    except UnitError:
        return False
