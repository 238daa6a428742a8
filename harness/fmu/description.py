"""What an FMU says about itself: the part of modelDescription.xml that the harness needs, and its terminals."""

from __future__ import annotations

import difflib
import math
import re
import zipfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import product
from os.path import isfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from mechanism_fmu.fmu.disk.folders import unsafe_name

from ..errors import UsageError
from .declared import NOTHING, Declared, read_declared
from .units import BASE_UNITS, Measure, Units

# Terminals of an FMU: variables that belong together, as angle, speed and torque of a shaft do.
#
# FMI 3.0, section 2.4.9 (terminalsAndIcons.xml); this project writes the same file into FMUs of FMI 2.0.

#: Where the file is, in both versions of the standard.
FILE = "terminalsAndIcons/terminalsAndIcons.xml"


@dataclass(frozen=True)
class Member:
    """One variable of a terminal.

    Attributes:
        name: by which it is matched with that of another terminal.
        variable: name of it.
        kind: "signal": both are equal; "inflow" or "outflow": what flows into, or out of the FMU, sums to zero.
    """

    name: str
    variable: str
    kind: str


@dataclass(frozen=True)
class Terminal:
    """Variables that belong together.

    Attributes:
        name: "<terminal>", or "<terminal>.<terminal>" of one within another one.
        rule: how members are matched; "plug": by their names, all of them.
        kind: what it is, in words of its maker's; "" where nobody says.
        members: in the order of the file.
    """

    name: str
    rule: str
    kind: str
    members: tuple[Member, ...]


def read_terminals(path: Path) -> dict[str, Terminal]:
    """Terminals of the FMU file `path` by name; none where it has no such file.

    Raises:
        ValueError: the file is there, and is none.
    """
    with zipfile.ZipFile(path) as archive:
        if FILE not in archive.namelist():
            return {}
        data = archive.read(FILE)
    try:
        root = ElementTree.fromstring(data)
    except ElementTree.ParseError as error:
        raise ValueError(f"its {FILE} is no XML: {error}") from None
    return {terminal.name: terminal for parent in root.findall("Terminals") for terminal in _terminals(parent, "")}


def _terminals(parent: Element, within: str) -> Iterator[Terminal]:
    for element in parent.findall("Terminal"):
        name = within + element.get("name", "")
        members = tuple(
            Member(
                member.get("memberName", member.get("variableName", "")),
                member.get("variableName", ""),
                member.get("variableKind", "signal"),
            )
            for member in element.findall("TerminalMemberVariable")
        )
        yield Terminal(name, element.get("matchingRule", ""), element.get("terminalKind", ""), members)
        yield from _terminals(element, f"{name}.")


#: Value of a variable: Real, Integer, Boolean or String; Binary ones are their bytes in hexadecimal, as in FMI's XML.
Value = float | int | bool | str

#: Value references are unsigned numbers of 32 bits in both standards.
_LARGEST_REFERENCE = 2**32 - 1
#: Of all variables of an FMU together; one of a million takes seconds to read.
_MOST_ELEMENTS = 1_000_000
_FILE_NAME = re.compile(r"[^/\\:\x00-\x1f]{1,200}")
#: Letters of a reason that are shown.
_LONGEST_REASON = 300


@dataclass(frozen=True)
class Variable:
    """One scalar variable.

    Attributes:
        name, description: as in the FMU.
        reference: its value reference.
        type: "Real", "Integer", "Boolean", "String", "Binary" or "Clock" (an Enumeration counts as Integer, FMI 3's
            Float64 as Real, ...).
        causality: "input", "output", "parameter", "calculatedParameter", "local" or "independent".
        continuous: whether it varies continuously.
        unit, display_unit: "" when it has none, or the unit "1".
        start: its default value, as text; None when it has none.
        minimum, maximum: its limits in `unit`; None when it has none.
        nominal: its usual size in `unit`.
        depends_on: of an output, the inputs that it follows at once; None: nobody says, so it may be all.
        fmi_type: what FMI calls its type, as in "Float64".
        elements, element: of an array of FMI 3, how many numbers it has, and which of them this variable is.
        clocks: names of the clocks by which it ticks (FMI 3): it has a value only while one of them does.
        interval: of a Clock, what decides when it ticks (intervalVariability), as in "triggered".
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
    nominal: float = 1.0
    depends_on: frozenset[str] | None = None
    fmi_type: str = ""
    elements: int = 1
    element: int = 0
    clocks: tuple[str, ...] = ()
    interval: str = ""

    @property
    def in_event_mode_only(self) -> bool:
        """Whether nobody may read it between events: a clock, or what ticks by one (FMI 3.0, section 4.2.1.4)."""
        return self.type == "Clock" or bool(self.clocks)

    @property
    def settable(self) -> bool:
        """Whether it may be set before the initialization."""
        return self.causality in ("input", "parameter") and not self.in_event_mode_only

    @property
    def start_value(self) -> Value | None:
        """Its default value; None when it has none."""
        if self.start is None:
            return None
        if self.type == "Boolean":
            return self.start in ("true", "1")
        if self.type == "Real":
            return float(self.start)
        return int(self.start) if self.type == "Integer" else self.start


@dataclass(frozen=True)
class Description:
    """One FMU.

    Attributes:
        model, guid, generation_tool, text: modelName, guid, generationTool and description of the FMU.
        identifier: name of its library.
        variables: by name, in the FMU's order.
        units: its unit definitions.
        stop_time, step: of its default experiment [s]; None when it gives none.
        saves_state, serializes_state: its capability flags.
        takes_slopes, gives_slopes: whether it takes slopes of inputs (canInterpolateInputs), and tells those of outputs
            (maxOutputDerivativeOrder).
        log_categories: by name, with what each is for.
        fmi: version of FMI, 2 or 3.
        has_event_mode, returns_early: of FMI 3, whether it can let the importer handle events, and end a step at one.
        varies_step: whether its steps may have different sizes (canHandleVariableCommunicationStepSize).
        once_per_process: whether a process can have one instance only (canBeInstantiatedOnlyOncePerProcess).
        terminals: by name.
        analysis: what it declares to be analysed of a run.
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
    gives_slopes: bool = False
    log_categories: Mapping[str, str] = field(default_factory=dict)
    fmi: int = 2
    has_event_mode: bool = False
    returns_early: bool = False
    varies_step: bool = True
    once_per_process: bool = False
    terminals: Mapping[str, Terminal] = field(default_factory=dict)
    analysis: Declared = NOTHING

    def variable(self, name: str) -> Variable:
        """The variable with this name.

        Raises:
            UsageError: there is none; the message suggests similar names.
        """
        if name in self.variables:
            return self.variables[name]
        raise UsageError(f"{self.model} has no variable '{name}'.{hint_at(name, self.variables)}")

    def of(self, *causalities: str) -> list[Variable]:
        """All variables of these causalities, in the FMU's order, but for those that are there in event mode only."""
        return [v for v in self.variables.values() if v.causality in causalities and not v.in_event_mode_only]

    @property
    def has_clocks(self) -> bool:
        """Whether it must be instantiated with the event mode in use (FMI 3.0, fmi3InstantiateCoSimulation)."""
        return any(variable.type == "Clock" for variable in self.variables.values())


