"""Newton's cradle: five equal balls on threads, restitution 1, with a gap between them and without.

Between impacts each ball is a pendulum, theta'' = -g/L sin(theta), and with w = sqrt(g/L), k = sin(amplitude / 2)

    sin(theta / 2) = k sn(w (t - t_0), k)         theta' = 2 k w cn(w (t - t_0), k)

With gaps the balls strike in pairs. Along the line of centres n, two equal balls exchange what they approach by: with
t_i along the path of ball i, and the approach v = n . (u_1 t_1 - u_2 t_2) of the speeds u_i, u_1 loses
2 v (n . t_1) / G and u_2 gains 2 v (n . t_2) / G, G = (n . t_1)^2 + (n . t_2)^2. As good as in line: one in, one out.

Balls that touch are struck together. Then each pair must separate with e times its approach, 0 where there is none, by
impulses that push (Moreau). With e = 1, of n balls of which m come in at the speed v,

    u+ = (2 m - n) v / n of those that came in        u+ = 2 m v / n of the others
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import accumulate, pairwise
from typing import Any

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipj, ellipk, ellipkinc

from harness.report.plot import Curve, Plot
from harness.report.style import COLOURS
from mechanism_fmu import codes
from mechanism_fmu.model import GROUND, Body, Distance, Mechanism, Outline, OutlineContact, Output, Settings
from mechanism_fmu.simulation import Simulation

from ..case import Case, Known, Run, steps_of

COUNT, RADIUS, LENGTH, GRAVITY = 5, 0.01, 0.1, 9.81
ANGLE = 0.5
#: Unequal, so that no two pairs meet at once [m].
GAPS = (1.0e-4, 1.3e-4, 1.1e-4, 1.5e-4)
_TOUCHING = (0.0,) * (COUNT - 1)
RAISED = (1, 2)
#: Ends within which the balls come together twice [s].
_STOP = 0.6
_W = math.sqrt(GRAVITY / LENGTH)


def cradle(raised: int, gaps: Sequence[float], tolerance: float) -> Mechanism:
    """Discs side by side on massless threads, the first ones raised; none of them turns."""
    balls, threads = [], []
    for k, pivot in enumerate(_pivots(gaps)):
        angle = -ANGLE if k < raised else 0.0
        at = (pivot + LENGTH * math.sin(angle), -LENGTH * math.cos(angle), 0.0)
        balls.append(Body(f"ball{k}", 0.1, 0.1 * RADIUS**2 / 2, at))
        threads.append(Distance(f"thread{k}", GROUND.at(pivot, 0), balls[-1].at(0, 0), distance=LENGTH))
    rim = Outline.circle(RADIUS)
    pairs = [
        OutlineContact(f"pair{k}", one, other, outline_i=rim, outline_j=rim, restitution=1.0, points=1)
        for k, (one, other) in enumerate(pairwise(balls))
    ]
    return Mechanism(
        tuple(balls),
        tuple(threads),
        contacts=tuple(pairs),
        outputs=(
            *(Output(f"x{k}", ball.x, "m") for k, ball in enumerate(balls)),
            *(Output(f"u{k}", ball.x_rate, "m/s") for k, ball in enumerate(balls)),
            Output("kinetic", "energy.kinetic", "J"),
            Output("work", "energy.work", "J"),
        ),
        gravity=(0.0, -GRAVITY),
        settings=Settings(tolerance),
    )


def _pivots(gaps: Sequence[float]) -> list[float]:
    """Of the threads, along the row [m]."""
    return list(accumulate((2 * RADIUS + gap for gap in gaps), initial=0.0))


def _behind(simulation: Simulation, count: int) -> tuple[float, dict[str, float]]:
    """Time [s] of the impact of this number, and what is read right behind it."""
    simulation.begin_step()
    while simulation.counters[codes.COUNT_IMPACTS] < count:
        simulation.go_on(_STOP, codes.STOP_AT_IMPACT)
    return simulation.time, simulation.read()


def _passing(raised: int) -> int:
    """How many impacts it takes to hand on the momentum: each that comes in goes through each that rests."""
    return raised * (COUNT - raised)


def run(tolerance: float) -> Run:
    """With gaps: both ways through the cradle; without: the first impact."""
    values: list[float] = []
    steps = 0
    for raised in RAISED:
        simulation = Simulation(cradle(raised, GAPS, tolerance))
        counts = (1, _passing(raised), 2 * _passing(raised))
        (first, _), (there, out), (back, home) = (_behind(simulation, count) for count in counts)
        values += [first, there, *(out[f"u{k}"] for k in range(COUNT)), back, *(home[f"u{k}"] for k in range(raised))]
        values.append(home["kinetic"] / home["work"])
        steps += steps_of(simulation)
    for raised in RAISED:
        simulation = Simulation(cradle(raised, _TOUCHING, tolerance))
        first, after = _behind(simulation, 1)
        values += [first, *(after[f"u{k}"] / _SPEED for k in range(COUNT))]
        steps += steps_of(simulation)
    return Run(tuple(values), steps)


class Pendulum:
    """A ball on its thread: its motion from a time, angle and rate on."""

    def __init__(self, pivot: float, time: float, angle: float, rate: float) -> None:
        self.pivot = pivot
        along, turns = math.sin(angle / 2), rate / (2 * _W)
        self._modulus = math.hypot(along, turns)
        self._begin = ellipkinc(math.atan2(along, turns), self._modulus**2) - _W * time

    def at(self, time: Any) -> tuple[Any, Any]:
        """Angle [rad] and its rate [rad/s], at one time or many."""
        sn, cn, _, _ = ellipj(_W * time + self._begin, self._modulus**2)
        return 2 * np.arcsin(self._modulus * sn), 2 * self._modulus * _W * cn

    def place(self, time: Any) -> Any:
        """Of its centre, as a complex number [m]."""
        angle, _ = self.at(time)
        return self.pivot - 1j * LENGTH * np.exp(1j * angle)


def _speeds(balls: list[Pendulum], time: float) -> list[float]:
    """Along the row [m/s]."""
    return [float(LENGTH * rate * math.cos(angle)) for angle, rate in (ball.at(time) for ball in balls)]


def by_pairs(raised: int, count: int) -> Iterator[tuple[float, list[float]]]:
    """Times [s] of the first impacts with gaps, and all speeds along the row [m/s] behind each."""
    balls = [Pendulum(pivot, 0.0, -ANGLE if k < raised else 0.0, 0.0) for k, pivot in enumerate(_pivots(GAPS))]
    time = 0.0

    def gap(at: float, k: int) -> float:
        return float(abs(balls[k + 1].place(at) - balls[k].place(at)) - 2 * RADIUS)

    for _ in range(count):
        hits = []
        # no gap closes and opens within a step of the grid
        grid = time + np.linspace(0.0, 0.35, 141)
        places = np.array([ball.place(grid) for ball in balls])
        for k, gaps in enumerate(abs(np.diff(places, axis=0)) - 2 * RADIUS):
            if gaps[0] < 1e-14 and _approach(balls, k, time)[0] > 0.0:
                hits.append((time, k))  # in the same instant as another pair
            elif np.any(gaps[1:] < 0.0):
                n = int(np.argmax(gaps[1:] < 0.0))
                hits.append((brentq(gap, grid[n], grid[n + 1], (k,), xtol=1e-15, rtol=1e-14), k))
        time, k = min(hits)
        _strike(balls, k, time)
        yield time, _speeds(balls, time)


def _approach(balls: list[Pendulum], k: int, time: float) -> tuple[float, list[float]]:
    """How fast a ball and the next one approach, over the threads' length, and n . t of both."""
    pair = balls[k : k + 2]
    line = pair[1].place(time) - pair[0].place(time)
    states = [ball.at(time) for ball in pair]
    along = [float((np.exp(1j * angle) * line.conjugate()).real / abs(line)) for angle, _ in states]
    return float(along[0] * states[0][1] - along[1] * states[1][1]), along


