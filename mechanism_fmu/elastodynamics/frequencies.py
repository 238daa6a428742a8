"""Instantaneous natural frequencies and shapes, and the damping that has a given ratio in each of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .fourier import FloatArray

#: Of mu = 1 / omega^2, in parts of the largest, below which a mode has no mass: rounding makes no more.
_MASSLESS = 1e-14


@dataclass(frozen=True)
class InstantaneousModes:
    """Modes of the linkage frozen in each position: K shape = omega^2 M shape.

    Attributes:
        omega: shape (T, n), ascending [rad/s]; infinite where a mode has no mass.
        shapes: shape (T, n, n), mode k in `shapes[:, :, k]`, with shape^T K shape = 1 and shape^T M shape = 1/omega^2.
    """

    omega: FloatArray
    shapes: FloatArray

    @property
    def hertz(self) -> FloatArray:
        """Natural frequencies [Hz], shape (T, n)."""
        return self.omega / (2.0 * np.pi)

    def damping(self, ratio: npt.ArrayLike) -> FloatArray:
        """C, shape (T, n, n), with the damping `ratio` zeta [-] in every mode, one number or n of them.

        C = K Z diag(2 zeta / omega) Z^T K with the shapes Z: Z^T C Z = 2 zeta / omega, which is 2 zeta omega in shapes
        of unit mass. In another position the modes are others, and so is C. A mode without mass is not damped.

        Raises:
            ValueError: a ratio is negative or not below 1.
        """
        zeta = np.asarray(ratio, dtype=float)
        if not np.all((zeta >= 0.0) & (zeta < 1.0)):
            raise ValueError(f"the damping ratio is {zeta}, but must be 0 or more and below 1; 2 % is 0.02.")
        # Z^T K Z = 1, so K Z is the inverse of Z^T.
        left = np.linalg.inv(self.shapes).swapaxes(-1, -2)
        return np.asarray((left * (2.0 * zeta / self.omega)[:, None, :]) @ left.swapaxes(-1, -2))


def instantaneous_modes(stiffness: FloatArray, mass: FloatArray) -> InstantaneousModes:
    """Natural frequencies and shapes in each position.

    With K = L L^T the eigenvalues of L^-1 M L^-T are 1/omega^2: the low frequencies, which matter, come out best, and
    M may be singular.

    Args:
        stiffness: K, shape (T, n, n), symmetric and positive.
        mass: M, shape (n, n) or (T, n, n), symmetric, not negative.

    Raises:
        ValueError: K is not positive, or M negative, in some position.
    """
    try:
        root = np.linalg.cholesky(stiffness)
    except np.linalg.LinAlgError as error:
        raise ValueError(
            "the stiffness is not positive in every position: the linkage can move without bending, or is in a dead "
            "centre there."
        ) from error
    inverse = np.linalg.inv(root)
    mu, vectors = np.linalg.eigh(inverse @ mass @ inverse.swapaxes(-1, -2))
    mu, vectors = mu[:, ::-1], vectors[:, :, ::-1]
    least = _MASSLESS * np.abs(mu).max(axis=1, keepdims=True)
    if np.any(mu < -least):
        position = int(np.argmin(np.min(mu / least, axis=1)))
        raise ValueError(f"the mass matrix is not one in position {position}: some motion has a negative mass there.")
    with np.errstate(divide="ignore"):
        omega = np.where(mu > least, 1.0 / np.sqrt(np.maximum(mu, 0.0)), np.inf)
    return InstantaneousModes(omega, inverse.swapaxes(-1, -2) @ vectors)
