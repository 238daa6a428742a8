"""ecos by its package ecospy. Its library needs oneTBB, of the system or of the package tbb."""

from __future__ import annotations

import ctypes
import ctypes.util
import sys
from pathlib import Path

from tests.importers.asked import Asked
from tests.importers.tool import Tool, Values, package_missing, package_version


def missing() -> str:
    without = package_missing("ecospy tbb", "ecospy")
    return without or ("" if _threads() else "needs oneTBB: python -m pip install tbb")


def run(asked: Asked) -> Values:
    ctypes.CDLL(_threads(), ctypes.RTLD_GLOBAL)
    from ecospy import EcosSimulation, EcosSimulationStructure

    with EcosSimulationStructure() as structure:
        structure.add_model("one", asked.fmu)
        with EcosSimulation(structure=structure, step_size=asked.step) as simulation:
            simulation.init()
            simulation.step(asked.steps)
            read = {"real": simulation.get_real, "integer": simulation.get_integer, "boolean": simulation.get_bool}
            values = {output.name: float(read[output.kind](f"one::{output.name}")) for output in asked.outputs}
            simulation.terminate()
    return values


def _threads() -> str | None:
    own = Path(sys.prefix, "lib", "libtbb.so.12")
    return str(own) if own.is_file() else ctypes.util.find_library("tbb")


TOOL = Tool(
    "ecos (ecospy)",
    ("fmi2", "fmi3", "pythonfmu"),
    run,
    missing,
    lambda: package_version("ecospy"),
    "it has no event mode, and an FMU with a clock crashes it",
)
