"""Materials of a beam."""

from __future__ import annotations

from dataclasses import dataclass

from .checks import require_within


@dataclass(frozen=True)
class Material:
    """A linear elastic material with modal damping.

    Attributes:
        youngs_modulus: E [Pa], 1 to 1e15.
        density: rho [kg/m3], 1e-3 to 1e6.
        damping_ratio: zeta [-] of every mode, 0 (undamped) to 0.99 (the response must oscillate).

    Raises:
        ValueError: when a value is outside its limits or not a number.
    """

    youngs_modulus: float
    density: float
    damping_ratio: float

    def __post_init__(self) -> None:
        """Refuse a value outside its limits."""
        require_within("Young's modulus", self.youngs_modulus, 1.0, 1e15, "Pa", "steel has 2.06e11")
        require_within("density", self.density, 1e-3, 1e6, "kg/m3", "steel has 7850")
        require_within("damping ratio", self.damping_ratio, 0.0, 0.99, "", "the mode must oscillate; steel has 0.03")


#: Steel; the damping ratio is the paper's (Pennestrì, Valentini, Vita, section 5), E and rho are handbook values.
STEEL = Material(youngs_modulus=2.06e11, density=7850.0, damping_ratio=0.03)
