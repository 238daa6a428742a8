"""Model description of an FMU: its variables and capability flags, as the harness needs them."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from ..errors import UsageError
from .declared import NOTHING, Declared
from .terminals import Terminal
from .units import Units

#: Value of a variable: Real, Integer, Boolean or String; Binary ones are their bytes in hexadecimal, as in FMI's XML.
Value = float | int | bool | str


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
        depends_on: of an output, the inputs that it follows at once; None: not declared, so it may be all.
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
        """Whether it may be read in event mode only: a clock, or what ticks by one (FMI 3.0, section 4.2.1.4)."""
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
        takes_slopes, gives_slopes: whether it takes slopes of inputs (canInterpolateInputs), and returns those of
            outputs (maxOutputDerivativeOrder).
        log_categories: by name, with what each is for.
        fmi: version of FMI, 2 or 3.
        has_event_mode, returns_early: of FMI 3, whether it can let the importer handle events, and end a step at one.
        varies_step: whether its steps may have different sizes (canHandleVariableCommunicationStepSize).
        once_per_process: whether a process can have one instance only (canBeInstantiatedOnlyOncePerProcess).
        exchange: whether it is used by its interface for Model Exchange, not for co-simulation.
        states, indicators: how many continuous states and event indicators it has (FMI 2).
        needs_completed: whether it is to be told of each step that is accepted (completedIntegratorStep).
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
    exchange: bool = False
    states: int = 0
    indicators: int = 0
    needs_completed: bool = True
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
