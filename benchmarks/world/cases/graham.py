"""Graham's dead-beat escapement: ticks and limit cycles, beside a second formulation in two coordinates.

psi is the angle of the wheel (inertia J, torque T), theta that of the pendulum (mass m, its centre c below the arbor,
inertia I about the arbor, damping d). A tooth's centre, seen from the arbor in the frame of the anchor, is
P(psi, theta), and its distance from the arbor depends on psi alone. So, between pushes,

    I theta'' = -m g c sin(theta) - d theta'                                             (1)

whatever the wheel does: it falls by J psi'' = T to where the distance of its next tooth is that of the dead arc, and
stands there. A push goes around the corner of the dead arc, along the impulse face, around its other corner:

    J psi'' = T + p s_psi,   I theta'' = (1) + p s_theta,   s = |P - corner| - rho or n.(P - corner) - rho = 0   (2)

till p is zero. At a turning point a tooth rests: the angle theta there is all there is to know, and the limit cycle
is a zero of one equation.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import newton

import models
from harness.report.plot import Curve, Plot
from mechanism_fmu.simulation import Simulation
from models.graham.model import ARBOR, ARM, ASIDE, FREE, RADIUS, SPAN, TEETH

from ..case import Case, Known, Run, impacts_until, steps_of

MODEL = models.load("graham").MODEL
TORQUE: float = MODEL.inputs[0].start
PITCH = math.tau / TEETH
_EXACT = {"rtol": 3e-14, "atol": 1e-15, "max_step": 0.02}


@dataclass(frozen=True)
class Pallet:
    """In the frame of the anchor, as complex numbers [m].

    Attributes:
        begins, ends: corners at which a push begins and ends.
        along: direction of the impulse face between them [1].
        place: angle of a tooth that rests on the dead arc [rad], as psi is counted.
        sense: +1, where a push turns the anchor to larger angles, else -1.
    """

    begins: complex
    ends: complex
    along: complex
    place: float
    sense: int


def pallets(thickness: float, lift: float, lock: float, tip: float) -> tuple[Pallet, Pallet]:
    """The entry and the exit pallet: thickness and radius of the teeth's tips [m], lift and lock [rad]."""
    met, left = 0.5 * (lift - lock), 0.5 * (lift + lock)
    found = []
    for side in (1, -1):  # right of the line of centres, where teeth come from outside, and left of it
        start, stop = ARM + side * 0.5 * thickness, ARM - side * 0.5 * thickness
        middle = 1.5 * math.pi + side * ASIDE
        begins, ends = cmath.rect(start, middle + side * met), cmath.rect(stop, middle - side * left)
        along = (ends - begins) / abs(ends - begins)
        rests = start + side * tip
        place = math.acos((RADIUS**2 + ARBOR[1] ** 2 - rests**2) / (2 * RADIUS * ARBOR[1]))
        found.append(Pallet(begins, ends, along, 0.5 * math.pi - side * place, side))
    return found[0], found[1]


