"""Rocking block: times and speeds of its impacts against Housner's formula and quadratures of the fall.

A corner stands still, so that with the lean theta, the half diagonal R and the critical angle alpha, for 0 < theta,

    4/3 R^2 theta'^2/2 + g R cos(alpha - theta) = const,

and the moment of momentum about the corner that strikes is kept: an impact leaves r of the energy,

    r = (1 - m R^2 (1 - cos(2 alpha))/I_0)^2 = (1 - 3/2 sin(alpha)^2)^2,    I_0 = 4/3 m R^2.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from scipy.integrate import quad

from mechanism_fmu.simulation import Simulation

from ..case import Case, Known, Run, example, example_path, impacts_until, steps_of

WIDTH, HEIGHT, GRAVITY = 0.2, 0.8, 9.81
COUNT = 6


def run(tolerance: float) -> Run:
    """Times and closing speeds of six impacts, and the energy that one of them leaves.

    Between impacts no energy is lost, and the block falls as far as it has risen: speeds are to each other as roots of
    energies.
    """
    model = example("rocking_block")
    made = model.build(model.values())
    simulation = Simulation(replace(made, settings=replace(made.settings, relative_tolerance=tolerance)))
    found = impacts_until(simulation, np.linspace(0.0, 2.5, 201)[1:].tolist())[:COUNT]
    values = [value for one in found for value in (one.time, one.closing_speed)]
    return Run((*values, (found[1].closing_speed / found[0].closing_speed) ** 2), steps_of(simulation))


def impacts(count: int, width: float, height: float) -> Iterator[tuple[float, float]]:
    """Times [s] and closing speeds [m/s] of Housner's block.

    The time of falling from rest is a quadrature, whose integrand is smooth over the root of the angle fallen; each
    impact leaves 1 - 3/2 sin(alpha)^2 of the speed.
    """
    radius, alpha = math.hypot(width, height) / 2, math.atan2(width, height)
    root = math.sqrt(1.5 * GRAVITY / radius)
    time, lean = 0.0, alpha / 2
    for k in range(count):
        least = alpha - lean

        def slowness(s: float, least: float = least) -> float:
            fallen = s * s / 2
            height_lost = math.sin(least + fallen) * (math.sin(fallen) / fallen if fallen else 1.0)
            return 2.0 / (root * math.sqrt(height_lost))

        fall, _ = quad(slowness, 0.0, math.sqrt(lean), epsabs=1e-13, epsrel=1e-12)
        time += fall if k == 0 else 2 * fall
        drop = 2 * math.sin((alpha + least) / 2) * math.sin(lean / 2)  # cos(least) - cos(alpha)
        rate = root * math.sqrt(drop)
        yield time, width * rate
        rate *= 1 - 1.5 * math.sin(alpha) ** 2
        lean = alpha - math.acos(math.cos(alpha) + (rate / root) ** 2)


def _known() -> Iterator[Known]:
    for number, (time, speed) in enumerate(impacts(COUNT, WIDTH, HEIGHT), 1):
        yield Known(f"time of impact {number}", "s", time, "closed form")
        yield Known(f"closing speed of impact {number}", "m/s", speed, "closed form")
    squared = WIDTH**2 / (WIDTH**2 + HEIGHT**2)  # sin(alpha)^2
    yield Known("energy after an impact, over that before", "1", (1 - 1.5 * squared) ** 2, "closed form")


CASE = Case(
    name="rocking_block",
    title="Rocking block",
    statement=(
        "A uniform block, 0.2 m wide and 0.8 m high, stands on a rough floor; let go tilted by half its "
        "critical angle, it rocks "
        "from corner to corner, with restitution 0 and without slip."
    ),
    source=(
        "G. W. Housner, The behavior of inverted pendulum structures during earthquakes, Bulletin of the "
        "Seismological Society "
        "of America 53 (1963); an example of Siconos"
    ),
    known=tuple(_known()),
    run=run,
    model=example_path("rocking_block"),
    within=1e-10,
    remark=(
        "An impact leaves 1 \u2212 3/2 sin\u00b2(alpha) of the speed, alpha being the critical angle; between "
        "impacts the time is a quadrature, without Housner's assumption of a slender block: with it, the first impact "
        "would be at arcosh(2)/sqrt(3 g/(4 R)) = 0.3118 s."
    ),
)
