"""Position, velocity and acceleration of a driven mechanism at given times."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..model import Mechanism
from .equations import Equations, FloatArray
from .errors import KinematicsError, SingularConfigurationError
from .rank import independence
from .solve import NEWTON, close

#: The rows are about to depend on each other when their least singular value (rows of length 1) is below this.
_SINGULAR_BELOW = 1e-7


@dataclass(frozen=True)
class KinematicMotion:
    """What a driven mechanism does.

    Attributes:
        coordinates: names of the columns, "<body>.x|y|angle" and "<contact>.alpha_i|alpha_j".
        time: shape (times,) [s].
        position, velocity, acceleration: q, qd, qdd, shape (times, coordinates) [m, rad and by s, by s2].
    """

    coordinates: tuple[str, ...]
    time: FloatArray
    position: FloatArray
    velocity: FloatArray
    acceleration: FloatArray

    def of(self, coordinate: str) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Position, velocity and acceleration of one coordinate, each of shape (times,).

        Raises:
            KinematicsError: there is no such coordinate.
        """
        if coordinate not in self.coordinates:
            raise KinematicsError(f"There is no coordinate {coordinate!r}; there are: {', '.join(self.coordinates)}.")
        k = self.coordinates.index(coordinate)
        return self.position[:, k], self.velocity[:, k], self.acceleration[:, k]


def analyse(mechanism: Mechanism, times: Sequence[float] | FloatArray) -> KinematicMotion:
    """Position, velocity and acceleration at `times` [s], which increase: Phi = 0, Phi_q qd = nu, Phi_q qdd = gamma.

    The mechanism is assembled from its start guess at the first time; from then on each position is sought where the
    last one leads. Rows may be redundant.

    Raises:
        KinematicsError: drivers leave something free, contradict each other, or no position exists at a time.
        SingularConfigurationError: at one of the times, or between two of them, the rank of the rows drops.
        MechanismError: a part of the mechanism cannot be right.
    """
    equations = Equations(mechanism)
    grid = np.asarray(times, dtype=float)
    if grid.ndim != 1 or len(grid) == 0 or not np.all(np.isfinite(grid)) or np.any(np.diff(grid) <= 0.0):
        raise KinematicsError("The times must be finite and increase; give at least one.")
    shape = (len(grid), len(equations.coordinates))
    position, velocity, acceleration = np.empty(shape), np.empty(shape), np.empty(shape)
    q = equations.assemble(grid[0])
    last_sign, last_rows = 0.0, [-1]
    for k, time in enumerate(grid):
        if k > 0:
            h = time - grid[k - 1]
            q = q + h * velocity[k - 1] + 0.5 * h * h * acceleration[k - 1]
        q, left = close(equations, q, time)
        if not left <= NEWTON.closed_within:
            raise _lost(equations, q, time, left)
        sign, rows_used = _orientation(equations, q, time)
        if rows_used == last_rows and last_sign * sign < 0.0:
            raise SingularConfigurationError(
                f"Between t = {grid[k - 1]:.9g} s and {time:.9g} s the mechanism passes a singular configuration: the "
                "rank of its constraint rows drops there, and it may go on along another branch. Change the lengths "
                "(equal cranks and couplers lie flat), or analyse the two parts apart."
            )
        last_sign, last_rows = sign, rows_used
        position[k] = q
        velocity[k] = _solve(equations.at(q, time).jacobian, equations.at(q, time).nu, time, "velocity")
        rows = equations.at(q, time, velocity[k])
        acceleration[k] = _solve(rows.jacobian, rows.gamma, time, "acceleration")
    return KinematicMotion(equations.coordinates, grid, position, velocity, acceleration)


def _orientation(equations: Equations, q: FloatArray, time: float) -> tuple[float, list[int]]:
    """The sign of the determinant of the independent rows, and these.

    It changes where the mechanism passes a singular configuration.

    Raises:
        KinematicsError: the rows leave something free, or are about to.
    """
    jacobian = equations.at(q, time).jacobian
    found = independence(jacobian)
    missing = jacobian.shape[1] - len(found.independent)
    if missing > 0:
        free = np.abs(np.linalg.svd(jacobian)[2][-missing:]).max(axis=0)
        moving = [name for name, size in zip(equations.coordinates, free, strict=True) if size > 1e-6]
        raise (SingularConfigurationError if len(equations.rows) >= jacobian.shape[1] else KinematicsError)(
            f"At t = {time:.9g} s the constraint rows have rank {len(found.independent)} for {jacobian.shape[1]} "
            f"coordinates: {', '.join(moving)} can move freely. Where that is so at all times, add a driver; where "
            "only here, the configuration is singular (as a parallelogram that lies flat): start away from it."
        )
    if found.least < _SINGULAR_BELOW:
        raise SingularConfigurationError(
            f"At t = {time:.9g} s the configuration is singular: the rows {', '.join(equations.rows)} are about to "
            f"depend on each other (least singular value {found.least:.3g}). Velocities have no sense there."
        )
    sign, _ = np.linalg.slogdet(jacobian[found.independent])
    return float(sign), found.independent


def _solve(jacobian: FloatArray, right: FloatArray, time: float, what: str) -> FloatArray:
    solution: FloatArray = np.asarray(np.linalg.lstsq(jacobian, right, rcond=1e-12)[0], dtype=np.float64)
    left = float(np.abs(jacobian @ solution - right).max(initial=0.0))
    if left > 1e-8 * max(1.0, float(np.abs(right).max(initial=0.0))):
        raise KinematicsError(
            f"At t = {time:.9g} s no {what} agrees with all rows ({left:.3g} is left): drivers contradict each "
            "other, or dependent rows do. Take out a driver."
        )
    return solution


def _lost(equations: Equations, q: FloatArray, time: float, left: float) -> KinematicsError:
    residual = np.abs(equations.at(q, time).residual)
    worst = [equations.rows[k] for k in np.argsort(-residual)[:3] if residual[k] > NEWTON.closed_within]
    least = independence(equations.at(q, time).jacobian).least
    kind = SingularConfigurationError if least < 1e-3 else KinematicsError
    return kind(
        f"At t = {time:.9g} s no position closes all rows: {', '.join(worst)} stay open by {left:.3g} (m, or rad), "
        f"least singular value {least:.3g}. The driver asks for a position out of reach, or past a singular "
        "configuration; or the times are too far apart to follow the motion."
    )
