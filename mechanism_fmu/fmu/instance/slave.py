"""FMI 2.0 co-simulation slave (pythonfmu): FMI calls on one side, a `MovingMechanism` on the other, no dynamics."""

from __future__ import annotations

import functools
import math
import weakref
from collections.abc import Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any, ClassVar
from xml.etree.ElementTree import Element

from pythonfmu import Fmi2Slave
from pythonfmu.enums import Fmi2Status

from ... import __version__
from ...engine.run import compiled_library
from ...model import MechanismError, Model, compile_mechanism
from ...model.model import check_value
from ...moving import MovingMechanism, SimulationError, StepBudgetError
from ...tables.layout import FIELDS, pack
from ...tables.sizes import sizes_of
from ..parts.variables import FIRST_REFERENCE, Variable, variables_of
from . import saved_state
from .news import News
from .protocol import (
    TIGHTEST,
    Experiment,
    FmiError,
    PassedTexts,
    Phase,
    experiment,
    fmi_call,
    place_of,
    require,
    step_target,
    survive_release,
)
from .saved_state import Admissible, CheckedState, Contents, SavedState, SavedStateError, check_contents
from .self_check import compile_engine, require_numbers, start_explained

_SETTABLE = {
    "input": (Phase.INSTANTIATED, Phase.INITIALIZATION, Phase.STEPPING),
    "parameter": (Phase.INSTANTIATED, Phase.INITIALIZATION),
}