def not_in_step_mode(variable: Variable) -> str:
    """Why a variable cannot be read between events, as the beginning of a sentence."""
    if variable.type == "Clock":
        return f"'{variable.name}' is a clock, which ticks at events and has no value between them"
    return f"'{variable.name}' ticks by {' and '.join(variable.clocks)}: it has a value at events only, in event mode"


def hint_at(name: str, known: Iterable[str]) -> str:
    """The sentence, after a space, that asks for the known names most like `name`; "" when there are none."""
    similar = difflib.get_close_matches(name, list(known), n=3)
    return f" Did you mean {' or '.join(similar)}?" if similar else ""


def read_description(path: Path) -> Description:
    """Read the description of the FMU file `path`.

    Raises:
        UsageError: no such file, not an FMU, or not one for co-simulation of FMI 2.0 or 3.0.
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
    if version not in ("2", "3") or raw.coSimulation is None:
        kinds = {"Model Exchange": raw.modelExchange, "Scheduled Execution": raw.scheduledExecution}
        has = " and ".join(kind for kind, there in kinds.items() if there is not None)
        has = has or ("Co-Simulation" if raw.coSimulation is not None else "no interface that is known")
        raise UsageError(
            f"'{path}' is not an FMU for co-simulation of FMI 2.0 or 3.0: it has {has} only, of FMI {raw.fmiVersion}. "
            "The harness runs no other kind; export it again, for Co-Simulation."
        )
    try:
        described = replace(_described(raw, int(version)), terminals=terminals)
        return replace(described, analysis=read_declared(path, described.variables))
    except (ValueError, TypeError, AttributeError, OverflowError) as error:  # a text where a number should be, ...
        raise damaged(path, error) from error


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


def _described(raw: Any, fmi: int) -> Description:
    _require_sound(raw)
    known = [variable for variable in raw.modelVariables if variable.type in _TYPES]
    depends_on = {unknown.variable.name: _dependencies(unknown) for unknown in raw.outputs}
    variables = [one for variable in known for one in _variables(variable, depends_on.get(variable.name))]
    experiment, ability = raw.defaultExperiment, raw.coSimulation
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
        takes_slopes=ability.canInterpolateInputs and fmi == 2,  # FMI 3.0 has no function for it
        gives_slopes=ability.maxOutputDerivativeOrder > 0,
        log_categories={category.name: category.description or "" for category in raw.logCategories},
        fmi=fmi,
        has_event_mode=ability.hasEventMode,
        returns_early=ability.mightReturnEarlyFromDoStep,
        varies_step=ability.canHandleVariableCommunicationStepSize,
        once_per_process=ability.canBeInstantiatedOnlyOncePerProcess,
    )


#: Types of FMI by what they are to the harness.
_TYPES = {
    **dict.fromkeys(("Real", "Float64", "Float32"), "Real"),
    **dict.fromkeys(("Integer", "Enumeration"), "Integer"),
    **{f"{sign}Int{bits}": "Integer" for sign in ("", "U") for bits in (8, 16, 32, 64)},
    **{name: name for name in ("Boolean", "String", "Binary", "Clock")},
}


def _require_sound(raw: Any) -> None:
    """Refuse numbers that no FMU can mean, before anything is made of them.

    Raises:
        ValueError: naming the variable, its number and the limit.
    """
    if not _FILE_NAME.fullmatch(raw.coSimulation.modelIdentifier):
        raise ValueError(f"its modelIdentifier is '{raw.coSimulation.modelIdentifier}', which is no name of a library")
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
    return frozenset(name for variable in unknown.dependencies for name in _element_names(variable))


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
