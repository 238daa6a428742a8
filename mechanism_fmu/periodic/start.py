"""The state at the beginning of a cycle: which numbers of it are sought, and the mechanism that starts with them.

A number is a start parameter of the model, or a coordinate or rate of a body, "wheel.angle", "wheel.speed": those are
put into the bodies' own start, so that a model needs no parameters for them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from ..model import Body, Mechanism, MechanismError, Model, Output
from ..model.quantities import quantity
from ..simulation import Simulation
from .passage import Direction, Section

Array = npt.NDArray[np.float64]

#: What a body's state is, and in which units.
COORDINATES = ("x", "y", "angle")
RATES = ("x_rate", "y_rate", "speed")
UNITS = dict(zip(COORDINATES + RATES, ("m", "m", "rad", "m/s", "m/s", "rad/s"), strict=True))
#: Numbers below these are small [their unit]: steps of differences and residuals are shares of the larger of the two.
_SMALL = {"m": 1e-2, "rad": 1e-1, "m/s": 1e-1, "rad/s": 1.0}
_START = "_start"
_CLOSED: dict[str, Any] = {"closed": True}


@dataclass(frozen=True)
class Unknown:
    """A number of the state at the beginning of a cycle.

    Attributes:
        name: a parameter, "pendulum_angle_start", or a coordinate or rate of a body, "wheel.angle".
        output: what it is compared with at the end of the cycle: an output; of a coordinate, itself.
        unit: SI unit of both.
        advance: by how much it grows each cycle [unit], as the angle of a wheel does that is let go by a tooth.
    """

    name: str
    output: str
    unit: str
    advance: float = 0.0

    @property
    def of_body(self) -> bool:
        """Whether it is a coordinate or rate of a body."""
        return "." in self.name

    def scale(self, value: float) -> float:
        """What changes of it are measured by [unit]: its size, or what is small in its unit, if that is more."""
        return max(abs(value), _SMALL.get(self.unit, 1e-6))


@dataclass(frozen=True)
class Problem:
    """What is asked: a model with its fixed numbers, and the unknown ones.

    Attributes:
        model: the model.
        values: of parameters that differ from the default, by name [their unit].
        inputs: likewise; held through all cycles.
        unknowns: what is sought, at least one.
        held: coordinates that stay as they are at the beginning, "balance.angle" of a section.
        tolerance: relative, of the integration [1].
        state: coordinates and rates of all bodies, by name; {}: the start of the model.
        closed: contacts that are closed in that state.
    """

    model: Model
    values: Mapping[str, float]
    inputs: Mapping[str, float]
    unknowns: tuple[Unknown, ...]
    held: tuple[str, ...] = ()
    tolerance: float = 1e-11
    state: Mapping[str, float] | None = None
    closed: tuple[str, ...] = ()

    @property
    def advances(self) -> Array:
        """By how much each unknown grows each cycle, shape (unknowns,) [their units]."""
        return np.array([unknown.advance for unknown in self.unknowns])

    def guess(self) -> Array:
        """The unknowns as the model has them, or as the state says, shape (unknowns,) [their units]."""
        defaults = {p.name: p.start for p in self.model.parameters} | dict(self.values)
        state = self.state or (_assembled(self) if any(u.of_body for u in self.unknowns) else {})
        known = state if self.state else {}
        return np.array(
            [state[u.name] if u.of_body else known.get(u.output, defaults.get(u.name, 0.0)) for u in self.unknowns]
        )

    def with_state(self) -> Problem:
        """The same with a state: where numbers of bodies are sought and there is none, that of the model's start."""
        if self.state or not any(unknown.of_body for unknown in self.unknowns):
            return self
        return replace(self, state=_assembled(self))

    def scales(self, x: Array) -> Array:
        """What changes of the unknowns are measured by, shape (unknowns,) [their units].

        Args:
            x: unknowns, shape (unknowns,).
        """
        return np.array([unknown.scale(float(value)) for unknown, value in zip(self.unknowns, x, strict=True)])

    def simulation(self, x: Array) -> Simulation:
        """The mechanism at the beginning of a cycle, at time 0.

        Args:
            x: unknowns, shape (unknowns,).

        Raises:
            MechanismError: there can be no such mechanism, or it cannot be assembled.
        """
        return _begun(self.mechanism(x), self.inputs)

    def mechanism(self, x: Array) -> Mechanism:
        """The mechanism that starts with these unknowns; its outputs are the model's and all coordinates and rates.

        Args:
            x: unknowns, shape (unknowns,).
        """
        given = dict(zip((u.name for u in self.unknowns), map(float, x), strict=True))
        numbers = {name: value for name, value in given.items() if "." not in name}
        built = _built(self, numbers)
        of_bodies = {name: value for name, value in given.items() if "." in name}
        if not of_bodies:  # the model makes the start of its parameters
            return built
        state = {**(self.state or _assembled(self)), **of_bodies}
        bodies = tuple(_placed(body, state) for body in built.bodies)
        held = {_coordinate(name) for name in (*of_bodies, *self.held)}
        return replace(built, bodies=bodies, held=tuple(sorted(held)), contacts=_closed(built, self.closed))


