"""Reads an FMU's modelDescription.xml, by way of fmpy, and refuses a damaged one."""

from __future__ import annotations

import math
import re
import zipfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from itertools import product
from os.path import isfile
from pathlib import Path
from typing import Any

from mechanism_fmu.fmu.disk.folders import unsafe_name

from ..errors import UsageError
from .declared import read_declared
from .description import Description, Variable
from .terminals import read_terminals
from .units import BASE_UNITS, Measure, Units

#: Value references are unsigned numbers of 32 bits in both standards.
_LARGEST_REFERENCE = 2**32 - 1
#: Of all variables of an FMU together; one of a million takes seconds to read.
_MOST_ELEMENTS = 1_000_000
_FILE_NAME = re.compile(r"[^/\\:\x00-\x1f]{1,200}")
#: Letters of a reason that are shown.
_LONGEST_REASON = 300


def read_description(path: Path, exchange: bool = False) -> Description:
    """Read the description of the FMU file `path`.

    Args:
        path: of the file.
        exchange: whether its interface for Model Exchange is wanted; one that has no other is described by that anyway.

    Raises:
        UsageError: no such file, not an FMU, or not one of FMI 2.0 or 3.0 with the interface that is wanted.
    """
    import fmpy

    if not isfile(path):
        raise UsageError(f"There is no FMU file '{path}'. Build one with: mechanism-fmu build ratchet -o build")
    try:
        _require_safe_names(path)
        with open(path, "rb") as file:  # fmpy would leave a damaged one open
            raw = fmpy.read_model_description(file, validate=False)
        terminals = read_terminals(path)
    except Exception as error:  # fmpy raises whatever zipfile, lxml and its own conversions raise
        raise damaged(path, error) from error
    version = raw.fmiVersion.partition(".")[0]
    exchange = exchange or (raw.coSimulation is None and raw.modelExchange is not None)
    if version not in ("2", "3") or (raw.modelExchange if exchange else raw.coSimulation) is None:
        kinds = {
            "Co-Simulation": raw.coSimulation,
            "Model Exchange": raw.modelExchange,
            "Scheduled Execution": raw.scheduledExecution,
        }
        has = " and ".join(kind for kind, there in kinds.items() if there is not None) or "no interface that is known"
        wanted = "Model Exchange" if exchange else "Co-Simulation or Model Exchange"
        raise UsageError(
            f"'{path}' is not an FMU for {wanted} of FMI 2.0 or 3.0: it has {has} only, of FMI {raw.fmiVersion}. "
            f"The harness runs no other kind; export it again{_WAY_OUT if exchange else ''}."
        )
    try:
        described = replace(_described(raw, int(version), exchange), terminals=terminals)
        return replace(described, analysis=read_declared(path, described.variables))
    except (ValueError, TypeError, AttributeError, OverflowError) as error:  # a text where a number should be, ...
        raise damaged(path, error) from error


_WAY_OUT = ", or leave --integrator out; of this project's FMUs the native flavour has Model Exchange"


def damaged(path: Path, error: Exception) -> UsageError:
    """What to raise for the FMU file `path` that cannot be used for this reason: one line, with the way out."""
    reason = " ".join(str(error).split()) or type(error).__name__
    reason = reason if len(reason) <= _LONGEST_REASON else f"{reason[:_LONGEST_REASON]} ..."
    return UsageError(
        f"'{path}' cannot be read as an FMU: {reason.removesuffix('.')}. The file is damaged, or not made by the "
        "standard: copy or build it anew, or ask whoever made it."
    )


def _require_safe_names(path: Path) -> None:
    with zipfile.ZipFile(path) as archive:
        objection = unsafe_name(archive.infolist())
    if objection is not None:
        raise ValueError(objection)


def _described(raw: Any, fmi: int, exchange: bool) -> Description:
    ability = raw.modelExchange if exchange else raw.coSimulation
    _require_sound(raw, ability.modelIdentifier)
    known = [variable for variable in raw.modelVariables if variable.type in _TYPES]
    depends_on = {unknown.variable.name: _dependencies(unknown) for unknown in raw.outputs}
    variables = [one for variable in known for one in _variables(variable, depends_on.get(variable.name))]
    experiment = raw.defaultExperiment
    return Description(
        model=raw.modelName,
        identifier=ability.modelIdentifier,
        guid=raw.guid,
        variables={variable.name: variable for variable in variables},
        units=_units(raw.unitDefinitions),
        generation_tool=raw.generationTool or "",
        text=raw.description or "",
        stop_time=_duration(experiment and experiment.stopTime, "stopTime of its DefaultExperiment"),
        step=_duration(experiment and experiment.stepSize, "stepSize of its DefaultExperiment"),
        saves_state=ability.canGetAndSetFMUstate,
        serializes_state=ability.canSerializeFMUstate,
        takes_slopes=not exchange and ability.canInterpolateInputs and fmi == 2,  # FMI 3.0 has no function for it
        gives_slopes=not exchange and ability.maxOutputDerivativeOrder > 0,
        log_categories={category.name: category.description or "" for category in raw.logCategories},
        fmi=fmi,
        has_event_mode=not exchange and ability.hasEventMode,
        returns_early=not exchange and ability.mightReturnEarlyFromDoStep,
        varies_step=exchange or ability.canHandleVariableCommunicationStepSize,
        once_per_process=ability.canBeInstantiatedOnlyOncePerProcess,
        exchange=exchange,
        states=len(raw.derivatives),
        indicators=int(raw.numberOfEventIndicators or 0) if fmi == 2 else 0,
        needs_completed=not exchange or ability.needsCompletedIntegratorStep,
    )


