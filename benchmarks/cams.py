"""One acceleration of a larger mechanism: ten bodies and four cams, against the textbook's rows and numpy."""

from __future__ import annotations

import math

import numpy as np

from mechanism_fmu.engine import status
from mechanism_fmu.engine.compiler.subset import entry
from mechanism_fmu.engine.dynamics.acceleration import derivative
from mechanism_fmu.engine.starting.begin import begin
from mechanism_fmu.kinematics.equations import Equations
from mechanism_fmu.model import (
    GROUND,
    Body,
    CamFollower,
    Contact,
    Gears,
    Mechanism,
    Revolute,
    Settings,
    Torque,
    Translational,
)
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.model.curves.profiles import circle, harmonic_profile
from mechanism_fmu.model.joints import Joint
from mechanism_fmu.tables.declare import Array
from mechanism_fmu.tables.layout import field_of, pack

from .timing import Comparison, batch, in_turns, require_agreement

_LONGEST = 20e-6
_WITHIN = 1e-9
_PLAIN_CALLS, _ENGINE_CALLS = 100, 2000
_TORQUE = 0.7


def compare(rounds: int) -> list[Comparison]:
    """Compare the acceleration of `ten_bodies` at its start, where the cams turn at 3 rad/s."""
    mechanism = ten_bodies()
    block = pack(compile_mechanism(mechanism))
    outcome = begin(block, 0.0)
    if outcome != status.OK:
        raise RuntimeError(status.ADVICE[outcome])
    y = field_of(block, "y_end").copy()
    dy = np.zeros_like(y)
    n = 3 * len(mechanism.bodies)

    def engine(count: int) -> Array:
        _repeat(block, y, dy, count)
        return dy[n : 2 * n]

    engine(1)
    q, qd = np.r_[y[:n], y[2 * n + 2 :]], np.r_[y[n : 2 * n], dy[2 * n + 2 :]]
    equations = Equations(mechanism, 0.0)
    mass = np.diag([*(m for body in mechanism.bodies for m in (body.mass, body.mass, body.inertia)), *[0.0] * 8])
    force = np.zeros(len(q))
    force[2] = _TORQUE

    def plain() -> Array:
        rows = equations.at(q, 0.0, qd)
        zero = np.zeros((len(rows.gamma), len(rows.gamma)))
        system = np.block([[mass, -rows.jacobian.T], [rows.jacobian, zero]])
        solution: Array = np.linalg.solve(system, np.r_[force, rows.gamma])[:n]
        return solution

    require_agreement("One acceleration of ten bodies", plain(), engine(1), _WITHIN)
    slow, fast = in_turns(
        lambda: batch(plain, _PLAIN_CALLS),
        lambda: batch(lambda: engine(_ENGINE_CALLS), 1) / _ENGINE_CALLS,
        rounds,
    )
    return [Comparison("one acceleration", "ten bodies, four cams", slow, fast, longest=_LONGEST)]


def ten_bodies() -> Mechanism:
    """Four cams, geared to each other; four arms with rollers; a rod and a slider on the last arm."""
    bodies: list[Body] = []
    joints: list[Joint] = []
    contacts: list[Contact] = []
    for k in range(4):
        way = (-1) ** k
        bodies += [
            Body(f"cam{k}", 1.0, 0.3, (2.0 * k, 0.0, 0.1 * way), (0.0, 0.0, 3.0 * way)),
            Body(f"arm{k}", 0.5, 0.1, (2.0 * k, 1.6, 0.0)),
        ]
        joints += [
            Revolute(f"shaft{k}", f"cam{k}", (0.0, 0.0), GROUND, (2.0 * k, 0.0)),
            Revolute(f"pivot{k}", f"arm{k}", (-1.5, 0.0), GROUND, (2.0 * k - 1.5, 1.5)),
        ]
        if k > 0:
            joints.append(Gears(f"gears{k}", f"cam{k - 1}", 1.0, 0.0, f"cam{k}", 1.0, math.pi))
        profile = harmonic_profile(1.0, (0.1, 0.05), (0.02,))
        contacts.append(CamFollower(f"pair{k}", f"cam{k}", profile, f"arm{k}", circle(0.25)))
    bodies += [Body("rod", 0.2, 0.02, (6.0, 2.6, math.pi / 2)), Body("slider", 0.2, 0.02, (6.0, 3.6, 0.0))]
    joints += [
        Revolute("big_end", "arm3", (0.0, 0.0), "rod", (-1.0, 0.0)),
        Revolute("small_end", "rod", (1.0, 0.0), "slider", (0.0, 0.0)),
        Translational("guide", "slider", (0.0, 0.0), (0.0, 1.0), GROUND, (6.0, 0.0), (0.0, 1.0)),
    ]
    return Mechanism(
        bodies=tuple(bodies),
        joints=tuple(joints),
        contacts=tuple(contacts),
        forces=(Torque("drive", "cam0", torque=_TORQUE),),
        held=("cam0.angle",),
        settings=Settings(baumgarte_alpha=0.0, baumgarte_beta=0.0),
    )


@entry
def _repeat(block: Array, y: Array, dy: Array, count: int) -> None:
    """Evaluate the derivative `count` times, compiled, as the integrator does."""
    for _ in range(count):
        derivative(block, y, dy)
