"""The files of a turn: cycle.csv, cycle.parquet, summary.json; and the FMU's elastic outputs beside the calculation."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from mechanism_fmu.elastodynamics import ElasticPorts, SpeedSweep, elastic_ports

from ...fmu import Fmu
from ...fmu.description import Value
from ...run.checks import Check
from ...run.results import versions, write_binary, write_json, write_with_units
from .options import Limits
from .solution import Bent, Rigid, Solution, solution_checks
from .synthesis import Synthesised
from .tables import cycle_table, speeds_table

# The FMU's elastic outputs beside the calculation: the same linkage, in the same positions, by another way.

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
        torque = () if ports.torque else (f"an input of the torque on {ports.crank!r}",)
        lacks = [*missing, *torque, *(() if expected else ("outputs of elastic members",))]
        return Agreement({}, 0, f"the FMU cannot be put into the positions of the turn: it lacks {', '.join(lacks)}")
    chosen = np.unique(np.linspace(0, len(found.angle) - 1, min(_POSITIONS, len(found.angle)), dtype=int))
    rows = []
    for k in chosen.tolist():
        angle = float(found.angle[k])
        values: dict[str, Value] = {start: angle, speed: found.speed, ports.torque: float(found.rigid.torque[k])}
        # the shaft turns along and gives no torque of its own
        shaft = {ports.shaft_speed: found.speed, ports.shaft_angle: angle}
        values = {**parameters, **values, **{name: value for name, value in shaft.items() if name}}
        with fmu.instantiate(fmu.description.model) as one:
            one.set(values)
            one.initialize(0.0, 1.0)
            rows.append([float(value) for value in one.get(list(expected))])
    differences = {
        name: float(np.abs(column - there[chosen]).max() / np.abs(there).max())
        for column, (name, there) in zip(np.transpose(rows), expected.items(), strict=True)
    }
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


@dataclass(frozen=True)
class Result:
    """All results of a turn.

    Attributes:
        fmu: of the mechanism.
        text: what the model says it is.
        parameters: those that differ from the model's defaults.
        solution: the turn.
        sweep: of speeds.
        agreement: with the FMU.
        limits: that were asked for.
        synthesis: the search for the lightest design, whose turn this is; None: none was asked for.
        frictionless: the same turn with the mechanism's own friction only, where other friction was asked for.
        speeds_asked: whether the speeds of the sweep were asked for.
    """

    fmu: Fmu
    text: str
    parameters: dict[str, Value]
    solution: Solution
    sweep: SpeedSweep
    agreement: Agreement
    limits: Limits = field(default_factory=Limits)
    synthesis: Synthesised | None = None
    frictionless: Solution | None = None
    speeds_asked: bool = False

    @property
    def checks(self) -> tuple[Check, ...]:
        """All verdicts."""
        return (*self.agreement.checks, *solution_checks(self.solution), *self.limits.checks(self.solution))

    @property
    def notes(self) -> tuple[str, ...]:
        """What is to be said besides."""
        refusal = self.agreement.refusal
        return (*self.solution.notes, *((f"Not compared with the FMU: {refusal}.",) if refusal else ()))


def write_result(result: Result, folder: Path) -> list[Path]:
    """Write cycle.csv (units in its headings), cycle.parquet (the same, plain names) and summary.json, in SI units.

    cycle.parquet is left out where pyarrow, of the extra `designs`, is not installed. Beside them
    speeds.csv, when there were speeds to be looked at.

    Raises:
        UsageError: the disk refuses.
    """
    table, units = cycle_table(result.solution)
    parquet = folder / "cycle.parquet"
    speeds = [write_with_units(*speeds_table(result.sweep), folder / "speeds.csv")] if result.speeds_asked else []
    return [
        write_with_units(table, units, folder / "cycle.csv"),
        *([write_binary(parquet, lambda file: table.to_parquet(file, index=False))] if find_spec("pyarrow") else ()),
        *speeds,
        write_json(folder / "summary.json", summary(result, units)),
    ]


def summary(result: Result, units: dict[str, str]) -> dict[str, Any]:
    """What the table does not say, ready for JSON; frequencies in Hz, all else in SI units and radians."""
    found = result.solution
    return {
        "versions": versions(result.fmu.path, result.fmu.description),
        "speed": found.speed,
        "damping_ratio": found.damping,
        "place": found.place,
        "parameters": result.parameters,
        "quasi_static": _largest(found, found.static),
        "elastodynamic": _largest(found, found.dynamic),
        "input_torque": asdict(found.rigid.fluctuation),
        **_frame(found.rigid),
        "friction": _friction(result),
        "limits": asdict(result.limits),
        "synthesis": None if result.synthesis is None else _synthesis(result.synthesis),
        "natural_frequencies": [
            {"least": least, "mean": mean / (2 * math.pi), "largest": largest}
            for (least, largest), mean in zip(
                found.frequency_range[: found.modes].tolist(), found.critical[: found.modes, 0].tolist(), strict=True
            )
        ],
        "critical_speeds": found.critical[: found.modes].tolist(),
        "floquet_multiplier": found.growth,
        "feedback": asdict(found.feedback),
        "sweep": {name: values.tolist() for name, values in vars(result.sweep).items()},
        "agreement_with_fmu": asdict(result.agreement),
        "units": units,
        "checks": [asdict(check) for check in result.checks],
        "notes": list(result.notes),
    }


def _largest(found: Solution, bent: Bent) -> dict[str, Any]:
    return {
        "largest_deviation": bent.largest_deviation,
        "at_crank_angle": bent.largest_at,
        "largest_stress": dict(zip(found.members, bent.largest_stress.tolist(), strict=True)),
    }


def _frame(rigid: Rigid) -> dict[str, Any]:
    """What the frame and the joints carry, and the flywheel."""
    (force, moment), wheel = rigid.largest_shaking, rigid.flywheel
    return {
        "shaking": {
            "about": list(rigid.shaking.about),
            "largest_force": force.value,
            "largest_force_at": force.at,
            "largest_moment": moment.value,
            "largest_moment_at": moment.at,
        },
        "largest_joint_force": _by_joint(rigid, [one.value for one in rigid.largest_forces]),
        "flywheel": None
        if wheel is None
        else {
            "coefficient_of_fluctuation": wheel.coefficient,
            "inertia": wheel.inertia,
            "least_speed": rigid.flywheel_speeds[0],
            "largest_speed": rigid.flywheel_speeds[1],
        },
    }


def _by_joint(rigid: Rigid, values: list[float]) -> dict[str, float]:
    return dict(zip((joint.joint for joint in rigid.joints), values, strict=True))


def _friction(result: Result) -> dict[str, Any] | None:
    """What friction does; None where no joint has any."""
    rigid = result.solution.rigid
    if not rigid.rubs:
        return None
    without = result.frictionless
    return {
        "largest": _by_joint(rigid, [one.value for one in rigid.largest_friction]),
        "lost_energy": _by_joint(rigid, rigid.lost_energy.tolist()),
        "input_torque_without": None if without is None else asdict(without.rigid.fluctuation),
    }


def _synthesis(found: Synthesised) -> dict[str, Any]:
    judged = (("before", found.before, found.start), ("after", found.after, found.design))
    return {
        "designs_judged": found.evaluations,
        "bounds": {bound.name: [bound.least, bound.largest] for bound in found.bounds},
        **{
            when: {
                "parameters": dict(zip((bound.name for bound in found.bounds), design.tolist(), strict=True)),
                "mass": judgement.mass,
                "deviation": float(judgement.deviation.max()),
                "stress": float(judgement.stress.max()),
            }
            for when, judgement, design in judged
        },
    }
