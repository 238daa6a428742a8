"""Cam and follower: a valve train whose follower leaves its cam, and bounces on it.

Radius h of a cam of circular arcs over the angle b: base circle, flank, nose, dwell, and back again. A point follower
of mass m above its centre, pressed on by a spring k that is free at h0; the cam turns at w, b = pi/2 + w t. In flight

    m u'' + k u = 0,  u = y - h0 > h(b) - h0,                                                              (1)

and where it strikes, u'+ = (1 + e) w h' - e u'- (di Bernardo, Osorio and Santini in the example of Siconos). In contact
the cam pushes with N = k (h - h0) + m w^2 h'' along y. Where flank and nose meet, h'' falls from 0.34 to -1.87 m, so
that the follower leaves the cam just there from the speed on at which N is zero behind it,

    w^2 = k (h - h0) / (m |h''|).                                                                          (2)

At 720 turns a minute it settles to one impact a turn: with W^2 = k / m and the time T of a turn, by symmetry of (1),

    w h' (1 + e) / (1 - e) = (h - h0) W tan(W T / 2).                                                      (3)
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
from scipy.optimize import brentq

from harness.report.plot import Curve, Plot
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Mechanism,
    Outline,
    OutlineContact,
    Output,
    Revolute,
    Settings,
    SpringDamper,
    Translational,
    polynomial_motion,
)
from mechanism_fmu.simulation import Simulation, simulate

from ..case import Case, Known, Run, steps_of

MASS, STIFFNESS, FREE, RESTITUTION = 1.221, 1430.8, 0.3, 0.8
#: Base circle, flank and nose: radii [m], distance of the flank's centre from that of the cam; where the dwell begins.
BASE, FLANK, NOSE, OFFSET, DWELL = 0.40, 0.85, 0.15, 0.45, math.radians(160.0)
#: The nose's circle touches that of the flank inside: its centre is as far from the flank's as their radii differ.
_DOWN = OFFSET * math.sin(DWELL)
REACH = math.sqrt(_DOWN**2 + (FLANK - NOSE) ** 2 - OFFSET**2) - _DOWN
TOP = REACH + NOSE
_LEAN = math.atan2(REACH * math.sin(DWELL) + OFFSET, REACH * math.cos(DWELL))  # from centre to centre
CORNER = math.atan2(FLANK * math.sin(_LEAN) - OFFSET, FLANK * math.cos(_LEAN))  # flank to nose
PER_MINUTE = math.pi / 30.0
_ROOT = math.sqrt(STIFFNESS / MASS)


def cam(speed: float, tolerance: float, angle: float = math.pi / 2) -> Mechanism:
    """The cam turns clockwise at a speed [1/min], its angle under the follower at first; the follower is in contact."""
    up, out = (
        (FLANK * math.cos(_LEAN), FLANK * math.sin(_LEAN) - OFFSET),
        (TOP * math.cos(DWELL), TOP * math.sin(DWELL)),
    )
    bulges = [math.tan(sweep / 4) for sweep in (math.pi, _LEAN - math.pi / 2, DWELL - _LEAN, 2 * (math.pi - DWELL))]
    base, flank, nose, dwell = bulges
    shape = ((0.0, -BASE, base), (0.0, BASE, flank), (*up, nose), (*out, dwell), (out[0], -out[1], nose))
    profile = Outline((*shape, (up[0], -up[1], flank)))
    tip = Outline.polygon([(0.0, 0.0), (0.01, 0.1), (-0.01, 0.1)])
    rate, (height, slope, _) = speed * PER_MINUTE, lift(angle)
    wheel = Body("cam", 1.0, 1.0, (0.0, 0.0, math.pi / 2 - angle), start_rate=(0.0, 0.0, -rate))
    follower = Body("follower", MASS, 1.0, (0.0, height, 0.0), start_rate=(0.0, rate * slope, 0.0))
    joints = (
        Revolute("shaft", wheel.at(0, 0), GROUND),
        AngleDriver("drive", wheel, motion=polynomial_motion(math.pi / 2 - angle, -rate)),
        Translational("guide", follower.line((0, 0), (0, 1)), GROUND.line((0, 0), (0, 1))),
    )
    spring = SpringDamper("spring", GROUND.at(0, 10), follower, stiffness=STIFFNESS, free_length=10 - FREE)
    touch = OutlineContact(
        "touch", follower, wheel, outline_i=tip, outline_j=profile, restitution=RESTITUTION, points=1
    )
    shown = (Output("force", "touch.force", "N"),)
    return Mechanism((wheel, follower), joints, (spring,), (touch,), outputs=shown, settings=Settings(tolerance))


def _eccentric(distance: float, radius: float, angle: float) -> tuple[float, float, float]:
    """Radius of a circle seen from a point in it, over the angle from the line of both centres; two derivatives."""
    s, c = math.sin(angle), math.cos(angle)
    chord = math.sqrt(radius**2 - (distance * s) ** 2)
    bent = distance * c + (distance**2 * (c * c - s * s) + (distance**2 * s * c / chord) ** 2) / chord
    return distance * c + chord, -distance * s - distance**2 * s * c / chord, -bent


def lift(angle: float) -> tuple[float, float, float]:
    """Radius h of the cam [m] over its angle [rad], and two derivatives."""
    turned = angle % math.tau
    b = min(turned, math.tau - turned)
    if b <= math.pi / 2:
        return BASE, 0.0, 0.0
    if b >= DWELL:
        return TOP, 0.0, 0.0
    h, slope, bend = _eccentric(OFFSET, FLANK, b + math.pi / 2) if b <= CORNER else _eccentric(REACH, NOSE, b - DWELL)
    return h, math.copysign(slope, math.pi - turned) if slope > 0 else slope, bend


def _leaves(time: float, rate: float) -> float:
    """When the follower next leaves the cam after a time [s].

    Behind both corners that a turning cam comes to on the outside of its nose, its force would jump below zero: at
    flank and nose from the speed of eq (2) on, at dwell and nose from 134.9 turns a minute on, below which the
    follower would leave on the nose's way down. So no lower speeds.
    """
    corners = [corner - math.pi / 2 for corner in (CORNER, math.tau - DWELL)]
    turn = math.floor(rate * time / math.tau)
    return min(at for k in (turn, turn + 1) for corner in corners if (at := (corner + k * math.tau) / rate) > time)


def flights(speed: float, count: int) -> list[tuple[float, float]]:
    """Times [s] and closing speeds along the normal [m/s] of so many impacts, by eq (1).

    A flight is a sine; its end is the first root of the gap, from below: by a bound of the gap's second derivative, no
    root comes before the one of a parabola, from where it is tried again. What strikes at less than 1e-6 m/s stays.
    """
    rate = speed * PER_MINUTE
    most_bent = max(abs(lift(angle)[2]) for angle in (CORNER + 1e-12, DWELL - 1e-12))
    time = _leaves(0.0, rate)
    h, slope, _ = lift(math.pi / 2 + rate * time)
    u, v, found = h - FREE, rate * slope, list[tuple[float, float]]()
    while len(found) < count:
        a, b = u, v / _ROOT
        bound = _ROOT**2 * math.hypot(a, b) + rate**2 * most_bent
        # in the instant in which it leaves, gap and speed are zero: a little later they are not
        gap, opening, s = 0.0, v - rate * slope, 0.0
        step = max(2 * opening / bound, 1e-5 * math.tau / rate if opening < 1e-9 else 0.0)
        while step > 1e-15 * time and not (s and gap < 1e-16 and opening < 0):
            s += step
            c, d = math.cos(_ROOT * s), math.sin(_ROOT * s)
            h, slope, _ = lift(math.pi / 2 + rate * (time + s))
            u, v = a * c + b * d, _ROOT * (b * c - a * d)
            gap, opening = max(u - h + FREE, 0.0), v - rate * slope
            step = (opening + math.sqrt(opening**2 + 2 * bound * gap)) / bound
        time += s
        found.append((time, -opening * h / math.hypot(h, slope)))
        v = rate * slope - RESTITUTION * opening
        if opening > -1e-6:
            time = _leaves(time, rate)
            h, slope, _ = lift(math.pi / 2 + rate * time)
            u, v = h - FREE, rate * slope
    return found


#: Speeds [1/min], and the impacts of each that are looked at. At 141 and 358 hops die away, on the dwell and across the
#: joints of arcs.
WATCHED = {141: (1, 8, 20), 358: (1, 2, 3, 6, 12, 20), 660: (1, 4, 8, 12)}
PERIODIC, TURNS = 720, 150


def _detached(tolerance: float) -> tuple[float, int]:
    """The speed [1/min] at which the cam does not push any more just behind the corner; and steps.

    Its force is linear in the square of the speed, so that two runs in contact tell where it vanishes.
    """
    forces, speeds, steps = [], (60.0, 100.0), 0
    for speed in speeds:
        simulation = Simulation(cam(speed, tolerance, CORNER - 0.2))
        behind = []
        for angle in (1e-9, 2e-9):
            simulation.advance((0.2 + angle) / (speed * PER_MINUTE))
            behind.append(simulation.read()["force"])
        forces.append(2 * behind[0] - behind[1])
        steps += steps_of(simulation)
    (slow, fast), (x, y) = forces, (speed**2 for speed in speeds)
    return math.sqrt((slow * y - fast * x) / (slow - fast)), steps


def run(tolerance: float) -> Run:
    """Speed of detachment, impacts at two speeds, and what the motion at a third one settles to."""
    detached, steps = _detached(tolerance)
    values = [detached]
    for speed, chosen in WATCHED.items():
        result = simulate(cam(speed, tolerance), _stop(speed, chosen[-1]), step=0.1)
        steps += result.statistics.accepted_steps
        values += [value for k in chosen for value in (result.impacts[k - 1].time, result.impacts[k - 1].closing_speed)]
    result = simulate(cam(PERIODIC, tolerance), TURNS * 60.0 / PERIODIC, step=1.0)
    last = result.impacts[-1]
    values += [(math.pi / 2 + last.time * PERIODIC * PER_MINUTE) % math.tau, last.closing_speed]
    return Run(tuple(values), steps + result.statistics.accepted_steps)


def _stop(speed: float, count: int) -> float:
    return flights(speed, count)[-1][0] + 1e-4


def _known() -> Iterator[Known]:
    h, _, bend = lift(CORNER + 1e-12)
    detached = math.sqrt(STIFFNESS * (h - FREE) / (MASS * -bend)) / PER_MINUTE
    yield Known("speed at which the follower leaves the cam", "1/min", detached, "closed form")
    for speed, chosen in WATCHED.items():
        found = flights(speed, chosen[-1])
        for k in chosen:
            yield Known(f"{speed}/min: time of impact {k}", "s", found[k - 1][0], "second formulation")
            yield Known(f"{speed}/min: closing speed of impact {k}", "m/s", found[k - 1][1], "second formulation")
    rate = PERIODIC * PER_MINUTE
    share, swing = (1 - RESTITUTION) / (1 + RESTITUTION), _ROOT * math.tan(_ROOT * math.pi / rate)

    def off(angle: float) -> float:
        h, slope, _ = lift(angle)
        return rate * slope - share * (h - FREE) * swing

    angle = float(brentq(off, CORNER + 1e-9, DWELL, xtol=1e-14, rtol=1e-14))
    h, slope, _ = lift(angle)
    yield Known(f"{PERIODIC}/min: angle of the cam at its one impact a turn", "rad", angle, "one coordinate")
    closing = ((h - FREE) * swing + rate * slope) * h / math.hypot(h, slope)
    yield Known(f"{PERIODIC}/min: its closing speed", "m/s", closing, "one coordinate")


def drawings() -> Sequence[Plot]:
    """Angles of the cam at impacts over its speed: one a turn and chaos, and hops that die away at low speeds."""
    plots = []
    for title, speeds, first, last, slowest in (
        ("One impact a turn, and chaos", np.linspace(690, 780, 91), 134, 150, 0.0),
        ("Chattering: impacts above 20 mm/s", np.linspace(115, 400, 115), 7, 8, 0.02),
    ):
        x, y = [], []
        for speed in speeds:
            turn = 60.0 / speed
            for impact in simulate(cam(speed, 1e-7), last * turn, step=turn).impacts:
                if impact.time > first * turn and impact.closing_speed > slowest:
                    x.append(speed)
                    y.append((90.0 + 360.0 * impact.time / turn) % 360.0)
        dots = Curve("impacts", x, y, "#1f6feb", line=False, dots=True)
        plots.append(Plot(title, "speed of the cam [1/min]", "angle of the cam [deg]", [dots], legend=False))
    return plots


CASE = Case(
    name="cam_follower",
    title="Cam and follower with bouncing",
    statement=(
        "A point follower of 1.221 kg on a cam of circular arcs (base 0.4 m, flank 0.85 m, nose 0.15 m, dwell at "
        "0.554 m), pressed on by 1430.8 N/m, free at 0.3 m; restitution 0.8, no weight. Where flank and nose meet the "
        "curvature jumps, and above some speed the follower leaves the cam there; the impacts that follow die away, "
        "repeat themselves, or never do, as the speed of the cam will."
    ),
    source=(
        "M. di Bernardo, G. Osorio, S. Santini, CamFollower, an example of Siconos (2006); data of its CamState.h. "
        "Such systems: Corner-Impact Bifurcations: a novel class of discontinuity-induced bifurcations in "
        "Cam-Follower Systems, arXiv:0711.1008"
    ),
    known=tuple(_known()),
    run=run,
    model=cam,
    within=1e-9,
    remark=(
        "Between impacts the follower swings freely, so that the second formulation is a sine and the first root of "
        "its gap to the cam. The cam of the example is kept as it is computed there; its curves were not printed as "
        "digits, and the paper was not opened beyond its introduction. At 358 the fourth to fourteenth impact are hops "
        "that die away on the dwell, and later ones go across the joint of two arcs. At 739.4 the motion with one "
        "impact a turn is no longer stable, and impacts spread at once as far as the end of the nose at 160 deg."
    ),
    drawings=drawings,
)
