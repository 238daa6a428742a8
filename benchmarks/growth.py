"""How one acceleration grows with the mechanism: chains of bars by the engine, and by MuJoCo's mj_forward.

And accelerations of closed loops and of contacts, which MuJoCo has softly or not at all: of the engine alone.

    python -m pip install -e '.[bench,dev]'         MuJoCo 4, and numba, without which nothing is timed
    python -m benchmarks.growth [--rounds 7]
    git worktree add ../older COMMIT
    python -m benchmarks.growth --beside ../older   the engine of another commit in turns with this one

The same chain hangs from a pin, at the same angles and speeds; MuJoCo has joint angles as coordinates, and no contacts.
Both give the same angular accelerations, which is checked; two engines give the same accelerations of all bodies.
"""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from statistics import median

import numpy as np

from mechanism_fmu.engine.compiler.subset import COMPILES, entry
from mechanism_fmu.engine.dynamics.acceleration import derivative
from mechanism_fmu.model import (
    GROUND,
    Gears,
    InternalGears,
    Mechanism,
    PointLineContact,
    Revolute,
    compile_mechanism,
    rigid_body,
)
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tables.declare import Array
from mechanism_fmu.tables.layout import field_of, pack

from .timing import batch, in_turns, require_agreement

LENGTH, MASS, GRAVITY = 0.1, 1.0, 9.81
#: So many bars have the chains.
SIZES = (5, 10, 20, 50, 100)
#: The two differ by less than this part of the largest acceleration.
_WITHIN = 1e-9
_CALLS = 2000


def angles(count: int) -> tuple[Array, Array]:
    """Angles [rad] and angular speeds [rad/s] of the bars, each of shape (count,).

    Args:
        count: of bars.
    """
    random = np.random.default_rng(count)
    return random.uniform(-1.0, 1.0, count), random.uniform(-1.0, 1.0, count)


def chain(count: int) -> Mechanism:
    """Bars that hang from each other, and the first one from the ground.

    Args:
        count: of bars.
    """
    phi, rate = angles(count)
    bodies, joints = [], []
    x = y = vx = vy = 0.0
    before = GROUND.at(0.0, 0.0)
    for k in range(count):
        angle, speed = float(phi[k]) - math.pi / 2, float(rate[k])
        half_x, half_y = 0.5 * LENGTH * math.cos(angle), 0.5 * LENGTH * math.sin(angle)
        bar = rigid_body(
            f"bar{k}",
            (x, y),
            mass=MASS,
            inertia=MASS * LENGTH**2 / 12,
            centre=(0.5 * LENGTH, 0.0),
            angle=angle,
            speed=speed,
            velocity=(vx, vy),
        )
        joints.append(Revolute(f"pin{k}", bar.at(0.0, 0.0), before))
        bodies.append(bar)
        before = bar.at(LENGTH, 0.0)
        x, y = x + 2 * half_x, y + 2 * half_y
        vx, vy = vx - 2 * half_y * speed, vy + 2 * half_x * speed
    return Mechanism(tuple(bodies), tuple(joints), gravity=(0.0, -GRAVITY))


def mjcf(count: int) -> str:
    """The same chain for MuJoCo, in the plane x, z; a positive hinge turns from x to z as ours from x to y.

    Args:
        count: of bars.
    """
    inertia = MASS * LENGTH**2 / 12
    body = (
        '<body pos="{at} 0 0"><joint type="hinge" axis="0 -1 0"/>'
        f'<inertial pos="{LENGTH / 2} 0 0" mass="{MASS}" diaginertia="{inertia} {inertia} {inertia}"/>'
    )
    text = "".join(body.format(at=0.0 if k == 0 else LENGTH) for k in range(count)) + "</body>" * count
    return (
        f'<mujoco><option gravity="0 0 -{GRAVITY}"><flag contact="disable" constraint="disable"/></option>'
        f"<worldbody>{text}</worldbody></mujoco>"
    )


