"""Command: `python -m benchmarks.limits`, from the root of the repository: designs at the limits of all parameters.

Each model with one to four parameters far from their defaults, up to the limits; 0.05 s of motion, timed. What takes
long must have something to do: turns, swings or events, which are counted; a design that is only stiff does not.
"""

from __future__ import annotations

import math
import random
import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated

import numpy as np
import typer
from rich.console import Console
from rich.progress import track
from rich.table import Table

import models
from mechanism_fmu import codes
from mechanism_fmu.model import MechanismError, Model, Parameter, Settings
from mechanism_fmu.simulation import Simulation, SimulationError

#: So long a motion [s], and so much processor time [s] for it without a reason.
MOTION, ALLOWED = 0.05, 0.1
#: More steps than this for each turn, swing or event are without a reason; those with one took up to 118.
STEPS_EACH = 200
#: A value is so many times its default, or the 1/so many part, or at a limit with the probability that follows.
_FACTOR, _AT_LIMIT = 1e5, 0.15
#: So many of a design's parameters are changed, at most.
_CHANGED = 4
#: An acceleration below this part of the largest one is its rounding: its sign counts as no swing.
_ROUNDING = 1e-12
_SETTINGS = tuple(Settings.__dataclass_fields__)


@dataclass(frozen=True)
class Run:
    """One design's 0.05 s.

    Attributes:
        model: its name.
        changed: values of the parameters that are not at their defaults, by name.
        seconds: processor time [s].
        steps: the engine's own.
        implicit: how many of them were implicit.
        reasons: turns, swings (of the velocity that changes its sense most often) and events together; NaN where it was
            fast.
        ending: "ran", or the first words of the message with which it ended.
    """

    model: str
    changed: dict[str, float]
    seconds: float
    steps: int
    implicit: int
    reasons: float
    ending: str

    @property
    def is_slow(self) -> bool:
        """Whether it took longer than `ALLOWED`."""
        return self.seconds > ALLOWED

    @property
    def has_reason(self) -> bool:
        """Whether what was slow had about as much to do as it took steps."""
        return self.steps <= STEPS_EACH * self.reasons


def designs(model: Model, count: int) -> Iterator[dict[str, float]]:
    """So many designs that the model does not refuse, as changes of its defaults; the same each time."""
    free = [p for p in model.parameters if p.name not in _SETTINGS]
    found = seed = 0
    while found < count and seed < 100 * count:
        chance = random.Random(f"{model.name} {seed}")
        seed += 1
        changed = {p.name: _value(p, chance) for p in chance.sample(free, chance.randint(1, _CHANGED))}
        try:
            if model.refused(model.checked({p.name: p.start for p in model.parameters} | changed)):
                continue
        except MechanismError:
            continue
        found += 1
        yield changed


def _value(parameter: Parameter, chance: random.Random) -> float:
    """A value far from the default, within the limits."""
    low = -1e6 if parameter.minimum is None else parameter.minimum
    high = 1e6 if parameter.maximum is None else parameter.maximum
    if parameter.type == "Boolean":
        return chance.randint(0, 1)
    if parameter.type == "Integer":
        return int(np.clip(round(parameter.start * 10 ** chance.uniform(-0.5, 0.5)), low, high))
    if chance.random() < _AT_LIMIT:
        return chance.choice((low, high))
    usual = parameter.start or (parameter.usual[1] if parameter.usual else 1.0) or 1.0
    power = math.log10(_FACTOR)
    sign = chance.choice((-1, 1)) if low < 0.0 else 1
    return float(np.clip(sign * abs(usual) * 10 ** chance.uniform(-power, power), low, high))


def run_of(name: str, changed: dict[str, float]) -> Run | None:
    """Run one design, timed; None where its start is refused."""
    try:
        simulation = _simulation(name, changed)
    except (MechanismError, SimulationError):
        return None
    began, ending = time.process_time(), "ran"
    try:
        simulation.advance(MOTION)
    except SimulationError as error:
        ending = str(error).partition(": ")[2][:60]
    seconds = time.process_time() - began
    counters = simulation.counters
    steps, implicit = counters.item(codes.COUNT_STEPS), counters.item(codes.COUNT_IMPLICIT)
    reasons = _reasons(_simulation(name, changed), steps) if seconds > ALLOWED else math.nan
    return Run(name, changed, seconds, steps, implicit, reasons, ending)


def survey(name: str, count: int) -> Iterator[Run | None]:
    """Run so many designs of a model; None for each whose start is refused."""
    for changed in designs(models.load(name).MODEL, count):
        yield run_of(name, changed)


def _simulation(name: str, changed: dict[str, float]) -> Simulation:
    model: Model = models.load(name).MODEL
    return Simulation(model.build(model.values(**changed)))


def _senses(accelerations: np.ndarray) -> np.ndarray:
    """Signs of accelerations, 0 for what is rounding of the largest."""
    return np.sign(np.where(np.abs(accelerations) > _ROUNDING * np.abs(accelerations).max(), accelerations, 0.0))


def _reasons(simulation: Simulation, steps: int) -> float:
    """Turns, swings and events of the first so many steps."""
    count = 3 * simulation.field("body_rank").size
    rates = slice(count, 2 * count)
    y = simulation.field("y_end")
    turned, changes = np.zeros(count), np.zeros(count)
    before, sense = y[:count].copy(), _senses(simulation.field("dy_end")[rates])
    simulation.begin_step()
    try:
        for _ in range(steps):
            simulation.go_on(MOTION, codes.STOP_AT_STEP)
            start, size = simulation.field("clock")[[codes.STEP_START, codes.STEP_SIZE]]
            inside = min(1.0, (MOTION - start) / size)  # the last step may end behind the motion that is timed
            turned += inside * np.abs(y[:count] - before)
            before = y[:count].copy()
            now = _senses(simulation.field("dy_end")[rates])
            changes += now * sense < 0
            sense = now
    except SimulationError:
        pass
    turns = float(turned[2::3].max()) / (2 * math.pi)
    return turns + float(changes.max()) / 2 + int(simulation.counters[codes.COUNT_EVENTS])


def run(
    count: Annotated[int, typer.Option(help="Designs of each model.", min=1)] = 100,
    only: Annotated[str | None, typer.Option("--model", help="One model only.")] = None,
) -> None:
    """Time designs at the limits of what each model's parameters allow, and say why what is slow is slow."""
    console = Console(width=150)
    found: list[Run] = []
    for name in [only] if only else list(models.available()):
        runs = track(survey(name, count), description=name, total=count, console=Console(stderr=True))
        found += [one for one in runs if one]
    table = Table("model", "changed", "time [s]", "steps", "implicit", "turns + swings + events", "steps each", "")
    slow = sorted((one for one in found if one.is_slow), key=lambda one: -one.seconds)
    for one in slow:
        named = ", ".join(f"{name} {value:.3g}" for name, value in one.changed.items())
        each = f"{one.steps / one.reasons:.1f}" if one.reasons else "-"
        numbers = (f"{one.seconds:.2f}", str(one.steps), str(one.implicit), f"{one.reasons:.0f}", each)
        table.add_row(one.model, named, *numbers, one.ending)
    console.print(table)
    times = np.array([one.seconds for one in found])
    stiff = sum(one.implicit > 0 for one in found)
    console.print(
        f"{len(found)} designs, {stiff} of them with implicit steps: {MOTION} s of motion in {np.median(times):.2g} s "
        f"in the middle, 99 of 100 in {np.quantile(times, 0.99):.2g} s; {len(slow)} took more than {ALLOWED} s."
    )


if __name__ == "__main__":
    typer.run(run)
