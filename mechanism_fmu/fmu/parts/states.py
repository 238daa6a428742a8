"""The continuous states of Model Exchange, and their derivatives, as variables of an FMU.

They are the engine's unknowns y = (q, qd, work, loss, alpha, own, wear), in its order. Coordinates are redundant: what
joints hold is kept by the accelerations, with gains on its drift in the mechanism's own time, and put right in events.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from typing import NamedTuple

from ...model import Mechanism
from .variables import Variable

#: Unit of the derivative of a state.
_PER_SECOND = {"m": "m/s", "rad": "rad/s", "m/s": "m/s2", "rad/s": "rad/s2", "J": "W", "1": "1/s"}
#: Nominal of a speed, for a place of nominal 1 [1/s]. With 1, integrators that measure errors by nominals find the
#: ratchet's impact five times less accurately.
_NOMINAL_RATE = 0.1


class State(NamedTuple):
    """A continuous state.

    Attributes:
        name, description: of the variable.
        unit: SI unit; "1" of states of force elements' own.
        nominal: typical magnitude, in `unit`: what an integrator measures its errors by.
    """

    name: str
    description: str
    unit: str
    nominal: float


def states_of(mechanism: Mechanism) -> tuple[State, ...]:
    """The states of a mechanism, in the order of the engine's unknowns."""
    return tuple(_states(mechanism))


def state_variables(mechanism: Mechanism, first: int, taken: Collection[str]) -> tuple[Variable, ...]:
    """The states and behind them their derivatives, as local variables.

    Args:
        mechanism: whose they are.
        first: value reference of the first one.
        taken: names that others have; a state of such a name, or of one of an earlier state, is called `state.NAME`.
    """
    states = states_of(mechanism)
    names: list[str] = []
    for state in states:
        names.append(_free(state.name, {*taken, *names}))
    variables = [
        Variable(
            name,
            reference,
            "Real",
            "local",
            "continuous",
            "calculated",
            state.description,
            state.unit,
            nominal=state.nominal,
            state=True,
        )
        for reference, (name, state) in enumerate(zip(names, states, strict=True), first)
    ]
    rates = [
        Variable(
            f"der({name})",
            reference,
            "Real",
            "local",
            "continuous",
            "calculated",
            f"Derivative of {name}",
            _PER_SECOND[state.unit],
            derivative=reference - len(states),
        )
        for reference, (name, state) in enumerate(zip(names, states, strict=True), first + len(states))
    ]
    return (*variables, *rates)


def indicator_count(mechanism: Mechanism) -> int:
    """How many event indicators a mechanism has: one for each guard and threshold, one for turns."""
    guards = 2 * (len(mechanism.contacts) + len(mechanism.patterns)) + len(mechanism.functions)
    thresholds = sum(len(force.thresholds()) for force in mechanism.elements)
    return guards + len(mechanism.rubbing) + thresholds + 1


def _states(mechanism: Mechanism) -> Iterator[State]:
    bodies = mechanism.bodies
    size = max((abs(float(place)) for body in bodies for place in body.start[:2]), default=0.0) or 1.0
    energy = max((float(body.mass) for body in bodies), default=1.0) * size**2
    for rate in (False, True):
        what, m, rad = ("Velocity", "m/s", "rad/s") if rate else ("Position", "m", "rad")
        nominal = _NOMINAL_RATE if rate else 1.0
        names = ("vx", "vy", "omega") if rate else ("x", "y", "phi")
        for body in bodies:
            label = _identifier(body.name)
            for axis, name in zip("xy", names, strict=False):
                yield State(
                    f"{label}.{name}", f"{what} of the centre of mass of {body.name} along {axis}", m, nominal * size
                )
            turn = "Angular velocity" if rate else "Angle"
            yield State(f"{label}.{names[2]}", f"{turn} of {body.name}", rad, nominal)
    yield State("ledger.work", "Work done on the mechanism since the start", "J", energy)
    yield State("ledger.loss", "Energy lost but in impacts since the start", "J", energy)
    for contact in mechanism.contacts:
        for k in range(contact.alphas):
            yield State(
                f"{_identifier(contact.name)}.alpha[{k + 1}]", f"Place of contact of {contact.name}", "rad", 1.0
            )
    for force in mechanism.elements:
        for k in range(force.own):
            yield State(f"{_identifier(force.name)}.state[{k + 1}]", f"State of {force.name}", "1", 1.0)
    for contact in mechanism.contacts:
        if contact.wears:
            yield State(f"{_identifier(contact.name)}.sliding_work", f"Work of sliding of {contact.name}", "J", energy)


def _free(name: str, taken: Collection[str]) -> str:
    while name in taken or f"der({name})" in taken:
        name = f"state.{name}"
    return name


def _identifier(name: str) -> str:
    found = re.sub(r"\W", "_", name)
    return f"_{found}" if found[:1].isdigit() else found
