"""The files of a machine's run, beside the recorded signals."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from mechanism_fmu import __version__
from mechanism_fmu.stress import SequenceDamage

from ..errors import UsageError
from ..machine.bonds import bond_summary
from ..machine.cycles import Cycles, cycles_of
from ..machine.growing_table import FORMATS
from ..machine.performed import MachineRun
from ..machine.statistics import STATISTICS_UNITS
from ..report.machine_report import write_machine_report
from ..results import write_json, write_text
from ..tooth_damage import damage_summary
from ..tooth_stress import beam_summary

#: What a run may leave in its folder.
_NAMES = (*(f"results{suffix}" for suffix in FORMATS), "impacts.csv", "summary.json", "report.html")


@dataclass(frozen=True)
class Written:
    """What is in the folder of a run.

    Attributes:
        files: of this run; a report that is there comes last.
        refused: what the disk refused.
        earlier: names of files of an earlier run.
    """

    files: list[Path]
    refused: list[UsageError]
    earlier: list[str]


def write_files(run: MachineRun, folder: Path) -> Written:
    """Write impacts.csv, summary.json and report.html: each of them, though the disk may refuse another one.

    A report needs the whole results.
    """
    impacts, files, refused = folder / "impacts.csv", [run.results], []
    whole = run.results.is_file()
    writers: list[Callable[[], Path]] = [
        lambda: write_text(impacts, lambda file: run.impacts.to_csv(file, index=False, lineterminator="\n")),
        lambda: write_json(folder / "summary.json", summary(run)),
        *([lambda: write_machine_report(run, folder / "report.html")] if whole else []),
    ]
    for write in writers:
        try:
            files.append(write())
        except UsageError as error:
            refused.append(error)
    names = {file.name for file in files}
    return Written(files, refused, [name for name in _NAMES if name not in names and (folder / name).exists()])


def summary(run: MachineRun) -> dict[str, Any]:
    """What the tables do not say, ready for JSON."""
    plan, outcome = run.machine.plan, run.outcome
    policy = asdict(plan.policy)
    policy["algorithm"] = policy.pop("scheme")
    return {
        "harness_version": __version__,
        "title": plan.title,
        "run": {**policy, "material": plan.material},
        "components": {component.name: _component(run, component.name) for component in plan.components},
        "connections": [asdict(connection) for connection in plan.connections],
        "bonds": bond_summary(run.bonds),
        "ending": outcome.ending.value,
        "error": None if outcome.error is None else str(outcome.error),
        "final_time": outcome.final_time,
        "steps": outcome.steps,
        "wall_time": run.wall_time,
        "results": run.results.name,
        "units": {table: dict(units) for table, units in run.units.items()} | {"statistics": STATISTICS_UNITS},
        "notes": run.machine.notes,
        "cautions": [caution.text for caution in run.cautions],
    }


def _of_cycles(cycles: Cycles, damage: SequenceDamage) -> dict[str, Any]:
    """What is repeated in the run, and what a thousand of it do to the beam."""
    return {
        "cycles_in_run": cycles.count,
        "a_cycle": cycles.counted,
        "damage_per_1000_cycles": cycles.damage_of_thousand(damage.damage),
    }


def _component(run: MachineRun, name: str) -> dict[str, Any]:
    """One component: where it is from, what was set, how it fared, what struck it."""
    plan = next(component for component in run.machine.plan.components if component.name == name)
    description = run.machine.fmus[name].description
    struck = run.by_component.get(name)
    damage = None
    if struck is not None and struck.damage is not None:
        counter = "" if struck.struck is None else struck.struck.strokes
        damage = damage_summary(struck.damage, run.card) | _of_cycles(
            cycles_of(name, counter, run.seen.table), struck.damage
        )
    return {
        "fmu": str(plan.source.path or plan.source.model),
        "model": description.model,
        "guid": description.guid,
        "start_values": dict(plan.values),
        "statistics": dict(run.statistics[name]),
        "impacts": None if struck is None else {"collected": len(struck.impacts), "lost": struck.lost},
        "tooth": None if struck is None else beam_summary(struck.struck, struck.beam),
        "fatigue": damage,
    }
