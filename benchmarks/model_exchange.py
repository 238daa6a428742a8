"""Command: `python -m benchmarks.model_exchange`, from the root of the repository: Model Exchange beside co-simulation.

Random designs of the models with events, by the harness with scipy's DOP853, and the same designs in co-simulation:
how many events there are, how many follow each other at one instant, how far the ends are from each other, and what is
refused with which words.
"""

from __future__ import annotations

import random
import time
from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated

import numpy as np
import typer
from rich.console import Console
from rich.progress import track
from rich.table import Table

import models
from harness.errors import FmuError, HarnessError
from harness.fmu import open_fmu
from harness.fmu.instances.integration import Integrator
from harness.fmu.interface import Instance
from mechanism_fmu.fmu.native.package import build_native_fmu
from mechanism_fmu.model import Model, Parameter

#: Models, how long each design moves [s], and the outputs whose ends are compared.
MODELS = {
    "ratchet": (2.0, ("wheel_angle", "pawl_angle", "energy_lost")),
    "ratchet_free": (2.0, ("wheel_angle", "pawl_angle", "energy_lost")),
    "geneva": (1.5, ("wheel_angle", "driver_angle")),
    "geneva_clearance": (0.1, ("wheel_angle", "driver_angle")),
    "cam_drive": (1.0, ("cam_angle", "follower_angle", "energy_lost")),
    "rotary_table": (2.0, ("table_angle", "energy_lost")),
    "slider_crank": (1.0, ("crank_angle", "energy_lost")),
    "pin_pallet": (0.2, ("balance_angle", "wheel_angle")),
}
#: Values are so far from their defaults, at most.
_FACTOR = 1.5
_STEPS = 20
_HEADINGS = (
    *("model", "designs", "refused at the start", "ran both ways", "apart, median and worst"),
    *("events, median and most", "at one instant", "times as long"),
)
_TOLERANCE = 1e-9


def designs(model: Model, count: int) -> list[dict[str, float]]:
    """So many designs: each number near its default, restitution and friction anywhere; the same each time."""
    chance = random.Random(model.name)
    return [{p.name: _value(p, chance) for p in model.parameters if _varies(p)} for _ in range(count)]


def _varies(parameter: Parameter) -> bool:
    of_settings = ("baumgarte", "tolerance", "internal", "method", "through", "impact_law", "guard", "shock")
    return parameter.type == "Real" and not any(word in parameter.name for word in of_settings)


def _value(parameter: Parameter, chance: random.Random) -> float:
    low = -np.inf if parameter.minimum is None else parameter.minimum
    high = np.inf if parameter.maximum is None else parameter.maximum
    if parameter.name == "restitution":
        return chance.choice((0.0, 0.3, 0.7, chance.random()))
    if "friction" in parameter.name and "radius" not in parameter.name:
        return chance.choice((0.0, 0.5 * chance.random()))
    if chance.random() < 0.7:  # most numbers of a mechanism belong together
        return float(parameter.start)
    return float(np.clip(parameter.start * _FACTOR ** chance.uniform(-1.0, 1.0), low, high))


def ends_of(slave: Instance, values: dict[str, float], until: float, names: tuple[str, ...]) -> list[float]:
    """Outputs at the end of a design's motion."""
    slave.set(values)
    slave.initialize(0.0, until)
    for k in range(_STEPS):
        slave.step(until * k / _STEPS, until / _STEPS)
    return [float(value) for value in slave.get(names)]


def run(
    count: Annotated[int, typer.Option(help="Designs of each model.", min=1)] = 125,
    only: Annotated[str | None, typer.Option("--model", help="One model only.")] = None,
) -> None:
    """Run random designs of the models with events both ways, and count."""
    console = Console()
    table = Table(*_HEADINGS)
    words: Counter[str] = Counter()
    with TemporaryDirectory() as folder:
        for name in [only] if only else list(MODELS):
            _of_model(name, count, Path(folder), table, words)
    console.print(table)
    for text, times in words.most_common():
        console.print(f"{times} times: {text}", markup=False)


def _of_model(name: str, count: int, folder: Path, table: Table, words: Counter[str]) -> None:
    until, names = MODELS[name]
    module = models.load(name)
    path = build_native_fmu(module, folder)
    refused, apart, events, at_once = 0, [], [], 0
    spent = {"co-simulation": 0.0, "Model Exchange": 0.0}
    with (
        open_fmu(path) as stepped,
        open_fmu(path, Integrator(relative_tolerance=_TOLERANCE)) as integrated,
        stepped.instantiate("stepped") as first,
        integrated.instantiate("integrated") as second,
    ):
        for design in track(designs(module.MODEL, count), description=f"{name:>16}"):
            ends = []
            for way, slave in zip(spent, (first, second), strict=True):
                slave.reset()
                began = time.process_time()
                try:
                    ends.append(np.array(ends_of(slave, design, until, names)))
                except (FmuError, HarnessError) as error:
                    if not ends and way == "co-simulation":
                        refused += 1
                        break
                    words[f"{name}: {str(error).partition('s: ')[2][:150]}"] += 1
                spent[way] += time.process_time() - began
            if len(ends) == 2:
                apart.append(float((np.abs(ends[1] - ends[0]) / np.maximum(1.0, np.abs(ends[0]))).max()))
                events.append(second.integration.events)  # type: ignore[attr-defined]
                at_once = max(at_once, second.integration.most_at_once)  # type: ignore[attr-defined]
    if apart:
        table.add_row(
            name,
            str(count),
            str(refused),
            str(len(apart)),
            f"{np.median(apart):.0e}, {max(apart):.0e}",
            f"{int(np.median(events))} to {max(events)}",
            str(at_once),
            f"{spent['Model Exchange'] / spent['co-simulation']:.1f}",
        )


if __name__ == "__main__":
    typer.run(run)
