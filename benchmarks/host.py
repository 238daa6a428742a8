"""A host of one FMU: the calls that any FMI 2.0 tool makes, by fmpy."""

from __future__ import annotations

from pathlib import Path
from time import perf_counter
from types import TracebackType

import fmpy
from fmpy.fmi2 import FMU2Slave

from .plain import OUTPUTS
from .step import STEP


class Host:
    """An initialized instance of the FMU `path`, unzipped into `folder`.

    Attributes:
        steps: of 1 ms that have been made.
    """

    def __init__(self, path: Path, folder: Path) -> None:
        fmpy.extract(str(path), unzipdir=str(folder))
        description = fmpy.read_model_description(str(folder))
        references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self._drive = [references["drive_torque"]]
        self._outputs = [references[name] for name in OUTPUTS]
        self.steps = 0
        self._fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=str(folder),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=path.stem,
        )
        self._fmu.instantiate()
        self._fmu.setupExperiment(startTime=0.0)
        self._fmu.enterInitializationMode()
        self._fmu.exitInitializationMode()

    def __enter__(self) -> Host:
        return self

    def __exit__(self, _type: type | None, _error: BaseException | None, _trace: TracebackType | None) -> None:
        self._fmu.terminate()
        self._fmu.freeInstance()

    def outputs(self) -> list[float]:
        """Values of `OUTPUTS`."""
        values: list[float] = self._fmu.getReal(self._outputs)
        return values

    def go_to(self, step: int) -> None:
        """Go on to the end of 1 ms step number `step` in steps of 10 ms."""
        while self.steps < step:
            self._fmu.doStep(self.steps * STEP, 10 * STEP)
            self.steps += 10

    def time_steps(self, torques: tuple[float, float], count: int) -> float:
        """Make `count` steps of 1 ms, with the drive torques in turns; return the time of fmi2DoStep alone [s]."""
        spent = 0.0
        for k in range(count):
            self._fmu.setReal(self._drive, [torques[k % 2]])
            began = perf_counter()
            self._fmu.doStep(self.steps * STEP, STEP)
            spent += perf_counter() - began
            self.steps += 1
        return spent / count

    def time_exchanges(self, torques: tuple[float, float], count: int) -> float:
        """The same, with setting the torque and reading `OUTPUTS` in the time."""
        began = perf_counter()
        for k in range(count):
            self._fmu.setReal(self._drive, [torques[k % 2]])
            self._fmu.doStep(self.steps * STEP, STEP)
            self.outputs()
            self.steps += 1
        return (perf_counter() - began) / count
