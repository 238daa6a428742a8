"""An arm and a strut in series as elastic bars, under forces and impacts on its tip: a ratchet's crank and pawl.

The drive stands still, the arm is a cantilever from its hinge, the strut hangs on the arm's pin and pushes a wheel at
the root of a tooth, where the tooth itself does not bend. Formulas: models/ratchet/README.md, "Crank and pawl give
way".
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Vectors = npt.NDArray[np.float64]

#: Of a uniform bar on a hinge whose inertia balances a force F across its tip, with the bending moment
#: F l x (1 - x) (1 - x / 2) at x l from the tip: the moment's largest value over F l, twice the energy over
#: F^2 l^3 / EI, the tip's deflection from the tangent at the hinge over F l^3 / EI, and the hinge's force over F.
LARGEST_MOMENT, ENERGY, DEFLECTION, HINGE = 1 / math.sqrt(27), 2 / 105, 7 / 120, 1 / 2


@dataclass(frozen=True)
class Bar:
    """A link of rectangular cross section: length l, width w, depth h [m], and flexibility along it, l / EA [m/N]."""

    length: float
    width: float
    depth: float
    axial: float

    @classmethod
    def cantilever(cls, length: float, width: float, depth: float, stiffness: float) -> Bar:
        """The bar whose end gives way across it by `stiffness` [N/m]: l^3 / 3 EI = (2 l / h)^2 l / EA."""
        return cls(length, width, depth, (depth / (2 * length)) ** 2 / stiffness)

    @property
    def bending(self) -> float:
        """The l^3 / EI of it [m/N]: three times the flexibility across it, as a cantilever."""
        return 12 * (self.length / self.depth) ** 2 * self.axial

    @property
    def stress(self) -> float:
        """Bending stress by a moment of 1 N m [1/m3]."""
        return 6 / (self.width * self.depth**2)


@dataclass(frozen=True)
class Teeth:
    """Teeth of a sawtooth wheel: radius of their roots [m]; pitch, angle of slope against radius, apex angle [rad]."""

    radius: float
    pitch: float
    slope_angle: float
    apex_angle: float


@dataclass(frozen=True)
class Pose:
    """Where the links stand, at some times.

    Attributes:
        time: [s], shape (times,).
        arm, strut: their directions, from hinge to pin and from pin to tip [rad], shape (times,).
        root: polar angle of the root at which the tip stands [rad], shape (times,).
    """

    time: Vectors
    arm: Vectors
    strut: Vectors
    root: Vectors


@dataclass(frozen=True)
class Loaded:
    """What gives way under one load.

    Attributes:
        time: of it [s].
        force: on the face [N].
        strut_deflection: of its tip, across it [m].
        strut_stress: by bending [Pa].
        strut_stretch: along it [m].
        arm_deflection: of its pin, across it [m].
        arm_stress: by bending [Pa].
        motion: by what the wheel turns [rad].
    """

    time: float
    force: float
    strut_deflection: float
    strut_stress: float
    strut_stretch: float
    arm_deflection: float
    arm_stress: float
    motion: float


@dataclass(frozen=True)
class SeriesLinks:
    """Arm and strut as bars, and the teeth that the strut's tip pushes."""

    arm: Bar
    strut: Bar
    teeth: Teeth

    def held(self, pose: Pose, push: Vectors, slope_force: Vectors, deflection: Vectors, stress: Vectors) -> Loaded:
        """Of times at which the tip pushes, that with the most lost motion; the forces act slowly.

        Args:
            pose: at those times, one or more.
            push: normal force on the face [N].
            slope_force: normal force on the slope [N].
            deflection: of the strut's tip across it [m].
            stress: by bending in the strut [Pa]. What bends it is known: the strut is a two-force member.
        """
        slope, face = self._normals(pose.root)
        force = push * face + slope_force * slope
        stretch, across, motion = self._lost(pose, force, force)
        worst = int(np.abs(motion).argmax())
        bent = float(deflection[worst]), float(stress[worst])
        return self._loaded(pose.time[worst], push[worst], bent, stretch[worst], across[worst], motion[worst])

    def struck(self, pose: Pose, closing_speed: Vectors, impulse: Vectors, restitution: float) -> Loaded:
        """Of the impacts on a face, that with the largest force.

        The force is that of a linear spring that takes up the energy m v^2 / 2 of the closing motion, F = v sqrt(k m)
        (as in W. Goldsmith, Impact, London 1960). m is the mass that the impact itself shows, impulse over closing
        speed and 1 + e; k is the stiffness of the strut along the face's normal, without arm and tooth, which would
        make the chain softer, and F smaller. Across the strut its inertia balances the force, as in a uniform bar.
        The arm takes no more than the closing energy gives: it and the lost motion are those of the chain of strut and
        arm, a smaller force in the same proportions on both.

        Args:
            pose: at the impacts, one or more.
            closing_speed: [m/s].
            impulse: on the face [N s].
            restitution: e [-].
        """
        _, face = self._normals(pose.root)
        along, across = _dot(face, _unit(pose.strut)), _dot(face, _left(pose.strut))
        flexibility = along**2 * self.strut.axial + across**2 * ENERGY * self.strut.bending
        blow = impulse / (1.0 + restitution)
        push = np.sqrt(closing_speed * blow / flexibility)
        side = push * across
        hinge = along * _unit(pose.strut) - HINGE * across * _left(pose.strut)  # by a force of 1 N
        give = _dot(hinge, _left(pose.arm)) ** 2 * self.arm.bending / 3
        give += _dot(hinge, _unit(pose.arm)) ** 2 * self.arm.axial
        chain = np.sqrt(closing_speed * blow / (flexibility + give))
        _, shift, motion = self._lost(pose, chain * face, chain * hinge)
        stretch = push * along * self.strut.axial
        worst = int(push.argmax())
        bent = (
            float(DEFLECTION * self.strut.bending * side[worst]),
            float(LARGEST_MOMENT * self.strut.length * self.strut.stress * side[worst]),
        )
        return self._loaded(pose.time[worst], push[worst], bent, stretch[worst], shift[worst], motion[worst])

    def _normals(self, root: Vectors) -> tuple[Vectors, Vectors]:
        """Normals of slope and face of the tooth whose root has these polar angles, shape (2, times) each."""
        slope = self.teeth.slope_angle
        lean = math.pi - slope - self.teeth.apex_angle - self.teeth.pitch
        return _unit(root + slope - math.pi / 2), _unit(root - math.pi / 2 - lean)

    def _lost(self, pose: Pose, tip: Vectors, pin: Vectors) -> tuple[Vectors, Vectors, Vectors]:
        """Stretch of the strut and shift of the arm's pin across it [m], and by what the wheel turns [rad].

        The tip stays at the root: r delta t.e = e.(shift of the pin) + stretch of the strut, with t the way of the root
        and e along the strut.
        """
        along, phi = _unit(pose.strut), pose.arm
        stretch = _dot(tip, along) * self.strut.axial
        across = _dot(pin, _left(phi)) * self.arm.bending / 3
        shift = across * _left(phi) + _dot(pin, _unit(phi)) * self.arm.axial * _unit(phi)
        lever = self.teeth.radius * _dot(_left(pose.root), along)
        return stretch, across, (_dot(shift, along) + stretch) / lever

    def _loaded(
        self, time: float, force: float, bent: tuple[float, float], stretch: float, across: float, motion: float
    ) -> Loaded:
        arm = self.arm
        stress = 3 * across / arm.bending * arm.length * arm.stress
        return Loaded(float(time), float(force), *bent, float(stretch), float(across), float(stress), float(motion))


def _unit(angle: Vectors) -> Vectors:
    return np.array([np.cos(angle), np.sin(angle)])


def _left(angle: Vectors) -> Vectors:
    return np.array([-np.sin(angle), np.cos(angle)])


def _dot(a: Vectors, b: Vectors) -> Vectors:
    return np.asarray((a * b).sum(axis=0))