class Clock:
    """The second formulation.

    Attributes:
        ticks: times [s] and closing speeds [m/s].
        turns: times [s] and angles [rad] at which the pendulum turns back.
        passages: times [s] at which it passes the middle upwards.
    """

    def __init__(self, torque: float, **values: float) -> None:
        """As the model starts: the wheel at rest before the entry pallet, the pendulum at rest at an angle.

        Args:
            torque: of the weight [N m].
            values: of the model's parameters.
        """
        at = MODEL.values(**values)
        self.torque, self.inertia = torque, at.wheel_inertia
        self.moved = at.pendulum_inertia + at.pendulum_mass * at.pendulum_length**2
        self.damping, self.weight = at.pendulum_damping, at.pendulum_mass * at.gravity * at.pendulum_length
        self.pallets = pallets(at.pallet_thickness, at.lift_angle, at.lock_angle, at.tip_radius)
        self.time, self.state = 0.0, np.array([at.pendulum_angle_start, 0.0])
        self.psi = 0.5 * math.pi - SPAN - (0.5 * at.pallet_thickness + at.tip_radius + FREE) / RADIUS
        self.speed = 0.0
        self.ticks: list[tuple[float, float]] = []
        self.turns: list[tuple[float, float]] = []
        self.passages: list[float] = []

    def go(self, swings: int) -> Clock:
        """So many half swings, from the entry pallet on; the clock itself."""
        for k in range(swings):
            self._swing(self.pallets[k % 2])
        return self

    def _swing(self, pallet: Pallet) -> None:
        """From where the wheel is free to where it is so again: drop, rest, and push."""
        way = (pallet.place - self.psi) % PITCH
        pull = self.torque / self.inertia
        wait = (math.sqrt(self.speed**2 + 2 * pull * way) - self.speed) / pull
        self.psi += way
        seen = cmath.rect(RADIUS, pallet.place) - 1j * ARBOR[1]
        closing = (self.speed + pull * wait) * abs((seen.conjugate() * (seen + 1j * ARBOR[1]) * 1j).real) / abs(seen)
        self.ticks.append((self.time + wait, closing))
        begins = (cmath.phase(seen) - cmath.phase(pallet.begins) + math.pi) % math.tau - math.pi
        self._move(self._free, (lambda y: y[0] - begins, pallet.sense))
        assert self.time > self.ticks[-1][0]
        self.state = np.array([pallet.place, self.state[0], 0.0, self.state[1]])

        def beyond(corner: complex) -> Any:
            return lambda y: (pallet.along.conjugate() * (self._seen(y) - corner)).real

        normal = -1j * pallet.along
        self._move(lambda y: self._pushed(y, pallet.begins, normal), (beyond(pallet.begins), 1))
        self._move(lambda y: self._pushed(y, None, normal), (beyond(pallet.ends), 1))
        self._move(
            lambda y: self._pushed(y, pallet.ends, normal), (lambda y: self._push(y, pallet.ends, normal)[0], -1)
        )
        self.psi += self.state[0] - pallet.place
        self.speed, self.state = self.state[2], self.state[[1, 3]]

    def _free(self, y: Any) -> list[float]:
        return [y[1], -(self.weight * math.sin(y[0]) + self.damping * y[1]) / self.moved]

    @staticmethod
    def _seen(y: Any) -> complex:
        """P: a tooth's centre, from the arbor, in the frame of the anchor."""
        return (cmath.rect(RADIUS, y[0]) - 1j * ARBOR[1]) * cmath.exp(-1j * y[1])

    def _push(self, y: Any, corner: complex | None, normal: complex) -> tuple[float, float, float, float]:
        """p, s_psi, s_theta, and the acceleration of the pendulum without p, of (2)."""
        psi, theta, u, v = y
        tooth, p = cmath.rect(RADIUS, psi) * cmath.exp(-1j * theta), self._seen(y)
        rates = 1j * tooth, -1j * p
        moved = rates[0] * u + rates[1] * v
        bent = -tooth * u * u + 2 * tooth * u * v - p * v * v
        n = normal if corner is None else (p - corner) / abs(p - corner)
        by_psi, by_theta = ((n.conjugate() * rate).real for rate in rates)
        curved = (n.conjugate() * bent).real
        if corner is not None:
            curved += (n.conjugate() * moved).imag ** 2 / abs(p - corner)
        _, free = self._free((theta, v))
        lack = curved + by_psi * self.torque / self.inertia + by_theta * free
        return -lack / (by_psi**2 / self.inertia + by_theta**2 / self.moved), by_psi, by_theta, free

    def _pushed(self, y: Any, corner: complex | None, normal: complex) -> list[float]:
        push, by_psi, by_theta, free = self._push(y, corner, normal)
        return [y[2], y[3], (self.torque + push * by_psi) / self.inertia, free + push * by_theta / self.moved]

    def _move(self, rates: Any, end: tuple[Any, int]) -> None:
        """Go on till a function of the state passes zero, upwards (1) or downwards (-1)."""
        place = len(self.state) // 2 - 1

        def ends(_: float, y: Any) -> float:
            return float(end[0](y))

        def turns(_: float, y: Any) -> float:
            return float(y[2 * place + 1])

        def passes(_: float, y: Any) -> float:
            return float(y[place])

        ends.terminal, ends.direction, passes.direction = True, end[1], 1  # type: ignore[attr-defined]
        found = solve_ivp(
            lambda _, y: rates(y),
            (self.time, self.time + 9.0),
            self.state,
            "DOP853",
            events=(ends, turns, passes),
            **_EXACT,
        )
        self.turns += [(float(t), float(y[place])) for t, y in zip(found.t_events[1], found.y_events[1], strict=True)]
        self.passages += map(float, found.t_events[2])
        self.time, self.state = float(found.t[-1]), found.y[:, -1]


