"""Command: `python -m benchmarks.drift`, from the root of the repository: energy, gaps and joints of random designs.

Each model with parameters at Sobol points around their defaults; designs that it refuses are counted. Each runs twice,
which must give the same bits, and once more with every communication step in two.
"""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import Annotated, Any

import numpy as np
import typer
from rich.console import Console
from rich.progress import track
from rich.table import Table
from scipy.stats import qmc

import models
from mechanism_fmu import codes
from mechanism_fmu.model import MechanismError, Model
from mechanism_fmu.simulation import Simulation, SimulationError

#: Each Real parameter lies within this part of its default, and within its limits.
_WIDTH = 0.3
#: Settings of the calculation are not a design's.
_SETTINGS = ("relative_tolerance", "baumgarte_alpha", "baumgarte_beta")
_STEPS = 60
_ENERGIES = {"energy.kinetic": 1.0, "energy.spring": 1.0, "energy.work": -1.0, "energy.lost": 1.0}


@dataclass(frozen=True)
class Drift:
    """What one design showed.

    Attributes:
        ending: "ran", "refused" (its values cannot work together) or "stopped" (the motion ended with advice).
        energy: largest residual of the balance over the energy in play [1].
        joints: largest residual of a joint [m, or rad].
        gap: the smallest gap of an open contact [m, or rad]; 0 where there is none below.
        same: whether a second run gave the same bits.
        split: largest difference of an output, over its own size or 1, when every step is cut in two [1].
    """

    ending: str
    energy: float = 0.0
    joints: float = 0.0
    gap: float = 0.0
    same: bool = True
    split: float = 0.0


def designs(model: Model, count: int, seed: int) -> Iterator[dict[str, float]]:
    """Parameter values at Sobol points; `count` is rounded up to a power of 2 for the points, and cut."""
    free = [p for p in model.parameters if p.type == "Real" and p.start and p.name not in _SETTINGS]
    points = qmc.Sobol(len(free), seed=seed).random_base2(int(np.ceil(np.log2(count))))[:count]
    for point in points:
        values = {}
        for parameter, place in zip(free, point, strict=True):
            value = parameter.start * (1.0 + _WIDTH * (2.0 * place - 1.0))
            low = -np.inf if parameter.minimum is None else parameter.minimum
            high = np.inf if parameter.maximum is None else parameter.maximum
            values[parameter.name] = float(np.clip(value, low, high))
        yield values


def drift_of(name: str, values: dict[str, float]) -> Drift:
    """Run one design of the model `name`."""
    model: Model = models.load(name).MODEL
    try:
        mechanism = model.build(model.checked({p.name: values.get(p.name, p.start) for p in model.parameters}))
        first, second, halves = (Simulation(mechanism) for _ in range(3))
    except MechanismError:
        return Drift("refused")
    sources = {output.source: output.name for output in mechanism.outputs}
    enabled = [contact.name for contact in mechanism.contacts if contact.enabled]
    gaps = [sources[f"{contact}.gap"] for contact in enabled if f"{contact}.gap" in sources]
    energies = {sources[source]: sign for source, sign in _ENERGIES.items() if source in sources}
    joint_rows = sum(joint.rows for joint in mechanism.joints)
    energy = joints = gap = 0.0
    play = 1e-12
    initial = None
    try:
        for time in np.linspace(0.0, model.stop_time, _STEPS + 1)[1:]:
            for simulation in (first, second):
                simulation.advance(float(time))
            halves.advance(float((halves.time + time) / 2))
            halves.advance(float(time))
            found = first.read()
            if len(energies) == len(_ENERGIES):
                balance = sum(sign * found[output] for output, sign in energies.items())
                initial = balance if initial is None else initial
                play = max(play, *(abs(found[output]) for output in energies))
                energy = max(energy, abs(balance - initial))
            joints = max(joints, float(np.abs(first.field("residual")[:joint_rows]).max(initial=0.0)))
            gap = min([gap, *(found[output] for output in gaps)])
    except SimulationError:
        return Drift("stopped")
    return Drift("ran", energy / play, joints, gap, _bits(first) == _bits(second), _difference(first, halves))


def _bits(simulation: Simulation) -> bytes:
    return bytes(simulation.state.tobytes())


def _difference(one: Simulation, other: Simulation) -> float:
    """Of the motion; what is noted of a communication step is not in it."""
    a, b = one.field("y_end"), other.field("y_end")
    if one.field("clock")[codes.STEP_END] != other.field("clock")[codes.STEP_END]:
        return float("nan")
    return float((np.abs(a - b) / np.maximum(1.0, np.abs(a))).max())


def run(
    count: Annotated[int, typer.Option(help="Designs of each model.", min=2)] = 1000,
    seed: Annotated[int, typer.Option(help="Of the points.")] = 1,
    only: Annotated[str | None, typer.Option("--model", help="One model only.")] = None,
) -> None:
    """Run random designs of every model, and show the worst of each."""
    out, progress = Console(highlight=False, width=120), Console(stderr=True, highlight=False)
    table = Table(title=f"{count} designs of each model, seed {seed}")
    for heading in (
        "model",
        "ran",
        "refused",
        "stopped",
        "energy [1]",
        "joints [m]",
        "gap [m]",
        "same bits",
        "split [1]",
    ):
        table.add_column(heading, justify="left" if heading == "model" else "right")
    with ProcessPoolExecutor() as pool:  # one for all models: each process compiles the engine once
        for name in [only] if only else list(models.available()):
            model: Any = models.load(name).MODEL
            work = pool.map(partial(drift_of, name), designs(model, count, seed), chunksize=8)
            found = list(track(work, total=count, description=name, console=progress, transient=True))
            table.add_row(name, *_cells(found))
    out.print(table)


def _cells(found: list[Drift]) -> list[str]:
    """A row of the table."""
    ran = [drift for drift in found if drift.ending == "ran"]
    endings = [str(len(ran)), *(str(sum(d.ending == ending for d in found)) for ending in ("refused", "stopped"))]
    if not ran:
        return endings
    return [
        *endings,
        f"{max(drift.energy for drift in ran):.1e}",
        f"{max(drift.joints for drift in ran):.1e}",
        f"{min(drift.gap for drift in ran):.1e}",
        str(sum(drift.same for drift in ran)),
        f"{np.nanmax([drift.split for drift in ran]):.1e}",
    ]


if __name__ == "__main__":
    typer.run(run)
