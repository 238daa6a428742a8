"""A mechanism in motion: where `model` and `engine` meet, for FMUs, `batch` and `simulation`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from ctypes import CDLL
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np

from . import codes
from .advice import failure_details, picture_of_overlap, start_details
from .engine import status
from .engine.run import NotCompiledError, engine_for
from .model import Input, Mechanism, MechanismError, compile_mechanism
from .model.event_names import event_name
from .model.model import check_value
from .model.quantities import quantity
from .tables.layout import field_of, pack, state_of

__all__ = ["Event", "Impact", "MovingMechanism", "SimulationError", "StepBudgetError", "input_place", "input_value"]

Array = np.ndarray[Any, np.dtype[Any]]


class SimulationError(RuntimeError):
    """The motion cannot go on; the message gives the time, the reason and what to do.

    Attributes:
        picture: where two bodies have gone into each other, an SVG file as text that shows them; else "".
    """

    picture = ""


class StepBudgetError(SimulationError):
    """A communication step ended early (`status.OUT_OF_STEPS`); the time reached is good, and the next goes on."""


class Impact(NamedTuple):
    """An impact of one contact.

    All impacts of one instant, of several contacts or of several rounds, share `instant`, `velocity` and `energy_lost`:
    who sums, sums once an instant.

    Attributes:
        time: [s].
        contact: its name.
        closing_speed: normal, before [m/s; rad/s of stops and locks].
        impulse: normal [N s; N m s of stops and locks].
        instant: counts instants with impacts, from 1.
        velocity: v_I [m/s], length of the teeth times the jump of their body's speed; 0 without a body with teeth.
        energy_lost: [J].
    """

    time: float
    contact: str
    closing_speed: float
    impulse: float
    instant: int
    velocity: float
    energy_lost: float


class Event(NamedTuple):
    """An event: what made it happen, and the mode before and after.

    Attributes:
        time: [s].
        guard: e.g. "face.gap", "slope.force", "teeth.next", "teeth.previous", "holding_pawl.click", "pin_in_slot", or
            "input" when inputs have changed (`mechanism_fmu.model.logical_functions`).
        old_mode, new_mode: names of the closed contacts.
        impulse: sum of magnitudes over the contacts that struck or were switched on [N s; N m s of stops and locks].
    """

    time: float
    guard: str
    old_mode: tuple[str, ...]
    new_mode: tuple[str, ...]
    impulse: float


def input_place(name: str, ports: Sequence[Input]) -> int:
    """The place of an input among all.

    Args:
        name: of the input.
        ports: all inputs.

    Raises:
        MechanismError: there is no such input.
    """
    names = [port.name for port in ports]
    if name not in names:
        raise MechanismError(f"there is no input {name!r}; there are: {', '.join(names) or 'none'}.")
    return names.index(name)


def input_value(port: Input, value: float | str) -> float:
    """A value for an input in its SI unit, checked against its limits.

    Args:
        port: the input.
        value: in its SI unit, or a text with another unit of the kind, "20 N.mm".

    Raises:
        MechanismError: it is no finite number, outside the limits, or of another unit.
    """
    number = quantity(value, port.unit, port.name)
    try:
        found = float(number)
    except (TypeError, ValueError):
        raise MechanismError(f"{port.name} wants a number in {port.unit}, got {value!r}.") from None
    check_value(port, found)
    return found


class MovingMechanism:
    """One mechanism, from assembly through its motion.

    Args:
        mechanism: its numbers are checked and written as tables.
        start_time: [s].
        inputs: values at the start, in the order of `mechanism.inputs`, one for each; their own start values by
            default.

    Raises:
        MechanismError: the mechanism cannot be right, or cannot be assembled (with what is left of each joint); or the
            values of inputs are too few, too many, or such as an input does not take.
    """

    def __init__(
        self, mechanism: Mechanism, start_time: float = 0.0, inputs: Sequence[float | str] | None = None
    ) -> None:
        self._take(mechanism, pack(compile_mechanism(mechanism)))
        self._begin_with(start_time, inputs)

    @classmethod
    def over(cls, mechanism: Mechanism, block: Array, library: CDLL | None = None) -> MovingMechanism:
        """A simulation of what stands in a block; it has to `begin` yet, and begins anew when the block is rewritten.

        Args:
            mechanism: of the same structure; only names are taken from it.
            block: numbers of shape (size,), as `tables.layout.pack` makes them.
            library: of the compiled engine; None: as `engine.run.engine_for` finds it.
        """
        self = cls.__new__(cls)
        self._take(mechanism, block, library)
        return self

    def _take(self, mechanism: Mechanism, block: Array, library: CDLL | None = None) -> None:
        self._mechanism = mechanism
        self._block = block
        try:
            self._engine = engine_for(self._block, library)
        except NotCompiledError as error:
            raise MechanismError(str(error)) from error
        self._output_names = [o.name for o in mechanism.outputs] + [c.name for c in mechanism.calculated]
        self.inputs: Array = field_of(self._block, "inputs")
        self.outputs: Array = field_of(self._block, "outputs")
        self.state: Array = state_of(self._block)
        self.counters: Array = field_of(self._block, "counters")
        self._clock: Array = field_of(self._block, "clock")
        self._impacts: Array = field_of(self._block, "impacts")
        self._events: Array = field_of(self._block, "events")
        self._contacts = tuple(contact.name for contact in mechanism.contacts)
        # of thousands of events, hardly any is of a new kind
        self._closed = cache(self._closed_in)
        self._event_name = cache(partial(event_name, mechanism))

    def _begin_with(self, time: float, inputs: Sequence[float | str] | None) -> None:
        """Begin with values of all inputs, or with their own start values."""
        ports = self._mechanism.inputs
        if inputs is not None:
            if len(inputs) != len(ports):
                names = ", ".join(port.name for port in ports) or "none"
                raise MechanismError(
                    f"inputs has {len(inputs)} values for {len(ports)} inputs ({names}); give one for each, in this "
                    "order."
                )
            self.inputs[:] = [input_value(port, value) for port, value in zip(ports, inputs, strict=True)]
        self.begin(time)

    @property
    def time(self) -> float:
        """The time reached [s]."""
        return float(self._clock.item(codes.TIME))

    def begin(self, time: float) -> None:
        """Assemble the mechanism and make it ready at `time` [s]; what is made of a mechanism has begun already.

        Args:
            time: at which the motion begins [s].

        Raises:
            MechanismError: it cannot be assembled, or the time is not finite.
        """
        if not math.isfinite(time):
            raise MechanismError(f"the start time is {time} s; give a finite one.")
        outcome = self._engine.begin(float(time)) or self._engine.advance(float(time))
        if outcome == status.OK:
            return
        text = status.ADVICE[outcome] + start_details(self._mechanism, self._block, outcome, self.mode())
        error = MechanismError(text)
        error.picture = picture_of_overlap(self._mechanism, self._block, outcome)
        raise error

    def advance(self, target: float) -> None:
        """Go on to time `target` [s] with the inputs held.

        Args:
            target: time to be reached [s], not before the present one.

        Raises:
            SimulationError: the motion cannot be continued; the time reached is the last good one.
        """
        self._require_later(target)
        self._require(self._engine.advance(float(target)))

    def begin_step(self) -> None:
        """Begin a communication step here: the records are emptied, and inputs with their slopes act from now on.

        Raises:
            SimulationError: as of `advance`.
        """
        self._require(self._engine.begin_step())

    def go_on(self, target: float, rule: int) -> None:
        """Go on within the communication step.

        Args:
            target: where to stop at the latest [s], not before `time`.
            rule: what stops earlier: `codes.STOP_AT_TARGET`, `codes.STOP_AT_IMPACT`, `codes.STOP_AT_EVENT` or
                `codes.STOP_AT_STEP`.

        Raises:
            SimulationError: as of `advance`.
        """
        self._require_later(target)
        self._require(self._engine.go_on(float(target), rule))

    def read(self) -> dict[str, float]:
        """All outputs and calculated parameters at the current time, by name (SI units)."""
        self._engine.read_outputs()
        return dict(zip(self._output_names, self.outputs.tolist(), strict=True))

    def read_array(self) -> Array:
        """As `read`, as an array of shape (outputs,): a view that the next read overwrites."""
        self._engine.read_outputs()
        return self.outputs

    def set_input(self, name: str, value: float | str) -> None:
        """Set an input from now on (SI units).

        Args:
            name: of the input.
            value: in its SI unit, or a text with another unit of the kind.

        Raises:
            MechanismError: there is no such input, or it does not take this value (`input_value`).
        """
        ports = self._mechanism.inputs
        place = input_place(name, ports)
        self.inputs[place] = input_value(ports[place], value)

    def set_slope(self, name: str, slope: float) -> None:
        """Let an input change by `slope` (its SI unit per second) during the next communication step, and hold then.

        Args:
            name: of the input.
            slope: change per second [SI unit/s].

        Raises:
            MechanismError: there is no such input, or the slope is not finite.
        """
        place = input_place(name, self._mechanism.inputs)
        if not math.isfinite(slope):
            raise MechanismError(f"{name}: slope = {slope} is not a finite number; give its change per second.")
        self.field("input_slopes")[place] = slope

    def read_rates(self) -> dict[str, float]:
        """Derivatives of all outputs with respect to time, by name (SI units); NaN where there is none."""
        self._engine.read_output_rates()
        return dict(zip(self._output_names, self.field("output_rates").tolist(), strict=True))

    def field(self, name: str) -> Array:
        """A view of a field of the instance's block (see `tables.layout`), for tests and diagnosis.

        Args:
            name: of the field.
        """
        return field_of(self._block, name)

    def passed_configurations(self) -> tuple[int, float]:
        """How many singular configurations have been passed so far, and when the last one was [s]; NaN if not known.

        It is not while the engine, which is ahead by a step, has already passed another one.
        """
        count, last = int(self.counters.item(codes.COUNT_PASSED)), float(self._clock.item(codes.PASSED_AT))
        if count == 0 or last > self.time:
            return max(0, count - 1), math.nan
        return count, last

    def pulling_contacts(self) -> dict[str, float]:
        """Closed contacts that have pulled so far, with the first time [s] at which each did."""
        times = field_of(self._block, "pull_time").tolist()
        pairs = zip(self._mechanism.contacts, times, strict=True)
        return {contact.name: time for contact, time in pairs if time <= self.time}

    def impacts_in_step(self, last: int | None = None) -> list[Impact]:
        """The impacts of the last call of `advance`, oldest first, at most as many as are kept (`model.Output`).

        Args:
            last: only that many, the last ones; None: all that are kept.
        """
        places = self._places(codes.FIRST_IMPACT, codes.COUNT_IN_STEP, len(self._impacts), last)
        records = self._impacts[places, : codes.RECORD_CONTACT_IMPULSES].tolist()
        names = self._contacts
        return [
            Impact(
                record[codes.RECORD_TIME],
                names[int(record[codes.RECORD_CONTACT])],
                record[codes.RECORD_CLOSING_SPEED],
                record[codes.RECORD_IMPULSE],
                int(record[codes.RECORD_INSTANT]),
                record[codes.RECORD_VELOCITY],
                record[codes.RECORD_ENERGY],
            )
            for record in records
        ]

    def events_in_step(self, last: int | None = None) -> list[Event]:
        """The events of the last call of `advance`, oldest first, at most as many as are kept (`model.Output`).

        Args:
            last: only that many, the last ones; None: all that are kept.
        """
        places = self._places(codes.FIRST_EVENT, codes.EVENTS_IN_STEP, len(self._events), last)
        records = self._events[places].tolist()
        return [
            Event(
                record[codes.EVENT_TIME],
                self._event_name(int(record[codes.EVENT_GUARD]), int(record[codes.EVENT_SUBJECT])),
                self._closed(tuple(record[codes.EVENT_OLD_MODE :: 2])),
                self._closed(tuple(record[codes.EVENT_NEW_MODE :: 2])),
                record[codes.EVENT_IMPULSE],
            )
            for record in records
        ]

    def _places(self, first: int, kept: int, length: int, last: int | None) -> Array:
        """Places of the records of a buffer that goes round, oldest first, or of the last of them."""
        count = int(self.counters[kept])
        begin = 0 if last is None else max(count - last, 0)
        return (int(self.counters[first]) + np.arange(begin, count)) % length

    def mode(self) -> tuple[str, ...]:
        """Names of the contacts that are closed now."""
        modes = field_of(self._block, "contact_mode").tolist()
        return tuple(c.name for c, mode in zip(self._mechanism.contacts, modes, strict=True) if mode == codes.CLOSED)

    def _closed_in(self, modes: tuple[float, ...]) -> tuple[str, ...]:
        mode = sum(int(word) << codes.MODE_BITS * k for k, word in enumerate(modes))
        return tuple(name for c, name in enumerate(self._contacts) if mode >> c & 1)

    def _require_later(self, target: float) -> None:
        if not self.time <= target < math.inf:
            raise SimulationError(
                f"t = {self.time:.9g} s: the motion cannot go on to {target:.9g} s; give a later time."
            )

    def _details(self, outcome: int) -> str:
        names = {name for event in self.events_in_step() for name in (*event.old_mode, *event.new_mode)}
        return failure_details(self._mechanism, self._block, outcome, names | set(self.mode()))

    def _require(self, outcome: int) -> None:
        if outcome != status.OK:
            kind = StepBudgetError if outcome in status.OUT_OF_STEPS else SimulationError
            error = kind(f"t = {self.time:.9g} s: {status.ADVICE[outcome]}{self._details(outcome)}")
            error.picture = picture_of_overlap(self._mechanism, self._block, outcome)
            raise error
