"""Number and order of events of random mechanisms, beside an integrator that knows nothing of the engine.

python -m tests.analytic.event_families 100     prints, of so many draws of each family, those whose events differ

Families: a block on a belt, tied to a wall; a chain of blocks on a belt; a disc under a brake that comes and goes; a
follower on an eccentric cam that lifts off. Between events motions are integrated by scipy, event by event of its dense
output, in coordinates of their own.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from mechanism_fmu import codes
from mechanism_fmu.engine.dynamics.scaling import LENGTH, RATE
from mechanism_fmu.model import (
    GROUND,
    AngleDriver,
    Brake,
    Input,
    Mechanism,
    PointFollower,
    PointLineContact,
    Revolute,
    SpringDamper,
    TorsionSpringDamper,
    Translational,
    XDriver,
    harmonic_motion,
    harmonic_profile,
    polynomial_motion,
    rigid_body,
)
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tolerances import STICK_SPEED

Events = list[tuple[str, float]]

GRAVITY = 9.81
#: Of scipy's integration: some digits more than the engine's own 1e-9.
_ACCURACY = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14}
#: Times of one event agree within this share of the run: both integrate to 1e-9 or better, and what follows of an
#: event amplifies that.
TIMES_AGREE = 1e-6
#: So many looks for each step of scipy's show what begins and ends within one; less than this is rounding [m/s, N].
_LOOKS, _NOISE = 8, 1e-9
#: A contact that would part more slowly than this part of the mechanism's length (of the cam: its radius) times its
#: rate after an impact stays closed: docs/decisions/069-scales.md.
_STAYS_CLOSED = STICK_SPEED / (LENGTH * RATE)


@dataclass
class Draw:
    """A mechanism, and who says independently what happens: `expected` until `until` [s].

    `legs` are communication steps: until when, and slopes of inputs.
    """

    mechanism: Mechanism
    until: float
    expected: Callable[[], Events]
    legs: list[tuple[float, dict[str, float]]] = field(default_factory=list)

    def simulated(self) -> Events:
        """Events of the engine, but for inputs."""
        simulation = Simulation(self.mechanism)
        events: Events = []
        for until, slopes in self.legs or [(self.until, {})]:
            for name, slope in slopes.items():
                simulation.set_slope(name, slope)
            simulation.begin_step()
            seen = simulation.counters.item(codes.COUNT_EVENTS)
            while simulation.time < until:
                simulation.go_on(until, codes.STOP_AT_EVENT)
                new = simulation.counters.item(codes.COUNT_EVENTS) - seen
                seen += new
                events += [(event.guard, event.time) for event in simulation.events_in_step(new) if new]
        return [event for event in events if event[0] != "input"]


# Blocks that stick and slip.


@dataclass
class Blocks:
    """Masses [kg] in a row, a spring and a damper before each, the first of them from a wall; all on one support.

    `speed` and `acceleration` are the support's; friction is at most `holds` [N] while it sticks, `rubs` while it
    slips, functions of time. `names` are those of their friction.
    """

    mass: np.ndarray
    stiffness: np.ndarray
    damping: np.ndarray
    rate: np.ndarray
    speed: Callable[[float], float]
    acceleration: Callable[[float], float]
    rubs: Callable[[float], np.ndarray]
    holds: Callable[[float], np.ndarray]
    names: list[str]

    def springs(self, y: np.ndarray) -> np.ndarray:
        """Forces on the blocks [N]."""
        x, v = np.split(y, 2)
        pull = self.stiffness * np.diff(x, prepend=0.0) + self.damping * np.diff(v, prepend=0.0)
        return -pull + np.append(pull[1:], 0.0)

    def needed(self, t: float, y: np.ndarray) -> np.ndarray:
        """Friction that lets each block go with the support [N]."""
        return self.mass * self.acceleration(t) - self.springs(y)

    def events(self, until: float) -> Events:
        """Mode after mode, 0 where a block sticks, else the sign of its slip."""
        count = len(self.mass)
        y = np.concatenate([np.zeros(count), self.rate])
        t = 0.0
        needed = self.needed(t, y)
        slip = np.where(np.abs(self.rate - self.speed(t)) > 1e-12, np.sign(self.rate - self.speed(t)), 0.0)
        slip = np.where((slip == 0) & (np.abs(needed) > self.holds(t)), -np.sign(needed), slip)
        found: Events = []
        while t < until:
            end = self._go_on(t, until, y, slip)
            t, y = end.t[-1], end.y[:, -1].copy()
            for k in range(count):
                if not len(end.t_events[k]):
                    continue
                found.append((f"{self.names[k]}.{'slips' if slip[k] == 0 else 'sticks'}", t))
                stuck = slip[k] == 0
                y[count + k] = self.speed(t)
                needed = self.needed(t, y)[k]
                slip[k] = 0.0 if not stuck and abs(needed) <= self.holds(t)[k] else -np.sign(needed)
        return found

    def _go_on(self, t: float, until: float, y: np.ndarray, slip: np.ndarray) -> Any:
        """Integrate in these modes; in shorter steps where a value is found to dip below zero within one."""
        ends = [self._end_of(k, slip[k]) for k in range(len(slip))]
        longest = until / 300
        while True:
            end = solve_ivp(
                lambda t, y: self._rates(t, y, slip),
                (t, until),
                y,
                events=ends,
                dense_output=True,
                max_step=longest,
                **_ACCURACY,
            )
            looks = np.linspace(t, end.t[-1], _LOOKS * len(end.t))[_LOOKS:-_LOOKS]
            dips = any(left(look, end.sol(look)) < -_NOISE for look in looks for left in ends)
            if not dips or longest < until / 1e5:
                return end
            longest /= 20

    def _rates(self, t: float, y: np.ndarray, slip: np.ndarray) -> np.ndarray:
        a = (self.springs(y) - slip * self.rubs(t)) / self.mass
        v = y[len(slip) :]
        return np.concatenate([v, np.where(slip == 0, self.acceleration(t), a)])

    def _end_of(self, k: int, slip: float) -> Callable[[float, np.ndarray], float]:
        def left(t: float, y: np.ndarray) -> float:
            if slip:
                return float(slip * (y[len(self.mass) + k] - self.speed(t)))
            return float(self.holds(t)[k] - abs(self.needed(t, y)[k]))

        left.terminal, left.direction = True, -1.0  # type: ignore[attr-defined]
        return left


def blocks_on_a_belt(rng: np.random.Generator, count: int) -> Draw:
    """So many blocks on a belt that goes on evenly, or to and fro."""
    mass = rng.uniform(0.3, 4.0, count)
    mu = rng.uniform(0.1, 0.6, count)
    more = rng.uniform(1.05, 1.8, count)
    stiffness = np.exp(rng.uniform(np.log(20.0), np.log(600.0), count)) + 30.0 * mass.sum() * mu.max()
    damping = rng.uniform(0.0, 2.0, count)
    wobbles = rng.random() < 0.5
    if wobbles and rng.random() < 0.6:
        more[:] = 1.0
    v, amplitude, frequency = float(np.exp(rng.uniform(np.log(0.03), 0.0))), 0.0, 1.0
    if wobbles:
        v, amplitude, frequency = 0.0, rng.uniform(0.02, 0.3), rng.uniform(2.0, 12.0)

    def speed(t: float) -> float:
        return float(v - amplitude * frequency * np.sin(frequency * t))

    def acceleration(t: float) -> float:
        return float(-amplitude * frequency**2 * np.cos(frequency * t))

    rate = np.full(count, speed(0.0))
    if rng.random() < 0.3:
        rate = rng.uniform(-0.5, 0.5, count)
    belt = rigid_body("belt", (0, -1), mass=1.0, inertia=1.0, velocity=(v, 0))
    bodies = [rigid_body(f"block{k}", (k, 0), mass=m, inertia=0.1, velocity=(rate[k], 0)) for k, m in enumerate(mass)]
    ends = [GROUND.at(-1, 0), *(body.at(0, 0) for body in bodies)]
    motion = polynomial_motion(0.0, v) if not wobbles else harmonic_motion(-amplitude, amplitude, frequency, np.pi / 2)
    mechanism = Mechanism(
        (*bodies, belt),
        (
            XDriver("drive", "belt", (0.0, 0.0), motion),
            Translational("way", GROUND.line((0, -1), (1, 0)), belt.line((0, 0), (1, 0))),
        ),
        tuple(
            SpringDamper(
                f"spring{k}", ends[k + 1], ends[k], stiffness=stiffness[k], damping=damping[k], free_length=1.0
            )
            for k in range(count)
        ),
        contacts=tuple(
            PointLineContact(
                f"rub{k}",
                body.at(0, 0),
                belt.line((0, 1), (1, 0)),
                closed=True,
                friction=mu[k],
                friction_static=mu[k] * more[k],
            )
            for k, body in enumerate(bodies)
        ),
        gravity=(0.0, -GRAVITY),
    )
    rubs = mu * mass * GRAVITY
    blocks = Blocks(
        mass,
        stiffness,
        damping,
        rate,
        speed,
        acceleration,
        lambda t: rubs,
        lambda t: rubs * more,
        [f"rub{k}" for k in range(count)],
    )
    until = 3.0
    return Draw(mechanism, until, lambda: blocks.events(until))


def belt(rng: np.random.Generator) -> Draw:
    """A block."""
    return blocks_on_a_belt(rng, 1)


def chain(rng: np.random.Generator) -> Draw:
    """Two to four blocks."""
    return blocks_on_a_belt(rng, int(rng.integers(2, 5)))


def brake(rng: np.random.Generator) -> Draw:
    """A disc on a torsion spring that turns, is braked more and more, held, and let go."""
    inertia, stiffness = np.exp(rng.uniform(np.log(0.02), 0.0)), np.exp(rng.uniform(0.0, np.log(60.0)))
    speed, damping = rng.uniform(1.0, 10.0) * rng.choice([-1.0, 1.0]), rng.uniform(0.0, 0.05)
    swing = abs(speed) * np.sqrt(stiffness * inertia)
    limits = [0.0]
    times = [0.0]
    for k in range(4):
        times.append(times[-1] + rng.uniform(0.3, 1.5))
        limits.append(float(rng.uniform(0.3, 1.2) * swing if k % 2 == 0 else rng.uniform(0.0, 0.15) * swing))
    disc = rigid_body("disc", (0, 0), mass=1.0, inertia=inertia, speed=speed)
    mechanism = Mechanism(
        (disc,),
        (Revolute("hinge", disc, GROUND),),
        (
            TorsionSpringDamper("spring", disc, GROUND, stiffness=stiffness, damping=damping),
            Brake("brake", disc, limit=0.0),
        ),
        inputs=(Input("limit", "brake.limit", 0.0, "", "N.m"),),
    )

    def bound(t: float) -> np.ndarray:
        return np.array([np.interp(t, times, limits)])

    one = Blocks(
        *(np.array([number]) for number in (inertia, stiffness, damping, speed)),
        lambda t: 0.0,
        lambda t: 0.0,
        bound,
        bound,
        ["brake"],
    )
    slopes = np.diff(limits) / np.diff(times)
    legs = [(until, {"limit": float(slope)}) for until, slope in zip(times[1:], slopes, strict=True)]
    return Draw(mechanism, times[-1], lambda: one.events(times[-1]), legs)


# A follower.


def cam(rng: np.random.Generator) -> Draw:
    """A follower that a spring presses on an eccentric cam, at 0.7 to 1.6 times the speed from which it lifts off."""
    base, lift = 0.025, rng.uniform(0.002, 0.008)
    mass, stiffness, preload = rng.uniform(0.1, 1.0), rng.uniform(500.0, 5000.0), rng.uniform(0.001, 0.01)
    restitution = float(rng.choice([0.0, 0.0, 0.3]))
    weight = mass * GRAVITY
    critical = np.sqrt((stiffness * (preload + 2 * lift) + weight) / (mass * lift))
    speed = critical * rng.uniform(0.7, 1.6)
    upwards = {"angle": np.pi / 2}
    wheel = rigid_body("cam", (0, 0), mass=1.0, inertia=1e-3, angle=np.pi / 2, speed=speed)
    follower = rigid_body("follower", (0, base + lift), mass=mass, inertia=1e-4)
    mechanism = Mechanism(
        (wheel, follower),
        (
            Revolute("hinge", wheel, GROUND),
            Translational("guide", GROUND.line((0, 0), **upwards), follower.line((0, 0), **upwards)),
            AngleDriver("drive", "cam", polynomial_motion(np.pi / 2, speed)),
        ),
        (
            SpringDamper(
                "spring", follower, GROUND.at(0, 0.2), stiffness=stiffness, free_length=0.2 - (base - lift) + preload
            ),
        ),
        contacts=(
            PointFollower(
                "touch",
                follower,
                wheel,
                profile_j=harmonic_profile(base, [lift]),
                unilateral=True,
                restitution=restitution,
            ),
        ),
        held=(wheel.angle,),
        gravity=(0.0, -GRAVITY),
    )
    until = float(4.0 * 2.0 * np.pi / speed)

    def height(t: float, order: int) -> float:
        """Follower on the cam, above the least height, or its derivatives."""
        return float(lift * speed**order * np.cos(speed * t + 0.5 * np.pi * order) + (lift if order == 0 else 0.0))

    def force(t: float) -> float:
        return mass * height(t, 2) + weight + stiffness * (preload + height(t, 0))

    def gap_since(start: float) -> Callable[[float, np.ndarray], float]:
        def gap(t: float, y: np.ndarray) -> float:
            return float(y[0] - height(t, 0)) if t > start else 1.0  # it has just parted: that is no zero

        gap.terminal, gap.direction = True, -1.0  # type: ignore[attr-defined]
        return gap

    def expected() -> Events:
        t, closed, y = 0.0, force(0.0) > 0.0, np.array([height(0.0, 0), height(0.0, 1)])
        found: Events = []
        while t < until:
            if closed:
                pushes = lambda t, y: force(t)  # noqa: E731
                pushes.terminal, pushes.direction = True, -1.0
                end = solve_ivp(lambda t, y: [0.0], (t, until), [0.0], events=pushes, max_step=until / 800)
                t = end.t[-1]
                if end.status == 1:
                    found.append(("touch.force", t))
                    closed, y = False, np.array([height(t, 0), height(t, 1)])
                continue
            end = solve_ivp(
                lambda t, y: [y[1], -(weight + stiffness * (preload + y[0])) / mass],
                (t, until),
                y,
                events=gap_since(t),
                max_step=until / 800,
                **_ACCURACY,
            )
            t, y = end.t[-1], end.y[:, -1]
            if end.status == 1:
                found.append(("touch.gap", t))
                parts = restitution * (height(t, 1) - y[1])
                slope = height(t, 1) / (speed * (base - lift + height(t, 0)))  # r'/r: of the normal to the follower
                stays = parts < _STAYS_CLOSED * (base + lift) * speed * np.hypot(1.0, slope)
                closed, y = (
                    bool(stays and force(t) > 0.0),
                    np.array([height(t, 0), height(t, 1) + (0 if stays else parts)]),
                )
        return found

    return Draw(mechanism, until, expected)


FAMILIES = {"belt": belt, "chain": chain, "brake": brake, "cam": cam}


def difference(name: str, seed: int) -> str:
    """How the events of one draw differ; "" where they do not."""
    draw = FAMILIES[name](np.random.default_rng(seed))
    try:
        simulated = draw.simulated()
    except Exception as error:
        return f"fails: {error}"
    expected = draw.expected()
    for place in range(max(len(simulated), len(expected))):
        pair = [events[place] if place < len(events) else None for events in (simulated, expected)]
        if pair[0] is None or pair[1] is None or pair[0][0] != pair[1][0]:
            return f"event {place} is {pair[0]}, expected {pair[1]} (of {len(simulated)}, expected {len(expected)})"
        if abs(pair[0][1] - pair[1][1]) > TIMES_AGREE * draw.until:
            return f"event {place} {pair[0]} is {pair[0][1] - pair[1][1]:.2g} s off"
    return ""


def differences(count: int) -> Iterator[tuple[str, int, str]]:
    """Family, number of the draw and difference of all that differ."""
    for name in FAMILIES:
        for seed in range(count):
            found: Any = difference(name, seed)
            if found:
                yield name, seed, found


if __name__ == "__main__":
    draws = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    for family, number, text in differences(draws):
        print(family, number, text, flush=True)
    print(f"{draws} draws of each of {', '.join(FAMILIES)}")
