"""The files of a turn: cycle.csv, cycle.parquet, summary.json."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from mechanism_fmu.elastodynamics import SpeedSweep

from ..checks import Check
from ..description import Value
from ..fmu import Fmu
from ..results import write_binary, write_json, write_with_units
from ..versions import versions
from .agreement import Agreement
from .options import Limits
from .solution import Bent, Rigid, Solution, solution_checks
from .synthesis import Synthesised
from .tables import cycle_table


@dataclass(frozen=True)
class Result:
    """All that there is to tell.

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

    Raises:
        UsageError: the disk refuses.
    """
    table, units = cycle_table(result.solution)
    return [
        write_with_units(table, units, folder / "cycle.csv"),
        write_binary(folder / "cycle.parquet", lambda file: table.to_parquet(file, index=False)),
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
