"""Case 3: the equations of a bending linkage over one turn, M u'' + C u' + K u = p, and its natural frequencies."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
import numpy.typing as npt

from .cycle import Cycle
from .elements import FloatArray, LinkageError
from .fourier import resampled
from .structure.configuration import Configurations
from .structure.linkage import largest_stress, section_forces
from .structure.masses import consistent_load, consistent_mass, mass_matrix, system_forces

# The equations of a bending linkage over one turn: M u'' + C u' + K u = p, all periodic.


@dataclass(frozen=True)
class ElasticCycle:
    """Case 3: M(t) u'' + C(t) u' + K(t) u = p(t), at T even times of one period.

    u are the deviations of the system coordinates from the rigid motion; units are any that fit each other.

    Attributes:
        period: of the motion [s].
        mass: M, shape (n, n) or (T, n, n), symmetric, not negative.
        damping: C, shape (n, n) or (T, n, n).
        stiffness: K, shape (T, n, n), symmetric and positive.
        load: p, shape (T, n); of a linkage that only its inertia bends, -M a_rigid.

    Raises:
        ValueError: shapes do not fit, a value is not finite, or there are fewer than 8 samples.

    Source: docs/explanation/elastodynamics-dynamics.md, eqs (K1), (K2).
    """

    period: float
    mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray
    load: FloatArray

    def __post_init__(self) -> None:
        """Give every array its full shape, and refuse what does not fit."""
        samples, n = np.shape(self.load) if np.ndim(self.load) == 2 else (0, 0)
        if samples < 8 or n == 0:
            raise ValueError(
                f"the load has the shape {np.shape(self.load)}: give it at 8 or more even times of one period, in "
                "rows, for one or more coordinates, in columns."
            )
        if not 0.0 < self.period < np.inf:
            raise ValueError(f"the period is {self.period:g} s, but must be positive and finite.")
        for name in ("mass", "damping", "stiffness", "load"):
            array = np.asarray(getattr(self, name), dtype=float)
            if name != "load":
                if array.shape not in [(n, n), (samples, n, n)]:
                    raise ValueError(
                        f"the {name} has the shape {array.shape}, but must have {(samples, n, n)} or {(n, n)}, as the "
                        "load says."
                    )
                array = np.broadcast_to(array, (samples, n, n))
            if not np.all(np.isfinite(array)):
                raise ValueError(f"the {name} has values that are not finite; is the linkage in a dead centre there?")
            object.__setattr__(self, name, array)

    @property
    def samples(self) -> int:
        """Number T of times."""
        return len(self.load)

    def resampled(self, count: int) -> ElasticCycle:
        """The same cycle at `count` times, by the trigonometric series through the samples.

        Args:
            count: number of times, 8 or more.

        Raises:
            ValueError: there are fewer than 8.
        """
        return ElasticCycle(
            self.period,
            *(resampled(part, count) for part in (self.mass, self.damping, self.stiffness, self.load)),
        )

    def faster(self, factor: float) -> ElasticCycle:
        """The cycle at `factor` times the speed: a period so much shorter, and a load of the square.

        That holds where only inertia loads the linkage, and it turns in the same way; K, and C for the same ratios, are
        those of the positions.

        Args:
            factor: of the speed [-], > 0.

        Raises:
            ValueError: the factor is not positive and finite.
        """
        if not 0.0 < factor < np.inf:
            raise ValueError(f"the speed is {factor:g} times as high, but that must be positive and finite.")
        return replace(self, period=self.period / factor, load=self.load * factor**2)

    def size(self, u: FloatArray) -> float:
        """Root of the largest u^T K u of the cycle, for u of shape (T, n): it counts lengths and angles alike.

        Args:
            u: deviations at the T times, shape (T, n), in the units of the cycle.
        """
        with np.errstate(invalid="ignore"):
            return float(np.sqrt(np.max(np.einsum("ta,tab,tb->t", u, self.stiffness, u))))

    def static(self) -> FloatArray:
        """Quasi-static deviation K^-1 p, shape (T, n): Case 2."""
        return np.asarray(np.linalg.solve(self.stiffness, self.load[..., None])[..., 0])


# Instantaneous natural frequencies and shapes, and the damping that has a given ratio in each of them.

#: Of mu = 1 / omega^2, in parts of the largest, below which a mode has no mass: rounding makes no more.
_MASSLESS = 1e-14


@dataclass(frozen=True)
class InstantaneousModes:
    """Modes of the linkage frozen in each position: K shape = omega^2 M shape.

    Attributes:
        omega: shape (T, n), ascending [rad/s]; infinite where a mode has no mass.
        shapes: shape (T, n, n), mode k in `shapes[:, :, k]`, with shape^T K shape = 1 and shape^T M shape = 1/omega^2.

    Source: docs/explanation/elastodynamics-dynamics.md, eqs (K3), (K4).
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

        Args:
            ratio: zeta [-], 0 or more and below 1: one number, or shape (n,) in the order of the modes.

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

    Source: textbook: the generalised eigenvalue problem of free vibration; docs/explanation/elastodynamics-dynamics.md,
        eq (K3).
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