def four_bars(count: int) -> Mechanism:
    """N-four-bar of the IFToMM benchmark A02: rockers of 1 m side by side, leaning, and a rod from each to the next.

    Args:
        count: of rods; there is one rocker more.
    """
    lean = 0.3
    tip = math.sin(lean), math.cos(lean)
    rockers = [
        rigid_body(f"rocker{k}", (k, 0.0), mass=1.0, inertia=1 / 12, centre=(0.5, 0.0), angle=0.5 * math.pi - lean)
        for k in range(count + 1)
    ]
    rods = [
        rigid_body(f"rod{k}", (k + tip[0], tip[1]), mass=1.0, inertia=1 / 12, centre=(0.5, 0.0)) for k in range(count)
    ]
    joints = [Revolute(f"ground{k}", rocker.at(0.0, 0.0), GROUND.at(k, 0.0)) for k, rocker in enumerate(rockers)]
    for k, rod in enumerate(rods):
        joints.append(Revolute(f"left{k}", rod.at(0.0, 0.0), rockers[k].at(1.0, 0.0)))
        joints.append(Revolute(f"right{k}", rod.at(1.0, 0.0), rockers[k + 1].at(1.0, 0.0)))
    return Mechanism((*rockers, *rods), tuple(joints), gravity=(0.0, -GRAVITY))


def blocks(count: int) -> Mechanism:
    """Blocks that stand beside each other, each on two points of a floor.

    Args:
        count: of blocks.
    """
    bodies = [rigid_body(f"block{k}", (0.3 * k, 0.05), mass=2.0, inertia=0.01) for k in range(count)]
    floor = GROUND.line((0.0, 0.0), (1.0, 0.0))
    contacts = [
        PointLineContact(f"{side}_{body.name}", body.at(x, -0.05), floor)
        for body in bodies
        for side, x in (("left", -0.1), ("right", 0.1))
    ]
    return Mechanism(tuple(bodies), contacts=tuple(contacts), gravity=(0.0, -GRAVITY))


def planetary(count: int) -> Mechanism:
    """Planets on a carrier between a sun and a fixed ring: all but the first one's rows repeat each other.

    Args:
        count: of planets.
    """
    sun = rigid_body("sun", mass=1.0, inertia=1e-3, speed=2.0)
    carrier = rigid_body("carrier", mass=1.0, inertia=1e-3, speed=0.6)
    joints: list[Revolute | Gears | InternalGears] = [
        Revolute("sun_pin", sun.at(0.0, 0.0), GROUND),
        Revolute("carrier_pin", carrier.at(0.0, 0.0), GROUND),
    ]
    planets = []
    for k in range(count):
        angle = math.tau * k / count
        x, y = 0.05 * math.cos(angle), 0.05 * math.sin(angle)
        planet = rigid_body(f"planet{k}", (x, y), mass=0.1, inertia=1e-5, velocity=(-0.6 * y, 0.6 * x), speed=-1.5)
        planets.append(planet)
        joints.append(Revolute(f"pin{k}", planet.at(0.0, 0.0), carrier.at(x, y)))
        meshes = {"radius_j": 0.02, "angle_i": angle}
        joints.append(Gears(f"outside{k}", sun, planet, radius_i=0.03, angle_j=angle + math.pi, **meshes))
        joints.append(InternalGears(f"inside{k}", GROUND, planet, radius_i=0.07, angle_j=angle, **meshes))
    return Mechanism((sun, carrier, *planets), tuple(joints))


def landing(count: int) -> Mechanism:
    """The blocks a hand's breadth above the floor, so that all contacts strike in one instant, after 0.1 s.

    Args:
        count: of blocks.
    """
    standing = blocks(count)
    higher = (replace(body, start=(body.start[0], body.start[1] + 0.05, 0.0)) for body in standing.bodies)
    return replace(standing, bodies=tuple(higher))


#: So many bodies have the motions of many.
LARGE = (50, 100, 200, 400)
#: What is timed besides, by name.
_OTHERS: dict[str, Callable[[], Mechanism]] = {
    "planetary train, 3 planets": lambda: planetary(3),
    "planetary train, 6 planets": lambda: planetary(6),
    "N-four-bar, N = 10": lambda: four_bars(10),
    "N-four-bar, N = 40": lambda: four_bars(40),
    "25 blocks on 50 contacts": lambda: blocks(25),
}
#: Motions of many, by name, and how long they last [s].
_MOTIONS: tuple[tuple[str, Callable[[int], Mechanism], float], ...] = (
    ("bars of a chain, 20 ms", chain, 0.02),
    ("blocks that land at once, 0.2 s", landing, 0.2),
)


@entry
def _repeat(block: Array, y: Array, dy: Array, count: int) -> None:
    for _ in range(count):
        derivative(block, y, dy)


