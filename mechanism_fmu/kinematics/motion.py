"""Position, velocity and acceleration of a driven mechanism at given times."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ..model import Mechanism
from ..tolerances import CLOSED_WITHIN
from .equations import SHOWN, Equations, FloatArray, KinematicsError, SingularConfigurationError, close
from .mobility import independence, moving, rows_around

# Rates and accelerations in one position, where the rows determine them.

#: The configuration is singular when the least singular value of the balanced rows is below this: positions are then
#: right to about 1e-11 only, and velocities to about 1e-6.
SINGULAR_BELOW = 1e-5
#: The driver is at the end of its range when more than this part of nu points where the rows cannot follow.
_OUT_OF_REACH = 1e-3
#: Rates and accelerations agree with a row when they miss it by less than this part of the largest of them.
_AGREE = 1e-8
#: What moves by less than this part of the size of the mechanism in the time of the analysis stands still: a hundred
#: times the rounding of what drivers say.
_STILL = 1e-7
#: Singular values below this part of the largest one count as zero: redundant rows are as far off by rounding.
_RANK = 1e-12


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


def state_at(equations: Equations, q: FloatArray, time: float, span: float) -> State:
    """The state at `time` [s] in a position q, shape (coordinates,), that closes the rows.

    In an analysis that spans so many seconds: what would not move visibly in that time is rounding.

    Raises:
        KinematicsError: something is free, drivers contradict each other, or one is at the end of its range.
        SingularConfigurationError: the rank of the rows drops here.
    """
    rows = equations.at(q, time)
    balanced = equations.balanced(rows.jacobian)
    least = least_singular_value(balanced)
    if least < SINGULAR_BELOW:
        raise _undetermined(equations, q, time, balanced)
    still = _STILL * equations.size / span if span > 0.0 else 0.0
    bends = equations.as_lengths(equations.solved(rows.jacobian, rows.gamma, _RANK)[0])
    turns_back = math.sqrt(equations.size * float(np.abs(bends).max(initial=0.0)))  # where a driver stands
    qd = _solve(equations, rows.jacobian, rows.nu, time, "velocity", max(still, turns_back))
    gamma = equations.at(q, time, qd).gamma
    turns = float(np.square(equations.as_lengths(qd)).max(initial=0.0)) / equations.size
    slow = still / span if span > 0.0 else 0.0
    qdd = _solve(equations, rows.jacobian, gamma, time, "acceleration", max(turns, slow))
    return State(time, q, qd, qdd, balanced, least)


def _solve(
    equations: Equations, jacobian: FloatArray, right: FloatArray, time: float, what: str, terms: float
) -> FloatArray:
    """Rates or accelerations that agree with all rows, but for the rounding of these and of `terms` of such a size."""
    solution, off = equations.solved(jacobian, right, _RANK)
    left = np.abs(off)
    size = float(np.abs(equations.as_lengths(solution)).max(initial=0.0))
    if left.max(initial=0.0) > _AGREE * max(size, terms):
        worst = ", ".join(equations.rows[k] for k in np.argsort(-left)[:4] if left[k] > SHOWN * left.max())
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


# From one position of a driven mechanism to the next one of the same motion.

#: A step is right when Phi_q changes by less than this part of its least singular value: no singular configuration can
#: lie between, nor can the step end on another branch.
_MOST_CHANGE = 0.5
#: Or when the position changes by less than this part of it: what jumps then is the curvature of a profile.
_LEAST_MOVE = 0.01
#: In one step, no angle changes by more than this [rad]: after a whole turn Phi_q is the same again.
_MOST_TURN = 0.5
#: Steps are halved at most down to this part of the way.
_SHORTEST = 1e-14


def follow(equations: Equations, here: State, time: float, span: float) -> State:
    """The state at `time` [s], later than `here`, in an analysis that spans so many seconds.

    Raises:
        KinematicsError: as of `state_at`, or the rows cannot be closed.
        SingularConfigurationError: the motion comes to a singular configuration on the way.
    """
    shortest = _SHORTEST * (time - here.time)
    step = time - here.time
    while here.time < time:
        target = time if here.time + step >= time else here.time + step
        h = target - here.time
        q, left = close(equations, here.q + h * here.qd + 0.5 * h * h * here.qdd, target)
        if left <= CLOSED_WITHIN and _is_same_motion(equations, here, q, target):
            here = state_at(equations, q, target, span)
            step *= 2.0
        elif step > shortest:
            step *= 0.5
        else:
            raise _lost(equations, here, q, target)
    return here


def _is_same_motion(equations: Equations, here: State, q: FloatArray, time: float) -> bool:
    if np.abs((q - here.q)[equations.angular]).max(initial=0.0) > _MOST_TURN:
        return False
    rows = equations.balanced(equations.at(q, time).jacobian)
    least = min(here.least, least_singular_value(rows))
    if np.linalg.norm(rows - here.jacobian, 2) <= _MOST_CHANGE * here.least:
        return True
    return float(np.linalg.norm(equations.as_lengths(q - here.q))) <= _LEAST_MOVE * least * equations.size


def _lost(equations: Equations, here: State, q: FloatArray, time: float) -> KinematicsError:
    rows = equations.at(q, time)
    residual = np.abs(rows.residual)
    is_open = equations.most_open(rows.residual, rows.jacobian, q) > CLOSED_WITHIN
    worst = [equations.rows[k] for k in np.argsort(-residual)[:4] if is_open and residual[k] > SHOWN * residual.max()]
    what = f"{', '.join(worst)} stay open by {residual.max():.3g} (m, or rad)" if worst else "the next one is far away"
    return KinematicsError(
        f"Behind t = {here.time:.9g} s no position is found that goes on from there: {what}. A profile has an edge, "
        "or drivers ask for a position out of reach."
    )


@dataclass(frozen=True)
class KinematicMotion:
    """What a driven mechanism does.

    Attributes:
        coordinates: names of the columns, "<body>.x|y|angle" and "<contact>.alpha_i|alpha_j".
        time: shape (times,) [s].
        position, velocity, acceleration: q, qd, qdd, shape (times, coordinates) [m, rad and by s, by s2].

    Source: `analyse`.
    """

    coordinates: tuple[str, ...]
    time: FloatArray
    position: FloatArray
    velocity: FloatArray
    acceleration: FloatArray

    def of(self, coordinate: str) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Position, velocity and acceleration of one coordinate, each of shape (times,).

        Args:
            coordinate: its name, one of `coordinates`.

        Raises:
            KinematicsError: there is no such coordinate.
        """
        if coordinate not in self.coordinates:
            raise KinematicsError(f"There is no coordinate {coordinate!r}; there are: {', '.join(self.coordinates)}.")
        k = self.coordinates.index(coordinate)
        return self.position[:, k], self.velocity[:, k], self.acceleration[:, k]


