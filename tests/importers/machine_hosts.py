"""Run an .ssp file in a tool that is not this project's, in a process of its own: some of them crash when they end.

    python -m tests.importers.machine_hosts TOOL FILE.ssp STEP STEPS OUT.npy SIGNAL ...

writes the signals after each step, shape (steps, signals). A signal is "<component>.<variable>".
"""

import ctypes
import ctypes.util
import importlib.util
import os
import subprocess
import sys
import zipfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

#: What to install for each tool.
PACKAGES = {"libcosim": "libcosimpy", "ecos": "ecospy", "container": "fmu_manipulation_toolbox", "fmpy": "fmpy"}


def tools(*names: str) -> list[object]:
    """Parameters of a test, skipped before anything is built where a tool is not there."""
    missing = {name: importlib.util.find_spec(PACKAGES[name]) is None for name in names}
    missing["ecos"] = missing.get("ecos", True) or not (_threads() or ctypes.util.find_library("tbb"))
    installed = {name: f"python -m pip install {package.replace('_', '-')}" for name, package in PACKAGES.items()}
    installed["ecos"] += " tbb"
    return [
        pytest.param(n, marks=pytest.mark.skipif(missing[n], reason=f"{n} is not there: {installed[n]}")) for n in names
    ]


def curves(tool: str, ssp: Path, step: float, steps: int, signals: Sequence[str], parameters: str = "") -> np.ndarray:
    """The signals after each step, shape (steps, signals).

    Args:
        tool: a name of `PACKAGES`.
        ssp: the file.
        step: [s].
        steps: how many.
        signals: names in the machine.
        parameters: name of the parameter set, for a tool that must be told it.
    """
    out = ssp.with_name(f"{ssp.stem}_{tool}.npy")
    command = [sys.executable, "-m", "tests.importers.machine_hosts", tool, str(ssp), repr(step), str(steps), str(out)]
    environment = {**os.environ, "PARAMETER_SET": parameters}
    done = subprocess.run([*command, *signals], env=environment, capture_output=True, text=True, check=False)
    assert out.is_file(), f"{tool}, exit code {done.returncode}: {done.stdout[-2000:]}{done.stderr[-2000:]}"
    return np.load(out)


def _threads() -> Path | None:
    """The library that ecos needs, of the package tbb; None where it is not installed."""
    library = Path(sys.prefix) / "lib" / "libtbb.so.12"
    return library if library.is_file() else None


def _in_libcosim(ssp: Path, step: float, steps: int, signals: Sequence[str]) -> list[list[float]]:
    """By its fixed-step algorithm, whose step stands in the file."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver

    log_output_level(CosimLogLevel.WARNING)
    execution = CosimExecution.from_ssp_file(str(ssp))
    observer = CosimObserver.create_last_value()
    assert execution.add_observer(observer)
    places = {info.name.decode(): info.index for info in execution.slave_infos()}
    known = {name: (places[name.partition(".")[0]], reference) for name, reference in _references(ssp, signals)}
    rows = []
    for k in range(steps):
        assert execution.step()
        assert abs(execution.status().current_time * 1e-9 - (k + 1) * step) < 1e-6
        rows.append([observer.last_real_values(place, [reference])[0] for place, reference in known.values()])
    return rows


def _in_ecos(ssp: Path, step: float, steps: int, signals: Sequence[str]) -> list[list[float]]:
    library = _threads()
    if library is not None:
        ctypes.CDLL(str(library), ctypes.RTLD_GLOBAL)
    from ecospy import EcosSimulation

    rows = []
    simulation = EcosSimulation(ssp_path=str(ssp), step_size=step)
    simulation.init(parameter_set=os.environ.get("PARAMETER_SET") or None)
    for _ in range(steps):
        simulation.step(1)
        rows.append([simulation.get_real(signal.replace(".", "::")) for signal in signals])
    return rows


def _in_container(ssp: Path, step: float, steps: int, signals: Sequence[str]) -> list[list[float]]:
    """The container of fmu-manipulation-toolbox, run by fmpy; it shows connected outputs."""
    from fmpy import simulate_fmu

    command = [sys.executable, "-m", "fmu_manipulation_toolbox.cli.fmucontainer", "-fmu-directory", str(ssp.parent)]
    subprocess.run([*command, "-container", f"{ssp.name}:{step!r}", "-no-auto-link"], check=True, capture_output=True)
    made = next(path for path in ssp.parent.glob("*.fmu") if b"fmi2DoStep" in _library(path))
    found = simulate_fmu(str(made), stop_time=step * steps, step_size=step, output_interval=step, output=list(signals))
    return np.column_stack([found[signal] for signal in signals])[1 : steps + 1].tolist()


def _in_fmpy(ssp: Path, step: float, steps: int, signals: Sequence[str]) -> list[list[float]]:
    """Its row for a time holds what the step from then on has come to."""
    from fmpy.ssp.simulation import simulate_ssp

    found = simulate_ssp(str(ssp), stop_time=step * steps, step_size=step)
    return np.column_stack([found[signal] for signal in signals])[:steps].tolist()


def _library(path: Path) -> bytes:
    with zipfile.ZipFile(path) as archive:
        return archive.read(next(name for name in archive.namelist() if name.startswith("binaries/linux64/")))


def _references(ssp: Path, signals: Sequence[str]) -> list[tuple[str, int]]:
    """Value references by the names of signals."""
    from xml.etree import ElementTree

    from harness.fmu.description_file import read_description
    from harness.machine.formats.ssp_xml import tag

    place = ssp.with_suffix(".files")
    with zipfile.ZipFile(ssp) as archive:
        archive.extractall(place)
    root = ElementTree.parse(place / "SystemStructure.ssd").getroot()
    files = {c.attrib["name"]: place / c.attrib["source"] for c in root.iter(tag("ssd:Component"))}
    names = [signal.partition(".") for signal in signals]
    return [(f"{part}.{own}", read_description(files[part]).variables[own].reference) for part, _, own in names]


_RUN = {"libcosim": _in_libcosim, "ecos": _in_ecos, "container": _in_container, "fmpy": _in_fmpy}


def main() -> None:
    """Run, and end without what may crash at the end."""
    tool, ssp, step, steps, out, *signals = sys.argv[1:]
    rows = _RUN[tool](Path(ssp), float(step), int(steps), signals)
    with open(f"{out}.part", "wb") as file:
        np.save(file, np.array(rows))
    os.replace(f"{out}.part", out)
    os._exit(0)


if __name__ == "__main__":
    main()
