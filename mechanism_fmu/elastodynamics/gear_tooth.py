"""A gear tooth as a short cantilever: compression at the contact, bending and shear."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np

from .elements import FloatArray, integral, tapered_cantilever


@dataclass(frozen=True)
class GearTooth:
    """A tooth from its root to the place where the mating tooth pushes, with flanks straight between the two.

    The gear body is rigid. For l of 0.75 h_0 to 3 h_0 and h_1 of h_0/2 to h_0, the deflection is up to 4 % and the
    rotation up to 5.5 % more than those of a plate of finite elements, clamped at its root so that it cannot warp;
    axial compression differs by 5 % at most, the whole along the normal of a flank by 10 %. The stress is plane: of
    teeth much wider than high, give E / (1 - nu^2) for E and nu / (1 - nu) for nu.

    Attributes:
        height: l, of the contact above the root, along the centre line [m].
        root_thickness: h_0, from flank to flank at the root [m].
        contact_thickness: h_1, from flank to flank at the contact [m].
        face_width: b, along the axis of the gear [m].
        young: E [Pa].
        poisson: nu [-], 0 to 0.5; of plane strain, up to 1.

    Raises:
        ValueError: a size is not positive and finite, or nu is outside 0 to 1.

    Source: Erdman, Sandor and Oakberg, "Analysis of Elastic Systems", last paragraph, in words only; the formulas are
        Timoshenko's beam and Hertz's contact.
    """

    height: float
    root_thickness: float
    contact_thickness: float
    face_width: float
    young: float
    poisson: float

    def __post_init__(self) -> None:
        """Refuse what cannot be a tooth."""
        for field in fields(self)[:-1]:
            value = getattr(self, field.name)
            if not 0.0 < value < math.inf:
                raise ValueError(f"the {field.name} of the tooth is {value:g}, but must be positive and finite.")
        if not 0.0 <= self.poisson <= 1.0:
            raise ValueError(f"Poisson's ratio of the tooth is {self.poisson:g}, but must lie between 0 and 1.")

    @property
    def length(self) -> float:
        """Length l of the beam [m]."""
        return self.height

    @property
    def breaks(self) -> tuple[float, ...]:
        """The flanks are straight all along."""
        return ()

    def area(self, x: FloatArray) -> FloatArray:
        """Area A [m2] at the distances `x` from the root [m], in its shape.

        Args:
            x: distances from the root [m], any shape.
        """
        return self.face_width * self._thickness(x)

    def second_moment(self, x: FloatArray) -> FloatArray:
        """Second moment I [m4] at the distances `x` from the root [m], in its shape.

        Args:
            x: distances from the root [m], any shape.
        """
        return self.face_width / 12.0 * self._thickness(x) ** 3

    def flexibility(self) -> FloatArray:
        """Axial, transverse, rotation of the section at the contact, shape (3, 3): bending and shear.

        With sigma = M y / I, equilibrium and flanks free of stress leave the shear stress

            tau = V p / (b h) + 3 M h' (1 - p) / (b h^2),    p = 3/2 (1 - (2 y / h)^2),    V = M',

        and so the shear energy per length (6/5 V^2 - 6/5 V M h'/h + 9/5 M^2 h'^2/h^2) / (2 G b h): of a uniform beam
        Timoshenko's, of a tapered one less, by a tenth of the whole deflection of a stubby tooth.
        """
        flexibility = tapered_cantilever(self, self.young)
        slope = (self.contact_thickness - self.root_thickness) / self.height

        def integrand(x: float) -> FloatArray:
            arm, h = self.height - x, float(self._thickness(np.array(x)))
            return np.array([1.0 / h, arm / h**2, 1.0 / h**2, arm**2 / h**3, arm / h**3, 1.0 / h**3])

        force, force_arm, mixed, arm_arm, arm_only, moment = integral(self, integrand)
        across = 1.2 * force + 1.2 * slope * force_arm + 1.8 * slope**2 * arm_arm
        both, turn = 0.6 * slope * mixed + 1.8 * slope**2 * arm_only, 1.8 * slope**2 * moment
        shear_modulus = self.young / (2.0 * (1.0 + self.poisson))
        flexibility[1:, 1:] += np.array([[across, both], [both, turn]]) / (shear_modulus * self.face_width)
        return flexibility

    def compression(self, half_contact: float) -> float:
        """How much nearer to the centre line the contact comes, by the force along its normal [m/N].

        (2 ln(2 d / a) - nu) / (pi E b), with the centre line d = h_1 / 2 below the flank. It depends on the
        half width a of Hertz's contact, which grows as the root of the force, so little that one a does for a cycle;
        `mechanism_fmu.stress.hertz_line_contact` has it.

        Args:
            half_contact: a [m].

        Raises:
            ValueError: a is not positive, or so wide that it is no contact on a flank any more.

        Source: K. L. Johnson, Contact Mechanics, Cambridge 1985, eq (5.57), for plane stress.
        """
        depth = 0.5 * self.contact_thickness
        if not 0.0 < half_contact < 0.5 * depth:
            raise ValueError(
                f"the half width of the contact is {half_contact:g} m, but must be positive and below a quarter of the "
                f"tooth's thickness there, {0.5 * depth:g} m."
            )
        return (2.0 * math.log(2.0 * depth / half_contact) - self.poisson) / (math.pi * self.young * self.face_width)

    def along_normal(self, pressure_angle: float, half_contact: float) -> float:
        """Flexibility of the contact along the line of action [m/N]: b^T F b + compression.

        The force pushes across the tooth by its cosine and towards the root by its sine, at half a thickness from the
        centre line, so b = (-sin a, cos a, h_1/2 sin a): towards the root it straightens the tooth again.

        Args:
            pressure_angle: between the force and the normal of the centre line [rad], towards the root.
            half_contact: half width of Hertz's contact [m].

        Raises:
            ValueError: as of `compression`.
        """
        s, c = math.sin(pressure_angle), math.cos(pressure_angle)
        force = np.array([-s, c, -0.5 * self.contact_thickness * s])
        return float(force @ self.flexibility() @ force) + self.compression(half_contact)

    def _thickness(self, x: FloatArray) -> FloatArray:
        return self.root_thickness + (self.contact_thickness - self.root_thickness) * x / self.height
