"""All modes of contacts with dry friction at one instant, tried one after the other in plain numpy and scipy.

With G the accelerations by unit forces and c those without them, each contact is open (no force, g'' >= 0), slips
(g'' = 0, friction mu lambda_N against a slip that is known or begins), or sticks within its cone. The search goes
through all of them, contact by contact, and leaves a branch only where a linear program shows that nothing in it can
hold: it is complete. In an impact the same holds of impulses and rates.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from mechanism_fmu import codes
from mechanism_fmu.model import Mechanism
from mechanism_fmu.simulation import Simulation

Numbers = NDArray[np.float64]

OPEN, CLOSED, STICKS, FORWARDS, BACKWARDS = range(5)
#: Turns a direction by a quarter to the left.
QUARTER = np.array([[0.0, -1.0], [1.0, 0.0]])


class ContactProblem(NamedTuple):
    """Contacts that touch at one instant.

    Attributes:
        normal: rows of the gaps' rates in the rates of the bodies, shape (contacts, coordinates).
        tangent: likewise of the slip.
        inverse_mass: of each coordinate, shape (coordinates,) [1/kg, 1/(kg m2)].
        gap: accelerations of the gaps without any force, or rates less their targets, shape (contacts,).
        slip: accelerations of the slips, or rates.
        friction: coefficients.
        direction: 1.0 or -1.0 of a slip whose direction is known, 0.0 where it may stick or begin to slip either way.
    """

    normal: Numbers
    tangent: Numbers
    inverse_mass: Numbers
    gap: Numbers
    slip: Numbers
    friction: Numbers
    direction: Numbers


def solution_modes(problem: ContactProblem, slack: float = 1e-9) -> tuple[int, ...] | None:
    """Modes of all contacts that agree with finite forces, or None where there are none.

    Args:
        problem: of the instant.
        slack: by which conditions may be missed, beside the largest acceleration; a problem is only called unsolvable
            where it stays so with that.
    """
    count = len(problem.gap)
    rows = np.concatenate([problem.normal, problem.tangent])
    response = rows * problem.inverse_mass @ rows.T
    unit = max(float(np.abs(problem.gap).max()), float(np.abs(problem.slip).max()), 1e-300)
    force = max(float(np.diag(response).max()), 1e-300)
    left = np.concatenate([problem.gap, problem.slip]) / unit
    changes = response / force  # of gaps and slips by forces in units of unit / force
    loose = slack

    def fits(modes: tuple[int, ...]) -> bool:
        """Whether forces exist with these modes of the first contacts; the others need only not pull nor go in."""
        above: list[Numbers] = []
        least: list[float] = []
        bounds: list[tuple[float | None, float | None]] = [(0.0, None)] * count + [(None, None)] * count

        def at_least(row: Numbers, value: float) -> None:
            above.append(-row)
            least.append(loose - value)

        for k in range(count):
            normal, along = np.zeros(2 * count), np.zeros(2 * count)
            normal[k] = along[count + k] = 1.0
            mu = problem.friction[k]
            mode = modes[k] if k < len(modes) else None
            at_least(changes[k], -left[k])
            if mode is not None and mode != OPEN:
                at_least(-changes[k], left[k])
            if mode == OPEN:
                bounds[k] = bounds[count + k] = (0.0, 0.0)
            elif problem.direction[k] != 0.0:
                at_least(along + problem.direction[k] * mu * normal, 0.0)
                at_least(-along - problem.direction[k] * mu * normal, 0.0)
            elif mode in (FORWARDS, BACKWARDS):
                sign = 1.0 if mode == FORWARDS else -1.0
                at_least(along + sign * mu * normal, 0.0)
                at_least(-along - sign * mu * normal, 0.0)
                at_least(sign * changes[count + k], -sign * left[count + k])
            else:
                at_least(mu * normal - along, 0.0)
                at_least(mu * normal + along, 0.0)
                if mode == STICKS:
                    at_least(changes[count + k], -left[count + k])
                    at_least(-changes[count + k], left[count + k])
        found = linprog(np.zeros(2 * count), A_ub=np.array(above), b_ub=np.array(least), bounds=bounds, method="highs")
        return bool(found.status == 0)

    def search(modes: tuple[int, ...]) -> tuple[int, ...] | None:
        if not fits(modes):
            return None
        if len(modes) == count:
            return modes
        k = len(modes)
        known = problem.direction[k] != 0.0 or problem.friction[k] == 0.0
        for mode in (CLOSED, OPEN) if known else (STICKS, OPEN, FORWARDS, BACKWARDS):
            found = search((*modes, mode))
            if found is not None:
                return found
        return None

    return search(())


def problem_at(simulation: Simulation, mechanism: Mechanism) -> ContactProblem:
    """Return the problem of forces at the instant at which a motion of outlines of straight sides has been refused.

    Which contacts there are is what the engine has found; normals, slips, accelerations and directions are calculated
    here, from the poses and rates of the bodies. Free bodies only, with a corner against a side each.
    """
    bodies = mechanism.bodies
    gravity = np.array(mechanism.gravity or (0.0, 0.0))
    count, size = simulation.field("problem")[0], 3 * len(bodies)
    state = simulation.field("y_end")
    kind, data = simulation.field("feature_kind"), simulation.field("feature_data")
    table = {
        name: simulation.field(f"contact_{name}") for name in ("body_i", "body_j", "feature_i", "feature_j", "value")
    }
    found = []
    for contact in simulation.field("candidates")[:count]:
        ends = [(table["body_i"][contact], table["feature_i"][contact])]
        ends.append((table["body_j"][contact], table["feature_j"][contact]))
        if kind[ends[0][1]] != codes.VERTEX:
            ends.reverse()
        (corner_body, corner), (side_body, side) = ends
        assert kind[corner] == codes.VERTEX, "a corner"
        assert kind[side] == codes.SEGMENT, "against a side"
        rows = np.zeros((2, size))
        d, d_rate, d_acceleration = np.zeros(2), np.zeros(2), np.zeros(2)
        turn, spin = np.eye(2), 0.0
        for sign, body, feature in ((1.0, corner_body, corner), (-1.0, side_body, side)):
            place = data[feature, :2]
            if body * 3 < size:
                x, y, angle = state[3 * body : 3 * body + 3]
                u, v, w = state[size + 3 * body : size + 3 * body + 3]
                turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
                arm, spin = turn @ place, w
                d += sign * (np.array([x, y]) + arm)
                d_rate += sign * (np.array([u, v]) + w * QUARTER @ arm)
                d_acceleration += sign * (gravity - w * w * arm)
            else:
                turn, spin = np.eye(2), 0.0
                d += sign * place
        along = turn @ data[side, 2:4]
        gap, slip = [], []
        for axis, direction in enumerate((-QUARTER @ along, along)):
            turning = spin * QUARTER @ direction
            value = direction @ d_acceleration + 2.0 * turning @ d_rate - spin * spin * direction @ d
            (gap, slip)[axis].append(value)
            for sign, body, feature in ((1.0, corner_body, corner), (-1.0, side_body, side)):
                if body * 3 < size:
                    angle = state[3 * body + 2]
                    own = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
                    rows[axis, 3 * body : 3 * body + 2] = sign * direction
                    rows[axis, 3 * body + 2] = sign * direction @ QUARTER @ own @ data[feature, :2]
                    if sign < 0.0:
                        rows[axis, 3 * body + 2] += QUARTER @ direction @ d
        speed = along @ d_rate + spin * QUARTER @ along @ d
        known = 0.0 if abs(speed) < 1e-9 else float(np.sign(speed))
        found.append((rows[0], rows[1], gap[0], slip[0], table["value"][contact, codes.FRICTION], known))
    inverse = np.array([value for b in bodies for value in (1 / b.mass, 1 / b.mass, 1 / b.inertia)])
    normal, tangent, gaps, slips, friction, known_slips = (np.array(column) for column in zip(*found, strict=True))
    return ContactProblem(normal, tangent, inverse, gaps, slips, friction, known_slips)
