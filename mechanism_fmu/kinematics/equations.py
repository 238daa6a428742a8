"""The constraint equations of a mechanism with all coordinates, and Newton's method for its positions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from ..engine import status
from ..model import Contact, Mechanism, compile_mechanism
from ..model.joints import Joint
from ..tables.layout import field_of, pack
from ..tables.sizes import sizes_of
from ..tolerances import CLOSED_WITHIN

# What can go wrong in kinematic analysis.


class KinematicsError(ValueError):
    """The mechanism cannot be analysed as asked; the message says why and what to do."""


class SingularConfigurationError(KinematicsError):
    """The rank of the constraint rows drops: the motion may go on along more than one branch, or not at all."""


FloatArray = np.ndarray[Any, np.dtype[np.float64]]


class Rows(NamedTuple):
    """Phi, nu, gamma, shape (rows,), and Phi_q, shape (rows, coordinates): Phi_q qd = nu, Phi_q qdd = gamma."""

    residual: FloatArray
    nu: FloatArray
    gamma: FloatArray
    jacobian: FloatArray


class Equations:
    """The rows of all joints and closed contacts, by the engine (`mechanism_fmu.engine.constraints.textbook`).

    Args:
        mechanism: its start guess is where assembly begins.
        time: of the assembly [s].

    Attributes:
        coordinates: names: "<body>.x", ".y" and ".angle" of each body in turn, then "<contact>.alpha_i" and ".alpha_j".
        angular: which coordinates are angles, shape (coordinates,).
        rows: names: "<part>", or "<part>[k]" where a part has several.
        owners: the part of each row.
        driving: which rows are those of drivers, shape (rows,).
        start: coordinates that close the rows at `time`, shape (coordinates,).
        size: the longest lever arm [m], 1 when there is none: the size of the mechanism as its rows see it.

    Raises:
        MechanismError: a part of the mechanism cannot be right.
        KinematicsError: the rows cannot be closed from the start guess; the message says what is left open.
    """

    def __init__(self, mechanism: Mechanism, time: float) -> None:
        tables = compile_mechanism(mechanism)
        self._block = pack(tables)
        self._bodies = 3 * len(mechanism.bodies)
        sizes = sizes_of(self._block)
        self._alphas = slice(sizes["y_alpha"], sizes["y_own"])
        names = [f"{body.name}.{c}" for body in mechanism.bodies for c in ("x", "y", "angle")]
        for contact in mechanism.contacts:
            pairs = zip(("alpha_i", "alpha_j"), contact.profiles, strict=True)
            names += [f"{contact.name}.{name}" for name, profile in pairs if profile is not None]
        self.coordinates = tuple(names)
        first = np.cumsum([0, *(joint.rows for joint in mechanism.joints)]).tolist()
        parts: list[tuple[Joint | Contact, int]] = list(zip(mechanism.joints, first, strict=False))
        parts += [
            (contact, tables.joint_rows + int(row))
            for contact, row in zip(mechanism.contacts, tables.contact_row_first, strict=True)
            if contact.enabled > 0.5 and contact.closed > 0.5 and contact.closed_while is None
        ]
        each = [(part, row, k) for part, row in parts for k in range(part.rows)]
        self._selected = [row + k for _, row, k in each]
        self.rows = tuple(f"{part.name}[{k + 1}]" if part.rows > 1 else part.name for part, _, k in each)
        self.owners = tuple(part.name for part, _, _ in each)
        self.driving = np.array([getattr(part, "motion", None) is not None for part, _, _ in each], dtype=bool)
        self.start = self._assembled(time)
        self.size = self._longest_lever(time)
        self.angular = np.array([not name.endswith((".x", ".y")) for name in names], dtype=bool)
        self._columns = np.where(self.angular, 1.0 / self.size, 1.0)

    def _assembled(self, time: float) -> FloatArray:
        from ..engine.starting.begin import assemble_at  # compiled just in time: what only describes needs none of it

        outcome = assemble_at(self._block, float(time))
        y = field_of(self._block, "y_end")
        q = np.concatenate([y[: self._bodies], y[self._alphas]])
        if outcome != status.OK:
            left = np.abs(self.at(q, time).residual)
            worst = ", ".join(
                f"{self.rows[k]} by {left[k]:.4g}" for k in np.argsort(-left)[:4] if left[k] > SHOWN * left.max()
            )
            raise KinematicsError(
                f"The mechanism cannot be assembled at t = {time:g} s from its start guess. Left open: {worst} "
                "(m, or rad). Give other lengths, or a better start guess for the bodies; of drivers, see that they "
                "do not contradict each other."
            )
        return q

    def _longest_lever(self, time: float) -> float:
        jacobian = np.abs(self.at(self.start, time).jacobian[:, : self._bodies])
        along = np.maximum(jacobian[:, 0::3], jacobian[:, 1::3]).max(axis=1, initial=0.0)
        turning = jacobian[:, 2::3].max(axis=1, initial=0.0)
        levers = turning[along > 0.0] / along[along > 0.0]
        return float(levers.max(initial=0.0)) or 1.0

    def balanced(self, jacobian: FloatArray) -> FloatArray:
        """Phi_q, of shape (rows, coordinates), with angles as lengths on the longest lever arm, and rows of length 1.

        So neither the size of the mechanism nor the units of its rows have a say in how near to each other they are.
        """
        rows = jacobian * self._columns
        lengths = np.linalg.norm(rows, axis=1)
        balanced: FloatArray = rows / np.where(lengths > 0.0, lengths, 1.0)[:, None]
        return balanced

    def solved(self, jacobian: FloatArray, right: FloatArray, part: float) -> tuple[FloatArray, FloatArray]:
        """The change of the coordinates, as small as can be as `balanced` measures it, for which Phi_q dq = right.

        Of Phi_q, shape (rows, coordinates), and right, shape (rows,); and what each balanced row is off, shape (rows,)
        [m]. Singular values below this `part` of the largest one count as zero.
        """
        rows = jacobian * self._columns
        lengths = np.linalg.norm(rows, axis=1)
        lengths = np.where(lengths > 0.0, lengths, 1.0)
        rows, right = rows / lengths[:, None], right / lengths
        change: FloatArray = np.asarray(np.linalg.lstsq(rows, right, rcond=part)[0], dtype=np.float64)
        return change * self._columns, rows @ change - right

    def most_open(self, residual: FloatArray, jacobian: FloatArray, q: FloatArray) -> float:
        """The most that a row is off, over what it changes by where the coordinates move by the mechanism's size.

        Of the residual, shape (rows,), and Phi_q, shape (rows, coordinates), at coordinates q; infinite when one is no
        number. Far from the origin, where places are rounded, the size is a part of how far.
        """
        size = max(self.size, _FAR * float(np.abs(q[~self.angular]).max(initial=0.0)))
        change = size * np.abs(jacobian * self._columns).max(axis=1, initial=0.0)
        left = np.abs(residual) / np.where(change > 0.0, change, size)
        return float(left.max(initial=0.0)) if np.isfinite(left).all() else np.inf

    def as_lengths(self, step: FloatArray) -> FloatArray:
        """A change of the coordinates, shape (coordinates,), with angles measured as `balanced` does [m]."""
        lengths: FloatArray = step / self._columns
        return lengths

    def from_lengths(self, step: FloatArray) -> FloatArray:
        """A change of the coordinates [m, rad] from what `as_lengths` made of it, shape (coordinates,)."""
        change: FloatArray = step * self._columns
        return change

    def at(self, q: FloatArray, time: float, qd: FloatArray | None = None) -> Rows:
        """The rows at coordinates q, rates qd (zero when left out), both of shape (coordinates,), and `time` [s]."""
        rates = np.zeros_like(q) if qd is None else qd
        y = field_of(self._block, "y_end")
        n = self._bodies
        y[:n], y[n : 2 * n] = q[:n], rates[:n]
        y[self._alphas] = q[n:]
        field_of(self._block, "alpha_rate")[:] = rates[n:]
        from ..engine.constraints.textbook import textbook_rows

        textbook_rows(self._block, float(time))
        residual, rate, gamma, jacobian = (
            field_of(self._block, name)[self._selected] for name in ("residual", "residual_rate", "gamma", "jacobian")
        )
        jacobian = np.hstack([jacobian[:, :n], jacobian[:, n + 3 :]])
        return Rows(residual, jacobian @ rates - rate, gamma, jacobian)


# Newton's method for the position rows.

_STEPS = 40
#: This part of the distance from the origin is a size at least: a row is then closed to 1000 times its rounding.
_FAR = 2.0**-12
#: Of rows that stay open, those are named that are off by more than this part of the worst one.
SHOWN = 1e-3


def close(equations: Equations, q: FloatArray, time: float) -> tuple[FloatArray, float]:
    """Coordinates near q that close all rows at `time` [s], shape (coordinates,), and the largest row left open."""

    def rows_at(q: FloatArray) -> tuple[FloatArray, FloatArray]:
        rows = equations.at(q, time)
        return rows.residual, rows.jacobian

    return newton(equations, rows_at, q)


def newton(
    equations: Equations, rows_at: Callable[[FloatArray], tuple[FloatArray, FloatArray]], q: FloatArray
) -> tuple[FloatArray, float]:
    """Where the rows vanish near q, by steps of least length, and the most that is left of one (see `most_open`).

    `rows_at` gives them, shape (rows,), and their derivatives, shape (rows, coordinates). After they are closed one
    more step is taken: it takes away what rounding allows.
    """
    best, least = q, np.inf
    for _ in range(_STEPS):
        residual, jacobian = rows_at(q)
        left = equations.most_open(residual, jacobian, q)
        if not left < np.inf:
            break
        settled = least <= CLOSED_WITHIN
        if left < least:
            best, least = q, left
        if settled or left == 0.0:
            break
        q = q - equations.solved(jacobian, residual, 1e-8)[0]
    return best, least
