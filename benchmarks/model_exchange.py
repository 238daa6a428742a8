"""Command: `python -m benchmarks.model_exchange`, from the root of the repository: Model Exchange beside co-simulation.

Random designs of the models with events, by the harness with scipy's DOP853, and the same designs in co-simulation:
how many events there are, how many follow each other at one instant, how far the ends are from each other, and what is
refused with which words.
"""

from __future__ import annotations

import math
import random
import time
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
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
#: Designs of each.
COUNT = 125
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


@dataclass(frozen=True)
class BothWays:
    """Designs of a model, run both ways.

    Attributes:
        model: its name.
        tried: how many designs there were.
        refused: how many co-simulation refused.
        apart: how far the ends are from each other, of each that ran both ways.
        events: how many there were in Model Exchange, of each.
        at_once: most that followed each other at one instant.
        slower: how many times as long Model Exchange took.
        words: of messages, and how often they came.
    """

    model: str
    tried: int
    refused: int
    apart: tuple[float, ...]
    events: tuple[int, ...]
    at_once: int
    slower: float
    words: Counter[str]


def both_ways(name: str, todo: Iterable[dict[str, float]], folder: Path) -> BothWays:
    """Run designs of a model both ways.

    Args:
        name: of the model.
        todo: its designs.
        folder: for its FMU.
    """
    until, names = MODELS[name]
    path = build_native_fmu(models.load(name), folder)
    tried, refused, at_once = 0, 0, 0
    apart: list[float] = []
    events: list[int] = []
    words: Counter[str] = Counter()
    spent = {"co-simulation": 0.0, "Model Exchange": 0.0}
    with (
        open_fmu(path) as stepped,
        open_fmu(path, Integrator(relative_tolerance=_TOLERANCE)) as integrated,
        stepped.instantiate("stepped") as first,
        integrated.instantiate("integrated") as second,
    ):
        for design in todo:
            tried += 1
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
    slower = spent["Model Exchange"] / spent["co-simulation"] if apart else math.nan
    return BothWays(name, tried, refused, tuple(apart), tuple(events), at_once, slower, words)


def run(
    count: Annotated[int, typer.Option(help="Designs of each model.", min=1)] = COUNT,
    only: Annotated[str | None, typer.Option("--model", help="One model only.")] = None,
) -> None:
    """Run random designs of the models with events both ways, and count."""
    console = Console()
    table = Table(*_HEADINGS)
    words: Counter[str] = Counter()
    with TemporaryDirectory() as folder:
        for name in [only] if only else list(MODELS):
            todo = designs(models.load(name).MODEL, count)
            one = both_ways(name, track(todo, description=f"{name:>16}"), Path(folder))
            words += one.words
            if one.apart:
                table.add_row(*_cells(one))
    console.print(table)
    for text, times in words.most_common():
        console.print(f"{times} times: {text}", markup=False)


def _cells(one: BothWays) -> tuple[str, ...]:
    return (
        one.model,
        str(one.tried),
        str(one.refused),
        str(len(one.apart)),
        f"{np.median(one.apart):.0e}, {max(one.apart):.0e}",
        f"{int(np.median(one.events))} to {max(one.events)}",
        str(one.at_once),
        f"{one.slower:.1f}",
    )


if __name__ == "__main__":
    typer.run(run)
