"""What an FMU says about itself: the part of modelDescription.xml that the harness needs."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .errors import UsageError
from .si import BASE_UNITS, Measure
from .units import Units

#: Value of a variable: Real, Integer, Boolean or String.
Value = float | int | bool | str


@dataclass(frozen=True)
class Variable:
    """One scalar variable.

    Attributes:
        name, description: as in the FMU.
        reference: its value reference.
        type: "Real", "Integer", "Boolean" or "String" (an Enumeration counts as Integer).
        causality: "input", "output", "parameter", "calculatedParameter", "local" or "independent".
        continuous: whether it varies continuously.
        unit, display_unit: "" when it has none, or the unit "1".
        start: its default value, as text; None when it has none.
        minimum, maximum: its limits in `unit`; None when it has none.
    """

    name: str
    reference: int
    type: str
    causality: str
    description: str = ""
    continuous: bool = False
    unit: str = ""
    display_unit: str = ""
    start: str | None = None
    minimum: float | None = None
    maximum: float | None = None

    @property
    def settable(self) -> bool:
        """Whether it may be set before the initialization."""
        return self.causality in ("input", "parameter")


@dataclass(frozen=True)
class Description:
    """One FMU.

    Attributes:
        model, guid, generation_tool, text: modelName, guid, generationTool and description of the FMU.
        identifier: name of its library.
        variables: by name, in the FMU's order.
        units: its unit definitions.
        stop_time, step: of its default experiment [s]; None when it gives none.
        saves_state, serializes_state, takes_slopes: its capability flags; the last is canInterpolateInputs.
        log_categories: by name, with what each is for.
    """

    model: str
    identifier: str
    guid: str
    variables: Mapping[str, Variable]
    units: Units = field(default_factory=Units)
    generation_tool: str = ""
    text: str = ""
    stop_time: float | None = None
    step: float | None = None
    saves_state: bool = False
    serializes_state: bool = False
    takes_slopes: bool = False
    log_categories: Mapping[str, str] = field(default_factory=dict)

    def variable(self, name: str) -> Variable:
        """The variable with this name.

        Raises:
            UsageError: there is none; the message suggests similar names.
        """
        if name in self.variables:
            return self.variables[name]
        raise UsageError(f"{self.model} has no variable '{name}'.{hint_at(name, self.variables)}")

    def of(self, *causalities: str) -> list[Variable]:
        """All variables of these causalities, in the FMU's order."""
        return [variable for variable in self.variables.values() if variable.causality in causalities]


def hint_at(name: str, known: Iterable[str]) -> str:
    """The sentence, after a space, that asks for the known names most like `name`; "" when there are none."""
    similar = difflib.get_close_matches(name, list(known), n=3)
    return f" Did you mean {' or '.join(similar)}?" if similar else ""


def read_description(path: Path) -> Description:
    """Read the description of the FMU file `path`.

    Raises:
        UsageError: no such file, not an FMU, or not an FMI 2.0 co-simulation FMU.
    """
    import fmpy

    if not path.is_file():
        raise UsageError(f"There is no FMU file '{path}'. Build one with: mechanism-fmu build ratchet -o build")
    try:
        raw = fmpy.read_model_description(str(path), validate=False)
    except Exception as error:  # fmpy raises whatever zipfile and lxml raise
        raise UsageError(f"'{path}' cannot be read as an FMU: {error}") from error
    if raw.fmiVersion != "2.0" or raw.coSimulation is None:
        raise UsageError(
            f"'{path}' is not an FMI 2.0 co-simulation FMU (its FMI version is {raw.fmiVersion}); "
            "the harness runs no other kind."
        )
    return _described(raw)


def _described(raw: Any) -> Description:
    variables = [_variable(v) for v in raw.modelVariables]
    experiment = raw.defaultExperiment
    return Description(
        model=raw.modelName,
        identifier=raw.coSimulation.modelIdentifier,
        guid=raw.guid,
        variables={variable.name: variable for variable in variables},
        units=_units(raw.unitDefinitions),
        generation_tool=raw.generationTool or "",
        text=raw.description or "",
        stop_time=_number(experiment and experiment.stopTime),
        step=_number(experiment and experiment.stepSize),
        saves_state=raw.coSimulation.canGetAndSetFMUstate,
        serializes_state=raw.coSimulation.canSerializeFMUstate,
        takes_slopes=raw.coSimulation.canInterpolateInputs,
        log_categories={category.name: category.description or "" for category in raw.logCategories},
    )


def _variable(raw: Any) -> Variable:
    declared = raw.declaredType

    def attribute(name: str) -> Any:
        own = getattr(raw, name)
        return own if own is not None or declared is None else getattr(declared, name)

    return Variable(
        name=raw.name,
        reference=raw.valueReference,
        type="Integer" if raw.type == "Enumeration" else raw.type,
        causality=raw.causality or "local",
        description=raw.description or "",
        continuous=raw.type == "Real" and raw.variability in (None, "continuous"),
        unit="" if attribute("unit") in (None, "1") else attribute("unit"),
        display_unit=attribute("displayUnit") or "",
        start=raw.start,
        minimum=_number(attribute("min")),
        maximum=_number(attribute("max")),
    )


def _units(definitions: Iterable[Any]) -> Units:
    defined, displayed = {}, {}
    for unit in definitions:
        base = unit.baseUnit
        if base is not None:
            defined[unit.name] = Measure(tuple(getattr(base, name) for name in BASE_UNITS), base.factor, base.offset)
        displayed[unit.name] = {display.name: (display.factor, display.offset) for display in unit.displayUnits}
    return Units(defined, displayed)


def _number(text: str | None) -> float | None:
    return None if text is None else float(text)
