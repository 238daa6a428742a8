"""The free ratchet up to its first impact and behind it, with numpy and scipy: what the engine is measured against.

A disc that slides on a sawtooth wheel is a point that slides on the wheel whose slopes and faces stand farther out by
the radius of the disc: again a sawtooth wheel, with another root, turned by a little. So the guided ratchet of
`benchmarks.reference`, which shares no code with `mechanism_fmu`, moves as the free pawl does, as long as its rows
push. Up to the impact, the slope pushes the wheel against its holding pawl: it is so heavy there that nothing moves it.

    python -m benchmarks.ratchet_free > models/ratchet_free/reference.csv
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from .curve_file import print_curve
from .ratchet import Parameters, Ratchet, build
from .reference import CRANK_ANGLE, PAWL_ANGLE, WHEEL_ANGLE, State, Trajectory, advance, impact

#: Of the ready model: number and slope angle of the teeth, radius of the nose [m].
BASE = Parameters(tooth_count=20, tooth_slope_angle=math.radians(95))
NOSE = 1e-3

#: Inertia [kg.m2] of a wheel that is held.
_HELD = 1e12


def offset(p: Parameters, radius: float) -> tuple[Parameters, float]:
    """The wheel for the middle of a disc, and by how much its root stands ahead of that of the disc's wheel [rad].

    Args:
        p: the wheel on which the disc slides.
        radius: of the disc [m].
    """
    slope, face = build(p).normals
    root = np.array([p.wheel_inner_radius, 0.0]) + np.linalg.solve(np.array([slope, face]), [radius, radius])
    pitch = 2 * math.pi / p.tooth_count
    # the apex is where the slope meets the face of the next tooth, clockwise
    c, s = math.cos(pitch), math.sin(pitch)
    next_face = np.array([c * face[0] + s * face[1], c * face[1] - s * face[0]])
    next_root = np.array([c * root[0] + s * root[1], c * root[1] - s * root[0]])
    apex = np.linalg.solve(np.array([slope, next_face]), [slope @ root, next_face @ next_root])
    ahead, r = math.atan2(root[1], root[0]), math.hypot(*root)
    ratio = math.dist(apex, root) / (2 * r * math.sin(pitch / 2))
    wheel = replace(
        p,
        wheel_inner_radius=r,
        tooth_slope_angle=p.tooth_slope_angle - ahead,
        slope_ratio=ratio,
        wheel_angle_start=p.wheel_angle_start + ahead,
        spring_free_angle=p.spring_free_angle + ahead,
    )
    return wheel, ahead


def held(r: Ratchet) -> Ratchet:
    """The same with its wheel held."""
    mass = r.mass.copy()
    mass[WHEEL_ANGLE] = _HELD
    return replace(r, mass=mass)


def simulate(r: Ratchet, stop_time: float, rtol: float, atol: float) -> Trajectory:
    """With the wheel held up to the first impact, which is that of the free wheel.

    Raises:
        RuntimeError: there is none up to `stop_time` [s].
    """
    end, first, struck = advance(held(r), State(0.0, r.start, np.zeros(9)), stop_time, rtol, atol)
    if struck is None:
        raise RuntimeError(f"There is no impact up to {stop_time:g} s.")
    hit = impact(r, struck.time, struck.q, struck.before)
    behind = State(end.time, end.q, hit.after, on_face=True)
    _, second, _ = advance(r, behind, stop_time, rtol, atol)
    return Trajectory((first, second), (hit,))


def main() -> None:
    """Print the reference curve of the default values: CSV, 0..6 s every 0.01 s."""
    wheel, ahead = offset(BASE, NOSE)
    trajectory = simulate(build(wheel), 6.0, rtol=1e-12, atol=1e-14)
    angles = [WHEEL_ANGLE, CRANK_ANGLE, PAWL_ANGLE]
    back = np.array([ahead, 0.0, 0.0])
    moments = ((time, *trajectory.at(time)) for time in (k / 100 for k in range(601)))
    print_curve(
        "time,wheel_angle,crank_angle,pawl_angle,wheel_speed,crank_speed,pawl_speed",
        ((time, *(q[angles] - back), *qd[angles]) for time, q, qd in moments),
        digits=12,
    )


if __name__ == "__main__":
    main()