def _strike(balls: list[Pendulum], k: int, time: float) -> None:
    """Two balls exchange what they approach by."""
    approach, along = _approach(balls, k, time)
    share = 2 * approach / (along[0] ** 2 + along[1] ** 2)
    for n, change in enumerate((-share, share)):
        angle, rate = balls[k + n].at(time)
        balls[k + n] = Pendulum(balls[k + n].pivot, time, angle, rate + change * along[n])


_SPEED = 2 * _W * LENGTH * math.sin(ANGLE / 2)


def _known() -> Iterator[Known]:
    for raised in RAISED:
        found = list(by_pairs(raised, 2 * _passing(raised)))
        (first, _), (there, out), (back, home) = (found[k] for k in (0, _passing(raised) - 1, -1))
        name = f"gaps, {raised} in"
        for what, value in ((f"{name}: time of the first impact", first), (f"{name}: {raised} out at", there)):
            yield Known(what, "s", value, "second formulation")
        for k, speed in enumerate(out):
            yield Known(f"{name}: speed of ball {k + 1} then", "m/s", speed, "second formulation")
        yield Known(f"{name}: back again at", "s", back, "second formulation")
        for k, speed in enumerate(home[:raised]):
            yield Known(f"{name}: speed of ball {k + 1} then", "m/s", speed, "second formulation")
        yield Known(f"{name}: kinetic energy then over the work of the weight", "1", 1.0, "closed form")
    fall = float(ellipk(math.sin(ANGLE / 2) ** 2)) / _W
    for raised in RAISED:
        name = f"touching, {raised} in"
        yield Known(f"{name}: time of the impact", "s", fall, "closed form")
        for k in range(COUNT):
            speed = (2 * raised - COUNT * (k < raised)) / COUNT
            yield Known(f"{name}: speed of ball {k + 1} behind it over that before", "1", speed, "closed form")


