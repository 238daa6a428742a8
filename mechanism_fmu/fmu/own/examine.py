"""What can be known of a user's model before its FMU is built: mistakes, and what looks like one."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

from ...model import Calculated, Input, Mechanism, MechanismError, Model, Output, Parameter, compile_mechanism
from ...model.trace import trace
from ..contents import model_of
from ..drawing import drawing
from ..logic import logic
from ..model_description import model_description
from ..units import UnitError, parse_unit
from ..variables import variables_of
from .mistakes import explained
from .shape import check_mechanism, check_model

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
        mechanism = model.build(model.values())
        check_mechanism(mechanism)
        compile_mechanism(mechanism)
        _check_variables(model)
        model_description(model, "")
        drawing(model)
        logic(model)  # which calls the model's functions with other values than the default ones
        remarks = [*_degrees(model, mechanism), *_units(model, mechanism)]
    try:
        with explained(path):
            trace(model)
    except MechanismError as error:
        if native:
            raise
        remarks.append(f"as it is, it cannot be built with --flavour native. {error}")
    return [f"{path}: {remark}" for remark in remarks]


def _check_variables(model: Model) -> None:
    """Check the names of all variables: the FMU's, and its importers', have rules of their own."""
    seen: dict[str, str] = {}
    for variable in variables_of(model):
        label = f"{variable.causality.capitalize()} {variable.name!r}"
        if not _VARIABLE.fullmatch(variable.name):
            raise MechanismError(f"{label}: a variable's name must be of letters, digits and '_'; rename it.")
        if variable.name in seen:
            raise MechanismError(f"{label} has the name of another {seen[variable.name]}; rename one of the two.")
        seen[variable.name] = variable.causality


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


def _is_unit(text: str) -> bool:
    try:
        return bool(parse_unit(text))
    except UnitError:
        return False
