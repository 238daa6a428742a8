"""The rows of a mechanism with its contact coordinates, as arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
from stated_joints import Rows

from mechanism_fmu.engine.constraints.textbook import textbook_rows
from mechanism_fmu.tables.layout import field_of
from mechanism_fmu.tables.sizes import sizes_of

Array = np.ndarray[Any, Any]


def evaluated_rows(block: Array, q: Array, qd: Array, time: float) -> Rows:
    """All rows at coordinates q = (those of the bodies, contact coordinates) and their rates; a copy."""
    write_state(block, q, qd)
    textbook_rows(block, time)
    return written_rows(block, 0, sizes_of(block)["joint_rows"] + sizes_of(block)["contact_rows"])


def write_state(block: Array, q: Array, qd: Array) -> None:
    """Write coordinates and rates to where the engine reads them."""
    n = sizes_of(block)["coordinates"]
    field_of(block, "y_end")[:] = [*q[:n], *qd[:n], 0.0, 0.0, *q[n:]]
    field_of(block, "alpha_rate")[:] = qd[n:]


def written_rows(block: Array, first: int, count: int) -> Rows:
    """Some rows as they stand, without the columns of the ground; a copy."""
    n = sizes_of(block)["coordinates"]
    fields = ("residual", "residual_rate", "gamma", "nu", "jacobian")
    phi, rate, gamma, nu, jacobian = (field_of(block, name)[first : first + count].copy() for name in fields)
    return Rows(phi, rate, gamma, nu, np.delete(jacobian, slice(n, n + 3), axis=1))