@cache
def drawings() -> tuple[Plot, ...]:
    """Where the balls are, with gaps and without."""
    plots = []
    for title, raised, gaps in (
        ("Gaps: one in, one out", 1, GAPS),
        ("Gaps: two in, two out", 2, GAPS),
        ("Touching: struck together, one in", 1, _TOUCHING),
        ("Touching: struck together, two in", 2, _TOUCHING),
    ):
        simulation = Simulation(cradle(raised, gaps, 1e-9))
        times = np.linspace(0.0, 1.6, 401)
        courses: list[list[float]] = [[] for _ in range(COUNT)]
        for time in times:
            simulation.advance(time)
            read = simulation.read()
            for k, course in enumerate(courses):
                course.append(1e3 * read[f"x{k}"])
        curves = [
            Curve(f"ball {k + 1}", times, course, colour)
            for k, (course, colour) in enumerate(zip(courses, COLOURS, strict=False))
        ]
        plots.append(Plot(title, "time [s]", "place along the row [mm]", curves))
    return tuple(plots)


CASE = Case(
    name="newtons_cradle",
    title="Newton's cradle",
    statement=(
        "Five discs of 10 mm radius hang side by side on threads of 0.1 m; one or two of them are let go at 0.5 rad. "
        "Restitution 1, no friction; weight 9.81 m/s\u00b2. With gaps of 0.10, 0.13, 0.11 and 0.15 mm they strike in "
        "pairs: as many go out as come in. Touching, they are struck together."
    ),
    source=(
        "a toy of textbooks; D. Simanek, Newton's Cradle (web page), for what it is expected to do; the law of impacts "
        "struck together: J. J. Moreau, Unilateral contact and dry friction in finite freedom dynamics, CISM 302 (1988)"
    ),
    known=tuple(_known()),
    run=run,
    model=cradle,
    within=1e-9,
    remark=(
        "The discs meet a little beside the lowest point, so that what stays behind is not quite 0: some "
        "\u00b5m/s, which the second formulation has as well, elliptic functions between impacts of two. Where balls "
        "touch, energy and momentum do not decide, and Moreau's law is not the textbook's: of n balls with m in, it "
        "leaves "
        "(2m \u2212 n)/n of the speed to those that came in and 2m/n to the others, with all of the energy and the "
        "momentum. The engine's Newton, Poisson and Stronge do the same here. It counts pairs nearer than 1e-9 m as "
        "touching: gaps of 1.5e-9 m already give one in, one out. With equal gaps, pairs that meet within 1e-9 m of "
        "each other are struck in one instant; that is why these are unequal."
    ),
    drawings=drawings,
)
