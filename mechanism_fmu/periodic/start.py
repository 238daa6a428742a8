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

from ..model import Body, Mechanism, Model, Output
from ..simulation import Simulation

Array = npt.NDArray[np.float64]

#: What a body's state is, and in which units.
COORDINATES = ("x", "y", "angle")
RATES = ("x_rate", "y_rate", "speed")
UNITS = dict(zip(COORDINATES + RATES, ("m", "m", "rad", "m/s", "m/s", "rad/s"), strict=True))
#: Numbers below these are small [their unit]: steps of differences and residuals are shares of the larger of the two.
_SMALL = {"m": 1e-2, "rad": 1e-1, "m/s": 1e-1, "rad/s": 1.0}


@dataclass(frozen=True)
class Unknown:
    """A number of the state at the beginning of a cycle.

    Attributes:
        name: a parameter, "pendulum_angle_start", or a coordinate or rate of a body, "wheel.angle".
        output: what it is compared with at the end of the cycle: an output; of a coordinate, itself.
        unit: SI unit of both.
        advance: by how much it grows each cycle [unit], as the angle of a wheel does that is let go by a tooth.

    Source: R. Seydel, Practical Bifurcation and Stability Analysis, 3rd ed. (2010), sections 7.4 and 7.5.
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
        """What changes of it are measured by [unit]: its size, or what is small in its unit, if that is more.

        Args:
            value: of it [unit].
        """
        return max(abs(value), _SMALL.get(self.unit, 1e-6))


@dataclass(frozen=True)
class Problem:
    """What is asked: a model with its fixed numbers, and the unknown ones.

    Attributes:
        model: the model.
        values: of parameters that differ from the default, by name [their unit].
        inputs: likewise [their unit]; held through all cycles.
        unknowns: what is sought, at least one.
        held: coordinates that stay as they are at the beginning, "balance.angle" of a section.
        tolerance: relative, of the integration [1].
        state: all outputs at the beginning, with coordinates and rates of all bodies, by name [SI units]; None: as the
            model starts, which `with_state` finds out.
        closed: contacts that are closed in that state.

    Source: R. Seydel, Practical Bifurcation and Stability Analysis, 3rd ed. (2010), sections 7.4 and 7.5.
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
        known = self._known
        return np.array([known[u.name] if u.of_body else known.get(u.output, defaults[u.name]) for u in self.unknowns])

    @property
    def touching(self) -> tuple[str, ...]:
        """Contacts that are closed at the beginning and cannot be kept so where numbers of bodies are varied."""
        if not any(unknown.of_body for unknown in self.unknowns):
            return ()
        kept = _kept(finely(self, {}))
        return tuple(name for name in self.closed if name not in kept)

    @property
    def _known(self) -> Mapping[str, float]:
        return self.state or {}

    def with_state(self) -> Problem:
        """The same with a state: where numbers of bodies are sought and there is none, that of the model's start."""
        if self.state or not any(unknown.of_body for unknown in self.unknowns):
            return self
        begun = _begun(finely(self, {}), self.inputs)
        return replace(self, state=begun.read(), closed=begun.mode())

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
        built = finely(self, numbers)
        of_bodies = {name: value for name, value in given.items() if "." in name}
        if not of_bodies:  # the model makes the start of its parameters
            return built
        state = {**self._known, **of_bodies}
        bodies = tuple(_placed(body, state) for body in built.bodies)
        held = {_coordinate(name) for name in (*of_bodies, *self.held)}
        return replace(built, bodies=bodies, held=tuple(sorted(held)), contacts=_closed(built, self.closed))


def numbers_of_bodies(mechanism: Mechanism) -> list[str]:
    """Names of all coordinates and rates.

    Args:
        mechanism: whose bodies they are of.
    """
    return [f"{body.name}.{what}" for body in mechanism.bodies for what in COORDINATES + RATES]


def _coordinate(name: str) -> str:
    """The coordinate of a coordinate or rate: "wheel.angle" of "wheel.speed"."""
    body, _, what = name.rpartition(".")
    return f"{body}.{COORDINATES[RATES.index(what)] if what in RATES else what}"


def finely(problem: Problem, numbers: Mapping[str, float]) -> Mechanism:
    """The model's mechanism, with all coordinates and rates among its outputs, integrated finely.

    Args:
        problem: whose model it is.
        numbers: parameters beside those that are fixed, by name [their unit].
    """
    built = problem.model.build(problem.model.values(**{**problem.values, **numbers}))
    more = tuple(Output(name, name, "", UNITS[name.rpartition(".")[2]]) for name in numbers_of_bodies(built))
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


def _closed(mechanism: Mechanism, names: Sequence[str]) -> tuple[Any, ...]:
    """Contacts, of which those named begin closed: assembly then keeps them so, whatever the unknowns are.

    Outlines cannot begin closed: they touch, or do not, as the bodies stand.
    """
    return tuple(
        replace(contact, **_as(contact.name in names))
        if any(field.name == "closed" for field in fields(contact))
        else contact
        for contact in mechanism.contacts
    )


def _as(closed: bool) -> dict[str, Any]:
    return {"closed": closed}


def _kept(mechanism: Mechanism) -> set[str]:
    return {c.name for c in mechanism.contacts if any(field.name == "closed" for field in fields(c))}