#: Types of FMI by what they are to the harness.
_TYPES = {
    **dict.fromkeys(("Real", "Float64", "Float32"), "Real"),
    **dict.fromkeys(("Integer", "Enumeration"), "Integer"),
    **{f"{sign}Int{bits}": "Integer" for sign in ("", "U") for bits in (8, 16, 32, 64)},
    **{name: name for name in ("Boolean", "String", "Binary", "Clock")},
}


def _require_sound(raw: Any, identifier: str) -> None:
    """Refuse numbers that no FMU can mean, before anything is made of them.

    Raises:
        ValueError: naming the variable, its number and the limit.
    """
    if not _FILE_NAME.fullmatch(identifier):
        raise ValueError(f"its modelIdentifier is '{identifier}', which is no name of a library")
    for unit in raw.unitDefinitions:
        for scale in (unit.baseUnit, *unit.displayUnits):
            if scale is not None and not (math.isfinite(scale.factor) and scale.factor and math.isfinite(scale.offset)):
                raise ValueError(
                    f"the unit {unit.name} has a factor of {scale.factor:g}, an offset of {scale.offset:g}"
                )
    count = 0
    for variable in raw.modelVariables:
        if not 0 <= variable.valueReference <= _LARGEST_REFERENCE:
            raise ValueError(
                f"the valueReference of {variable.name} is {variable.valueReference}, but must be from 0 to "
                f"{_LARGEST_REFERENCE}"
            )
        if any(size < 0 for size in variable.shape or ()):
            raise ValueError(f"the array {variable.name} has a negative size")
        count += math.prod(variable.shape or ())
        if count > _MOST_ELEMENTS:
            raise ValueError(f"its variables have more than {_MOST_ELEMENTS:,} elements, at {variable.name}")


def _dependencies(unknown: Any) -> frozenset[str] | None:
    if unknown.dependencies is None:
        return None
    inputs = (variable for variable in unknown.dependencies if variable.causality == "input")  # and not states
    return frozenset(name for variable in inputs for name in _element_names(variable))


def _variables(raw: Any, depends_on: frozenset[str] | None) -> Iterator[Variable]:
    """A variable, or the elements of one that is an array."""
    names = _element_names(raw)
    whole = not raw.shape or raw.type in ("String", "Binary")  # of an array of these, fmpy keeps the first start only
    start = None if raw.start is None else [raw.start] if whole else raw.start.split()
    for element, name in enumerate(names):
        own = start[element] if start is not None and len(start) == len(names) else None
        yield _variable(raw, name, own, depends_on, element, len(names))


def _element_names(raw: Any) -> list[str]:
    """Its name, or those of its elements, counted from 1.

    An array of a structure's fields, such as `impacts.time`, counts the structures: impacts[1].time.
    """
    if not raw.shape:
        return [raw.name]
    places = product(*(range(1, size + 1) for size in raw.shape))
    structure, dot, field_name = raw.name.rpartition(".")
    ahead, behind = (structure, dot + field_name) if dot else (raw.name, "")
    return [f"{ahead}[{','.join(map(str, place))}]{behind}" for place in places]


def _variable(
    raw: Any, name: str, start: str | None, depends_on: frozenset[str] | None, element: int, elements: int
) -> Variable:
    declared = raw.declaredType

    def attribute(name: str) -> Any:
        own = getattr(raw, name)
        return own if own is not None or declared is None else getattr(declared, name)

    kind = _TYPES[raw.type]
    if start is not None and not _is_value(start, kind):
        raise ValueError(f"the start value of {name} is '{start}', which is no {kind}")
    return Variable(
        name=name,
        reference=raw.valueReference,
        type=kind,
        causality=raw.causality or "local",
        description=raw.description or "",
        continuous=kind == "Real" and raw.variability in (None, "continuous"),
        unit="" if attribute("unit") in (None, "1") else attribute("unit"),
        display_unit=attribute("displayUnit") or "",
        start=start,
        minimum=_limit(attribute("min"), f"min of {name}"),
        maximum=_limit(attribute("max"), f"max of {name}"),
        nominal=_number(attribute("nominal"), f"nominal of {name}") or 1.0,
        depends_on=depends_on,
        fmi_type=raw.type,
        elements=elements,
        element=element,
        clocks=tuple(clock.name for clock in raw.clocks or ()),
        interval=raw.intervalVariability or "" if raw.type == "Clock" else "",
    )


def _is_value(text: str, kind: str) -> bool:
    """Whether a text means a value of a type."""
    if kind == "Boolean":
        return text in ("true", "false", "1", "0")
    makes: Mapping[str, Callable[[str], object]] = {"Real": float, "Integer": int, "Binary": bytes.fromhex}
    try:
        makes.get(kind, str)(text)
    except ValueError:
        return False
    return True


def _units(definitions: Iterable[Any]) -> Units:
    defined, displayed = {}, {}
    for unit in definitions:
        base = unit.baseUnit
        if base is not None:
            defined[unit.name] = Measure(tuple(getattr(base, name) for name in BASE_UNITS), base.factor, base.offset)
        displayed[unit.name] = {display.name: (display.factor, display.offset) for display in unit.displayUnits}
    return Units(defined, displayed)


def _duration(text: str | None, what: str) -> float | None:
    """A time of the default experiment; one that is not positive says nothing, as some tools write 0 for none."""
    number = _number(text, what)
    return number if number is not None and number > 0.0 else None


def _limit(text: str | None, what: str) -> float | None:
    """A limit of a variable; an infinite one is none."""
    return (
        None if text is not None and text.strip().lstrip("+-").lower() in ("inf", "infinity") else _number(text, what)
    )


def _number(text: str | None, what: str = "") -> float | None:
    """A number of the description, which is finite.

    Raises:
        ValueError: it is none; the message names `what` it is of.
    """
    if text is None:
        return None
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise ValueError(f"{what} is '{text}', which is no finite number")
    return number
