"""Rates and accelerations in one position, where the rows determine them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .around import moving, rows_around
from .equations import Equations, FloatArray
from .errors import KinematicsError, SingularConfigurationError
from .rank import independence

#: The configuration is singular when the least singular value of the balanced rows is below this: positions are then
#: right to about 1e-11 only, and velocities to about 1e-6.
SINGULAR_BELOW = 1e-5
#: The driver is at the end of its range when more than this part of nu points where the rows cannot follow.
_OUT_OF_REACH = 1e-3


class State(NamedTuple):
    """Time [s], q, qd, qdd of shape (coordinates,), the balanced Phi_q, and its least singular value."""

    time: float
    q: FloatArray
    qd: FloatArray
    qdd: FloatArray
    jacobian: FloatArray
    least: float


def least_singular_value(rows: FloatArray) -> float:
    """Of balanced rows; 0 when they are too few to determine all coordinates."""
    if rows.shape[0] < rows.shape[1]:
        return 0.0
    return float(np.linalg.svd(rows, compute_uv=False)[-1])


def state_at(equations: Equations, q: FloatArray, time: float) -> State:
    """The state at `time` [s] in a position q, shape (coordinates,), that closes the rows.

    Raises:
        KinematicsError: something is free, drivers contradict each other, or one is at the end of its range.
        SingularConfigurationError: the rank of the rows drops here.
    """
    rows = equations.at(q, time)
    balanced = equations.balanced(rows.jacobian)
    least = least_singular_value(balanced)
    if least < SINGULAR_BELOW:
        raise _undetermined(equations, q, time, balanced)
    qd = _solve(equations, rows.jacobian, rows.nu, time, "velocity")
    gamma = equations.at(q, time, qd).gamma
    return State(time, q, qd, _solve(equations, rows.jacobian, gamma, time, "acceleration"), balanced, least)


def _solve(equations: Equations, jacobian: FloatArray, right: FloatArray, time: float, what: str) -> FloatArray:
    solution: FloatArray = np.asarray(np.linalg.lstsq(jacobian, right, rcond=1e-12)[0], dtype=np.float64)
    left = np.abs(jacobian @ solution - right)
    if left.max(initial=0.0) > 1e-8 * max(1.0, float(np.abs(right).max(initial=0.0))):
        worst = ", ".join(equations.rows[k] for k in np.argsort(-left)[:4] if left[k] > 1e-3 * left.max())
        raise KinematicsError(
            f"At t = {time:.9g} s no {what} agrees with all rows: {worst} differ by {left.max():.3g}. Drivers "
            "contradict each other; take one out, or let their motions agree at all times."
        )
    return solution


def _undetermined(equations: Equations, q: FloatArray, time: float, rows: FloatArray) -> KinematicsError:
    """Why the rows do not determine the motion: drivers are missing, one is at its limit, or the rank drops here."""
    around = [rows, *rows_around(equations, q, time)]
    ranks = [len(independence(one).independent) for one in around]
    free = rows.shape[1] - max(ranks)
    if free > 0:
        usual = [one for one, rank in zip(around, ranks, strict=True) if rank == max(ranks)]
        return KinematicsError(
            f"{free} degree{'' if free == 1 else 's'} of freedom {'is' if free == 1 else 'are'} not driven: "
            f"{', '.join(moving(equations, usual))} can move. Add {free} driver{'' if free == 1 else 's'}, or see with "
            "`mobility` which rows say the same."
        )
    nu = equations.at(q, time).nu
    last = np.linalg.svd(rows)[0][:, rows.shape[1] - 1]
    if abs(last @ nu) > _OUT_OF_REACH * np.linalg.norm(nu):
        names = ", ".join(name for name, drives in zip(equations.rows, equations.driving, strict=True) if drives)
        return KinematicsError(
            f"At t = {time:.6g} s a driver ({names}) comes to the end of its range: what follows is out of reach, and "
            "velocities grow without limit towards it. Let the driver turn back before, or drive another body."
        )
    return SingularConfigurationError(
        f"At t = {time:.6g} s the configuration is singular: the rank of the constraint rows drops from "
        f"{rows.shape[1]}, and the motion may go on along more than one branch, as that of a parallelogram that lies "
        "flat. Change lengths, add a joint that decides (as a third crank out of line does), or analyse the motion "
        "before and behind it apart."
    )
