"""The four-bar path generator of Erdman, Sandor and Oakberg, written out by hand from the paper, one angle at a time.

Inch, pound-force, second. The coordinates are x, y, rotation of P, x, y, rotation of A, x, y of B, in the global frame.
It shares no code with `mechanism_fmu.elastodynamics` but the record of the result.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from mechanism_fmu.elastodynamics.elastic_cycle import ElasticCycle, instantaneous_modes

FloatArray = npt.NDArray[np.float64]

#: That of the oracle [in/s2]; the paper's table has 386.08858, which differs in the eighth digit.
GRAVITY = 9.80665 / 0.0254
GROUND, CRANK, COUPLER, FOLLOWER, ARM, ALPHA = 10.0, 4.0, 10.0, 8.0, 6.0, math.pi / 6
YOUNG, AREA, SECOND, WEIGHT = 30e6, 0.125, 0.25 * 0.5**3 / 12, 0.283


def pose(phi: FloatArray | float) -> tuple[FloatArray, FloatArray]:
    """Angles of coupler and follower [rad], by the law of cosines, open branch."""
    ax, ay = CRANK * np.cos(phi), CRANK * np.sin(phi)
    diagonal = np.hypot(GROUND - ax, ay)
    to_ground = np.arctan2(-ay, GROUND - ax)
    inner = np.arccos((COUPLER**2 + diagonal**2 - FOLLOWER**2) / (2 * COUPLER * diagonal))
    lam = to_ground + inner
    psi = np.arctan2(ay + COUPLER * np.sin(lam), ax + COUPLER * np.cos(lam) - GROUND)
    return lam, psi


def points(phi: FloatArray | float) -> FloatArray:
    """Coordinates of P, A, B (with the coupler's angle as rotation of P and of A), shape (T, 8)."""
    lam, psi = pose(phi)
    ax, ay = CRANK * np.cos(phi), CRANK * np.sin(phi)
    px, py = ax + ARM * np.cos(lam + ALPHA), ay + ARM * np.sin(lam + ALPHA)
    bx, by = GROUND + FOLLOWER * np.cos(psi), FOLLOWER * np.sin(psi)
    return np.stack([px, py, lam, ax, ay, lam, bx, by], axis=-1)


def accelerations(phi: FloatArray, speed: float) -> FloatArray:
    """Second derivative of `points` by time at constant crank speed, from the loop of complex numbers, shape (T, 8)."""
    lam, psi = pose(phi)
    crank, coupler, follower, arm = (
        length * np.exp(1j * angle)
        for length, angle in ((CRANK, phi), (COUPLER, lam), (FOLLOWER, psi), (ARM, lam + ALPHA))
    )

    def turned(rest: npt.NDArray[np.complex128]) -> tuple[FloatArray, FloatArray]:
        """The rates x of coupler and y of follower with `rest` + coupler x = follower y."""
        return (rest / follower).imag / -(coupler / follower).imag, (rest / coupler).imag / (follower / coupler).imag

    dlam, dpsi = turned(crank)
    ddlam, _ = turned(1j * crank + 1j * coupler * dlam**2 - 1j * follower * dpsi**2)
    at_a = -crank
    at_p = at_a + (1j * ddlam - dlam**2) * arm
    at_b = at_a + (1j * ddlam - dlam**2) * coupler
    columns = [at_p.real, at_p.imag, ddlam, at_a.real, at_a.imag, ddlam, at_b.real, at_b.imag]
    return speed**2 * np.stack(columns, axis=-1)


def flexibility() -> FloatArray:
    """Element flexibilities in the order of the paper's coordinates, shape (8, 8)."""
    ea, ei = YOUNG * AREA, YOUNG * SECOND
    arm, crank = [ARM / ea, ARM**3 / 3 / ei, ARM / ei], [CRANK / ea, CRANK**3 / 3 / ei]
    f = np.diag([*arm, *crank, COUPLER / 3 / ei, COUPLER / ea, FOLLOWER / ea])
    f[1, 2] = f[2, 1] = ARM**2 / 2 / ei
    return np.asarray(f)


def transfer(phi: float) -> FloatArray:
    """B for the global coordinates at one angle, shape (8, 8): the corrected eq (13), B's column resolved obliquely."""
    lam, psi = map(float, pose(phi))
    beta = lam + ALPHA
    m = np.array([-ARM * math.sin(beta), ARM * math.cos(beta), 1.0])
    N = m / (COUPLER * math.sin(psi - lam))
    rows: list[npt.ArrayLike] = [
        (math.cos(beta), math.sin(beta), 0.0),
        (-math.sin(beta), math.cos(beta), 0.0),
        (0.0, 0.0, 1.0),
        np.array([math.cos(phi), math.sin(phi), 0.0]) - N * math.cos(psi - phi),
        np.array([-math.sin(phi), math.cos(phi), 0.0]) - N * math.sin(psi - phi),
        m,
        -N * math.cos(psi - lam),
        N,
    ]
    B = np.zeros((8, 8))
    B[:, :3] = np.array([np.asarray(row) for row in rows])
    B[3:, 5] = B[3:, 2]  # A moment on the coupler does the same wherever it acts on it.
    B[3:5, 3:5] = [[math.cos(phi), math.sin(phi)], [-math.sin(phi), math.cos(phi)]]
    oblique = np.array([[math.cos(lam), math.cos(psi)], [math.sin(lam), math.sin(psi)]])
    along = np.zeros((8, 2))
    along[3:5, 0] = [math.cos(lam - phi), math.sin(lam - phi)]
    along[6, 0] = along[7, 1] = 1.0
    B[:, 6:] = along @ np.linalg.inv(oblique)
    return B


def masses() -> FloatArray:
    """Lumped masses: half of each link's at each end, and the disks, shape (8, 8)."""
    arm, crank, coupler, follower = (WEIGHT * AREA * length / 2 for length in (ARM, CRANK, COUPLER, FOLLOWER))
    at_p, at_a, at_b = 0.5 + arm, 0.1 + crank + coupler + arm, 0.1 + coupler + follower
    turn_p, turn_a = 0.5 * 0.5 * 0.75**2, 0.5 * 0.1 * 0.5**2
    return np.diag([at_p, at_p, turn_p, at_a, at_a, turn_a, at_b, at_b]) / GRAVITY


def stiffness(phi: FloatArray) -> FloatArray:
    """K = (B^T F B)^-1 at the angles `phi`, shape (T, 8, 8)."""
    f = flexibility()
    B = np.array([transfer(angle) for angle in phi])
    return np.linalg.inv(B.swapaxes(1, 2) @ f @ B)


def cycle(rpm: float, samples: int, ratio: float = 0.02) -> ElasticCycle:
    """Case 3 at constant speed: a turn with `ratio` of damping in every mode."""
    speed = rpm * math.pi / 30
    phi = np.asarray(2 * math.pi / samples * np.arange(samples))
    K, M = stiffness(phi), masses()
    C = instantaneous_modes(K, M).damping(ratio)
    return ElasticCycle(2 * math.pi / speed, M, C, K, -accelerations(phi, speed) @ M)
