"""The escapements of models/: reference curves, rates, and the period against the torque.

    python -m benchmarks.escapements graham > models/graham/reference.csv
    python -m benchmarks.escapements                                          (the table; takes a minute)

The curves are the library's own, with a hundredth of the error that a run has by default. What they are checked with is
another computation, which has ticks and limit cycles of three of them (tests/data/shapes.json), and laws.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator
from typing import NamedTuple

import models
from mechanism_fmu.model import Model
from mechanism_fmu.simulation import Simulation

from .curve_file import print_curve


class Swung(NamedTuple):
    """A model, what swings in it, and how long it takes to come to its limit cycle [s]."""

    model: str
    body: str
    settles: float

    @property
    def described(self) -> Model:
        """Its `MODEL`."""
        found = models.load(self.model).MODEL
        assert isinstance(found, Model)
        return found


ESCAPEMENTS = (
    Swung("verge", "foliot", 20.0),
    Swung("recoil_anchor", "pendulum", 200.0),
    Swung("graham", "pendulum", 160.0),
    Swung("pin_pallet", "balance", 12.0),
    Swung("lever_escapement", "balance", 60.0),
)
#: Factors of the default torque: eight from the least to the greatest.
FACTORS = (0.5, 1.0, 1.5, 2.0, 4.0)
#: Rows of a curve.
ROWS = 200


class Beat(NamedTuple):
    """The last whole period: period [s], amplitude [rad], rate [s/d], power [W]."""

    period: float
    amplitude: float
    rate: float
    power: float


def columns(one: Swung) -> tuple[str, ...]:
    """What a reference curve has besides the time."""
    return "wheel_angle", f"{one.body}_angle", "period", "amplitude", "rate", "power", "swings", "impact_count"


def curve(one: Swung) -> Iterator[tuple[float, ...]]:
    """Rows of the reference: time [s], then `columns`; the default run."""
    model = one.described
    simulation = Simulation(model.build(model.values(relative_tolerance=1e-12)))
    for k in range(ROWS + 1):
        time = k * model.stop_time / ROWS
        simulation.advance(time)
        shown = simulation.read()
        yield time, *(shown[name] for name in columns(one))


def steady(one: Swung, factor: float = 1.0, **values: float) -> Beat:
    """What it does after it has settled.

    It starts near its limit cycle: power, and with it the square of the amplitude, goes with the torque.

    Args:
        one: which.
        factor: of the default torque.
        values: of its parameters.
    """
    model = one.described
    starts = {p.name: p.start * math.sqrt(factor) for p in model.parameters if p.name == f"{one.body}_angle_start"}
    simulation = Simulation(model.build(model.values(**starts, **values)))
    simulation.set_input("drive_torque", factor * model.inputs[0].start)
    simulation.advance(one.settles)
    shown = simulation.read()
    return Beat(*(float(shown[name]) for name in Beat._fields))


def exponent(low: tuple[float, Beat], high: tuple[float, Beat]) -> float:
    """D ln period / d ln torque between two torques."""
    return math.log(high[1].period / low[1].period) / math.log(high[0] / low[0])


def rate_of_reference(one: Swung) -> float:
    """Gain [s/d] over the last whole period of the reference run."""
    *_, last = curve(one)
    return last[1 + columns(one).index("rate")]


def table() -> Iterator[str]:
    """Lines: of each, period, amplitude, rate and power over the torque, and the exponent between neighbours."""
    for one in ESCAPEMENTS:
        least = one.described.inputs[0].start
        yield f"{one.model}: rate of the reference run {rate_of_reference(one):+.3f} s/d"
        before: tuple[float, Beat] | None = None
        for factor in FACTORS:
            beat = steady(one, factor)
            rise = "" if before is None else f"  {exponent(before, (factor, beat)):+.6f}"
            yield (
                f"  {1e3 * factor * least:7.3f} N.mm  {beat.period:.7f} s  {math.degrees(beat.amplitude):8.4f} deg  "
                f"{1e3 * beat.power:9.5f} mW{rise}"
            )
            before = factor, beat


def main() -> None:
    """Print a reference curve, or the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", nargs="?", choices=[one.model for one in ESCAPEMENTS])
    asked = parser.parse_args().model
    if asked is None:
        for line in table():
            print(line, flush=True)
        return
    (one,) = (one for one in ESCAPEMENTS if one.model == asked)
    print_curve(",".join(("time", *columns(one))), curve(one))


if __name__ == "__main__":
    main()
