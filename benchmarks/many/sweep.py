"""The designs, and what each of the three ways makes of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from mechanism_fmu.batch import Batch

from ..ratchet import Parameters, Vector, build
from ..reference import WHEEL_ANGLE, simulate
from .mjcf import SLIDE, WHEEL, mjcf

_STEP = 1e-3


@dataclass(frozen=True)
class Found:
    """Of each design: time of the impact [s], wheel speed right after it and at the end [rad/s], shape (designs,)."""

    impact_time: Vector
    speed_after: Vector
    speed_at_end: Vector

    def first(self, count: int) -> Found:
        """Of the first designs only."""
        return Found(self.impact_time[:count], self.speed_after[:count], self.speed_at_end[:count])

    def error(self, exact: Found) -> tuple[float, float, float]:
        """Largest differences from what is exact: in time [s], in speed after the impact and at the end [rad/s]."""

        def most(ours: Vector, others: Vector) -> float:
            return float(np.max(np.abs(ours - others)))

        return (
            most(self.impact_time, exact.impact_time),
            most(self.speed_after, exact.speed_after),
            most(self.speed_at_end, exact.speed_at_end),
        )


def random_designs(count: int) -> list[Parameters]:
    """Wheels, springs and torques around the paper's base case; always the same ones."""
    rng = np.random.default_rng(2024)
    return [
        Parameters(
            tooth_slope_angle=float(np.radians(rng.uniform(86, 94))),
            spring_stiffness=float(rng.uniform(10e-3, 20e-3)),
            drive_torque=float(rng.uniform(0.8e-3, 1.2e-3)),
        )
        for _ in range(count)
    ]


class FastPath:
    """`mechanism_fmu.batch`, with the FMU's model and engine."""

    def __init__(self, fmu: Path, designs: Sequence[Parameters], stop_time: float, tolerance: float) -> None:
        self._batch = Batch.of_fmu(fmu)
        names = ("tooth_slope_angle", "spring_stiffness", "drive_torque")
        self._columns = {name: np.array([getattr(design, name) for design in designs]) for name in names}
        self._columns["relative_tolerance"] = np.full(len(designs), tolerance)
        self._stop_time = stop_time

    def run(self, threads: int) -> Found:
        """All designs."""
        found = self._batch.run(self._columns, [0.0, self._stop_time], ["wheel_speed"], threads=threads)
        if any(found.failures):
            raise RuntimeError(f"Not all designs run: {set(found.failures)}")
        return Found(found.impacts["time"][:, 0], found.impacts["wheel_speed"][:, 0], found.values["wheel_speed"])


class MuJoCo:
    """MuJoCo's batched rollout, of models that have been made before."""

    def __init__(self, designs: Sequence[Parameters], stop_time: float, threads: int, step: float = _STEP) -> None:
        import mujoco
        from mujoco.rollout import Rollout

        self._models = [mujoco.MjModel.from_xml_string(mjcf(design, step)) for design in designs]
        self._data = [mujoco.MjData(self._models[0]) for _ in range(threads)]
        whole = mujoco.mjtState.mjSTATE_FULLPHYSICS
        self._start = np.zeros((len(designs), mujoco.mj_stateSize(self._models[0], whole)))
        for model, start in zip(self._models, self._start, strict=True):
            mujoco.mj_getState(model, mujoco.MjData(model), start, whole)
        steps = round(stop_time / step)
        self._torques = np.zeros((len(designs), steps, 2))
        self._torques[:, :, 0] = np.array([design.drive_torque for design in designs])[:, None]
        self._states = np.empty((len(designs), steps, self._start.shape[1]))
        self._rollout = Rollout(nthread=threads)

    def run(self) -> None:
        """All designs."""
        self._rollout.rollout(self._models, self._data, self._start, self._torques, state=self._states)

    def close(self) -> None:
        """End the threads."""
        self._rollout.close()

    def found(self) -> Found:
        """Of the last run; the speed after the impact is that two steps later, when the limit has done its work."""
        time, slide, speed = (self._states[:, :, k] for k in (0, 1 + SLIDE, 5 + WHEEL))
        limits = np.array([model.jnt_range[SLIDE, 0] for model in self._models])
        hit = np.argmax(slide <= limits[:, None], axis=1)
        rows = np.arange(len(hit))
        return Found(time[rows, hit], speed[rows, hit + 2], speed[:, -1])


@contextmanager
def processes(count: int) -> Iterator[ProcessPoolExecutor]:
    """A pool of processes that have imported what they need."""
    with ProcessPoolExecutor(count, mp_context=get_context("spawn")) as pool:
        list(pool.map(plainly, [(Parameters(), 1e-3, 1e-3)] * (4 * count)))
        yield pool


def plainly(task: tuple[Parameters, float, float]) -> tuple[float, float, float]:
    """A design by `benchmarks.reference` (solve_ivp), to a stop time [s] at a relative tolerance."""
    design, stop_time, tolerance = task
    trajectory = simulate(build(design), stop_time, rtol=tolerance, atol=1e-3 * tolerance)
    _, rates = trajectory.at(stop_time)
    if not trajectory.impacts:
        return 0.0, 0.0, float(rates[WHEEL_ANGLE])
    hit = trajectory.impacts[0]
    return hit.time, float(hit.after[WHEEL_ANGLE]), float(rates[WHEEL_ANGLE])


def pooled(pool: ProcessPoolExecutor, designs: Sequence[Parameters], stop_time: float, tolerance: float) -> Found:
    """All designs by `plainly`."""
    tasks = [(design, stop_time, tolerance) for design in designs]
    return Found(*np.array(list(pool.map(plainly, tasks))).T)
