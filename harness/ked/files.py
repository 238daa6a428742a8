"""The files of a turn: cycle.csv, cycle.parquet, summary.json."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from mechanism_fmu.elastodynamics import SpeedSweep

from ..checks import Check
from ..description import Value
from ..fmu import Fmu
from ..results import write_binary, write_json, write_with_units
from ..versions import versions
from .agreement import Agreement
from .solution import Bent, Solution, solution_checks
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
    """

    fmu: Fmu
    text: str
    parameters: dict[str, Value]
    solution: Solution
    sweep: SpeedSweep
    agreement: Agreement

    @property
    def checks(self) -> tuple[Check, ...]:
        """All verdicts."""
        return (*self.agreement.checks, *solution_checks(self.solution))

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
