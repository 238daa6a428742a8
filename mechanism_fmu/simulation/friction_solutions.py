"""All forces with which friction agrees at the start of a motion: none, one, or several (Painlevé's paradox)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from .. import codes
from ..engine.run import engine_for
from ..model import Mechanism, MechanismError, Output, compile_mechanism
from ..model.mechanism import may_rub, turns
from ..tables.layout import field_of, pack
from ..tolerances import SLIPS_ABOVE
from .simulation import engine_here

#: A force may be missing this share of the largest one, an acceleration of the largest one.
_SHARE = 1e-9
#: More combinations of modes than these are not tried.
_MOST = 4096
_SLIPS = {codes.STICKS: "sticks", codes.FORWARDS: "slips forwards", codes.BACKWARDS: "slips backwards"}


@dataclass(frozen=True)
class FrictionSolution:
    """One way in which a motion can go on.

    Attributes:
        modes: of what touches, by name: "open", "closed" (without friction), "sticks", "slips forwards" or "slips
            backwards".
        normal_forces: of the contacts that touch, by name [N; N m of stops].
        friction_forces: of what rubs, by name, positive forwards [N; N m of pins and brakes].
        accelerations: (x, y, angle) of each body, by name [m/s2, m/s2, rad/s2].
    """

    modes: dict[str, str]
    normal_forces: dict[str, float]
    friction_forces: dict[str, float]
    accelerations: dict[str, tuple[float, float, float]]


def friction_solutions(mechanism: Mechanism, start_time: float = 0.0) -> tuple[FrictionSolution, ...]:
    """All solutions of the contact problem at the start, found by trying all combinations of modes.

    There is one as a rule. With friction there may be none, as for a rod that is pushed over a rough floor, and then
    only an impact leads on (`Mechanism.tangential_shock`); or several, of which a motion takes one. What slips is taken
    to slip on; what is at rest may stick, or slip either way.

    Args:
        mechanism: in its start position.
        start_time: [s].

    Returns:
        The solutions; those whose forces agree to 1e-9 of the largest are one.

    Raises:
        MechanismError: the mechanism cannot be right or cannot be assembled, or more contacts
            touch than can be tried (4096 combinations).

    Source: Genot, Brogliato, European Journal of Mechanics A 18 (1999) 653; Glocker, Pfeiffer, Nonlinear Dynamics 7
        (1995) 471: the complementarity problem whose solutions are sought.
    """
    still = replace(mechanism.settings, baumgarte_alpha=0.0, baumgarte_beta=0.0)
    looked = replace(mechanism, outputs=tuple(_outputs(mechanism)), calculated=(), settings=still)
    search = _Search(looked, start_time)
    found: list[FrictionSolution] = []
    for one in search.solutions():
        if not any(_same(one, other) for other in found):
            found.append(one)
    return tuple(found)


def _outputs(mechanism: Mechanism) -> Iterator[Output]:
    for body in mechanism.bodies:
        for rate in ("x_rate", "y_rate", "speed"):
            yield _read(f"{body.name}.{rate}")
    for contact in mechanism.contacts:
        yield from map(_read, (f"{contact.name}.force", f"{contact.name}.gap_acceleration"))
    for part in filter(may_rub, mechanism.rubbing):
        for what in ("friction_force", "slip_speed", "slip_acceleration"):
            yield _read(f"{part.name}.{what}")


def _read(source: str) -> Output:
    return Output(source, source, "")


class _Search:
    """A mechanism at its start, in one combination of modes after the other."""

    def __init__(self, mechanism: Mechanism, start_time: float) -> None:
        self._mechanism = mechanism
        self._block = pack(compile_mechanism(mechanism))
        self._engine = engine_for(self._block, engine_here())
        if self._engine.begin(start_time) != 0:
            raise MechanismError("friction_solutions: the mechanism cannot be assembled; a Simulation says why.")
        self._names = [output.name for output in mechanism.outputs]
        self._mode = field_of(self._block, "contact_mode")
        self._slip = field_of(self._block, "rub_slip")
        touching = self._mode == codes.CLOSED
        bodies = 3 * len(mechanism.bodies)
        self._choices = {
            c: (codes.OPEN, codes.CLOSED)
            for c, contact in enumerate(mechanism.contacts)
            if touching[c] and contact.closed_while is None and not contact.guided
        }
        self._rubbing = {
            k: part.name
            for k, part in enumerate(mechanism.rubbing)
            if may_rub(part) and (k >= len(mechanism.contacts) or touching[k])
        }
        self._slip[list(self._rubbing)] = codes.FORWARDS
        speeds = self._values()
        length, _, _, rate = field_of(self._block, "scales").tolist()
        units = {k: (rate or 1.0) * (1.0 if turns(mechanism.rubbing[k]) else length) for k in self._rubbing}
        self._slips = {
            k: _possible(speeds[f"{name}.slip_speed"], SLIPS_ABOVE * units[k]) for k, name in self._rubbing.items()
        }
        self._bodies = bodies

    def solutions(self) -> Iterator[FrictionSolution]:
        """Every combination whose forces and accelerations agree with it."""
        choices = [*self._choices.values(), *self._slips.values()]
        if math.prod(map(len, choices)) > _MOST:
            raise MechanismError(f"friction_solutions: there are more than {_MOST} combinations; let less touch.")
        for modes in product(*choices):
            self._mode[list(self._choices)] = modes[: len(self._choices)]
            self._slip[list(self._slips)] = modes[len(self._choices) :]
            values = self._values()
            lost = field_of(self._block, "dy_at")[2 * self._bodies + 1]  # not a number: no forces agree
            if not math.isnan(lost) and self._agrees(values):
                yield self._solution(values)

    def _values(self) -> dict[str, float]:
        self._engine.read_outputs()
        return dict(zip(self._names, field_of(self._block, "outputs").tolist(), strict=True))

    def _agrees(self, values: dict[str, float]) -> bool:
        forces = [value for name, value in values.items() if name.endswith("force")]
        bends = [value for name, value in values.items() if name.endswith("acceleration")]
        little = _SHARE * max(map(abs, forces), default=0.0)
        slow = _SHARE * max(map(abs, bends), default=0.0)
        for c in self._choices:
            name = self._mechanism.contacts[c].name
            if self._mode[c] == codes.CLOSED and values[f"{name}.force"] < -little:
                return False
            if self._mode[c] == codes.OPEN and values[f"{name}.gap_acceleration"] < -slow:
                return False
        for k, name in self._rubbing.items():
            if not self._touches(k):
                if self._slip[k] != self._slips[k][0]:
                    return False  # said once, of an open contact
            elif self._slip[k] == codes.STICKS:
                if abs(values[f"{name}.friction_force"]) > self._bound(k, values) + little:
                    return False
            elif len(self._slips[k]) > 1 and self._slip[k] * values[f"{name}.slip_acceleration"] < -slow:
                return False
        return True

    def _touches(self, rub: int) -> bool:
        return rub >= len(self._mechanism.contacts) or bool(self._mode[rub] == codes.CLOSED)

    def _bound(self, rub: int, values: dict[str, float]) -> float:
        """The most friction of what sticks [N, N m]."""
        part = self._mechanism.rubbing[rub]
        if rub < len(self._mechanism.contacts):
            return float(part.holding) * abs(values[f"{part.name}.force"])  # type: ignore[union-attr]
        place = rub - len(self._mechanism.contacts)
        if place >= len(self._mechanism.joints):
            return float(part.limit)  # type: ignore[union-attr]
        joint = self._mechanism.joints[place]
        row = int(field_of(self._block, "joint_row")[place])
        along = field_of(self._block, "multiplier")[row : row + (2 if joint.row == "revolute" else 1)]
        length = 1.0 if joint.row == "revolute" else float(getattr(joint, "axis_length", 1.0))
        return float(joint.holding) * length * float(np.linalg.norm(along))

    def _solution(self, values: dict[str, float]) -> FrictionSolution:
        self._engine.read_output_rates()
        rates = field_of(self._block, "output_rates")[: self._bodies].reshape(-1, 3).tolist()
        modes = {
            self._mechanism.contacts[c].name: "closed" if self._mode[c] == codes.CLOSED else "open"
            for c in self._choices
        }
        modes |= {name: _SLIPS[int(self._slip[k])] for k, name in self._rubbing.items() if self._touches(k)}
        return FrictionSolution(
            modes,
            {name: values[f"{name}.force"] for name in (self._mechanism.contacts[c].name for c in self._choices)},
            {name: values[f"{name}.friction_force"] for name in self._rubbing.values()},
            {body.name: (x, y, a) for body, (x, y, a) in zip(self._mechanism.bodies, rates, strict=True)},
        )


def _possible(speed: float, slips_above: float) -> tuple[int, ...]:
    """How what has this slip speed may go on."""
    if abs(speed) <= slips_above:
        return codes.STICKS, codes.FORWARDS, codes.BACKWARDS
    return (codes.FORWARDS,) if speed > 0.0 else (codes.BACKWARDS,)


def _same(one: FrictionSolution, other: FrictionSolution) -> bool:
    numbers = [
        np.array([*s.normal_forces.values(), *s.friction_forces.values(), *sum(s.accelerations.values(), ())])
        for s in (one, other)
    ]
    return bool(np.abs(numbers[0] - numbers[1]).max(initial=0.0) <= _SHARE * np.abs(numbers).max(initial=0.0))
