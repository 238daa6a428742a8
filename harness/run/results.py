"""The files of a run: results.csv, impacts.csv, events.csv, summary.json, with the versions that made them."""

from __future__ import annotations

import json
import os
import platform
import tempfile
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import asdict
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import IO, Any, BinaryIO, TextIO

import pandas as pd

from mechanism_fmu import __version__

from ..analysis.compliance import compliance_values
from ..analysis.stress import beam_summary, damage_summary
from ..errors import UsageError
from ..fmu.description import Description, Value
from .drawing import is_of_drawing
from .experiment import Run

# What made a result: the versions that another one needs to be the same.

#: Packages that numbers, tables and pictures come from: the engine and the FMU, stresses, designs, files, charts.
_PACKAGES = (
    *("numpy", "numba", "llvmlite", "pythonfmu", "fmpy"),
    *("scipy", "rainflow", "optuna", "distributed", "dask"),
    *("pandas", "pyarrow", "pillow"),
)


def versions(fmu: Path, description: Description) -> dict[str, str]:
    """What made a result, by name: the FMU, this harness, Python and the packages used."""
    return {
        "FMU": fmu.name,
        "model": description.model,
        "GUID of the FMU": description.guid,
        "generation tool of the FMU": description.generation_tool or "unknown",
        **software(),
    }


def software() -> dict[str, str]:
    """The versions of this harness, of Python and of the packages used, by name."""
    return {
        "mechanism_fmu": __version__,
        "Python": f"{platform.python_version()}, {platform.system()} {platform.machine()}",
        **{name: found for name in _PACKAGES if (found := _installed(name))},
    }