def problem_of(
    model: Model,
    unknowns: Sequence[str] = (),
    settings: Sequence[str] = (),
    advances: Sequence[str] = (),
    tolerance: float = 1e-11,
    section: str = "",
) -> Problem:
    """A problem as it is written on a command line.

    Args:
        model: the model.
        unknowns: names, "wheel.angle" or "pendulum_angle_start"; with another output than that of the same name
            without `_start`: "start=bird"; none: all parameters that end in `_start` and have such an output.
        settings: "name=value", of parameters and inputs, with or without unit.
        advances: "name=value", of unknowns that grow each cycle.
        tolerance: relative, of the integration [1].
        section: output of the section, which may advance, too.

    Raises:
        MechanismError: a name, value or unit that cannot be; the message says what can.
    """
    values, inputs = _settings(model, settings)
    bare = Problem(model, values, inputs, (), tolerance=tolerance)
    mechanism = _built(bare, {})
    outputs = {output.name: output.unit for output in mechanism.outputs}
    parameters = {p.name: p.unit for p in model.parameters}
    wanted = list(unknowns) or [name for name in parameters if name.endswith(_START) and _bare(name) in outputs]
    if not wanted:
        raise MechanismError(
            f"{model.name} has no parameter like angle{_START} with an output of the same name; say what is unknown at "
            f"the beginning of a cycle, --unknown NAME for each: {', '.join(_of_bodies(mechanism))}."
        )
    found = [_unknown(text, parameters, outputs) for text in wanted]
    for name, text in (_pair(entry, "--advance") for entry in advances):
        places = [k for k, u in enumerate(found) if name in (u.name, u.output)]
        if not places and name == section:
            continue
        if not places:
            raise MechanismError(f"{name} advances, but is not unknown; unknown: {', '.join(u.name for u in found)}.")
        unknown = found[places[0]]
        found[places[0]] = replace(unknown, advance=_number(text, unknown.unit, name))
    return replace(bare, unknowns=tuple(found))


def section_of(
    problem: Problem,
    text: str,
    direction: Direction,
    passages: int = 1,
    longest: float | None = None,
    advances: Sequence[str] = (),
) -> Section:
    """A section as it is written on a command line.

    Args:
        problem: whose outputs it may name.
        text: "output", "output=value", with or without unit.
        direction: "rising" or "falling".
        passages: of a cycle.
        longest: a cycle that takes longer is none [s]; None: ten times the stop time of the model.
        advances: as of `problem_of`.

    Raises:
        MechanismError: there is no such output, or the value is none of it.
    """
    name, _, value = text.partition("=")
    units = {output.name: output.unit for output in _built(problem, {}).outputs}
    if name not in units:
        raise MechanismError(f"There is no output {name!r} for a section; there are: {', '.join(units)}.")
    advance = dict(_pair(entry, "--advance") for entry in advances).get(name, "0")
    number, step = (_number(each, units[name], name) for each in (value or "0", advance))
    return Section(name, number, direction, passages, longest or 10.0 * problem.model.stop_time, step)


def _number(text: str, unit: str, name: str) -> float:
    """A number in an SI unit, which may be left out."""
    try:
        return float(text)
    except ValueError:
        return float(quantity(text, unit, name))


