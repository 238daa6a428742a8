"""What the tests against the oracle of friction share: its cases, runs with their events, comparisons, parts."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from mechanism_fmu import codes
from mechanism_fmu.model import (
    AngleDriver,
    Body,
    Mechanism,
    Output,
    PointForce,
    PointLineContact,
    Revolute,
    Settings,
    polynomial_motion,
)
from mechanism_fmu.simulation import Simulation
from tests.exchanged_oracle import oracle_path

Case = Mapping[str, Any]

#: Another file with the same kinds of cases and other numbers.
OTHER_FILE = "FRICTION_ORACLE"
#: What a value may be off, as a share of the largest of its quantity in the case, by the tolerance of the integration.
SHARES = {1e-9: 1e-8, 1e-12: 1e-10}
#: The same, of impacts, and of accelerations and forces at an instant.
AT_AN_INSTANT = 1e-12


def kind_of(case: Case) -> str:
    """The kind of a case: the number with which its id begins, or the whole id."""
    number = re.match(r"\d+", case["id"])
    return number[0] if number else str(case["id"])


def all_cases() -> list[Case]:
    """The cases of the oracle, or of the file that FRICTION_ORACLE names."""
    cases: list[Case] = json.loads(oracle_path(OTHER_FILE, "friction.json").read_text(encoding="utf-8"))["cases"]
    return cases


def numbered(results: Mapping[str, Any], name: str) -> dict[int, Any]:
    """The results "<name>1", "<name>2" ... that there are, by number."""
    keys = [key for key in results if key.startswith(name) and key[len(name) :].isdigit()]
    return {int(key[len(name) :]): results[key] for key in keys}


class Comparison:
    """Values beside those expected, each judged by the largest magnitude of its quantity in the case."""

    def __init__(self, share: float) -> None:
        self._share = share
        self._pairs: dict[str, list[tuple[str, float, float]]] = {}

    def add(self, quantity: str, name: str, values: float | Sequence[float], expected: float | Sequence[float]) -> None:
        """Note one value, or several, of a quantity: those with a common scale."""
        pairs = zip(np.atleast_1d(values).tolist(), np.atleast_1d(expected).tolist(), strict=True)
        self._pairs.setdefault(quantity, []).extend((name, value, right) for value, right in pairs)

    def deviations(self) -> Iterator[tuple[str, str, float]]:
        """Quantity, name and deviation, as a share of the largest magnitude (of 1, where all are zero)."""
        for quantity, pairs in self._pairs.items():
            scale = max(abs(right) for _, _, right in pairs) or 1.0
            yield from ((quantity, name, abs(value - right) / scale) for name, value, right in pairs)

    def check(self) -> None:
        """Fail where any value is too far off."""
        found = list(self.deviations())
        assert found
        wrong = [f"{quantity} {name}: off by {off:.2g}" for quantity, name, off in found if not off <= self._share]
        assert not wrong, f"more than {self._share:g} of the largest: " + "; ".join(wrong)


# Runs.


class Moment(NamedTuple):
    """The state at an instant: behind the event `name`, if there is one."""

    time: float
    name: str
    state: dict[str, float]
    #: Of each contact o (apart), s (it sticks), + or -; behind them s, + or - of what else has friction.
    modes: str
    #: Of contacts, and behind them of joints and force elements, along the direction of slip [N, N m].
    friction: list[float]


def simulation_of(
    bodies: Sequence[Body], tolerance: float, contacts: Sequence[Any] = (), start: float = 0.0, **parts: Any
) -> Simulation:
    """A mechanism with friction in motion."""
    return Simulation(mechanism_of(bodies, tolerance, contacts, **parts), start)


def mechanism_of(bodies: Sequence[Body], tolerance: float, contacts: Sequence[Any] = (), **parts: Any) -> Mechanism:
    """A mechanism with friction; its outputs are all coordinates and rates, contact forces, energies."""
    sources = [f"{body.name}.{what}" for body in bodies for what in ("x", "y", "angle", "x_rate", "y_rate", "speed")]
    sources += [f"{contact.name}.{what}" for contact in contacts for what in ("force", "closed")]
    sources += ["energy.kinetic", "energy.lost", "impact.energy_lost"]
    sources += [f"impact.impulse:{contact.name}" for contact in contacts]
    sources += [f"impact.speed_before:{body.name}" for body in bodies]
    return Mechanism(
        tuple(bodies),
        contacts=tuple(contacts),
        outputs=tuple(Output(source, source, "") for source in sources),
        settings=Settings(relative_tolerance=tolerance),
        **parts,
    )


def now(simulation: Simulation, name: str = "") -> Moment:
    """The present state."""
    state = simulation.read()
    modes = {codes.APART: "o", codes.STICKS: "s", codes.FORWARDS: "+", codes.BACKWARDS: "-"}
    slips = [modes[slip] for slip in simulation.field("rub_slip").tolist()]
    contacts = simulation.field("contact_mode").size
    others = "".join(slips[contacts:]).replace("o", "")
    return Moment(
        simulation.time, name, state, "".join(slips[:contacts]) + others, simulation.field("rub_force").tolist()
    )


def run(simulation: Simulation, until: float) -> list[Moment]:
    """Go on to `until` in one communication step; the events on the way."""
    simulation.begin_step()
    moments: list[Moment] = []
    seen = simulation.counters.item(codes.COUNT_EVENTS)
    while simulation.time < until:
        simulation.go_on(until, codes.STOP_AT_STEP)
        new = simulation.counters.item(codes.COUNT_EVENTS) - seen
        seen += new
        moments += [now(simulation, event.guard) for event in simulation.events_in_step()[-new:] if new]
    return moments


def after(simulation: Simulation, until: float) -> Moment:
    """Go on to `until` in one communication step; the state there."""
    simulation.advance(until)
    return now(simulation)


# Parts.


def block(name: str, mass: float, x: float = 0.0, speed: float = 0.0, y: float = 0.0) -> Body:
    """A body that cannot turn where it is touched in its centre of mass."""
    return Body(name, mass, mass, (x, y, 0.0), (speed, 0.0, 0.0))


def on_line(name: str, body: str, under: str, coefficient: float) -> PointLineContact:
    """The centre of a body on the line through the centre of another, along its x axis."""
    return PointLineContact(name, body, (0.0, 0.0), under, (0.0, 0.0), (0.0, 1.0), closed=True, friction=coefficient)


def exciter(of: Body, force: float, frequency: float, phase: float) -> tuple[Sequence[Body], dict[str, Any]]:
    """The force F cos(frequency t + phase) along x on a body, exactly: that body, lighter, and two arms on it; parts.

    Either arm, a quarter of the mass, turns about the body's centre of mass with a force F/2 along itself: one with
    frequency t + phase, the other against it, so that the forces across x cancel.
    """
    parts: dict[str, Any] = {"joints": [], "forces": []}
    bodies = [Body(of.name, 0.5 * of.mass, of.inertia, of.start, of.start_rate)]
    for name, sign in (("arm_1", 1.0), ("arm_2", -1.0)):
        start, rate = (*of.start[:2], sign * phase), (*of.start_rate[:2], sign * frequency)
        bodies.append(Body(name, 0.25 * of.mass, of.inertia, start, rate))
        parts["joints"] += [
            Revolute(f"{name}_pin", name, (0.0, 0.0), of.name, (0.0, 0.0)),
            AngleDriver(f"{name}_driver", name, polynomial_motion(sign * phase, sign * frequency)),
        ]
        parts["forces"].append(PointForce(f"{name}_force", name, (0.0, 0.0), (0.5 * force, 0.0), "body"))
    return bodies, parts
