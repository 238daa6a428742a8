"""Verge and foliot: the limit cycle of two inertias that strike each other twice a period, in closed form.

Crown wheel (inertia I_c, radius r_c, torque T) and foliot (I_v) are rolled out, so that arms are constant: teeth move
along x = r_c psi, the pallets' plate along y = r_v theta, and faces at 45 deg make x' = y' of the upper contact and
x' = -y' of the lower one. With m = I_c / r_c^2, M = I_v / r_v^2, F = T / r_c and S = m + M:

    free       m x'' = F, y'' = 0
    blow       x' + y' becomes -e (x' + y'), m x' - M y' stays         (lower pallet; upper one: -y)
    pushed     S x'' = F

A face ends where the plate is d from its middle: there the tooth leaves, with x' = y' = v, and after the drop g the
other pallet meets the next tooth; half the pitch is 2 d + g. One half is as the other if (e = 0)

    v^2 = F (m g + 2 S d) / (2 m M)
    t_1 = m (sqrt(4 v^2 + 2 F g / m) - 2 v) / F,   w = (m (v + F t_1 / m) - M v) / S,   t_2 = S (v - w) / F

with the period 2 (t_1 + t_2) and, where w < 0 (recoil), the amplitude d + v t_1 + w^2 S / (2 F). Impacts keep
m x' - M y', hence with restitution the period is the same, as long as the bouncing ends before the tooth leaves:
2 e V / (1 - e) < F t_2 / m for the closing speed V = 2 v + F t_1 / m.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

from scipy.optimize import brentq

from harness.report.plot import Curve, Plot
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Damper,
    LinearCopies,
    Mechanism,
    Oscillation,
    Outline,
    OutlineContact,
    Output,
    RackAndPinion,
    Revolute,
    Settings,
    Torque,
    deg,
    polynomial_motion,
    rigid_body,
)
from mechanism_fmu.simulation import Simulation

from ..case import Case, Known, Origin, Run, impacts_until, steps_of

TEETH, RADIUS, PINION = 15, 0.20, 0.10
WHEEL_INERTIA, FOLIOT_INERTIA, TORQUE = 0.04, 0.02, 0.4
PITCH = 2 * math.pi * RADIUS / TEETH
#: Of the plate from its middle to where a tooth leaves [m], and of teeth until the other pallet meets one.
LEAVES = 0.015
DROP = PITCH / 2 - 2 * LEAVES
#: First gap of the upper pallet, height of the row of tips, length of a face above them [m].
GAP, ROW, FACE, OFF = 0.006, 0.06, 0.04, 0.3


@dataclass(frozen=True)
class Clock:
    """What is varied: restitution, torque [N m], inertia of the foliot [kg m2], damping of it [N m s]."""

    restitution: float = 0.0
    torque: float = TORQUE
    foliot: float = FOLIOT_INERTIA
    damping: float = 0.0


def _rolled(clock: Clock) -> tuple[float, float, float]:
    """The masses m and M, and the force F."""
    return WHEEL_INERTIA / RADIUS**2, clock.foliot / PINION**2, clock.torque / RADIUS


def verge(clock: Clock, tolerance: float) -> Mechanism:
    """Teeth in a row between two pallets on a plate; half of each inertia is in what the pinions move."""
    wheel = rigid_body("wheel", (0, 0), mass=1.0, inertia=0.5 * WHEEL_INERTIA)
    foliot = rigid_body("foliot", (-OFF, -RADIUS), mass=1.0, inertia=0.5 * clock.foliot)
    teeth = rigid_body("teeth", (0, -RADIUS), mass=0.5 * WHEEL_INERTIA / RADIUS**2, inertia=1.0)
    plate = rigid_body("plate", (0, -RADIUS), mass=0.5 * clock.foliot / PINION**2, inertia=1.0)
    at = PINION - OFF
    joints = (
        Revolute("arbor", wheel.at(0, 0), GROUND),
        Revolute("staff", foliot.at(0, 0), GROUND.at(-OFF, -RADIUS)),
        AngleDriver("row", teeth, motion=polynomial_motion(0.0)),
        AngleDriver("guide", plate, motion=polynomial_motion(0.0)),
        RackAndPinion(
            *("rim", teeth.line((0, 0), (1, 0)), wheel.at(0, 0), teeth.at(0, 0)), radius_j=RADIUS, angle_j=-deg(90)
        ),
        RackAndPinion("mesh", plate.line((at, 0), (0, 1)), foliot.at(0, 0), plate.at(at, 0), radius_j=PINION),
    )
    tooth = Outline.chain([(-0.003, ROW - 0.05), (0, ROW), (-0.02, ROW - 0.05)])
    face = Outline.chain([(GAP - FACE, ROW + FACE), (GAP + LEAVES, ROW - LEAVES)])
    sides = {"upper": (face, tooth), "lower": (face.mirrored().moved(PITCH / 2), tooth.mirrored())}
    contacts = tuple(
        OutlineContact(
            *(name, plate, teeth),
            outline_i=pallet,
            outline_j=struck,
            copies=LinearCopies((PITCH, 0)),
            restitution=clock.restitution,
            points=1,
        )
        for name, (pallet, struck) in sides.items()
    )
    return Mechanism(
        (wheel, foliot, teeth, plate),
        joints,
        (Torque("weight", wheel, torque=clock.torque), Damper("air", foliot, damping=clock.damping)),
        contacts,
        outputs=(Output("period", "beat.period", "", "s"), Output("amplitude", "beat.amplitude", "", "rad")),
        oscillations=(Oscillation("beat", foliot),),
        settings=Settings(tolerance),
    )


class Half(NamedTuple):
    """Half a cycle: its time [s], the largest travel of the plate [m], and the speed at the end [m/s]."""

    time: float
    travel: float
    speed: float


def half_cycle(clock: Clock) -> Half:
    """Half of the limit cycle without damping, by the formulas above; its travel blow by blow where there are more."""
    m, M, F = _rolled(clock)
    S, e = m + M, clock.restitution
    v = math.sqrt(F * (m * DROP + 2 * S * LEAVES) / (2 * m * M))
    free = m * (math.sqrt(4 * v * v + 2 * F * DROP / m) - 2 * v) / F
    w = (m * v + F * free - M * v) / S
    push = S * (v - w) / F
    y, closing = LEAVES + v * free, 2 * v + F * free / m
    assert 2 * e * closing / (1 - e) < F * push / m
    rate = v - (1 + e) * closing * m / S
    while rate > 0 and closing > 0:
        y, closing = y + rate * 2 * e * closing * m / F, e * closing
        rate -= (1 + e) * closing * m / S
    return Half(free + push, y + max(rate, 0.0) ** 2 * S / (2 * F), v)


def damped_half(clock: Clock, v: float) -> Half:
    """From where a tooth leaves with v to where the next one does: damped, each phase by its exponential function."""
    m, M, F = _rolled(clock)
    S, c = m + M, clock.damping / PINION**2
    rest = F / c  # the speed at which the weight only overcomes the air

    def coasted(t: float) -> float:
        return -v * M / c * math.expm1(-c * t / M)

    free = _root(lambda t: v * t + F * t * t / (2 * m) + coasted(t) - DROP, math.sqrt(2 * m * DROP / F))
    w = (m * v + F * free - M * v * math.exp(-c * free / M)) / S
    met = LEAVES + coasted(free)

    def pushed(t: float) -> float:
        return rest * t - (w - rest) * S / c * math.expm1(-c * t / S)

    push = _root(lambda t: pushed(t) - LEAVES - met, (LEAVES + met + abs(w - rest) * S / c) / rest)
    back = pushed(S / c * math.log1p(-w / rest)) if w < 0 else 0.0
    return Half(free + push, met - back, rest + (w - rest) * math.exp(-c * push / S))


@cache
def damped_cycle(clock: Clock) -> Half:
    """The half whose speed at the end is that of its beginning."""
    return damped_half(clock, _root(lambda v: damped_half(clock, v).speed - v, half_cycle(clock).speed))


def _root(of: Callable[[float], float], most: float) -> float:
    """Between 0 and a bound that rounding may have made a little too small."""
    return float(brentq(of, 0.0, 1.01 * most, xtol=1e-16, rtol=1e-15))


def ticks(clock: Clock, count: int) -> list[tuple[float, float]]:
    """Times [s] and closing speeds [m/s] along x of the first blows from rest; none may be the end of bouncing."""
    m, M, F = _rolled(clock)
    A = F / m
    t = x = u = y = v = 0.0
    ahead = {1.0: GAP, -1.0: GAP + PITCH / 2}  # where y = 0, of the next tooth of the upper and of the lower row
    found: list[tuple[float, float]] = []
    while len(found) < count:  # between events, x is a parabola and y a straight line
        waits = {}
        for side, place in ahead.items():
            gap, rate = place + side * y - x, side * v - u
            waits[side] = (rate + math.sqrt(rate * rate + 2 * A * max(gap, 0.0))) / A
        side = min(waits, key=waits.__getitem__)
        wait = waits[side]
        t, x, u, y = t + wait, x + u * wait + A * wait * wait / 2, u + A * wait, y + v * wait
        if side * y > LEAVES:  # the tooth goes by
            ahead[side] += PITCH
            continue
        closing = u - side * v
        found.append((t, closing))
        impulse = (1 + clock.restitution) * closing * m * M / (m + M)
        u, v = u - impulse / m, v + side * impulse / M
    return found


#: Clocks whose limit cycles are compared; the factor of the torque is one for which the exponent is looked at, too.
CYCLES = {
    "e = 0": Clock(),
    "e = 0.3": Clock(restitution=0.3),
    "torque x 4": Clock(torque=4 * TORQUE),
    "foliot x 2": Clock(foliot=2 * FOLIOT_INERTIA),
    "damped": Clock(damping=0.02),
}
#: Until the cycle is reached [s].
SETTLED = 30.0
BOUNCING, COUNTED = Clock(restitution=0.6), (6, 12, 18)


def settled(clock: Clock, tolerance: float, until: float = SETTLED) -> tuple[float, float, int]:
    """Period [s], amplitude [rad], and steps."""
    simulation = Simulation(verge(clock, tolerance))
    simulation.advance(until)
    shown = simulation.read()
    return shown["period"], shown["amplitude"], steps_of(simulation)


def run(tolerance: float) -> Run:
    """Limit cycles, the exponent of the torque, and blows of the clock that bounces."""
    values: list[float] = []
    steps = 0
    for clock in CYCLES.values():
        *found, taken = settled(clock, tolerance)
        values += found
        steps += taken
    values.append(math.log(values[4] / values[0]) / math.log(4))
    simulation = Simulation(verge(BOUNCING, tolerance))
    blows = impacts_until(simulation, [0.05 * k for k in range(1, 40)])
    for number in COUNTED:
        values += [blows[number - 1].time, math.sqrt(2) * blows[number - 1].closing_speed]
    return Run(tuple(values), steps + steps_of(simulation))


def _known() -> Iterator[Known]:
    for name, clock in CYCLES.items():
        half = damped_cycle(clock) if clock.damping else half_cycle(clock)
        origin: Origin = "second formulation" if clock.damping else "closed form"
        yield Known(f"{name}: period", "s", 2 * half.time, origin)
        yield Known(f"{name}: amplitude", "rad", half.travel / PINION, origin)
    yield Known("exponent of the period, torque x 4", "1", -0.5, "closed form")
    blows = ticks(BOUNCING, COUNTED[-1])
    for number in COUNTED:
        time, closing = blows[number - 1]
        yield Known(f"e = 0.6: time of blow {number}", "s", time, "second formulation")
        yield Known(f"e = 0.6: closing speed of blow {number}", "m/s", closing, "second formulation")


def drawings() -> Sequence[Plot]:
    """Period over torque, with and without air: formulas as lines, the engine as dots."""
    lines, dots = [k / 8 for k in range(-16, 13)], [k / 2 for k in range(-4, 4)]
    curves = []
    for name, damping, colour in (("in vacuo", 0.0, "#1f6feb"), ("with air", 0.4, "#d1242f")):
        clocks = {k: Clock(torque=TORQUE * 10**k, damping=damping) for k in (*lines, *dots)}
        halves = {k: damped_cycle(clock) if damping else half_cycle(clock) for k, clock in clocks.items()}
        curves.append(Curve(name, lines, [math.log10(2 * halves[k].time) for k in lines], colour))
        periods = [settled(clocks[k], 1e-9, 60 * halves[k].time)[0] for k in dots]
        curves.append(Curve(f"{name}, engine", dots, [math.log10(period) for period in periods], colour, dots=True))
    title = "Period over torque"
    return [Plot(title, f"log10 of torque over {TORQUE:g} N m", "log10 of period [s]", curves)]


CASE = Case(
    name="verge_foliot",
    title="Verge and foliot",
    statement=(
        "A crown wheel of 15 teeth driven by a constant torque of 0.4 N m, and a foliot, without spring or pendulum: "
        "0.04 and "
        "0.02 kg m\u00b2, arms of 0.2 and 0.1 m. Teeth strike an upper and a lower pallet in turn, with restitution "
        "0, 0.3 or 0.6, push it, and leave it 0.15 rad from the middle. Arms are constant, so that motion between "
        "blows is that of constant forces."
    ),
    source=(
        "A. V. Roup, D. S. Bernstein, S. G. Nersesov, W. M. Haddad, V. Chellaboina, Limit cycle analysis of the verge "
        "and foliot clock escapement using impulsive differential equations and Poincar\u00e9 maps, International "
        "Journal of Control 76 (2003) 1685\u20131698; data of this project"
    ),
    known=tuple(_known()),
    run=run,
    model=verge,
    within=5e-9,
    remark=(
        "The paper says that period and amplitude follow from the inertias and the restitution; it could not be opened "
        "beyond its abstract, so that the formulas are derived anew in the case's file, and its digits are not among "
        "these. Restitution leaves the period as it is, to the last digit, where bouncing ends before the tooth "
        "leaves. With four times the torque all goes twice as fast by the same angles. With air, the period goes "
        "with the torque to the power of \u22121 at small torques, as in P. Hoyng and A. C. T. Nieuwenhuizen, "
        "Dynamics of the verge and foliot clock escapement, arXiv:1604.06681, whose abstract has this exponent; "
        "their other one, \u22121/3 at large torques, is that of a torque that changes its sign at two angles, "
        "without wheel and blows, and here it is \u22121/2.\n\n"
        "What is left at tight tolerances is no error of integration: the engine goes from a face to its corner, and "
        "leaves that, by margins of up to 1e-10 of the mechanism's length. Blows of the clock that bounces, none of "
        "which is near the end of a face, are exact to the last digits."
    ),
    drawings=drawings,
)