def _unknown(text: str, parameters: Mapping[str, str], outputs: Mapping[str, str]) -> Unknown:
    name, _, output = text.partition("=")
    if "." in name:
        if name not in outputs:
            known = ", ".join(other for other in outputs if other.rpartition(".")[2] in UNITS and "[" not in other)
            raise MechanismError(f"There is no {name!r} to be unknown; of bodies there are: {known}.")
        return Unknown(name, name, UNITS[name.rpartition(".")[2]])
    if name not in parameters:
        starts = ", ".join(other for other in parameters if "start" in other) or "none"
        raise MechanismError(
            f"There is no parameter {name!r} to be unknown; with 'start' in their names there are: {starts}; or name "
            "coordinates and rates of bodies, 'body.angle'."
        )
    output = output or _bare(name)
    if output not in outputs:
        raise MechanismError(
            f"{name} is compared at the end of the cycle with the output {output!r}, which is not there; write "
            f"--unknown {name}=OUTPUT with one of: {', '.join(o for o in outputs if '[' not in o)}."
        )
    if outputs[output] != parameters[name]:
        raise MechanismError(
            f"{name} in {parameters[name]} cannot be compared with {output} in {outputs[output]}; write --unknown "
            f"{name}=OUTPUT with one in {parameters[name]}."
        )
    return Unknown(name, output, parameters[name])


def _settings(model: Model, settings: Sequence[str]) -> tuple[dict[str, float], dict[str, float]]:
    """Parameters and inputs that are set, as numbers."""
    units = {p.name: p.unit for p in model.parameters}
    ports = {port.name: port for port in model.build(model.values()).inputs}
    values, inputs = {}, {}
    for name, text in (_pair(entry, "--set") for entry in settings):
        if name in ports:
            inputs[name] = _number(text, ports[name].unit, name)
        else:
            values[name] = _number(text, units.get(name, "1"), name)
    model.values(**values)
    return values, inputs


def _pair(entry: str, option: str) -> tuple[str, str]:
    name, equals, text = entry.partition("=")
    if not equals or not text:
        raise MechanismError(f"{option} {entry}: write {option} NAME=VALUE, as in {option} angle=5deg.")
    return name, text


def _bare(name: str) -> str:
    return name.removesuffix(_START)


def _of_bodies(mechanism: Mechanism) -> list[str]:
    return [f"{body.name}.{what}" for body in mechanism.bodies for what in COORDINATES + RATES]


def _coordinate(name: str) -> str:
    """The coordinate of a coordinate or rate: "wheel.angle" of "wheel.speed"."""
    body, _, what = name.rpartition(".")
    return f"{body}.{COORDINATES[RATES.index(what)] if what in RATES else what}"


def _built(problem: Problem, numbers: Mapping[str, float]) -> Mechanism:
    """The model's mechanism, with all coordinates and rates among its outputs, integrated finely."""
    built = problem.model.build(problem.model.values(**{**problem.values, **numbers}))
    more = tuple(Output(name, name, "", UNITS[name.rpartition(".")[2]]) for name in _of_bodies(built))
    own = tuple(o for o in built.outputs if "[" not in o.name and not o.name.startswith("drawing_"))
    own = tuple(o for o in own if o.name not in {output.name for output in more})
    settings = replace(built.settings, relative_tolerance=problem.tolerance)
    return replace(built, outputs=own + more, calculated=(), settings=settings)


def _begun(mechanism: Mechanism, inputs: Mapping[str, float]) -> Simulation:
    values = [inputs.get(port.name, port.start) for port in mechanism.inputs]
    return Simulation(mechanism, 0.0, values)


def _placed(body: Body, state: Mapping[str, float]) -> Body:
    x, y, angle, *rates = (state[f"{body.name}.{what}"] for what in COORDINATES + RATES)
    return replace(body, start=(x, y, angle), start_rate=(rates[0], rates[1], rates[2]))


def _assembled(problem: Problem) -> dict[str, float]:
    """All outputs at the start of the model, by name."""
    return _begun(_built(problem, {}), problem.inputs).read()


def _closed(mechanism: Mechanism, names: Sequence[str]) -> tuple[Any, ...]:
    """Contacts, of which those named begin closed: assembly then keeps them so, whatever the unknowns are."""
    return tuple(
        replace(contact, **_CLOSED)
        if contact.name in names and any(field.name == "closed" for field in fields(contact))
        else contact
        for contact in mechanism.contacts
    )
