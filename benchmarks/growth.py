"""How one acceleration grows with the mechanism: chains of bars by the engine, and by MuJoCo's mj_forward.

    python -m benchmarks.growth [--rounds 7]        needs the extra "bench" (MuJoCo 4)

The same chain hangs from a pin, at the same angles and speeds; MuJoCo has joint angles as coordinates, and no contacts.
Both give the same angular accelerations, which is checked.
"""

from __future__ import annotations

import argparse
import math
from statistics import median

import numpy as np

from mechanism_fmu.engine.compiler.subset import entry
from mechanism_fmu.engine.dynamics.acceleration import derivative
from mechanism_fmu.model import GROUND, Mechanism, Revolute, compile_mechanism, rigid_body
from mechanism_fmu.tables.declare import Array
from mechanism_fmu.tables.layout import field_of, pack

from .timing import batch, in_turns, require_agreement

LENGTH, MASS, GRAVITY = 0.1, 1.0, 9.81
_SIZES = (5, 10, 20, 50, 100)
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


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=7, help="in which the two take turns")
    rounds = parser.parse_args().rounds
    found = {count: compare(count, rounds) for count in _SIZES}
    print("bars  engine  MuJoCo  ratio   [us an acceleration]")
    for count, (ours, theirs) in found.items():
        print(f"{count:4d} {1e6 * ours:7.2f} {1e6 * theirs:7.2f} {ours / theirs:6.2f}")
    exponent = math.log(found[100][0] / found[20][0]) / math.log(5.0)
    print(f"The engine's time grows as the number of bars to the power of {exponent:.2f}, from 20 to 100.")


if __name__ == "__main__":
    main()