class MechanismSlave(Fmi2Slave):
    """The slave of any model; `make_slave_class` gives it one."""

    model: ClassVar[Model]
    variables: ClassVar[tuple[Variable, ...]]
    _mark: ClassVar[bytes]
    _contents: ClassVar[Contents]
    _instances: ClassVar[weakref.WeakSet[MechanismSlave]] = weakref.WeakSet()

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        compile_engine(self.model)
        self.modelName = self.model.name
        self.description = self.model.description
        self._phase = Phase.INSTANTIATED
        self._experiment: Experiment | None = None
        self._parameters = [p.start for p in self.model.parameters]
        self._inputs = [float(v.start or 0.0) for v in self.variables if v.causality == "input"]
        self._first_parameter = sum(v.causality in ("input", "output") for v in self.variables)
        self._simulation: MovingMechanism | None = None
        self._values: list[float] | None = None
        self._news = News()
        self._passed = PassedTexts()
        self._instances.add(self)

    # --- life cycle --------------------------------------------------------------------------------------------------

    @fmi_call
    def setup_experiment(self, start_time: float, stop_time: float | None, tolerance: float | None) -> None:
        """fmi2SetupExperiment, times in s; of its tolerance and `relative_tolerance`, the tighter will be used."""
        require(self._phase, (Phase.INSTANTIATED,), "fmi2SetupExperiment")
        self._experiment = experiment(start_time, stop_time, tolerance)
        self._forget_simulation()

    @fmi_call
    def enter_initialization_mode(self) -> None:
        """fmi2EnterInitializationMode."""
        require(self._phase, (Phase.INSTANTIATED,), "fmi2EnterInitializationMode")
        if self._experiment is None:
            raise FmiError("fmi2EnterInitializationMode is not allowed before fmi2SetupExperiment.")
        self._phase = Phase.INITIALIZATION

    @fmi_call
    def exit_initialization_mode(self) -> None:
        """fmi2ExitInitializationMode: assemble the mechanism and begin its motion."""
        require(self._phase, (Phase.INITIALIZATION,), "fmi2ExitInitializationMode")
        self._prepared()
        values = SimpleNamespace(**self._parameter_values())  # checked when it was prepared
        for warning in self.model.warned(values):
            self.log(warning, Fmi2Status.warning)
        self._phase = Phase.STEPPING
        self._report_news()

    @fmi_call
    def do_step(self, current_time: float, step_size: float) -> bool:
        """fmi2DoStep from `current_time` [s] over `step_size` [s]."""
        require(self._phase, (Phase.STEPPING,), "fmi2DoStep")
        simulation = self._prepared()
        stop_time = math.inf if self._experiment is None else self._experiment.stop_time
        target = step_target(simulation.time, current_time, step_size, stop_time)
        self._values = None
        try:
            simulation.advance(target)
        except StepBudgetError as spent:
            self.log(f"{self.instance_name}: {spent}", Fmi2Status.discard, "logStatusDiscard")
            return False  # fmi2Discard
        finally:
            self._report_news()
        return True

    @fmi_call
    def terminate(self) -> None:
        """fmi2Terminate."""
        require(self._phase, (Phase.STEPPING,), "fmi2Terminate")
        self._phase = Phase.TERMINATED

    def to_xml(self, model_options: dict[str, str] | None = None) -> Element:
        """modelDescription.xml; the build asks for it, and writes the final GUID into it.

        Raises:
            StartError: with its default values, the mechanism cannot start; better said here than in another tool.
        """
        from ..parts.model_description import model_description

        with start_explained():
            require_numbers(self._prepared().read())
        return model_description(self.model, str(self.guid))

    # --- values ------------------------------------------------------------------------------------------------------

    @fmi_call
    def get_real(self, vrs: list[int]) -> list[float]:
        """fmi2GetReal."""
        return self._get("Real", vrs)

    @fmi_call
    def get_integer(self, vrs: list[int]) -> list[int]:
        """fmi2GetInteger."""
        return [int(value) for value in self._get("Integer", vrs)]

    @fmi_call
    def get_boolean(self, vrs: list[int]) -> list[bool]:
        """fmi2GetBoolean."""
        return [value != 0 for value in self._get("Boolean", vrs)]

    @fmi_call
    def get_string(self, vrs: list[int]) -> list[str]:
        """fmi2GetString: there are no strings."""
        self._places("String", vrs)
        return []

    @fmi_call
    def set_real(self, vrs: list[int], values: list[float]) -> None:
        """fmi2SetReal."""
        self._set("Real", vrs, values)

    @fmi_call
    def set_integer(self, vrs: list[int], values: list[int]) -> None:
        """fmi2SetInteger."""
        self._set("Integer", vrs, [float(v) for v in values])

    @fmi_call
    def set_boolean(self, vrs: list[int], values: list[bool]) -> None:
        """fmi2SetBoolean."""
        self._set("Boolean", vrs, [float(v) for v in values])

    @fmi_call
    def set_string(self, vrs: list[int], values: list[str]) -> None:
        """fmi2SetString: there are no strings."""
        self._places("String", vrs)

    # --- state -------------------------------------------------------------------------------------------------------

    @fmi_call
    def _get_fmu_state(self) -> bytes:
        """fmi2GetFMUstate: the saved state, already as the bytes that serialization hands out."""
        words = b"" if self._simulation is None else self._simulation.state.tobytes()
        state = SavedState(self._phase, self._experiment, tuple(self._parameters), tuple(self._inputs), words)
        return CheckedState(saved_state.encode(state, self._mark))

    @fmi_call
    def _set_fmu_state(self, state: bytes) -> None:
        """fmi2SetFMUstate: everything is restored; the log does not repeat what it has said."""
        saved = self._read(state)
        simulation = self._simulation if saved.words else None
        same = (saved.experiment, list(saved.parameters)) == (self._experiment, self._parameters)
        if saved.words and (simulation is None or not same):
            simulation = self._made(saved.experiment, saved.parameters, saved.inputs)  # may refuse: nothing changed yet
        if simulation is not None:
            simulation.state.data.cast("B")[:] = saved.words
        self._simulation = simulation
        self._experiment, self._parameters = saved.experiment, list(saved.parameters)
        self._inputs = list(saved.inputs)
        self._values = None
        self._phase = saved.phase
        self._news = News(self._simulation)

    @classmethod
    def _fmu_state_to_bytes(cls, state: bytes) -> bytes:
        return bytes(state)

    @classmethod
    def _fmu_state_from_bytes(cls, state: bytes) -> bytes:
        """fmi2DeSerializeFMUstate; the wrapper does not say for which instance."""
        try:
            cls._read(state)
        except SavedStateError:
            for instance in cls._instances:
                survive_release(type(instance), instance, instance.log_queue)
            raise
        return CheckedState(state)

    @classmethod
    def _read(cls, state: bytes) -> SavedState:
        """A saved state that is one of this model; what was checked when it came in is not checked again."""
        saved = saved_state.decode(state, cls._mark)
        if not isinstance(state, CheckedState):
            check_contents(saved, cls._contents)
        return saved

    # --- inside ------------------------------------------------------------------------------------------------------

    def log(self, msg: str, status: Fmi2Status = Fmi2Status.ok, category: str | None = None, debug: Any = None) -> None:
        """Log a plain text: the FMI logger takes it for a printf format, in which % must be doubled."""
        if not self.log_queue:
            self._passed.release()
        # A string of its own, which nobody else holds: the wrapper's reference to it will be released.
        text = "".join((msg.replace("%", "%%"), " "))[:-1]
        super().log(text, status, category)
        self._passed.add(text)

    def report(self, error: Exception) -> None:
        """Log an exception: as it is when it was meant for the user, with its type and place when it was not."""
        if isinstance(error, (FmiError, MechanismError, SimulationError, SavedStateError)):
            self.log(f"{self.instance_name}: {error}", Fmi2Status.error)
            return
        place = place_of(error)
        self.log(
            f"{self.instance_name}: internal error {type(error).__name__}: {error}{place}; please report it.",
            Fmi2Status.error,
        )

    def _parameter_values(self) -> dict[str, float]:
        return {p.name: value for p, value in zip(self.model.parameters, self._parameters, strict=True)}

    def _prepared(self) -> MovingMechanism:
        """The simulation; before the first step it is made anew after each change of a parameter or input."""
        if self._simulation is None:
            self._simulation = self._made(self._experiment, self._parameters, self._inputs)
        return self._simulation

    def _made(self, setup: Experiment | None, parameters: Sequence[float], inputs: Sequence[float]) -> MovingMechanism:
        """A simulation of parameter values and inputs, in the model's order, that has begun."""
        setup = setup or Experiment(0.0)
        values = {p.name: value for p, value in zip(self.model.parameters, parameters, strict=True)}
        mechanism = self.model.build(self.model.checked(values))
        tolerance = min(mechanism.settings.relative_tolerance, max(setup.tolerance, TIGHTEST))
        mechanism = replace(mechanism, settings=replace(mechanism.settings, relative_tolerance=tolerance))
        return MovingMechanism(mechanism, setup.start_time, inputs)

    def _forget_simulation(self) -> None:
        self._simulation = None
        self._values = None

    def _get(self, kind: str, vrs: Sequence[int]) -> list[float]:
        places = self._places(kind, vrs)
        if self._values is None:
            if all(self.variables[place].causality in _SETTABLE for place in places):
                return [self._setting(place) for place in places]
            outputs = self._prepared().read_array().tolist()
            split = self._first_parameter - len(self._inputs)
            self._values = [*self._inputs, *outputs[:split], *self._parameters, *outputs[split:]]
        values = self._values
        return [values[place] for place in places]

    def _setting(self, place: int) -> float:
        """The value of an input or parameter."""
        return self._inputs[place] if place < len(self._inputs) else self._parameters[place - self._first_parameter]

    def _set(self, kind: str, vrs: Sequence[int], values: Sequence[float]) -> None:
        """Set all values, or none when one is refused."""
        places = self._places(kind, vrs)
        for place, value in zip(places, values, strict=True):
            variable = self.variables[place]
            if variable.causality not in _SETTABLE:
                raise FmiError(f"{variable.name} is of causality {variable.causality} and cannot be set.")
            require(self._phase, _SETTABLE[variable.causality], f"Setting {variable.causality} {variable.name}")
            check_value(variable, value)
        for place, value in zip(places, values, strict=True):
            if place < len(self._inputs):
                self._inputs[place] = value
                if self._phase is Phase.STEPPING:
                    self._prepared().inputs[place] = value
            else:
                self._parameters[place - self._first_parameter] = value
        self._values = None
        if self._phase is not Phase.STEPPING:
            self._simulation = None

    def _places(self, kind: str, vrs: Sequence[int]) -> list[int]:
        """Where variables stand among all, when they are there and of this type."""
        places = [vr - FIRST_REFERENCE for vr in vrs]
        for place in places:
            if not 0 <= place < len(self.variables):
                raise FmiError(
                    f"There is no variable with value reference {(place + FIRST_REFERENCE) % 2**32}; "
                    f"they run from {FIRST_REFERENCE} to {len(self.variables)}."
                )
            variable = self.variables[place]
            if variable.type != kind:
                reference = variable.value_reference
                raise FmiError(f"{variable.name} (value reference {reference}) is of type {variable.type}, not {kind}.")
        return places

    def _report_news(self) -> None:
        for message in self._news.since_last(self._prepared()):
            self.log(*message)


@functools.cache
def make_slave_class(model: Model) -> type[MechanismSlave]:
    """The slave class of a model, named after it.

    Raises:
        ModuleNotFoundError: the engine is not there in compiled form, and numba is not installed.
    """
    if compiled_library() is None:
        import numba  # noqa: F401  (to be missed here, where the start says what to install, and not in a run)
    variables = variables_of(model)
    # In an FMU the package's name holds the hash of all sources: a state is for the very same ones.
    sizes = sizes_of(pack(compile_mechanism(model.build(model.values()))))
    parts = [__name__, __version__, model.name, *(v.name for v in variables), *map(repr, FIELDS), repr(sizes)]
    settable = {causality: tuple(v for v in variables if v.causality == causality) for causality in _SETTABLE}
    members = {
        "model": model,
        "variables": variables,
        "_mark": saved_state.fingerprint(parts),
        "_contents": Contents(settable["parameter"], settable["input"], Admissible.of(sizes)),
        "__doc__": model.description,
    }
    return type(model.name, (MechanismSlave,), members)