def analyse(mechanism: Mechanism, times: Sequence[float] | FloatArray) -> KinematicMotion:
    """Position, velocity and acceleration at `times` [s], which increase: Phi = 0, Phi_q qd = nu, Phi_q qdd = gamma.

    The mechanism is assembled from its start guess at the first time, with nothing held but by its drivers; from then
    on the motion is followed, in smaller steps than those of `times` where it needs them. Rows may be redundant.

    Args:
        mechanism: whose values are plain numbers.
        times: [s], shape (times,), increasing.

    Raises:
        KinematicsError: drivers leave something free, contradict each other, or ask for what is out of reach.
        SingularConfigurationError: the motion comes to a configuration where the rank of the rows drops.
        MechanismError: a part of the mechanism cannot be right.

    Source: ME451 slides, after E. J. Haug, Computer Aided Kinematics and Dynamics: Phi = 0, Phi_q qd = nu, Phi_q qdd =
        gamma.
    """
    grid = np.asarray(times, dtype=float)
    if grid.ndim != 1 or len(grid) == 0 or not np.all(np.isfinite(grid)) or np.any(np.diff(grid) <= 0.0):
        raise KinematicsError("The times must be finite and increase; give at least one.")
    equations = Equations(replace(mechanism, held=()), grid[0])
    span = float(grid[-1] - grid[0])
    states = [state_at(equations, equations.start, grid[0], span)]
    for time in grid[1:]:
        states.append(follow(equations, states[-1], time, span))
    position, velocity, acceleration = (np.array([state[k] for state in states]) for k in (1, 2, 3))
    return KinematicMotion(equations.coordinates, grid, position, velocity, acceleration)
