"""The constraint equations of a mechanism with all coordinates, contact coordinates among them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..engine import status
from ..engine.assembly import assemble_at
from ..engine.layout import field_of
from ..engine.pack import pack
from ..engine.textbook import textbook_rows
from ..model import Contact, Mechanism
from ..model.joints import Joint
from .errors import KinematicsError

FloatArray = np.ndarray[Any, np.dtype[np.float64]]


class Rows(NamedTuple):
    """Phi, nu, gamma, shape (rows,), and Phi_q, shape (rows, coordinates): Phi_q qd = nu, Phi_q qdd = gamma."""

    residual: FloatArray
    nu: FloatArray
    gamma: FloatArray
    jacobian: FloatArray


class Equations:
    """The rows of all joints and closed contacts, by the engine (`mechanism_fmu.engine.textbook`).

    Coordinates are (x, y, phi) of each body in turn, then the contact coordinates; both are named in `coordinates`, and
    the rows in `rows`, "<part>" or "<part>[k]" where a part has several.

    Raises:
        MechanismError: a part of the mechanism cannot be right.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        tables = mechanism.compile()
        self._block = pack(tables)
        self._bodies = 3 * len(mechanism.bodies)
        self.coordinates = tuple(f"{b.name}.{c}" for b in mechanism.bodies for c in ("x", "y", "angle"))
        for contact in mechanism.contacts:
            names = ("alpha_i", "alpha_j")
            profiles = zip(names, contact.profiles, strict=True)
            self.coordinates += tuple(f"{contact.name}.{name}" for name, profile in profiles if profile is not None)
        first = np.cumsum([0, *(joint.rows for joint in mechanism.joints)]).tolist()
        parts: list[tuple[Joint | Contact, int]] = list(zip(mechanism.joints, first, strict=False))
        parts += [
            (contact, tables.joint_rows + int(row))
            for contact, row in zip(mechanism.contacts, tables.contact_row_first, strict=True)
            if contact.enabled > 0.5 and contact.closed > 0.5 and contact.closed_while is None
        ]
        self._selected = [row + k for part, row in parts for k in range(part.rows)]
        self.rows = tuple(
            f"{part.name}[{k + 1}]" if part.rows > 1 else part.name for part, _ in parts for k in range(part.rows)
        )

    def assemble(self, time: float) -> FloatArray:
        """Coordinates that close the rows at `time` [s], from the bodies' start guess, shape (coordinates,).

        Raises:
            KinematicsError: they cannot be closed from there; the message says what is left open.
        """
        outcome = assemble_at(self._block, float(time))
        y = field_of(self._block, "y_end")
        q = np.concatenate([y[: self._bodies], y[2 * self._bodies + 2 :]])
        if outcome != status.OK:
            left = np.abs(self.at(q, time).residual)
            worst = ", ".join(f"{self.rows[k]} by {left[k]:.4g}" for k in np.argsort(-left)[:4] if left[k] > 0)
            raise KinematicsError(
                f"The mechanism cannot be assembled at t = {time:g} s from its start guess. Left open: {worst} "
                "(m, or rad). Give other lengths, or a better start guess for the bodies."
            )
        return q

    def at(self, q: FloatArray, time: float, qd: FloatArray | None = None) -> Rows:
        """The rows at coordinates q, rates qd (zero when left out), both of shape (coordinates,), and `time` [s]."""
        rates = np.zeros_like(q) if qd is None else qd
        y = field_of(self._block, "y_end")
        n = self._bodies
        y[:n], y[n : 2 * n] = q[:n], rates[:n]
        y[2 * n + 2 :] = q[n:]
        field_of(self._block, "alpha_rate")[:] = rates[n:]
        textbook_rows(self._block, float(time))
        residual, rate, gamma, jacobian = (
            field_of(self._block, name)[self._selected] for name in ("residual", "residual_rate", "gamma", "jacobian")
        )
        jacobian = np.hstack([jacobian[:, :n], jacobian[:, n + 3 :]])
        return Rows(residual, jacobian @ rates - rate, gamma, jacobian)