def cycle(factor: float, angle: float) -> tuple[float, float, float]:
    """Of the limit cycle: angle of its turning point [rad], period [s], amplitude [rad].

    Args:
        factor: of the model's torque.
        angle: a guess of the first [rad].
    """

    def started(theta: float) -> Clock:
        return Clock(factor * TORQUE, pendulum_angle_start=theta).go(3)

    # turning points are the start, the one opposite, and the next on this side
    theta = float(newton(lambda theta: started(theta).turns[2][1] - theta, angle, x1=1.01 * angle, tol=1e-13))
    found = started(theta)
    return theta, found.passages[1] - found.passages[0], 0.5 * (found.turns[1][1] - found.turns[2][1])


#: What `Clock(TORQUE).go(6).ticks` gives.
TICKS = (
    (0.00470692954722992, 0.08462374885619124),
    (0.6673129213293808, 0.12081760908381235),
    (1.6646524859453355, 0.12148260476216866),
    (2.6672862497408856, 0.12082054083064338),
    (3.6646286756247775, 0.12148548792412701),
    (4.667262690580558, 0.12082318371766376),
)
#: What `cycle` gives, by the factor of the torque.
CYCLES = {
    0.5: (-0.04718876030405173, 2.0016410442952193, 0.04718911564900194),
    1.0: (-0.06660996845044842, 2.000004705401094, 0.06661052437300569),
    2.0: (-0.09411631347457035, 1.999429951273814, 0.09411715291333039),
    4.0: (-0.1330528834990666, 1.9997986759324249, 0.1330541224567661),
}
COUNTED = (2, 4, 6)
#: A tooth rests on the exit pallet, and the next one on the entry pallet: between these times at least [s].
RESTS = ((0.7, 1.4), (1.7, 2.4))


def started(tolerance: float, factor: float = 1.0, **values: float) -> Simulation:
    """The model at the start, with a factor of its torque."""
    simulation = Simulation(MODEL.build(MODEL.values(relative_tolerance=tolerance, **values)))
    simulation.set_input("drive_torque", factor * TORQUE)
    return simulation


def in_cycle(tolerance: float, factor: float, angle: float) -> tuple[dict[str, float], int]:
    """What the model shows in the third period after a turning point [rad], and its steps."""
    simulation = started(tolerance, factor, pendulum_angle_start=angle)
    simulation.advance(7.0)
    return simulation.read(), steps_of(simulation)


def run(tolerance: float) -> Run:
    """Ticks of the default start, how the wheel stands between them, and the cycles at several torques."""
    simulation = started(tolerance)
    angles: list[list[float]] = []
    blows = impacts_until(simulation, [0.5])
    for begin, end in RESTS:
        times = np.linspace(begin, end, 15).tolist()
        angles.append([])
        for time in times:
            blows += impacts_until(simulation, [time])
            angles[-1].append(simulation.read()["wheel_angle"])
    blows += impacts_until(simulation, [3.0, 4.0, 5.0])
    values = [value for number in COUNTED for value in (blows[number - 1].time, blows[number - 1].closing_speed)]
    values += [max(map(np.ptp, angles)), angles[1][0] - angles[0][0]]
    steps = steps_of(simulation)
    for factor, (angle, _, _) in CYCLES.items():
        shown, taken = in_cycle(tolerance, factor, angle)
        values += [shown["period"], shown["amplitude"], shown["power"] * shown["period"] / (factor * TORQUE)]
        steps += taken
    return Run(tuple(map(float, values)), steps)


