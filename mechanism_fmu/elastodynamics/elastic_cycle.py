"""The equations of a bending linkage over one turn: M u'' + C u' + K u = p, all periodic."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .fourier import FloatArray, resampled


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
        """The same cycle at `count` times, by the trigonometric series through the samples."""
        return ElasticCycle(
            self.period,
            *(resampled(part, count) for part in (self.mass, self.damping, self.stiffness, self.load)),
        )

    def faster(self, factor: float) -> ElasticCycle:
        """The cycle at `factor` times the speed: a period so much shorter, and a load of the square.

        That holds where only inertia loads the linkage, and it turns in the same way; K, and C for the same ratios, are
        those of the positions.

        Raises:
            ValueError: the factor is not positive and finite.
        """
        if not 0.0 < factor < np.inf:
            raise ValueError(f"the speed is {factor:g} times as high, but that must be positive and finite.")
        return replace(self, period=self.period / factor, load=self.load * factor**2)

    def size(self, u: FloatArray) -> float:
        """Root of the largest u^T K u of the cycle, for u of shape (T, n): it counts lengths and angles alike."""
        with np.errstate(invalid="ignore"):
            return float(np.sqrt(np.max(np.einsum("ta,tab,tb->t", u, self.stiffness, u))))

    def static(self) -> FloatArray:
        """Quasi-static deviation K^-1 p, shape (T, n): Case 2."""
        return np.asarray(np.linalg.solve(self.stiffness, self.load[..., None])[..., 0])