def _installed(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return ""


#: How names of files end that are being written; they begin with a point.
UNFINISHED = ".unfinished"


def sweep_up(folder: Path) -> None:
    """Remove files that a process has left unfinished because it was killed; for who is alone in the folder."""
    for path in folder.glob(f".*{UNFINISHED}"):
        with suppress(OSError):  # of somebody else: it is in nobody's way
            path.unlink()


def prepare_folder(folder: Path) -> None:
    """Make the folder for the files, before any work is spent on them.

    Args:
        folder: that is to be.

    Raises:
        UsageError: it cannot be made or written to.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"The folder '{folder}' cannot be made: {error}.") from error
    if not os.access(folder, os.W_OK):
        raise UsageError(f"The folder '{folder}' cannot be written to; choose another one with -o.")


def write_text(path: Path, write: Callable[[TextIO], object]) -> Path:
    """Write a whole file or nothing: a reader never sees half of it, and an old one survives a failure.

    Raises:
        UsageError: the disk refuses.
    """
    return _whole(path, lambda handle: os.fdopen(handle, "w", encoding="utf-8", newline=""), write)


def write_bytes(path: Path, data: bytes) -> Path:
    """Write a file of bytes, whole or not at all; see `write_text`."""
    return write_binary(path, lambda file: file.write(data))


def write_binary(path: Path, write: Callable[[BinaryIO], object]) -> Path:
    """Write a file that is no text, whole or not at all; see `write_text`."""
    return _whole(path, lambda handle: os.fdopen(handle, "wb"), write)


def _whole(path: Path, opened: Callable[[int], IO[Any]], write: Callable[[Any], object]) -> Path:
    try:
        handle, temporary = tempfile.mkstemp(prefix=f".{path.name}.", suffix=UNFINISHED, dir=path.parent)
        try:
            with opened(handle) as file:
                write(file)
            os.chmod(temporary, 0o644)  # mkstemp makes files for the owner only
            os.replace(temporary, path)
        except BaseException:
            os.unlink(temporary)
            raise
    except OSError as error:
        raise UsageError(f"'{path}' cannot be written: {error}.") from error
    return path


def write_json(path: Path, data: Any) -> Path:
    """Write a JSON file, whole or not at all; see `write_text`."""
    return write_text(path, lambda file: file.write(json.dumps(data, indent=2, ensure_ascii=False) + "\n"))


def write_run(run: Run, folder: Path, units_row: bool = False) -> list[Path]:
    """Write the files of a run; the summary comes last.

    The tables have plain variable names as headings; their units are in the summary, and with `units_row` below the
    headings. Every number is the shortest text that reads back as the same double. A table without columns, as that of
    impacts of an FMU that reports none, has the column "time".

    Args:
        run: whose files they are.
        folder: that there is already.
        units_row: whether a row of units follows the headings.

    Raises:
        UsageError: the disk refuses.
    """
    return [
        _table(run, "results", run.results, folder, units_row),
        _table(run, "impacts", run.impacts, folder, units_row),
        *([_table(run, "events", run.events, folder, units_row)] if run.reports_events else ()),
        write_json(folder / "summary.json", summary(run)),
    ]


def _table(run: Run, name: str, table: pd.DataFrame, folder: Path, units_row: bool) -> Path:
    """<name>.csv; an FMU that reports no events has no events.csv."""
    whole = table if len(table.columns) else pd.DataFrame(columns=["time"])
    units = {"time": "s"} | dict(run.units[name])
    columns = list(map(str, whole.columns))
    heads = [columns, [units[column] for column in columns]] if units_row else [columns]

    def write(file: TextIO) -> None:
        pd.DataFrame(heads).to_csv(file, index=False, header=False, lineterminator="\n")
        whole.to_csv(file, index=False, header=False, lineterminator="\n")

    return write_text(folder / f"{name}.csv", write)


def _law(run: Run) -> dict[str, Any]:
    """The law of impacts with friction, where the FMU has contacts and says it."""
    if not run.logic.contacts or not run.logic.impact_law:
        return {}
    return {"law": run.logic.impact_law, "energy_guard": run.logic.energy_guard}


def summary(run: Run) -> dict[str, Any]:
    """What the tables do not say, ready for JSON."""
    experiment, outcome = run.experiment, run.outcome
    return {
        "harness_version": __version__,
        "fmu": {
            "file": str(run.fmu),
            "model": run.description.model,
            "guid": run.description.guid,
            "generation_tool": run.description.generation_tool,
        },
        "experiment": {
            "stop_time": experiment.stop_time,
            "step": experiment.step,
            "start_values": dict(experiment.start_values),
            "input_file": None if experiment.input_file is None else str(experiment.input_file),
            "input_note": None if run.inputs is None else run.inputs.note or None,
            "material": experiment.material.name,
        },
        "ending": outcome.ending.value,
        "error": None if outcome.error is None else str(outcome.error),
        "final_time": outcome.final_time,
        "steps": outcome.steps,
        "wall_time": run.wall_time,
        "final_values": final_values(run),
        "parameters": shown_parameters(run),
        "impacts": {"collected": len(run.impacts), "lost": run.impacts_lost, **_law(run)},
        "events": {"collected": len(run.events), "lost": run.events_lost},
        "tooth": beam_summary(run.description.analysis.struck, run.beam),
        "fatigue": None if run.damage is None else damage_summary(run.damage, experiment.material),
        "compliance": _compliance(run),
        "units": run.units,
        "checks": [asdict(check) for check in run.checks],
        "messages": [asdict(m) | {"status": m.status.name.lower()} for m in run.messages],
    }


def _compliance(run: Run) -> list[dict[str, Any]]:
    chain = run.description.analysis.chain
    return [] if chain is None else [compliance_values(chain, one) for one in run.compliance]


def final_values(run: Run) -> dict[str, Value]:
    """The recorded variables at the last communication point; none when the run did not start."""
    return {} if run.results.empty else {str(name): column.iloc[-1].item() for name, column in run.results.items()}


def shown_parameters(run: Run) -> dict[str, Value]:
    """Parameters and calculated parameters by name, without the numbers of a default drawing."""
    return {name: value for name, value in run.parameters.items() if not is_of_drawing(run.description.variable(name))}


def settings(run: Run) -> dict[str, Value]:
    """Parameters, calculated parameters, and inputs at the start of the run, by name; as of `shown_parameters`."""
    inputs = [variable.name for variable in run.description.of("input") if variable.name in run.results]
    first = {} if run.results.empty else {name: run.results[name].iloc[0].item() for name in inputs}
    return {**shown_parameters(run), **first}


def write_with_units(table: pd.DataFrame, units: Mapping[str, str], path: Path) -> Path:
    """Write a table whose headings are `name [unit]`, or the name alone where there is no unit.

    So `inputs.read_inputs` reads it, and so does pandas.

    Args:
        table: a column for each variable.
        units: by name of the column; what is missing, or "", has none.
        path: of the file.

    Raises:
        UsageError: the disk refuses.
    """
    names = [str(name) for name in table]
    headings = [f"{name} [{units[name]}]" if units.get(name) else name for name in names]
    return write_text(path, lambda file: table.to_csv(file, index=False, header=headings, lineterminator="\n"))