# Case 3: from the quasi-static cycle of a linkage to its equations of motion, and back to deflections and stresses.

#: What the end of a period may differ from its beginning, in parts of the largest value.
_CLOSED = 1e-6


class MassModel(Enum):
    """Where the mass of a member is.

    Attributes:
        LUMPED: half at each of its ends: the paper's Case 2 has masses at the joints, the halves are this project's. A
            rotation without a lumped mass has no inertia then.
        CONSISTENT: along it, swinging with the cubics in which it bends.
    """

    LUMPED = "lumped"
    CONSISTENT = "consistent"


def elastic_cycle(cycle: Cycle, damping_ratio: npt.ArrayLike, mass_model: MassModel = MassModel.LUMPED) -> ElasticCycle:
    """M u'' + C u' + K u = P over one period, with the loads, friction and inertia forces of the quasi-static cycle.

    Args:
        cycle: over one period, at even times, its end included: configurations and loads there are those of the start.
        damping_ratio: zeta of every mode, or of each of the m modes in ascending order [-].
        mass_model: of the members.

    Raises:
        LinkageError: the times are not even, or what the cycle ends with is not what it began with.
        ValueError: as of `InstantaneousModes.damping`.

    Source: docs/explanation/elastodynamics-dynamics.md, eqs (K1), (K2), (K4); Erdman, Sandor, Oakberg (1972) name a
        third case and do not describe it in the pages at hand.
    """
    configurations = cycle.configurations
    steps = np.diff(configurations.pose.time)
    if len(steps) == 0 or np.ptp(steps) > 1e-9 * steps.max():
        raise LinkageError("The times of a cycle must be even, e.g. numpy.linspace(0, period, 361).")
    load = system_forces(configurations, cycle.forces)
    if mass_model is MassModel.LUMPED:
        mass = mass_matrix(configurations)
    else:
        mass = consistent_mass(configurations)
        load = load + consistent_load(configurations)
    for name, values in (("stiffness", configurations.stiffness), ("load", load)):
        gap, most = np.abs(values[-1] - values[0]).max(), np.abs(values).max()
        if gap > _CLOSED * most:
            raise LinkageError(
                f"The {name} at the end of the cycle differs from that at its beginning by {gap:.3g}, of {most:.3g} at "
                "most: give one whole period, from its beginning to its end, of a motion that repeats."
            )
    stiffness = configurations.stiffness[:-1]
    mass = np.broadcast_to(mass, configurations.stiffness.shape)[:-1]
    damping = instantaneous_modes(stiffness, mass).damping(damping_ratio)
    return ElasticCycle(float(steps.sum()), mass, damping, stiffness, load[:-1])


def deflection_of(configurations: Configurations, displacement: FloatArray, place: str) -> FloatArray:
    """(delta_x, delta_y, rotation) of a place, shape (times, 3) [m, m, rad], by the displacements u.

    Args:
        configurations: the linkage along the motion.
        displacement: u, shape (times, m) [m, rad].
        place: its name, e.g. "arm.end".

    Raises:
        LinkageError: there is no such place.

    Source: docs/explanation/elastodynamics.md, section Flexibility approach: the rows of `Configurations.displacement`.
    """
    return np.asarray((configurations.displacement(place) @ displacement[:, :, None])[:, :, 0])


def stress_of(configurations: Configurations, displacement: FloatArray) -> FloatArray:
    """Largest stress in each element, shape (times, elements) [Pa], by the displacements u: f = F^-1 C u.

    Inertia forces between the ends of a member bend it further; that part, of lumped masses none, is not in it.

    Args:
        configurations: the linkage along the motion.
        displacement: u, shape (times, m) [m, rad].

    Source: Erdman, Sandor, Oakberg (1972), eq (1), solved for f; the stress as of `largest_stress`.
    """
    linkage = configurations.linkage
    deformation = (configurations.compatibility @ displacement[:, :, None])[:, :, 0]
    element_forces = np.asarray(np.linalg.solve(linkage.flexibility, deformation.T).T)
    return largest_stress(linkage, section_forces(linkage, element_forces))
