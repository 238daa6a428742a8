"""A run of a mechanism in one line."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from .. import codes
from ..model import MechanismError, Model, Output
from ..model.default_ports import default_outputs
from ..model.mechanism import Mechanism
from ..model.quantities import quantity
from ..model.sources import resolve_output
from ..moving import Event, Impact, input_place
from ..tables.method import METHOD
from .result import Result, Statistics
from .simulation import Simulation

#: So many steps a run has whose step is not given.
_USUAL_STEPS = 1000

#: What counts those that buffers hold: a run keeps all.
_OF_BUFFERS = ("impact.in_step", "impact.lost", "event.in_step")

#: So many impacts and events at one instant there is room for, for each contact and function.
_ROOM = 32

#: Units of what is read of bodies and elastic members, where no part says it.
_UNITS = {"x_rate": "m/s", "y_rate": "m/s", "rotation": "rad", "stress": "Pa", "axial_force": "N", "deviation": "m"}

#: An input is held at a number or a text with a unit, or follows a function of time [s].
Signal = float | str | Callable[[float], float]


def simulate(
    mechanism: Mechanism | Model,
    until: float | str,
    outputs: Sequence[str | Output] | None = None,
    step: float | str | None = None,
    inputs: Mapping[str, Signal] | None = None,
    start: float | str = 0.0,
) -> Result:
    """Run a mechanism and look at it at equal times; impacts and events are all kept, whenever they happen.

    The communication step decides at which times the table has rows, and how long an input is held; the engine's own
    steps follow from the tolerance (`Settings`), whatever it is.

    Args:
        mechanism: to be run, e.g. `MODEL.build(MODEL.values(length=0.3))`; a model is run with its default values.
        until: stop time [s]; a text has its unit, as in "500 ms", here and below.
        outputs: what the table shows: names of outputs that the mechanism declares, or sources such as "rod.angle" and
            "spring.force" (see `model.Output`), or `Output`s. None: all that the mechanism declares, or where it
            declares none, `model.default_outputs`.
        step: communication step [s]; None: a thousandth of the time.
        inputs: numbers or functions of time by name (SI units), as in {"motor_torque": lambda t: 0.1 * t}, or texts
            with units; others stay at their start values. A function's value is held from one row to the next.
        start: start time [s].

    Raises:
        MechanismError: the mechanism cannot be right or cannot be assembled, there is no such output or input, an
            input does not take a value, or an output is one of the buffers of impacts and events.
        ValueError: times that cannot be.
        SimulationError: the motion cannot go on.

    Source: `Simulation`, row by row.
    """
    start, until = float(quantity(start, "s", "start")), float(quantity(until, "s", "until"))
    step = (until - start) / _USUAL_STEPS if step is None else float(quantity(step, "s", "step"))
    if isinstance(mechanism, Model):
        mechanism = mechanism.build(mechanism.values())
    if not (np.isfinite([start, until, step]).all() and until > start and step > 0.0):
        raise ValueError(f"from {start:g} s to {until:g} s in steps of {step:g} s: give finite times, in this order.")
    given = dict(inputs or {})
    for name in given:
        input_place(name, mechanism.inputs)
    asked = _shown(mechanism, outputs)
    shown = asked if outputs is not None else [output for output in asked if "[" not in output.name]
    whole = replace(mechanism, outputs=(*asked, *_kept(mechanism)))

    def value(name: str, at: float) -> float | str:
        signal = given[name]
        return signal(at) if callable(signal) else signal

    began = time.perf_counter()
    starts = [value(port.name, start) if port.name in given else port.start for port in whole.inputs]
    simulation = Simulation(whole, start, starts)
    driven = [name for name, signal in given.items() if callable(signal)]
    count = max(int(np.ceil((until - start) / step - 1e-9)), 1)
    times = [*(start + step * np.arange(count)).tolist(), until]
    rows, impacts, events = [], simulation.impacts_in_step(), simulation.events_in_step()
    names = [output.name for output in shown]
    for at in times:
        if at > start:
            for name in driven:
                simulation.set_input(name, value(name, simulation.time))
            _advance(simulation, at, impacts, events)
        values = simulation.read()
        rows.append([at, *(simulation.inputs.tolist()), *(values[name] for name in names)])
    return Result.of(whole, shown, rows, impacts, events, _statistics(simulation, len(times) - 1, began))


def _advance(simulation: Simulation, until: float, impacts: list[Impact], events: list[Event]) -> None:
    """Go on, and stop at each event: so none is lost, and no impact, however many there are."""
    seen_impacts, seen_events = _counts(simulation)
    simulation.begin_step()  # where an input jumps, something may slip at once
    while simulation.time < until:
        simulation.go_on(until, codes.STOP_AT_EVENT)
        now_impacts, now_events = _counts(simulation)
        if now_impacts > seen_impacts:
            impacts += simulation.impacts_in_step(now_impacts - seen_impacts)
        if now_events > seen_events:
            events += simulation.events_in_step(now_events - seen_events)
        seen_impacts, seen_events = now_impacts, now_events


def _counts(simulation: Simulation) -> tuple[int, int]:
    counters = simulation.counters
    return counters.item(codes.COUNT_IMPACTS), counters.item(codes.COUNT_EVENTS)


def _shown(mechanism: Mechanism, outputs: Sequence[str | Output] | None) -> list[Output]:
    """The outputs that are asked for.

    Raises:
        MechanismError: a name is neither that of an output nor a source, or that of an impact or event of a step.
    """
    if outputs is None:
        every = mechanism.outputs or default_outputs(mechanism)
        return [output for output in every if output.source not in _OF_BUFFERS]
    every = (*mechanism.outputs, *default_outputs(mechanism))
    named = {output.name: output for output in reversed(every)} | {output.name: output for output in mechanism.outputs}
    read = {output.source: output for output in reversed(every)}
    found = [
        output if isinstance(output, Output) else named.get(output) or read.get(output) or _of_source(output, mechanism)
        for output in outputs
    ]
    for output in found:
        for what in ("impacts", "events"):
            if output.source.startswith(f"{what}["):
                raise MechanismError(
                    f"output {output.name!r} reads {output.source}, of the last communication step alone; a run keeps "
                    f"all {what}: leave it out, and take result.{what} or result.{what[:-1]}_table."
                )
    return found


def _of_source(source: str, mechanism: Mechanism) -> Output:
    """An output that reads a source, by its name; a unit it has where the source has one of its own.

    Raises:
        MechanismError: there is no such source.
    """
    resolve_output(source, mechanism)
    quantity = source.rpartition(".")[2]
    return Output(source.replace(".", "_"), source, "", _UNITS.get(quantity, "1"))


def _kept(mechanism: Mechanism) -> tuple[Output, ...]:
    """Outputs that ask for buffers with room for all that can happen at one instant; nobody sees them."""
    if not (mechanism.contacts or mechanism.functions or mechanism.patterns or mechanism.rubbing):
        return ()
    place = min(_ROOM * (1 + len(mechanism.contacts) + len(mechanism.functions)), codes.MOST_KEPT)
    return tuple(Output(f"{what}[{place}].time", f"{what}[{place}].time", "", "s") for what in ("impacts", "events"))


def _statistics(simulation: Simulation, steps: int, began: float) -> Statistics:
    counted = simulation.counters.tolist()
    return Statistics(
        communication_steps=steps,
        accepted_steps=counted[codes.COUNT_STEPS],
        rejected_steps=counted[codes.COUNT_REJECTED],
        evaluations=counted[codes.COUNT_TRIES] * (METHOD.stages - 1),
        events=counted[codes.COUNT_EVENTS],
        impacts=counted[codes.COUNT_IMPACTS],
        wall_time=time.perf_counter() - began,
    )
