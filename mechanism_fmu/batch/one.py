"""One design by way of `Simulation`: what `many.c` does, for where it cannot run, and for the words of a failure."""

from __future__ import annotations

import math
from ctypes import CDLL

import numpy as np

from .. import codes
from ..model import Mechanism
from ..simulation import Simulation
from .job import Job


class OneByOne:
    """Takes designs of a job, one after the other, through one block of its own.

    Args:
        job: it.
        mechanism: of the same structure, for the names in messages.
        library: of the compiled engine; None: just in time.
    """

    def __init__(self, job: Job, mechanism: Mechanism, library: CDLL | None) -> None:
        self._job = job
        self._block = job.given.copy()
        self._simulation = Simulation.over(mechanism, self._block, library)
        self._records = self._simulation.field("impacts")
        self._pull_time = self._simulation.field("pull_time")

    def run(self, design: int) -> None:
        """Take one design as far as it goes.

        Raises:
            MechanismError, SimulationError: it fails; what it did before is in the job.
        """
        job, simulation = self._job, self._simulation
        job.impact_count[design] = 0
        self._block[:] = job.given
        self._block[job.varied_word] = job.varied_value[design]
        self._drive(0)
        simulation.begin(float(job.times[0]))
        job.reached[design] = simulation.time
        self._look(design)
        for point, target in enumerate(job.times[1:].tolist()):
            self._drive(point)
            try:
                simulation.begin_step()
                self._step(design, target)
            finally:
                job.reached[design] = simulation.time
                self._keep_impacts(design)
            self._look(design)
            if job.until_impact and job.impact_count[design]:
                break
        job.pulled[design] = np.where(self._pull_time <= simulation.time, self._pull_time, math.inf)
        job.values[design] = simulation.read_array()[job.read_output]

    def _drive(self, point: int) -> None:
        if len(self._job.driven_word):
            self._block[self._job.driven_word] = self._job.driven_value[point]

    def _step(self, design: int, target: float) -> None:
        while True:
            self._simulation.go_on(target, codes.STOP_AT_IMPACT)
            self._keep_impacts(design)
            if self._simulation.time >= target or (self._job.until_impact and self._job.impact_count[design]):
                return

    def _keep_impacts(self, design: int) -> None:
        job, counters = self._job, self._simulation.counters
        count, held = counters.item(codes.COUNT_IMPACTS), counters.item(codes.COUNT_IN_STEP)
        for k in range(int(job.impact_count[design]), min(count, job.impacts.shape[1])):
            place = held - (count - k)
            if place >= 0:
                job.impacts[design, k] = self._records[place, job.impact_field]
        job.impact_count[design] = count

    def _look(self, design: int) -> None:
        job = self._job
        if len(job.least):
            values = self._simulation.read_array()[job.read_output]
            np.fmin(job.least[design], values, out=job.least[design])
            np.fmax(job.greatest[design], values, out=job.greatest[design])
