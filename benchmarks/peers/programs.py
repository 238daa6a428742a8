"""The peers: whether they are installed, in which version, what drives Exudyn, and the engine's own runs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from typing import Any

import numpy as np

from mechanism_fmu.model import Mechanism
from mechanism_fmu.simulation import Simulation, SimulationError

from .case import FAILED, OURS, TOLERANCES, Program, Run, Vector

#: Codes and what pip calls them.
PEERS = {"MuJoCo": "mujoco", "scipy": "scipy", "pymunk": "pymunk", "Exudyn": "exudyn"}


@dataclass(frozen=True)
class Peer:
    """A code, and its version; None where it is not installed."""

    code: str
    version: str | None


def peers() -> list[Peer]:
    """All of them, as they are installed here."""
    return [Peer(code, _version(package)) for code, package in PEERS.items()]


def is_here(code: str) -> bool:
    """Whether a program of this code can run."""
    return code == OURS or find_spec(PEERS[code]) is not None


def engine(mechanism: Mechanism, read: Callable[[Simulation], Vector], stop: float) -> Program:
    """The engine of this project at `TOLERANCES`.

    Args:
        mechanism: what moves, with any settings.
        read: from the simulation at its end to the quantities, e.g. `outputs`.
        stop: end of the motion [s].
    """

    def prepare(tolerance: float) -> Run:
        settings = replace(mechanism.settings, relative_tolerance=tolerance)
        simulation = Simulation(replace(mechanism, settings=settings))

        def run() -> Vector:
            try:
                simulation.advance(stop)
            except SimulationError:
                return FAILED
            return read(simulation)

        return run

    return Program(OURS, "its own", TOLERANCES, prepare)


def outputs(simulation: Simulation) -> Vector:
    """All outputs of a mechanism, in their order, shape (outputs,)."""
    return np.array(list(simulation.read().values()))


def solve_exudyn(system: Any, solver: Any, stop: float, steps: int) -> None:
    """Move a system of Exudyn by equal steps, without files and messages.

    Args:
        system: assembled.
        solver: one of `exudyn.DynamicSolverType`.
        stop: end of the motion [s].
        steps: how many.
    """
    import exudyn

    exudyn.config.printToConsole = False
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.endTime = stop
    settings.timeIntegration.numberOfSteps = steps
    settings.timeIntegration.automaticStepSize = False
    settings.timeIntegration.verboseMode = 0
    settings.timeIntegration.verboseModeFile = 0
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = stop
    settings.show.computationTime = settings.show.statistics = False
    # the system of a chain is sparse; the dense solver of the default grows with its cube
    settings.linearSolver.solverType = exudyn.LinearSolverType.EigenSparse
    system.SolveDynamic(settings, solverType=solver)


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None
