"""A model: a mechanism as a function of named parameters."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from types import EllipsisType, SimpleNamespace
from typing import Any, Protocol

from .analysis import Analysis
from .cases import Case
from .default_drawing import Plan, draw, plan_of
from .default_ports import default_outputs
from .drawing import Shape
from .errors import MechanismError
from .findings import Finding, messages
from .mechanism import DEFAULT_SETTINGS, Mechanism, Settings
from .ports import Calculated, Input, Output, Parameter
from .quantities import quantity
from .symbol import Recorder


def _nothing(_values: SimpleNamespace) -> tuple[()]:
    return ()


@dataclass(frozen=True)
class _Completed:
    """A model's function; what its mechanism leaves out of ports and settings comes from the model.

    Outputs that neither declares are the default ones.
    """

    function: Callable[[SimpleNamespace], Mechanism]
    inputs: tuple[Input, ...]
    outputs: tuple[Output, ...]
    calculated: Callable[[SimpleNamespace], tuple[Calculated, ...]]
    parameters: tuple[Parameter, ...]
    draws: bool

    def __call__(self, values: SimpleNamespace) -> Mechanism:
        found = self._completed(values)
        if not self.draws or not isinstance(found, Mechanism) or not _is_readable(found):
            return found
        drawn = draw(found, self.plan.size, self.plan.follows, self._names)
        return replace(
            found, outputs=(*found.outputs, *drawn.outputs), calculated=(*found.calculated, *drawn.calculated)
        )

    def _completed(self, values: SimpleNamespace) -> Mechanism:
        return self._whole(self.function(values), values)

    def _whole(self, found: Any, values: SimpleNamespace) -> Mechanism:
        if not isinstance(found, Mechanism):
            return found  # type: ignore[no-any-return]  # a user's function may return anything: objected to elsewhere
        whole = replace(
            found,
            inputs=found.inputs or self.inputs,
            outputs=found.outputs or self.outputs,
            calculated=found.calculated or self.calculated(values),
            settings=Settings.of(values) if found.settings is DEFAULT_SETTINGS else found.settings,
        )
        if not _is_readable(whole):
            return whole
        whole = replace(whole, rubs=self._rubs)
        return whole if whole.outputs else replace(whole, outputs=default_outputs(whole, self._names))

    @property
    def _names(self) -> list[str]:
        """Of the parameters."""
        return [getattr(parameter, "name", "") for parameter in self.parameters]

    @property
    def _starts(self) -> SimpleNamespace:
        return SimpleNamespace(**{p.name: p.start for p in self.parameters})

    @cached_property
    def _symbols(self) -> SimpleNamespace:
        recorder = Recorder()
        return SimpleNamespace(**{p.name: recorder.parameter(k, start=p.start) for k, p in enumerate(self.parameters)})

    @cached_property
    def _symbolic(self) -> Mechanism | None:
        """What the function returns for symbols; None where it cannot take them. It is called with them once."""
        with suppress(ArithmeticError, AttributeError, MechanismError, TypeError, ValueError):
            return self.function(self._symbols)
        return None

    @cached_property
    def _rubs(self) -> tuple[str, ...]:
        """Names of what may have friction for some values: found once, by symbols for all of them."""
        found = self._symbolic
        return found.rubs_or_may if isinstance(found, Mechanism) and _is_readable(found) else ()

    @cached_property
    def plan(self) -> Plan:
        """Which numbers of the default drawing follow from parameters: found once, by symbols for all of them."""
        symbolic: Mechanism | None = None
        with suppress(ArithmeticError, AttributeError, MechanismError, TypeError, ValueError):
            symbolic = None if self._symbolic is None else self._whole(self._symbolic, self._symbols)
        return plan_of(self._completed(self._starts), symbolic)

    @cached_property
    def shapes(self) -> tuple[Shape, ...]:
        """Of the default drawing."""
        mechanism = self._completed(self._starts)
        return tuple(draw(mechanism, self.plan.size, self.plan.follows, self._names).shapes)


def _is_readable(mechanism: Mechanism) -> bool:
    """Whether the parts are tuples of parts: what is not, is objected to elsewhere."""
    names = ("bodies", "joints", "forces", "markers", "oscillations", "contacts", "inputs", "calculated")
    parts = [getattr(mechanism, name) for name in names]
    return all(isinstance(entries, tuple) and all(hasattr(entry, "name") for entry in entries) for entries in parts)


@dataclass(frozen=True)
class Model:
    """What a folder of `models/` exports as `MODEL`, and what becomes an FMU.

    Attributes:
        name: of the FMU, a Python identifier, e.g. "Ratchet".
        description: one line for the user.
        parameters: all parameters with their limits; those of `settings_parameters` are its mechanism's settings.
        mechanism: pure function from parameter values (attributes of its one argument, by name) to the mechanism:
            plain arithmetic and `model.functions` only, no branching on structure, so that symbolic numbers pass;
            what it leaves out of ports and settings comes from here.
        objections: pure function, as `mechanism` is, to what is wrong with values that are each within their limits;
            it is asked first, so it must not fail where `mechanism` would.
        warnings: likewise, for what is legal but deserves a line in the log.
        stop_time, step_size: default experiment [s].
        drawing: how its FMU can be drawn, in terms of the FMU's variables; () when it cannot. None, and `...` among the
            shapes, stand for the default drawing of its bodies, joints, springs and contacts.
        analysis: what can be analysed of a run, in terms of the FMU's variables; () when nothing can.
        author: who made it; "" leaves it open.
        license: under which others may use it, one line; "" leaves it open.
        inputs, outputs: what the outside sees of the mechanism, where `mechanism` gives none; of a model without any
            outputs, `default_outputs` of all its parts.
        calculated: likewise; pure function, as `mechanism` is, to what follows from the parameters.
        cases: named values and inputs over time, to choose from on its page.

    Raises:
        MechanismError: stop_time or step_size is not positive and finite.
    """

    name: str
    description: str
    parameters: tuple[Parameter, ...]
    mechanism: Callable[[SimpleNamespace], Mechanism]
    objections: Callable[[SimpleNamespace], Sequence[Finding]] = _nothing
    warnings: Callable[[SimpleNamespace], Sequence[Finding]] = _nothing
    stop_time: float = 1.0
    step_size: float = 1e-3
    drawing: tuple[Shape | EllipsisType, ...] | None = None
    analysis: tuple[Analysis, ...] = ()
    author: str = ""
    license: str = ""
    inputs: tuple[Input, ...] = ()
    outputs: tuple[Output, ...] = ()
    calculated: Callable[[SimpleNamespace], tuple[Calculated, ...]] = _nothing
    cases: tuple[Case, ...] = ()

    def __post_init__(self) -> None:
        own = self.mechanism.function if isinstance(self.mechanism, _Completed) else self.mechanism
        if callable(own):
            draws = self.drawing is None or any(shape is ... for shape in self.drawing)
            completed = _Completed(own, self.inputs, self.outputs, self.calculated, self.parameters, draws)
            object.__setattr__(self, "mechanism", completed)
        for what, value in (("stop_time", self.stop_time), ("step_size", self.step_size)):
            if not 0.0 < value < math.inf:
                raise MechanismError(f"{self.name}: {what} = {value:g} s, but it must be positive and finite.")

    @property
    def declares_outputs(self) -> bool:
        """Whether its mechanism has outputs of its own, and not the default ones."""
        own: Any = self.mechanism.function if isinstance(self.mechanism, _Completed) else self.mechanism
        return bool(self.outputs or own(self.values()).outputs)

    @property
    def shapes(self) -> tuple[Shape, ...]:
        """The drawing, with the shapes of the default one in their place."""
        completed = self.mechanism
        default = completed.shapes if isinstance(completed, _Completed) and completed.draws else ()
        given = (...,) if self.drawing is None else self.drawing
        return tuple(shape for one in given for shape in (default if isinstance(one, EllipsisType) else (one,)))

    def values(self, **changes: float | str) -> SimpleNamespace:
        """Parameter values: the defaults with `changes`, which are in the parameters' units or texts such as "45 mm".

        Args:
            changes: values by name of the parameter, in its unit.

        Raises:
            MechanismError: unknown name, a value outside its limits, or a text with another unit.
        """
        units = {p.name: p.unit for p in self.parameters}
        for name in changes:
            self._require(name, units)
        numbers = {name: quantity(value, units[name], name) for name, value in changes.items()}
        return self.checked({p.name: p.start for p in self.parameters} | numbers)

    def checked(self, values: Mapping[str, float]) -> SimpleNamespace:
        """All parameter values, each checked against its limits.

        Args:
            values: by name of the parameter, in its unit.

        Raises:
            MechanismError: unknown name, or a value outside its limits.
        """
        known = {p.name: p for p in self.parameters}
        for name, value in values.items():
            self._require(name, known)
            check_value(known[name], value)
            if known[name].type == "Integer" and value != int(value):
                raise MechanismError(f"{name} = {value:g} is not a whole number; give an integer.")
            if known[name].type == "Boolean" and value not in (0, 1):
                raise MechanismError(f"{name} = {value:g} is neither true (1) nor false (0); give one of the two.")
        return SimpleNamespace(**values)

    def _require(self, name: str, known: Collection[str]) -> None:
        if name not in known:
            raise MechanismError(f"{self.name} has no parameter {name!r}; it has: {', '.join(sorted(known))}.")

    def build(self, values: SimpleNamespace) -> Mechanism:
        """The mechanism for parameter values, after asking for objections.

        Args:
            values: of all parameters, as `values` gives them.

        Raises:
            MechanismError: with all objections.
        """
        refused = self.refused(values)
        if refused:
            raise MechanismError(" ".join(refused))
        return self.mechanism(values)

    def refused(self, values: SimpleNamespace) -> list[str]:
        """Messages of the objections that apply to parameter values.

        Args:
            values: of all parameters, as `values` gives them.
        """
        return messages(self.objections(values))

    def warned(self, values: SimpleNamespace) -> list[str]:
        """Messages of the warnings that apply to parameter values.

        Args:
            values: of all parameters, as `values` gives them.
        """
        return messages(self.warnings(values))

    def show(self, height: int = 720) -> object:
        """Show the model as a page in which its engine runs, for the last line of a cell of a notebook.

        What shows it is the installed front end that has the entry point `show` of the group `mechanism_fmu.show`:
        `harness.page.shown.show` of this project.

        Args:
            height: of its frame in a notebook [px].

        Raises:
            MechanismError: no front end is installed, or the model cannot be built or traced.
            ValueError: the height is not positive.
        """
        from importlib.metadata import entry_points  # takes 20 ms, and travels in every FMU

        for point in entry_points(group="mechanism_fmu.show", name="show"):
            shown: object = point.load()(self, height)
            return shown
        raise MechanismError("Nothing that shows models is installed here; install the project again: docs/install.md.")


class Limited(Protocol):
    """Anything with a name, a unit and limits: a parameter, an input, an FMU's variable."""

    @property
    def name(self) -> str:
        """Its name."""

    @property
    def unit(self) -> str | None:
        """Its SI unit."""

    @property
    def minimum(self) -> float | None:
        """Its least value."""

    @property
    def maximum(self) -> float | None:
        """Its greatest value."""


def check_value(parameter: Limited, value: float) -> None:
    """Check one value, in the unit of what it is meant for, against its limits.

    Raises:
        MechanismError: not finite, or outside the limits.
    """
    unit = "" if parameter.unit in (None, "1") else f" {parameter.unit}"
    if not math.isfinite(value):
        raise MechanismError(
            f"{parameter.name} = {value} is not a finite number; give a value in{unit or ' plain numbers'}."
        )
    if parameter.minimum is not None and value < parameter.minimum:
        raise MechanismError(
            f"{parameter.name} = {value:g}{unit} is below its limit; give at least {parameter.minimum:g}{unit}."
        )
    if parameter.maximum is not None and value > parameter.maximum:
        raise MechanismError(
            f"{parameter.name} = {value:g}{unit} is above its limit; give at most {parameter.maximum:g}{unit}."
        )
