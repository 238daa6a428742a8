"""Simulation experiment with one FMU: settings in, a run with tables and verdicts out."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd

from mechanism_fmu.stress import STEEL_CARD, Beam, MaterialCard, SequenceDamage

from ..analysis.analyses import Analysis, Seen, analysed, analyses_of
from ..analysis.compliance import Compliance
from ..analysis.impacts import ImpactCollector
from ..analysis.stress import DAMAGE_UNITS
from ..errors import LogMessage, UsageError
from ..fmu.description import Description, Value
from ..fmu.instances.message_log import MessageHandler, discard_message
from ..fmu.interface import Instances, Observable
from ..fmu.values import parse_value, settable_variable
from .checks import Check, run_checks
from .division import HeldMessages
from .drawing import Drawing, is_of_drawing, read_drawing
from .inputs import InputSignals, check_no_overlap, read_inputs
from .logic import UNITS as EVENT_UNITS, EventCollector, LogicFile, read_logic
from .master import Observer, Outcome, Recorder, TimeGrid, never, recorded_variables, run_fixed_step, seconds


@dataclass(frozen=True)
class Experiment:
    """What to do with an FMU.

    Attributes:
        stop_time: [s].
        step: communication step [s].
        start_values: of inputs and parameters by name, in the units of the variables.
        input_file: table of input signals (`inputs.read_inputs`); None leaves inputs at their start values.
        material: of the beam that impacts strike.
        asks_for_stress: whether the user has named the material, so that a run without stress owes a word.
    """

    stop_time: float
    step: float
    start_values: Mapping[str, Value] = field(default_factory=dict)
    input_file: Path | None = None
    material: MaterialCard = STEEL_CARD
    asks_for_stress: bool = False


@dataclass(frozen=True)
class Run:
    """What came of an experiment.

    Attributes:
        fmu: path of the FMU file.
        description: of the FMU.
        experiment: what was asked.
        outcome: how far it came.
        results: recorded variables, a row for each communication point (`master.Recorder`), and for the ends of parts
            of steps that were divided (`division`).
        impacts: a row for each impact, with the stress it leaves when the FMU declares a beam that is struck.
        impacts_lost: impacts that the FMU could not report.
        parameters: parameters and calculated parameters after the initialization.
        messages: everything the FMU said.
        beam: what the impacts strike; None when the FMU declares none, or one that cannot be.
        units: by name ("1": dimensionless), for each of "results", "impacts", "events", "fatigue", "compliance" and
            "parameters".
        checks: verdicts.
        wall_time: of the simulation [s].
        drawing: how the mechanism is drawn.
        events: a row for each event, in words (`events.EventCollector`).
        events_lost: events that the FMU could not report.
        reports_events: whether the FMU reports events at all.
        logic: the modes and transitions that the FMU declares.
        damage: what all impacts together do to the beam; None without a beam or an impact.
        inputs: the signals that drove inputs; None when there were none.
        compliance: how far links give way; () when the FMU declares none, or nothing loads them.
    """

    fmu: Path
    description: Description
    experiment: Experiment
    outcome: Outcome
    results: pd.DataFrame
    impacts: pd.DataFrame
    impacts_lost: int
    parameters: Mapping[str, Value]
    messages: Sequence[LogMessage]
    beam: Beam | None
    units: Mapping[str, Mapping[str, str]]
    checks: Sequence[Check]
    wall_time: float
    drawing: Drawing = field(default_factory=Drawing)
    events: pd.DataFrame = field(default_factory=lambda: pd.DataFrame(columns=list(EVENT_UNITS)))
    events_lost: int = 0
    reports_events: bool = False
    logic: LogicFile = field(default_factory=LogicFile)
    damage: SequenceDamage | None = None
    inputs: InputSignals | None = None
    compliance: tuple[Compliance, ...] = ()

    @property
    def tooth(self) -> Beam | None:
        """The beam, by the name that it had before version 0.2."""
        return self.beam

    @property
    def tells_events(self) -> bool:
        """`reports_events`, by the name that it had before version 0.2."""
        return self.reports_events


class _ParameterReader:
    """An observer that reads parameters and calculated parameters once."""

    def __init__(self, description: Description) -> None:
        self.names = [variable.name for variable in description.of("parameter", "calculatedParameter")]
        self.values: dict[str, Value] = {}

    def started(self, unit: Observable, time: float) -> None:
        self.values = dict(zip(self.names, unit.get(self.names), strict=True))

    def stepped(self, unit: Observable, time: float) -> None:
        pass


def perform(
    fmu: Instances,
    experiment: Experiment,
    *,
    on_message: MessageHandler = discard_message,
    observers: Sequence[Observer] = (),
    stop_requested: Callable[[], bool] = never,
    inputs: InputSignals | None = None,
) -> Run:
    """Perform an experiment with a new instance of `fmu`, as `performing` does; the instance is freed then.

    Args:
        fmu: what is to be simulated.
        experiment: how.
        on_message: called with each message of the FMU.
        observers: who looks on at communication points.
        stop_requested: asked before each step.
        inputs: signals that the inputs follow; None: those of the experiment.
    """
    with performing(
        fmu,
        experiment,
        on_message=on_message,
        observers=observers,
        stop_requested=stop_requested,
        inputs=inputs,
    ) as run:
        return run


@contextmanager
def performing(
    fmu: Instances,
    experiment: Experiment,
    *,
    on_message: MessageHandler = discard_message,
    observers: Sequence[Observer] = (),
    stop_requested: Callable[[], bool] = never,
    inputs: InputSignals | None = None,
) -> Iterator[Run]:
    """Perform an experiment with a new instance of `fmu`, for a `with`: the instance is freed behind it.

    So the results can be written before that: an FMU may take the whole process with it when it is freed.

    An FMU that fails on the way gives a run whose outcome says so, with everything up to there. `inputs` are signals
    that have been read before, for an experiment that names no file.

    Raises:
        UsageError: a setting that cannot be used.
        FmuError: the FMU cannot even be instantiated.
    """
    grid = TimeGrid.of(experiment.stop_time, experiment.step)
    if experiment.input_file is not None:
        inputs = read_inputs(experiment.input_file, fmu.description, seconds(grid.start), seconds(grid.stop))
    if inputs is not None:
        check_no_overlap(inputs, experiment.start_values)
    recorder = Recorder(recorded_variables(fmu.description))
    collector = ImpactCollector(fmu.description)
    event_collector = EventCollector(fmu.description)
    logic = read_logic(fmu.folder)
    reader = _ParameterReader(fmu.description)
    held = HeldMessages(on_message)
    with fmu.instantiate(fmu.description.model, held) as slave:
        began = time.perf_counter()
        outcome = run_fixed_step(
            slave,
            grid,
            experiment.start_values,
            [reader, *observers],
            inputs,
            stop_requested,
            [recorder, collector, event_collector],
            held,
        )
        wall_time = time.perf_counter() - began
        messages = tuple(slave.messages)
        outputs = [variable.name for variable in fmu.description.of("output")]
        results = recorder.table()
        analyses = analyses_of(fmu.description.analysis, collector.fields)
        found = analysed(analyses, Seen(reader.values, results, collector.table(), experiment.material))
        yield Run(
            fmu=fmu.path,
            description=fmu.description,
            experiment=experiment,
            outcome=outcome,
            results=results,
            impacts=found.impacts,
            impacts_lost=collector.lost,
            parameters=reader.values,
            messages=messages,
            beam=found.beam,
            units=_units(fmu.description, collector, analyses, list(found.impacts.columns)),
            checks=[
                *run_checks(outcome, seconds(grid.stop), results, found.impacts, collector.lost, outputs),
                *_objections(fmu.description, found.objection),
            ],
            wall_time=wall_time,
            drawing=read_drawing(fmu.folder, fmu.description),
            events=event_collector.table(logic),
            events_lost=event_collector.lost,
            reports_events=event_collector.reports,
            logic=logic,
            damage=found.damage,
            inputs=inputs,
            compliance=found.compliance,
        )


def may_have_beam(run: Run) -> bool:
    """Whether a stress is missed where none is declared: v_I of teeth is reported, or a material was asked for."""
    return "velocity" in run.impacts.columns or run.experiment.asks_for_stress


#: So many steps a run has whose step size is not given.
_USUAL_STEPS = 1000


def start_values(assignments: Iterable[str], description: Description) -> dict[str, Value]:
    """Values by name from assignments such as "tooth_slope_angle=95deg" or "drive_torque=2 N.mm".

    A number without a unit is in the unit of the variable.

    Raises:
        UsageError: no `=`, unknown or unsettable variable, set twice, or a value that does not fit.
    """
    values: dict[str, Value] = {}
    for assignment in assignments:
        name, equals, text = assignment.partition("=")
        name = name.strip()
        if not equals:
            raise UsageError(f"'{assignment}' is not a setting; write name=value, e.g. drive_torque='2 N.mm'.")
        if name in values:
            raise UsageError(f"'{name}' is set twice; set it once.")
        values[name] = parse_value(text, settable_variable(name, description), description)
    return values


def default_times(description: Description, stop_time: float | None, step: float | None) -> tuple[float, float]:
    """Stop time and step [s], from the FMU's default experiment where they are None.

    Where no step size is given, it is a thousandth of the run, in whole nanoseconds.

    Raises:
        UsageError: no stop time is given.
    """
    stop_time = description.stop_time if stop_time is None else stop_time
    step = description.step if step is None else step
    if stop_time is None:
        raise UsageError(f"{description.model} has no default experiment to take it from; give --stop-time.")
    return stop_time, max(round(stop_time / _USUAL_STEPS, 9), 1e-9) if step is None else step


def _objections(description: Description, objection: str) -> list[Check]:
    """What cannot be analysed, though the FMU declares it."""
    declared = description.analysis
    said = [Check("What is to be analysed is known", False, declared.objection)] if declared.objection else []
    if objection and declared.struck is not None:
        said.append(Check(f"The struck {declared.struck.name} has a stress model", False, objection))
    return said


def _units(
    description: Description, collector: ImpactCollector, analyses: Sequence[Analysis], impact_columns: list[str]
) -> dict[str, dict[str, str]]:
    impact_units = {name: variable.unit or "1" for name, variable in collector.fields.items()}
    found: dict[str, dict[str, str]] = {"fatigue": dict(DAMAGE_UNITS), "compliance": {}}
    for analysis in analyses:
        impact_units |= analysis.columns
        found |= {table: dict(units) for table, units in analysis.tables.items()}
    return {
        "results": {"time": "s"} | {v.name: v.unit or "1" for v in recorded_variables(description)},
        "impacts": {name: impact_units[name] for name in impact_columns},
        "events": dict(EVENT_UNITS),
        **found,
        "parameters": {
            v.name: v.unit or "1" for v in description.of("parameter", "calculatedParameter") if not is_of_drawing(v)
        },
    }
