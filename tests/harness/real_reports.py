"""Reports of real runs of the ratchet, one of each kind."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from harness.app.commands.designs_run import run_optimise, run_sweep
from harness.app.commands.designs_shared import Runners
from harness.app.commands.machine_run import run_file
from harness.fmu import open_fmu
from harness.papers.study.study import ratchet_study
from harness.papers.study.study_report import paper_figures, write_study_report
from harness.report.run_report import write_report
from harness.run.experiment import Experiment, perform
from tests.report_page import figures

DESIGNS = """\
fmu.file = "{fmu}"
run = {{ stop_time = "1.2 s", step = 0.1 }}
vary.restitution = {{ from = 0.0, to = 0.6 }}
vary.tooth_slope_angle = {{ from = 86, to = 94, unit = "deg" }}
"""
SWEEP = 'sweep = { method = "sobol", count = 16 }\nrecord.first_impact = ["time", "stress_max"]\n'
MACHINE = """\
title = "Two ratchets"
run = {{ stop_time = "1.2 s", step = "10 ms", extrapolation = "constant" }}
component.upper.file = "{fmu}"
component.lower.file = "{fmu}"
connect = [{{ from = "upper.wheel_angle", to = "lower.drive_angle" }}]
"""
OPTIMUM = 'optimise = { minimise = "first_impact.stress_max", count = 20 }\n'


@dataclass(frozen=True)
class Report:
    """A file, and how many charts and pictures it has."""

    path: Path
    charts: int
    pictures: int = 1

    def drawn(self) -> list[int]:
        """The number of lines, sets of dots, bands and axes in each of its charts."""
        return [_drawn(figure) for figure in figures(self.path.read_text(encoding="utf-8"))]


def _drawn(figure: dict[str, Any]) -> int:
    if "axes" in figure:
        return len(figure["axes"])
    bands = sum(len(lane["spans"]) for lane in figure.get("lanes", ()))
    return bands + sum(
        curve["line"] + curve.get("dots", False) + curve.get("filled", False) for curve in figure["curves"]
    )


def written_reports(ratchet_fmu: Path, folder: Path) -> dict[str, Report]:
    """One of each kind, in a folder, by its name."""
    with open_fmu(ratchet_fmu) as fmu:
        run, demo = (perform(fmu, Experiment(*asked)) for asked in ((1.2, 1e-2), (6.0, 1e-3)))
        study = ratchet_study(fmu, lambda *_: None)
    return {
        "run": Report(write_report(run, folder / "report.html"), charts=12),
        "demo": Report(write_report(demo, folder / "demo.html"), charts=12),
        "study": Report(write_study_report(study, paper_figures(study), folder / "study.html"), charts=14),
        "sweep": Report(_designs(run_sweep, SWEEP, ratchet_fmu, folder / "sweep"), charts=7),
        "machine": Report(_machine(ratchet_fmu, folder / "machine"), charts=24, pictures=2),
        "optimum": Report(_designs(run_optimise, OPTIMUM, ratchet_fmu, folder / "optimum"), charts=6),
    }


def _designs(command: Callable[..., int], text: str, fmu: Path, folder: Path) -> Path:
    file = folder.with_suffix(".toml")
    file.write_text(text + DESIGNS.format(fmu=fmu.as_posix()))
    assert command(file, folder, Runners(fast=True)) == 0
    return folder / "report.html"


def _machine(fmu: Path, folder: Path) -> Path:
    file = folder.with_suffix(".toml")
    file.write_text(MACHINE.format(fmu=fmu.as_posix()))
    assert run_file(str(file), None, folder) == 0
    return folder / "report.html"
