"""A published problem: what is asked, what is known, and what the engine finds at a tolerance."""

from __future__ import annotations

import importlib.util
import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path
from typing import Any, Literal

from harness.report.plot import Plot
from mechanism_fmu import codes
from mechanism_fmu.model import Model
from mechanism_fmu.simulation import Impact, Simulation

#: Where a known value comes from: printed in the source; a formula; an equation of the one coordinate, solved by scipy;
#: other equations of the same problem, written by hand in the case's own file and solved without the engine; the same
#: model in another program, whose name, version and settings stand in the case's file.
Origin = Literal["published", "closed form", "one coordinate", "second formulation", "other program"]

#: Tolerances of the work-precision diagram, and the two whose digits a page shows.
TOLERANCES = (1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12)
SHOWN = (1e-9, 1e-12)
#: A run that takes longer is not repeated to be timed [s].
_LONG = 1.0

_EXAMPLES = Path(__file__).parents[2] / "docs" / "examples" / "gallery"


@dataclass(frozen=True)
class Known:
    """A quantity and its known value.

    Attributes:
        name: of the quantity.
        unit: of it.
        value: its value, as printed where it is published.
        origin: where that comes from.
    """

    name: str
    unit: str
    value: str | float
    origin: Origin

    @property
    def number(self) -> float:
        """The value."""
        return float(self.value)

    def deviation(self, found: float) -> float:
        """How far a value is off, relative to the known one; absolute where that is zero."""
        return abs(found - self.number) / (abs(self.number) or 1.0)

    def is_reached(self, found: float) -> bool | None:
        """Whether a value is the published one within half a unit of its last printed digit; None for other origins."""
        if self.origin != "published":
            return None
        exponent = Decimal(str(self.value)).as_tuple().exponent
        assert isinstance(exponent, int)
        return abs(found - self.number) <= 0.5 * 10.0**exponent


@dataclass(frozen=True)
class Run:
    """What a run has found: values in the order of the case's, and the engine's steps."""

    values: tuple[float, ...]
    steps: int


@dataclass(frozen=True)
class Case:
    """A published problem.

    Attributes:
        name: of its page.
        title: of it.
        statement: what moves, with its data.
        source: who has published it, and where.
        known: the quantities.
        run: from a relative tolerance to what is found.
        model: the function or the file that makes the mechanism, as the page shows it.
        within: largest deviation at the tighter one of `SHOWN`, with a reason in `remark` where it is more than the
            tolerance explains.
        remark: what the numbers mean; required where a published digit is not reached.
        drawings: makes other pictures of its page, where there are.
    """

    name: str
    title: str
    statement: str
    source: str
    known: tuple[Known, ...]
    run: Callable[[float], Run]
    model: Callable[..., Any] | Path
    within: float
    remark: str = ""
    drawings: Callable[[], Sequence[Plot]] | None = None

    def deviation(self, run: Run) -> float:
        """The largest of all quantities."""
        return max(one.deviation(value) for one, value in zip(self.known, run.values, strict=True))

    def unreached(self, run: Run) -> list[str]:
        """Names of published quantities whose last printed digit is not reached."""
        pairs = zip(self.known, run.values, strict=True)
        return [known.name for known, value in pairs if known.is_reached(value) is False]


@dataclass(frozen=True)
class Work:
    """One point of the diagram: a tolerance, steps and processor time [s] that it takes, and how far it is off."""

    tolerance: float
    steps: int
    seconds: float
    deviation: float


def work(case: Case, tolerance: float, rounds: int = 3) -> Work:
    """Run a case so many times, and keep the shortest time; what is made and assembled before is part of it.

    What takes long is not repeated: its time is known well enough.
    """
    found, shortest, spent = None, math.inf, 0.0
    for _ in range(rounds):
        if spent > _LONG:
            break
        began = time.process_time()
        found = case.run(tolerance)
        took = time.process_time() - began
        shortest, spent = min(shortest, took), spent + took
    assert found is not None
    return Work(tolerance, found.steps, shortest, case.deviation(found))


def steps_of(simulation: Simulation) -> int:
    """The engine's steps so far."""
    return int(simulation.counters[codes.COUNT_STEPS])


def impacts_until(simulation: Simulation, times: Sequence[float]) -> list[Impact]:
    """All impacts, with at most eight between one of the times [s] and the next."""
    found: list[Impact] = []
    for until in times:
        simulation.advance(float(until))
        found += simulation.impacts_in_step()
    return found


def example_path(name: str) -> Path:
    """The file of a mechanism of the gallery."""
    return _EXAMPLES / f"{name}.py"


def example(name: str) -> Model:
    """What that file sets as MODEL."""
    spec = importlib.util.spec_from_file_location(f"world_{name}", example_path(name))
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    model: Model = module.MODEL
    return model
