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

Numbers = NDArray[np.float64]

OPEN, CLOSED, STICKS, FORWARDS, BACKWARDS = range(5)


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
