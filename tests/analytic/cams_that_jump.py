"""Cams whose spring-loaded follower jumps, with their motion by formulas of their own: in flight a harmonic motion."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import brentq

from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Body,
    Curve,
    Mechanism,
    Move,
    Output,
    Piece,
    PointFollower,
    PointForce,
    Revolute,
    Settings,
    SpringDamper,
    Term,
    Translational,
    cycloidal,
    dwell,
    harmonic_profile,
    modified_sine,
    motion_profile,
    polynomial_345,
    polynomial_motion,
    spline_profile,
)
from mechanism_fmu.simulation import Simulation

#: Base radius [m], and the turn [rad].
BASE, TURN = 0.025, 2.0 * math.pi
_SAMPLES = 200


def _single(time: float, what: Any) -> float:
    return float(what(time).item())


class Cam(NamedTuple):
    """A cam that turns clockwise past its follower, and what presses that on it.

    `omega` [rad/s], mass [kg], stiffness [N/m], preload of the spring [m], a constant force [N].
    """

    profile: Curve
    omega: float
    mass: float = 0.2
    stiffness: float = 5000.0
    preload: float = 0.005
    weight: float = 0.0

    def lift(self, alpha: Any) -> Any:
        """Radius and its first two derivatives at contact coordinates; shape (3, ...)."""
        pieces = self.profile.pieces
        x = np.atleast_1d(np.mod(alpha, TURN))
        index = np.searchsorted([piece.start for piece in pieces], x, side="right") - 1
        total = np.zeros((3, *x.shape))
        for k in np.unique(index):
            here = index == k
            xi = x[here] - pieces[k].start
            for term in pieces[k].terms:
                polynomial = np.polynomial.Polynomial(term.polynomial or (0.0,))
                angle, w = term.frequency * xi + term.phase, term.frequency
                total[0, here] += polynomial(xi) + term.amplitude * np.sin(angle)
                total[1, here] += polynomial.deriv()(xi) + term.amplitude * w * np.cos(angle)
                total[2, here] += polynomial.deriv(2)(xi) - term.amplitude * w * w * np.sin(angle)
        return total

    def force(self, time: Any) -> Any:
        """Contact force of a follower on the cam [N]."""
        radius, _, bend = self.lift(-self.omega * np.asarray(time))
        return self.mass * bend * self.omega**2 + self.stiffness * (radius - BASE + self.preload) + self.weight

    def mechanism(self, tolerance: float) -> Mechanism:
        cam = Body("cam", 1.0, 1.0, (0.0, 0.0, math.pi / 2), (0.0, 0.0, self.omega))
        radius, slope, _ = self.lift(0.0)[:, 0]
        follower = Body("follower", self.mass, 1e-4, (0.0, radius, 0.0), (0.0, -self.omega * slope, 0.0))
        up = {"angle": math.pi / 2}
        return Mechanism(
            (cam, follower),
            joints=(
                Revolute("hinge", cam, GROUND),
                Translational("guide", GROUND.line((0, 0), **up), follower.line((0, 0), **up)),
                AngleDriver("drive", cam, motion=polynomial_motion(math.pi / 2, self.omega)),
            ),
            forces=(
                SpringDamper(
                    "spring",
                    follower,
                    GROUND.at(0, 0.2),
                    stiffness=self.stiffness,
                    free_length=0.2 - BASE + self.preload,
                ),
                PointForce("weight", follower, force=(0.0, -self.weight)),
            ),
            contacts=(PointFollower("touch", follower, cam, profile_j=self.profile, unilateral=True),),
            outputs=(Output("y", "follower.y", "", "m"), Output("gap", "touch.gap", "", "m")),
            held=(cam.angle,),
            settings=Settings(relative_tolerance=tolerance),
        )

    def by_formulas(self, until: float) -> list[tuple[str, float]]:
        """Lift-offs ("force") and landings ("gap"), without restitution, with their times [s]; stiffness > 0."""
        starts = np.array([float(piece.start) for piece in self.profile.pieces])
        turns = np.arange(math.ceil(self.omega * until / TURN) + 1)
        joins = np.sort((turns[:, None] * TURN + (TURN - starts)).ravel()) / self.omega
        edges = np.concatenate([[0.0], joins[(joins > 0.0) & (joins < until)], [until]])
        w, rest = math.sqrt(self.stiffness / self.mass), BASE - self.preload - self.weight / self.stiffness
        events: list[tuple[str, float]] = []
        time, closed = 0.0, True
        while time < until:
            grid = np.concatenate([[time], edges[edges > time]])
            inside = np.linspace(1e-9, 1.0 - 1e-9, _SAMPLES)
            if not closed:
                inside = np.concatenate([np.geomspace(1e-7, 1e-3, 40), inside[1:]])
            times = (grid[:-1, None] + np.diff(grid)[:, None] * inside).ravel()
            off = time
            radius, slope, _ = self.lift(-self.omega * off)[:, 0]
            speed = -self.omega * slope

            def gap(t: Any, off: float = off, y: float = radius, speed: float = speed) -> Any:
                u = np.asarray(t) - off
                flight = rest + (y - rest) * np.cos(w * u) + speed / w * np.sin(w * u)
                return flight - self.lift(-self.omega * np.asarray(t))[0]

            what = self.force if closed else gap
            values = what(times)
            below = np.flatnonzero(values < (0.0 if closed else -1e-15))
            if below.size == 0:
                break
            k = below[0]
            time = float(times[k])
            if k > 0 and values[k - 1] > 0.0:
                time = brentq(_single, times[k - 1], times[k], args=(what,), xtol=1e-16, rtol=1e-15)
            events.append(("force" if closed else "gap", time))
            closed = not closed and bool(self.force(time) > 0.0)
        return events

    def jump_speed(self) -> float:
        """The least speed at which the force falls to zero somewhere [rad/s]."""
        radius, _, bend = self.lift(np.linspace(0.0, TURN, 20_001))
        falls = bend < 0.0
        pressed = self.stiffness * (radius[falls] - BASE + self.preload) + self.weight
        return float(np.sqrt((pressed / (-self.mass * bend[falls])).min()))


class Motion(NamedTuple):
    """Events as (guard, time), the least gap at the ends of steps [m], and how far the follower is off the cam [m]."""

    events: list[tuple[str, float]]
    least_gap: float
    lift: float


def motion(cam: Cam, tolerance: float, until: float) -> Motion:
    simulation = Simulation(cam.mechanism(tolerance))
    simulation.begin_step()
    events, least, seen = [], 0.0, simulation.counters.item(codes.COUNT_EVENTS)
    while simulation.time < until:
        simulation.go_on(until, codes.STOP_AT_STEP)
        new = simulation.counters.item(codes.COUNT_EVENTS) - seen
        seen += new
        events += [(e.guard.rpartition(".")[2], e.time) for e in simulation.events_in_step()[-new:] if new]
        least = min(least, simulation.read()["gap"])
    lift = simulation.read()["y"] - cam.lift(-cam.omega * until)[0].item()
    return Motion(events, least, lift)


def parabolas(rates: Any, widths: Any, base: float = BASE) -> Curve:
    """A profile whose curvature jumps: parabolas by second derivative [m/rad2] and width [rad], which must close."""
    place = value = slope = 0.0
    pieces = []
    for rate, width in zip(map(float, rates), map(float, widths), strict=True):
        pieces.append((place, value, slope, 0.5 * rate))
        place, value, slope = place + width, value + slope * width + 0.5 * rate * width**2, slope + rate * width
    lowest = min(value for _, value, _, _ in pieces)
    return Curve(
        tuple(Piece(at, (Term((base - lowest + value, slope, half)),)) for at, value, slope, half in pieces),
        0.0,
        TURN,
        periodic=True,
    )


def random_cam(seed: int) -> Cam:
    """A cam with noise, jumps of curvature, harmonics or moves, at and around the speed at which it jumps."""
    rng = np.random.default_rng(seed)
    kind = ("noise", "parabolas", "harmonic", "moves")[seed % 4]
    if kind == "noise":
        count = int(rng.choice([36, 60, 90]))
        lifts = 5e-3 * (1.0 - np.cos(TURN * np.arange(count) / count))
        lifts += rng.normal(0.0, 10.0 ** rng.uniform(-7.0, -5.0), count)
        profile = spline_profile((BASE + lifts).tolist(), degree=3 if count < 90 else 5)
    elif kind == "parabolas":
        count = int(rng.choice([4, 6, 10]))
        widths = rng.dirichlet(np.full(count, 3.0)) * TURN
        rates = rng.choice([-0.01, -0.005, 0.0, 0.005, 0.01], count)
        ends = np.cumsum(widths)
        closing = np.array([widths, widths * (TURN - ends) + 0.5 * widths**2])
        profile = parabolas(rates - np.linalg.pinv(closing) @ (closing @ rates), widths, BASE + 0.004)
    elif kind == "harmonic":
        small = rng.normal(0.0, 3e-4, 3).tolist()
        profile = harmonic_profile(BASE + 0.006, [-0.005, small[0]], small[1:])
    else:
        laws = cycloidal, modified_sine, polynomial_345
        up, down = (laws[k] for k in rng.integers(3, size=2))
        angles = map(math.radians, (100.0, 40.0, 120.0))
        moves = zip((0.008, 0.008, 0.0), angles, (up, dwell, down), strict=True)
        profile = motion_profile(BASE, [Move(*move) for move in moves])
    cam = Cam(
        profile,
        1.0,
        mass=float(rng.choice([0.05, 0.2, 1.0])),
        stiffness=float(rng.choice([500.0, 5e3, 2e4])),
        preload=float(rng.choice([5e-4, 5e-3, 2e-2])),
    )
    return cam._replace(omega=cam.jump_speed() * float(rng.choice([0.97, 1.001, 1.02, 1.1, 1.3, 2.0])))
