"""A day of ticks: a pin-pallet escapement at two tolerances, and with a wheel of twice as many teeth.

    python -m benchmarks.escapement [--ticks 86400]        200 at least

Processor time of one thread; the rate is what the mean period of all ticks but the first hundred loses in a day.
"""

from __future__ import annotations

import argparse
import time
from typing import NamedTuple

from mechanism_fmu.model import (
    GROUND,
    CircularCopies,
    Damper,
    Mechanism,
    Oscillation,
    Outline,
    OutlineContact,
    Output,
    Revolute,
    Settings,
    Torque,
    TorsionSpring,
    deg,
    rigid_body,
)
from mechanism_fmu.model.functions import cos, sin, tan
from mechanism_fmu.simulation import Simulation

#: Ticks of a day [1], and its seconds [s].
DAY = 86400.0
#: Ticks until the swing is steady, the time of one, and a communication step [s].
_SETTLED, _TICK, _STEP = 100, 0.2, 60.0
#: So many there must be, that a mean period is left when the swing is steady.
_LEAST = 2 * _SETTLED
#: Teeth and tolerances.
CASES = ((15, 1e-9), (15, 1e-7), (30, 1e-7))


def _polar(radius: float, angle: float) -> tuple[float, float]:
    return radius * cos(angle), radius * sin(angle)


def pin_pallet(teeth: int, tolerance: float) -> Mechanism:
    """With teeth of one size, and the same forces, on a wheel that is as large as they need.

    Args:
        teeth: how many the wheel has.
        tolerance: relative, of the integrator [1].
    """
    more = teeth / 15
    # the pins are three and a half teeth apart
    half = deg(42) / more
    root, tip, on = 0.030 * more - 0.005, 0.030 * more + 0.0004, 0.030 * more - 0.0002
    hinge = (0.0, 0.030 * more / cos(half))
    arm = more * tan(half) / tan(deg(42))
    inertia = 2e-4 * arm * arm
    wheel = rigid_body("wheel", mass="5 g", inertia=2e-6 * more * more, angle=deg(90) + deg(48.1) / more)
    lever = rigid_body("lever", hinge, mass="50 g", inertia=inertia, angle=deg(6) / arm)
    corners = (root, -4.6), (tip - 0.0014, -4.6), (tip, 4.6), (root, 2.6)
    tooth = Outline.chain([_polar(radius, deg(angle / more)) for radius, angle in corners])
    contacts = []
    for name, side in (("entry", deg(90) + half), ("exit", deg(90) - half)):
        x, y = _polar(on, side)
        pin = Outline.circle("0.4 mm", (x, y - hinge[1]))
        copies = CircularCopies(teeth)
        contacts.append(OutlineContact(name, lever, wheel, outline_i=pin, outline_j=tooth, copies=copies))
    joints = (Revolute("arbor", wheel.at(0, 0), GROUND), Revolute("staff", lever.at(0, 0), GROUND.at(*hinge)))
    swing = 2.5 * deg(360)
    forces = (
        Torque("mainspring", wheel, torque=-6e-4 * more),
        TorsionSpring("hairspring", lever, stiffness=inertia * swing * swing),
        Damper("air", lever, damping=0.1 * inertia * swing),
    )
    beat = Oscillation("beat", lever, nominal_period=2 * _TICK)
    outputs = tuple(Output(name, f"beat.{name}", "", "1") for name in ("passages", "last_passage"))
    return Mechanism(
        (wheel, lever),
        joints,
        forces,
        tuple(contacts),
        outputs=outputs,
        settings=Settings(relative_tolerance=tolerance),
        oscillations=(beat,),
    )


class Run(NamedTuple):
    """Ticks, their mean period, and the processor time of all [s]."""

    ticks: int
    period: float
    seconds: float

    @property
    def of_a_day(self) -> float:
        """Processor time of as many ticks as a day has seconds [s]."""
        return DAY * self.seconds / self.ticks


def run(teeth: int, tolerance: float, ticks: int) -> Run:
    """Let it tick, and time it as a watchmaker does: by the passages of its lever through the middle.

    Args:
        teeth: as of `pin_pallet`.
        tolerance: likewise.
        ticks: how many, about.
    """
    simulation = Simulation(pin_pallet(teeth, tolerance))
    begun = time.process_time()
    settled = _passages(simulation, _TICK * _SETTLED)
    ended = _passages(simulation, _TICK * ticks)
    seconds = time.process_time() - begun
    swings = ended[0] - settled[0]
    return Run(round(2 * ended[0]), 0.5 * (ended[1] - settled[1]) / swings, seconds)


def _passages(simulation: Simulation, until: float) -> tuple[float, float]:
    """How often the lever has passed its middle upwards at a time [s], and when it did last [s]."""
    while simulation.time < until:
        simulation.advance(min(simulation.time + _STEP, until))
    values = simulation.read()
    return values["passages"], values["last_passage"]


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ticks", type=int, default=int(DAY), help="how many, about")
    ticks = parser.parse_args().ticks
    if ticks < _LEAST:
        parser.error(f"--ticks {ticks}: the swing is steady after {_SETTLED}; give {_LEAST} or more.")
    fine = run(15, 1e-9, ticks)
    for teeth, tolerance in CASES:
        found = fine if tolerance < 1e-8 else run(teeth, tolerance, ticks)
        rate = f", rate beside that {DAY * (found.period / fine.period - 1.0):+.4f} s a day" if teeth == 15 else ""
        each = 1e6 * found.seconds / found.ticks
        print(f"{teeth} teeth, {tolerance:.0e}: {found.ticks} ticks in {found.seconds:.2f} s, {each:.0f} us each{rate}")


if __name__ == "__main__":
    main()