def _known() -> Iterator[Known]:
    for number in COUNTED:
        time, closing = TICKS[number - 1]
        yield Known(f"time of tick {number}", "s", time, "second formulation")
        yield Known(f"closing speed of tick {number}", "m/s", closing, "second formulation")
    at = MODEL.values()
    entry, exit_ = pallets(at.pallet_thickness, at.lift_angle, at.lock_angle, at.tip_radius)
    yield Known("motion of the wheel while a tooth rests", "rad", 0.0, "closed form")
    yield Known("turn of the wheel from rest to rest", "rad", (entry.place - exit_.place) % PITCH, "closed form")
    for factor, (_, period, amplitude) in CYCLES.items():
        yield Known(f"torque x {factor:g}: period", "s", period, "second formulation")
        yield Known(f"torque x {factor:g}: amplitude", "rad", amplitude, "second formulation")
        yield Known(f"torque x {factor:g}: work of a period over the torque", "rad", PITCH, "closed form")


def drawings() -> Sequence[Plot]:
    """What moves, and the rate over the amplitude."""
    simulation = started(1e-9)
    times, shown = np.linspace(0.0, 6.0, 481), []
    for time in times.tolist():
        simulation.advance(time)
        shown.append(simulation.read())
    wheel = [(row["wheel_angle"] - shown[0]["wheel_angle"]) / PITCH for row in shown]
    swung = [math.degrees(row["pendulum_angle"]) for row in shown]
    motion = [Curve("wheel [teeth]", times, wheel, "#1f6feb"), Curve("pendulum [deg]", times, swung, "#d1242f")]
    small = Clock(TORQUE)
    least = math.tau / math.sqrt(small.weight / small.moved - (small.damping / small.moved / 2) ** 2)
    factors = [2 ** (k / 2) for k in range(-3, 5)]
    found = [cycle(factor, CYCLES[1.0][0] * math.sqrt(factor)) for factor in factors]
    rates = [86400 * (least / period - 1) for _, period, _ in found]
    periods = [in_cycle(1e-9, factor, angle)[0]["period"] for factor, (angle, _, _) in zip(factors, found, strict=True)]
    degrees = [math.degrees(amplitude) for _, _, amplitude in found]
    circular = [86400 * (1 / (1 + amplitude**2 / 16) - 1) for _, _, amplitude in found]
    curves = [
        Curve("circular error", degrees, circular, "#d1242f"),
        Curve("scipy", degrees, rates, "#1f6feb"),
        Curve("engine", degrees, [86400 * (least / period - 1) for period in periods], "#1f6feb", dots=True),
    ]
    return [
        Plot("Rest and push", "time [s]", "", motion),
        Plot("Rate", "amplitude [deg]", "gain on small free swings [s a day]", curves),
    ]


CASE = Case(
    name="graham",
    title="Graham's dead-beat escapement",
    statement=(
        "An escape wheel of 30 teeth, 12 N mm, an anchor whose dead arcs lie about its arbor, and a pendulum of two "
        "seconds, damped by 0.05 N m s. A tooth drops onto an arc without restitution, rests there while the pendulum "
        "swings on, and pushes it by 2\u00b0 along a slanting face on its way back."
    ),
    source=(
        "G. Graham, about 1715; G. B. Airy, On the disturbances of pendulums and balances, and on the theory of "
        "escapements, Transactions of the Cambridge Philosophical Society 3 (1830) 105\u2013128; data of this project"
    ),
    known=tuple(_known()),
    run=run,
    model=models.available()["graham"] / "model.py",
    within=1e-11,
    remark=(
        "No published digits of such a clock are known to us. The second formulation knows that the pendulum moves by "
        "itself but during a push, and the wheel by itself during a drop; a push is integrated by scipy with the force "
        "as multiplier, and the cycle is found by the secant method for the angle of a turning point. There the known "
        "cycle starts, and the engine is asked for the third period. At rest the wheel does not recoil: "
        "arcs about the arbor have no arm. In the cycle one tooth passes each period, whose work is torque times "
        "pitch, whatever the ticks take of it. The clock loses on small free swings by the circular error, "
        "1 + amplitude\u00b2 / 16, and by its pushes, which are longer behind the middle than before it; this falls "
        "with the amplitude, so that there is one at which the rate does not depend on the torque.\n\n"
        "Idealised are rigid parts, round tips, ticks without restitution, a constant torque, air with a torque in "
        "proportion to the speed, and dead arcs and pivots without friction."
    ),
    drawings=drawings,
)