def compare(count: int, rounds: int) -> tuple[float, float]:
    """Times of one acceleration by the engine and by MuJoCo [s].

    Args:
        count: of bars.
        rounds: in which the two take turns.
    """
    import mujoco

    block = pack(compile_mechanism(chain(count)))
    y = np.zeros(field_of(block, "y_end").size)
    dy = np.zeros_like(y)
    y[: 3 * count] = field_of(block, "body_start").ravel()
    y[3 * count : 6 * count] = field_of(block, "body_start_rate").ravel()
    model = mujoco.MjModel.from_xml_string(mjcf(count))
    data = mujoco.MjData(model)
    phi, rate = angles(count)
    data.qpos[:] = np.diff(phi - math.pi / 2, prepend=0.0)
    data.qvel[:] = np.diff(rate, prepend=0.0)
    _repeat(block, y, dy, 1)
    mujoco.mj_forward(model, data)
    ours, theirs = dy[3 * count + 2 : 6 * count : 3], np.cumsum(data.qacc)
    require_agreement(f"A chain of {count}", ours, theirs, _WITHIN * float(np.abs(theirs).max()))
    calls = max(20, _CALLS // count)
    mujoco_times, engine_times = in_turns(
        lambda: batch(lambda: mujoco.mj_forward(model, data), calls),
        lambda: batch(lambda: _repeat(block, y, dy, calls), 1) / calls,
        rounds,
    )
    return median(engine_times), median(mujoco_times)


def accelerations(mechanism: Mechanism) -> tuple[Callable[[], float], Array]:
    """What times one acceleration where a motion begins, with the contacts that are closed there [s].

    And the accelerations [m/s2, rad/s2], of shape (3 bodies,).

    Args:
        mechanism: which.
    """
    block = Simulation(mechanism)._block
    y = field_of(block, "y_end").copy()
    dy = np.zeros_like(y)
    count = len(mechanism.bodies)
    calls = max(20, _CALLS // count)
    _repeat(block, y, dy, 1)
    return lambda: batch(lambda: _repeat(block, y, dy, calls), 1) / calls, dy[3 * count : 6 * count].copy()


#: A process with the engine of one checkout (first argument) and the mechanisms of this file (second argument, the root
#: above it): `mechanism_fmu` is found first, and stays what it is.
_SERVER = """
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
import mechanism_fmu
if not Path(mechanism_fmu.__file__ or "").resolve().is_relative_to(sys.argv[1]):
    raise SystemExit(f"{sys.argv[1]} has no engine: {mechanism_fmu.__file__} was found in its place.")
sys.path.insert(0, sys.argv[2])
from benchmarks.growth import serve
serve()
"""


def require_compiler() -> None:
    """Refuse to time what runs as plain Python.

    Raises:
        SystemExit: how to get what compiles it.
    """
    if not COMPILES:
        raise SystemExit(
            "The loops that are timed here would run as plain Python: install numba by "
            "python -m pip install -e '.[bench,dev]', and leave NUMBA_DISABLE_JIT unset."
        )


def serve() -> None:
    """For each line of standard input, a name of `_OTHERS`, print the time of an acceleration [s] and accelerations."""
    require_compiler()
    made: dict[str, tuple[Callable[[], float], Array]] = {}
    for line in sys.stdin:
        name = line.strip()
        if name not in made:
            made[name] = accelerations(_OTHERS[name]())
        timed, found = made[name]
        print(json.dumps([timed(), found.tolist()]), flush=True)


def beside(older: Path, rounds: int) -> None:
    """Time the mechanisms of `_OTHERS` by this engine and by that of another checkout, in turns, and print both.

    Args:
        older: root of the other checkout.
        rounds: in which the two take turns.

    Raises:
        DisagreementError: they do not find the same accelerations.
    """
    here = Path(__file__).resolve().parents[1]
    with _server(older, here) as old, _server(here, here) as new:
        print(f"{'[us an acceleration]':27s} {'here':>8s} {older.name:>8s}  ratio")
        for name in _OTHERS:
            (_, theirs), (_, ours) = _ask(old, older, name), _ask(new, here, name)
            weight = math.hypot(*(_OTHERS[name]().gravity or (0.0, 0.0)))  # where all rests
            largest = max(float(np.abs(theirs).max()), weight)
            require_agreement(name, theirs, ours, _WITHIN * largest)
            then, now = in_turns(partial(_timed, old, older, name), partial(_timed, new, here, name), rounds)
            print(f"{name:27s} {1e6 * median(now):8.2f} {1e6 * median(then):8.2f} {median(now) / median(then):6.3g}")


def _server(checkout: Path, here: Path) -> subprocess.Popen[str]:
    command = [sys.executable, "-c", _SERVER, str(checkout), str(here)]
    return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd=checkout)


def _ask(server: subprocess.Popen[str], checkout: Path, name: str) -> tuple[float, Array]:
    assert server.stdin is not None
    assert server.stdout is not None
    answer = ""
    try:
        print(name, file=server.stdin, flush=True)
        answer = server.stdout.readline()
    except BrokenPipeError:
        with suppress(BrokenPipeError):  # closed here, it is not flushed again at the end
            server.stdin.close()
    if not answer:
        raise SystemExit(f"The engine of {checkout} cannot run '{name}'; see its message above.")
    seconds, found = json.loads(answer)
    return float(seconds), np.array(found)


def _timed(server: subprocess.Popen[str], checkout: Path, name: str) -> float:
    return _ask(server, checkout, name)[0]


def of_motion(mechanism: Mechanism, until: float, rounds: int) -> tuple[float, float]:
    """Processor time of a motion [s], and how much of its block was written [MB].

    Args:
        mechanism: which.
        until: end of the motion [s].
        rounds: whose median the time is.
    """
    simulation = Simulation(mechanism)
    simulation.advance(until)
    written = np.count_nonzero(simulation._block) * simulation._block.itemsize / 1e6

    def once() -> None:
        simulation.begin(0.0)
        simulation.advance(until)

    return median(batch(once, 1) for _ in range(rounds)), written


def others(rounds: int) -> Iterator[tuple[str, float]]:
    """Names of the mechanisms besides, and the time of one acceleration of each [s], median of so many rounds."""
    for name, made in _OTHERS.items():
        timed, _ = accelerations(made())
        yield name, median(timed() for _ in range(rounds))


@dataclass(frozen=True)
class Motions:
    """The same motion of ever more bodies.

    Attributes:
        name: what moves.
        times: processor time [s], by how many there are.
        written: of the mechanism's block [MB], likewise.
    """

    name: str
    times: dict[int, float]
    written: dict[int, float]

    @property
    def exponent(self) -> float:
        """The time grows as their number to this power."""
        return exponent(self.times)


def motions(rounds: int, counts: Sequence[int] = LARGE) -> Iterator[Motions]:
    """Each of `_MOTIONS` with so many bodies, times as the median of so many rounds."""
    for name, of_many, until in _MOTIONS:
        found = {count: of_motion(of_many(count), until, rounds) for count in counts}
        times, written = ({count: both[k] for count, both in found.items()} for k in (0, 1))
        yield Motions(name, times, written)


def exponent(times: Mapping[int, float]) -> float:
    """To which power of the number, the least and the greatest of them taken, a time grows."""
    least, most = min(times), max(times)
    return math.log(times[most] / times[least]) / math.log(most / least)


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=7, help="in which the two take turns")
    parser.add_argument("--beside", type=Path, metavar="CHECKOUT", help="time the engine of this checkout as well")
    arguments = parser.parse_args()
    rounds = arguments.rounds
    require_compiler()
    if arguments.beside is not None:
        older = arguments.beside.resolve()
        if not (older / "mechanism_fmu").is_dir():
            parser.error(f"--beside {older}: there is no folder mechanism_fmu in it; give the root of a checkout.")
        beside(older, rounds)
        return
    found = {count: compare(count, rounds) for count in SIZES}
    print("bars  engine  MuJoCo  ratio   [us an acceleration]")
    for count, (ours, theirs) in found.items():
        print(f"{count:4d} {1e6 * ours:7.2f} {1e6 * theirs:7.2f} {ours / theirs:6.3g}")
    power = exponent({count: found[count][0] for count in (20, 100)})
    print(f"The engine's time grows as the number of bars to the power of {power:.2f}, from 20 to 100.")
    for name, seconds in others(rounds):
        print(f"{name:27s} {1e6 * seconds:7.2f}")
    print("motions, with all events, checks and projections         [ms], and what is written of a block [MB]")
    for one in motions(rounds):
        for count, seconds in one.times.items():
            print(f"{count:4d} {one.name:30s} {1e3 * seconds:8.2f} {one.written[count]:7.2f}")
        print(f"     as their number to the power of {one.exponent:.2f}")


if __name__ == "__main__":
    main()
