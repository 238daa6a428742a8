"""fmusim of the FMI project's Reference-FMUs: its command line. The environment variable FMUSIM names the program."""

from __future__ import annotations

import csv
import os
import shutil
import subprocess
from pathlib import Path

from tests.importers.asked import Asked
from tests.importers.in_c import BY_PYTHONFMU, libpython
from tests.importers.tool import Tool, Values

_INSTALL = "not installed: a release of github.com/modelica/Reference-FMUs up to v0.0.39, in PATH or as FMUSIM=<file>"
# Seen with 0.0.39. It gets fmi3Error and "impact.tick.time is clocked; read it in event mode, or read impact_time."
_CLOCKS = "it reads clocked variables in step mode, too"


def missing() -> str:
    return "" if _program() else _INSTALL


def run(asked: Asked) -> Values:
    table = Path(asked.folder, "values.csv")
    options = ["--output-interval", repr(asked.step), "--stop-time", repr(asked.stop), "--output-file", str(table)]
    if asked.event_mode:
        options += ["--event-mode-used", "--early-return-allowed"]
    for name in asked.names():
        options += ["--output-variable", name]
    environment = {**os.environ, **libpython()} if asked.needs_python else None
    subprocess.run([_program(), *options, asked.fmu], env=environment, check=True)
    with table.open(newline="", encoding="utf-8") as file:
        *_, last = csv.DictReader(file)
    assert abs(float(last["time"]) - asked.stop) < 1e-9
    return {name: float(last[name]) for name in asked.names()}


def version() -> str:
    done = subprocess.run([_program(), "--version"], capture_output=True, text=True, check=True)
    return done.stdout.split()[1]


def _program() -> str:
    return os.environ.get("FMUSIM") or shutil.which("fmusim") or ""


TOOL = Tool("fmusim", ("fmi2", "fmi3", "fmi3_events", *BY_PYTHONFMU), run, missing, version, _CLOCKS)
