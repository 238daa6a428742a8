"""The FMU's elastic outputs beside the calculation: the same linkage, in the same positions, by another way."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from mechanism_fmu.elastodynamics import ElasticPorts, elastic_ports

from ..checks import Check
from ..description import Value
from ..fmu import Fmu
from .solution import Solution

#: So many positions of the turn are compared, at most.
_POSITIONS = 24
#: Differences that rounding and the FMU's own assembly cannot explain, in parts of a quantity's largest value.
_LIMIT = 1e-8


@dataclass(frozen=True)
class Agreement:
    """How far the FMU's outputs are off the calculation.

    Attributes:
        differences: the largest by output, in parts of its largest value.
        positions: how many were compared.
        refusal: why nothing was; "" when something was.
        frictionless: whether the calculation has other friction than the FMU, so that this is about one without it.
    """

    differences: dict[str, float]
    positions: int
    refusal: str = ""
    frictionless: bool = False

    @property
    def checks(self) -> tuple[Check, ...]:
        """The verdict; none where nothing was compared."""
        if self.refusal:
            return ()
        worst = max(self.differences, key=lambda name: self.differences[name])
        evidence = (
            f"{len(self.differences)} outputs at {self.positions} positions; the largest difference is "
            f"{self.differences[worst]:.1e} of the largest value, of {worst}; limit {_LIMIT:g}"
        )
        torque = "the input torque, both without this friction" if self.frictionless else "this input torque"
        claim = f"The FMU's elastic outputs are the quasi-static solution, with {torque}"
        return (Check(claim, self.differences[worst] <= _LIMIT, evidence),)


def agreement(fmu: Fmu, mechanism: Any, found: Solution, parameters: dict[str, Value]) -> Agreement:
    """Put the FMU into positions of the turn, with the crank's speed and the calculated torque on it, and compare.

    That torque keeps the speed constant at that instant, so that the FMU's elastic outputs, which follow from the
    accelerations that its engine finds, are those of the calculation.

    Raises:
        FmuError: the FMU refuses a position.
    """
    ports = elastic_ports(mechanism)
    start, speed = f"{ports.crank}_angle_start", f"{ports.crank}_speed_start"
    missing = [name for name in (start, speed) if name not in fmu.description.variables]
    expected = _expected(found, ports)
    if missing or not ports.torque or not expected:
        lacks = [*missing, *(() if ports.torque else (f"an input of the torque on {ports.crank!r}",))]
        lacks += [] if expected else ["outputs of elastic members"]
        return Agreement({}, 0, f"the FMU cannot be put into the positions of the turn: it lacks {', '.join(lacks)}")
    chosen = np.unique(np.linspace(0, len(found.angle) - 1, min(_POSITIONS, len(found.angle)), dtype=int))
    rows = []
    for k in chosen.tolist():
        values: dict[str, Value] = {**parameters, start: float(found.angle[k]), speed: found.speed}
        values[ports.torque] = float(found.rigid.torque[k])
        # the shaft turns along and gives no torque of its own
        values |= {ports.shaft_speed: found.speed} if ports.shaft_speed else {}
        values |= {ports.shaft_angle: float(found.angle[k])} if ports.shaft_angle else {}
        with fmu.instantiate(fmu.description.model) as one:
            one.set(values)
            one.initialize(0.0, 1.0)
            rows.append([float(value) for value in one.get(list(expected))])
    differences = {}
    for column, (name, values_there) in zip(np.transpose(rows), expected.items(), strict=True):
        off = np.abs(column - values_there[chosen]).max()
        differences[name] = float(off / np.abs(values_there).max())
    return Agreement(differences, len(chosen))


def _expected(found: Solution, ports: ElasticPorts) -> dict[str, Any]:
    """What the outputs of the place and of the members' stresses should be, by name, shape (angles,) each."""
    bent = found.rigid.path + found.static.deflection[:, :2]
    by_source = {
        f"{found.place}.x": found.rigid.path[:, 0],
        f"{found.place}.y": found.rigid.path[:, 1],
        f"{found.place}.x_bent": bent[:, 0],
        f"{found.place}.y_bent": bent[:, 1],
        f"{found.place}.deviation": found.static.deviation,
    }
    by_source |= {
        f"{member}.stress": stress for member, stress in zip(found.members, found.static.stress.T, strict=True)
    }
    return {name: by_source[source] for source, name in ports.outputs.items() if source in by_source}
