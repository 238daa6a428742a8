"""How system forces become element forces: f = B P, from compatibility d = C u by virtual work, B = C^-T."""

from __future__ import annotations

import numpy as np

from .elements import FloatArray
from .errors import LinkageError

#: A configuration is refused where errors of the geometry come out this much larger in the forces.
_WORST_CONDITION = 1e10


def transfer_matrix(
    compatibility: FloatArray,
    flexibility: FloatArray,
    time: FloatArray,
    coordinates: tuple[str, ...],
    scale: FloatArray,
) -> FloatArray:
    """B, shape (times, n, m).

    Virtual work, P.u = f.d for all u, is C^T f = P: as many equations as displacements. With n = m, B = C^-T. With
    n > m the linkage is statically indeterminate, and f = B_0 P + B_1 X with C^T B_0 = 1 and C^T B_1 = 0: the n - m
    redundants X are those that leave no gap, B_1^T F f = 0.

    Args:
        compatibility: C, shape (times, n, m).
        flexibility: F, shape (n, n).
        time: of the configurations, shape (times,) [s], for messages.
        coordinates: names of the m displacements, for messages.
        scale: what makes lengths of the m displacements, shape (m,): 1, and a length [m] where they are rotations.

    Raises:
        LinkageError: the linkage can move although its driven or held coordinates stand still, always or in one
            configuration; the message says what moves.
    """
    n, m = compatibility.shape[1:]
    if n < m:
        raise LinkageError(
            f"{m} displacements are free, but members resist in {n} ways only: "
            f"{_moving(compatibility[0], coordinates)} can move although driven or held coordinates stand still. "
            "Hold or drive one more, or give a body members."
        )
    transfer = _inverse(compatibility) if n == m else _with_redundants(compatibility, flexibility)
    condition = np.linalg.norm(compatibility / scale, axis=(1, 2)) * np.linalg.norm(transfer * scale, axis=(1, 2))
    worst = int(np.argmax(np.where(np.isfinite(condition), condition, np.inf)))
    if not condition[worst] < _WORST_CONDITION:
        raise LinkageError(
            f"At t = {time[worst]:.9g} s members hold nothing: {_moving(compatibility[worst], coordinates)} can move "
            "although driven or held coordinates stand still (a toggle position, or a part that hangs on one pin). "
            "Leave this position out, or hold or drive what moves."
        )
    return transfer


def _inverse(compatibility: FloatArray) -> FloatArray:
    try:
        return np.swapaxes(np.linalg.inv(compatibility), 1, 2)
    except np.linalg.LinAlgError:
        singular: FloatArray = np.full_like(compatibility, np.nan)
        regular = np.linalg.matrix_rank(compatibility) == compatibility.shape[1]
        singular[regular] = np.swapaxes(np.linalg.inv(compatibility[regular]), 1, 2)
        return singular


def _with_redundants(compatibility: FloatArray, flexibility: FloatArray) -> FloatArray:
    m = compatibility.shape[2]
    orthogonal, triangle = np.linalg.qr(compatibility, mode="complete")
    first, redundant = orthogonal[:, :, :m], orthogonal[:, :, m:]
    try:
        statics = first @ np.swapaxes(np.linalg.inv(triangle[:, :m]), 1, 2)
    except np.linalg.LinAlgError:
        return np.full_like(compatibility, np.nan)
    gaps = np.swapaxes(redundant, 1, 2) @ flexibility
    closing: FloatArray = statics - redundant @ np.linalg.solve(gaps @ redundant, gaps @ statics)
    return closing


def _moving(compatibility: FloatArray, coordinates: tuple[str, ...]) -> str:
    """The displacements with the largest part in what deforms no member, as a list of names."""
    free = np.linalg.svd(compatibility, full_matrices=True)[2][-1]
    shares = np.abs(free) / np.abs(free).max()
    return ", ".join(coordinates[k] for k in np.argsort(-shares)[:4] if shares[k] > 1e-3)
