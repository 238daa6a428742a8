"""Digits of MuJoCo among the published problems: its models, and that they still give these digits."""

import math
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from benchmarks.world.cases import chain, governor

mujoco = pytest.importorskip("mujoco")
pytestmark = pytest.mark.slow

Vector = npt.NDArray[np.float64]

_OPTION = (
    '<mujoco><compiler boundmass="0" boundinertia="0"/><option timestep="{step!r}" integrator="RK4" '
    'gravity="0 0 -9.81"><flag contact="disable" constraint="disable"/></option>'
)


def extrapolated(found: dict[int, Vector]) -> Vector:
    """From two numbers of steps, one twice the other, of a method of fourth order."""
    few, many = sorted(found)
    return found[many] + (found[many] - found[few]) / 15


def chain_after(count: int, steps: int) -> Vector:
    """Angles of all rods [rad], shape (count,): hinges, whose coordinates are angles between rods."""
    length, mass = chain.LENGTH, chain.MASS
    inertia = mass * length**2 / 12
    inertial = f'<inertial pos="{length / 2} 0 0" mass="{mass}" diaginertia="{inertia} {inertia} {inertia}"/>'
    rods = "".join(f'<body pos="{length if k else 0} 0 0"><joint axis="0 -1 0"/>{inertial}' for k in range(count))
    text = f"{_OPTION.format(step=chain.STOP / steps)}<worldbody>{rods}{'</body>' * count}</worldbody></mujoco>"
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, steps)
    return np.cumsum(data.qpos)


def governor_after(steps: int) -> Vector:
    """Height [m], angle [rad] and speed [rad/s] at each of the times, in space: z is up, the shaft turns about it."""
    half, aside = governor.LENGTH / 2, governor.ASIDE
    across, along, side = governor.ACROSS, governor.ALONG, governor.SLIDER * governor.SIDE**2 / 6
    ball = f'<body pos="{2 * half} 0 0"><inertial pos="0 0 0" mass="{governor.BALL}" diaginertia="1e-12 1e-12 1e-12"/>'
    rods = "".join(
        f'<body pos="{x} 0 {half}" euler="0 {math.degrees(turned)!r} 0"><joint name="{name}" axis="0 1 0"/>'
        f'<inertial pos="{half} 0 0" mass="{governor.ROD!r}" diaginertia="{along!r} {across!r} {across!r}"/>'
        f'<site name="{name}_middle" pos="{half} 0 0"/>{ball}</body></body>'
        for name, x, turned in (("right", aside, governor.START), ("left", -aside, math.pi - governor.START))
    )
    springs = "".join(
        f'<spatial stiffness="{governor.STIFFNESS}" damping="{governor.DAMPING}" '
        f'springlength="{governor.FREE_LENGTH}"><site site="{name}_end"/><site site="{name}_middle"/></spatial>'
        for name in ("right", "left")
    )
    text = (
        f"{_OPTION.format(step=governor.TIMES[-1] / steps)}<worldbody>"
        f'<body pos="0 0 {half}"><joint name="shaft" axis="0 0 1"/>'
        f'<inertial pos="0 0 0" mass="{governor.ROD!r}" diaginertia="{across!r} {across!r} {along!r}"/>'
        f'<body pos="0 0 {governor.HEIGHT - half}"><joint name="slider" type="slide" axis="0 0 1"/>'
        f'<inertial pos="0 0 0" mass="{governor.SLIDER!r}" diaginertia="{side!r} {side!r} {side!r}"/>'
        f'<site name="right_end" pos="{aside} 0 0"/><site name="left_end" pos="{-aside} 0 0"/></body>'
        f"{rods}</body></worldbody><tendon>{springs}</tendon></mujoco>"
    )
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.joint("shaft").qvel[0] = governor.SPEED
    found: list[Any] = []
    done = 0
    for time in governor.TIMES:
        until = round(time * steps / governor.TIMES[-1])
        mujoco.mj_step(model, data, until - done)
        done = until
        slider, right, shaft = (data.joint(name) for name in ("slider", "right", "shaft"))
        found += [governor.HEIGHT + slider.qpos[0], governor.START + right.qpos[0], shaft.qvel[0]]
    return np.array(found)


@pytest.mark.parametrize("count", chain.COUNTS)
def test_the_chain(count: int) -> None:
    angles = extrapolated({steps: chain_after(count, steps) for steps in (24000, 48000)})
    np.testing.assert_allclose(chain.quantities(angles), chain.BY_MUJOCO[count], rtol=1e-12)


def test_the_governor() -> None:
    found = extrapolated({steps: governor_after(steps) for steps in (100000, 200000)})
    np.testing.assert_allclose(found, governor.BY_MUJOCO, rtol=1e-12)
