"""Geneva drives of 4, 5 and 6 slots: angle, speed and acceleration of the wheel while the pin is in a slot.

The pin enters along the slot, at the driver's angle phi_0 = pi/2 - pi/n from the line of centres. With mu = sin(pi/n)
and D = 1 + mu^2 - 2 mu cos(phi), the wheel is at the angle beta from that line, the other way round, and

    beta'  = mu (cos(phi) - mu) / D             largest at phi = 0: mu / (1 - mu)
    beta'' = -mu (1 - mu^2) sin(phi) / D^2      tan(pi/n) at entry, where it jumps; largest a little before phi = 0

are its derivatives by phi (Bickford 1972; `benchmarks.geneva`, which knows nothing of the engine). At a steady driver's
speed w, speed and acceleration of the wheel are w beta' and w^2 beta''.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import numpy as np
from numpy.polynomial import Chebyshev

from harness.report.plot import Curve, Plot
from harness.report.style import COLOURS
from mechanism_fmu import codes
from mechanism_fmu.simulation import Simulation
from models.geneva.model import MODEL

from ...geneva import in_slot, peak
from ..case import Case, Known, Run, steps_of

SLOTS = (4, 5, 6)
SPEED = 2 * math.pi
#: A driver so heavy against the wheel that its speed changes by less than 1e-11 of itself.
_STEADY = {"driver_inertia": 1e6, "wheel_inertia": 1e-6, "drive_damping": 0.0, "driver_speed_start": SPEED}
#: Around the peak, the acceleration is read at so many angles, within so far [rad]: a polynomial goes through them.
_NODES, _NEAR = 21, 0.12


def drive(slots: int, tolerance: float) -> Simulation:
    """The drive with its pin on the far side of the driver, which turns at a steady speed."""
    return Simulation(MODEL.build(MODEL.values(slot_count=slots, relative_tolerance=tolerance, **_STEADY)))


def run(tolerance: float) -> Run:
    """Entry, a place on the way, the peaks and what a turn leaves, of each number of slots."""
    values: list[float] = []
    steps = 0
    for slots in SLOTS:
        simulation = drive(slots, tolerance)
        start = simulation.read()["wheel_angle"]
        simulation.begin_step()
        while not simulation.read()["slot_active"]:
            simulation.go_on(1.0, codes.STOP_AT_EVENT)
        values += [math.pi - simulation.read()["driver_angle"], -_acceleration(simulation)]
        values += _moved(simulation, -_entry(slots) / 2)
        places = _NEAR * np.polynomial.chebyshev.chebpts1(_NODES)
        course = [_at(simulation, shift - peak(slots).angle) for shift in places]
        around = Chebyshev.fit(places, course, _NODES - 1, domain=[-_NEAR, _NEAR])
        flat = min((float(root.real) for root in around.deriv().roots()), key=abs)
        values += [float(around(flat)), peak(slots).angle - flat]
        values += _moved(simulation, 0.0)[1:]
        simulation.advance(1.0)
        values.append(start - simulation.read()["wheel_angle"])
        steps += steps_of(simulation)
    return Run(tuple(values), steps)


def _entry(slots: int) -> float:
    return math.pi / 2 - math.pi / slots


def _at(simulation: Simulation, phi: float) -> float:
    """Acceleration of the wheel over w^2 at an angle [rad] of the driver from the line of centres."""
    simulation.advance((math.pi + phi) / SPEED)
    return -_acceleration(simulation)


def _acceleration(simulation: Simulation) -> float:
    return simulation.read_rates()["wheel_speed"] / SPEED**2


def _moved(simulation: Simulation, phi: float) -> list[float]:
    """Angle [rad] of the wheel from the line of centres, and its speed over w."""
    simulation.advance((math.pi + phi) / SPEED)
    read = simulation.read()
    return [-read["wheel_angle"], -read["wheel_speed"] / SPEED]


def _known() -> Iterator[Known]:
    for slots in SLOTS:
        top, half = peak(slots), in_slot(-_entry(slots) / 2, slots)
        for name, unit, value in (
            ("angle of the driver at entry", "rad", _entry(slots)),
            ("acceleration at entry over w\u00b2", "1", math.tan(math.pi / slots)),
            ("angle of the wheel half way to the middle", "rad", half.angle),
            ("speed there over w", "1", half.rate),
            ("largest acceleration over w\u00b2", "1", top.curvature),
            ("angle of the driver there", "rad", top.angle),
            ("largest speed over w", "1", in_slot(0.0, slots).rate),
            ("angle of the wheel after a turn", "rad", 2 * math.pi / slots),
        ):
            yield Known(f"{slots} slots: {name}", unit, value, "closed form")


@cache
def drawings() -> tuple[Plot, ...]:
    """Speed and acceleration over the driver's angle, for each number of slots."""
    curves: list[list[Curve]] = [[], []]
    for slots, colour in zip(SLOTS, COLOURS, strict=False):
        simulation = drive(slots, 1e-9)
        angles = np.linspace(-1.4, 1.4, 561)
        courses: list[list[float]] = [[], []]
        for phi in angles:
            courses[1].append(_at(simulation, phi))
            courses[0].append(-simulation.read()["wheel_speed"] / SPEED)
        for course, drawn in zip(courses, curves, strict=True):
            drawn.append(Curve(f"{slots} slots", np.degrees(angles), course, colour))
    phi = "driver from the line of centres [deg]"
    return (
        Plot("Speed of the wheel", phi, "wheel speed / w", curves[0]),
        Plot("Acceleration of the wheel", phi, "wheel acceleration / w^2", curves[1]),
    )


CASE = Case(
    name="geneva",
    title="Geneva drive",
    statement=(
        "A driver at a steady 60 rpm turns a wheel of 4, 5 or 6 slots by one of them in each turn; its pin enters "
        "along the slot, without a jump of speed, but of acceleration. The slot is a row that a logical function "
        "closes while the pin is within the wheel's radius; else one locks the wheel."
    ),
    source="textbook formulas, J. H. Bickford, Mechanisms for Intermittent Motion, Industrial Press, 1972",
    known=tuple(_known()),
    run=run,
    model=Path(__file__).parents[3] / "models" / "geneva" / "model.py",
    within=1e-8,
    remark=(
        "Tables of textbooks with these peaks could not be opened, so that none of their digits is called published. "
        "The engine finds the entry 1.4 to 2.0e-9 rad late, at any tolerance: a logical function counts a boundary as "
        "passed when it is passed by 1e-9 of the mechanism's length. The acceleration at entry, which rises from there "
        "at once, is off by 4e-9 for the same reason; all other values follow the tolerance. The largest acceleration "
        "and its place are those of a polynomial through 21 accelerations around it."
    ),
    drawings=drawings,
)
