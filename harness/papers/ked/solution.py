"""Results of a turn of a bending linkage."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from mechanism_fmu.elastodynamics import Fluctuation, Flywheel, JointForce, Shaking

from ...run.checks import Check

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Bent:
    """The linkage as it is bent, quasi-statically or in its periodic motion.

    Attributes:
        deflection: (x, y, rotation) of the place, shape (angles, 3) [m, m, rad].
        stress: the largest in each member, shape (angles, members) [Pa].
        ends: (along, left, rotation) of start and end of each member, shape (angles, members, 6) [m, m, rad].
        largest_deviation: over the continuous turn [m].
        largest_at: the crank's angle there [rad].
        largest_stress: in each member, of all calculated angles, shape (members,) [Pa].
        stress_at: the crank's angle there, shape (members,) [rad].
    """

    deflection: FloatArray
    stress: FloatArray
    ends: FloatArray
    largest_deviation: float
    largest_at: float
    largest_stress: FloatArray
    stress_at: FloatArray

    @property
    def deviation(self) -> FloatArray:
        """How far the place is off its rigid path, shape (angles,) [m]."""
        return np.asarray(np.hypot(self.deflection[:, 0], self.deflection[:, 1]), dtype=np.float64)


@dataclass(frozen=True)
class Largest:
    """The largest magnitude of all calculated angles, which may be more than those of the tables.

    Attributes:
        value: in the unit of the quantity.
        at: the crank's angle there [rad].
    """

    value: float
    at: float

    @property
    def degrees(self) -> float:
        """The crank's angle [deg]; a whole number is so, whatever the radians have lost."""
        return round(math.degrees(self.at), 9)


@dataclass(frozen=True)
class Rigid:
    """The rigid motion.

    Attributes:
        path: of the place, shape (angles, 2) [m].
        starts, ends: of each member, shape (angles, members, 2) [m].
        torque: on the crank, shape (angles,) [N m].
        fluctuation: of the torque.
        power_gap: the largest of the power balance, in parts of the largest power.
        shaking: force and moment on the frame, by its joints; rows are the angles.
        shaking_gap: how far off that is what Newton's laws make of the motion, in parts of the largest.
        joints: what they carry, and their friction; rows are the angles.
        largest_shaking: force [N] and moment [N m].
        largest_forces: in the joints, in their order [N].
        largest_friction: in the joints, in their order [N m of pins, N of sliders].
        lost_energy: by friction in each joint in a turn, in their order, shape (joints,) [J].
        flywheel: that was asked for; its speeds are those of the angles.
        flywheel_speeds: the least and the largest of all calculated angles [rad/s]; that of the crank without flywheel.
    """

    path: FloatArray
    starts: FloatArray
    ends: FloatArray
    torque: FloatArray
    fluctuation: Fluctuation
    power_gap: float
    shaking: Shaking
    shaking_gap: float
    joints: tuple[JointForce, ...]
    largest_shaking: tuple[Largest, Largest]
    largest_forces: tuple[Largest, ...]
    largest_friction: tuple[Largest, ...]
    lost_energy: FloatArray
    flywheel: Flywheel | None
    flywheel_speeds: tuple[float, float]

    @property
    def shaking_force(self) -> FloatArray:
        """How large the force on the frame is, shape (angles,) [N]."""
        return np.asarray(np.linalg.norm(self.shaking.force, axis=1), dtype=np.float64)

    @property
    def rubs(self) -> bool:
        """Whether any joint has friction."""
        return any(joint.friction.any() for joint in self.joints)


@dataclass(frozen=True)
class FedBack:
    """Elastic accelerations fed back into the inertia forces, from the quasi-static solution on.

    Attributes:
        converged: whether that has settled.
        rounds: how many there were.
        change: the least change of a round, in parts of the quasi-static deviation.
        largest_deviation: of the place then, of all calculated angles [m].
    """

    converged: bool
    rounds: int
    change: float
    largest_deviation: float


@dataclass(frozen=True)
class Solution:
    """A turn at constant speed.

    Attributes:
        speed: of the crank [rad/s].
        damping: ratio of every mode [1].
        place: whose path it is about, e.g. "arm.end".
        members: their names.
        angle: of the crank, ascending from 0 on [rad], shape (angles,).
        rigid, static, dynamic: the rigid motion, bent by its inertia, and bent in periodic motion.
        frequencies: of the linkage frozen at each angle, ascending, shape (angles, modes) [Hz]; infinite without mass.
        frequency_range: the least and the largest of all calculated angles, shape (modes, 2) [Hz].
        critical: speeds at which harmonic h of the crank meets mode i, shape (modes, harmonics) [rad/s].
        residual: what is left of the equations of the periodic motion.
        growth: of a disturbance of the periodic motion in a turn, its largest Floquet multiplier.
        feedback: the paper's way to that motion, as far as it goes.
        jump: what the largest step of friction from one angle to the next would bend the linkage by, in the same parts.
        notes: what is to be said of the calculation.
    """

    speed: float
    damping: float
    place: str
    members: tuple[str, ...]
    angle: FloatArray
    rigid: Rigid
    static: Bent
    dynamic: Bent
    frequencies: FloatArray
    frequency_range: FloatArray
    critical: FloatArray
    residual: float
    growth: float
    feedback: FedBack
    jump: float
    notes: tuple[str, ...]

    @property
    def degrees(self) -> FloatArray:
        """The crank's angles [deg]; whole numbers are so, whatever the radians have lost."""
        return np.round(np.degrees(self.angle), 9).astype(np.float64)

    @property
    def modes(self) -> int:
        """How many modes have a finite frequency at every angle."""
        return int(np.isfinite(self.frequencies).all(axis=0).sum())

    @property
    def rpm(self) -> float:
        """The speed in turns a minute."""
        return self.speed * 30 / math.pi


#: What is left of the power balance, and of the equations of the periodic motion, at most.
_POWER, _RESIDUAL = 1e-9, 1e-8
#: A disturbance of the periodic motion may grow in a turn by this at most, beside 1: without damping it stays as it is.
_GROWTH = 1e-6
#: By how much the two ways to the force on the frame may differ: the accelerations' series is through 360 angles.
_SHAKING = 1e-8


def solution_checks(found: Solution) -> tuple[Check, ...]:
    """Whether the calculation is consistent."""
    # a series cannot follow a jump at its very place: what the jump bends the linkage by may be left there
    most, where = max(_RESIDUAL, found.jump), ", but for the jumps of friction" if found.rigid.rubs else ""
    return (
        Check(
            "The power balance of the rigid motion closes",
            found.rigid.power_gap <= _POWER,
            f"largest gap {found.rigid.power_gap:.1e} of the largest power; limit {_POWER:g}",
        ),
        Check(
            "The forces in the joints of the frame add up to the shaking force and moment, -sum m a and -sum r x m a",
            found.rigid.shaking_gap <= _SHAKING,
            f"largest difference {found.rigid.shaking_gap:.1e} of the largest value; limit {_SHAKING:g}",
        ),
        Check(
            f"The periodic motion fulfils its equations at all angles{where}",
            found.residual <= most,
            f"{found.residual:.1e} of the motion is left; limit {most:.2g}",
        ),
        Check(
            "A disturbance of the periodic motion does not grow",
            found.growth <= 1.0 + _GROWTH,
            f"in a turn it becomes {found.growth:.3g} of what it was, the largest Floquet multiplier; limit 1",
        ),
    )
