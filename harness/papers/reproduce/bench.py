"""Shared data of several rows: the study, the ratchet at its impact, the path generator; and differences of numbers."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd

import build_fmu
from mechanism_fmu import codes
from mechanism_fmu.elastodynamics import Configurations, turn
from mechanism_fmu.kinematics.equations import Equations, Rows
from mechanism_fmu.model import Mechanism, PointLineContact
from mechanism_fmu.model.sawtooth import Sawtooth, sawtooth
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.stress import WedgeTooth

from ...fmu import Fmu
from ...run.experiment import Experiment, Run, perform
from ..study.study import Study, ratchet_study
from ..study.wheels import BASE_CASE, SLOPE_ANGLES_DEG, TOOTH_COUNTS, Wheel

FloatArray = npt.NDArray[np.float64]

#: Table 1 and section 5: d, a, b, r [m], L/h.
HINGES, CRANK, PAWL, RADIUS, SLOPE_RATIO = 0.130, 0.110, 0.100, 0.100, 1.115
#: Section 5: phi and psi at the start [rad].
PHI, PSI = math.radians(77), math.radians(75)
#: Its bodies.
PARTS = ("crank", "pawl", "wheel")
#: The first impact comes before this time [s].
AFTER_IMPACT = 1.2

#: nt and beta_0 [deg] of the twenty wheels; those that follow each other by nt, and by beta_0.
CASES = tuple((count, angle) for count in TOOTH_COUNTS for angle in SLOPE_ANGLES_DEG)
STEPS_OF_COUNT = tuple(((m, angle), (n, angle)) for angle in SLOPE_ANGLES_DEG for m, n in pairwise(TOOTH_COUNTS))
STEPS_OF_ANGLE = tuple(((count, a), (count, b)) for count in TOOTH_COUNTS for a, b in pairwise(SLOPE_ANGLES_DEG))


@dataclass(frozen=True)
class AtImpact:
    """The guided ratchet at its first impact, in the nine coordinates of its bodies.

    Attributes:
        time: t_I [s].
        q: coordinates, shape (9,).
        before, after: their rates just before and just after, as the engine has them, shape (9,).
        jacobian: A_21: rows that hold before the impact, then the face's, which it adds, shape (rows + 1, 9).
        mass: diagonal of M, shape (9,).
        gap: s at t_I, as the FMU gives it [m].
    """

    time: float
    q: FloatArray
    before: FloatArray
    after: FloatArray
    jacobian: FloatArray
    mass: FloatArray
    gap: float

    @property
    def approach(self) -> float:
        """(ds/dq) q' just before [m/s], negative."""
        return float(self.jacobian[-1] @ self.before)

    @property
    def jump(self) -> FloatArray:
        """Of the rates, as the engine has it, shape (9,)."""
        return self.after - self.before


@dataclass(frozen=True)
class AtAngle:
    """The four-bar path generator at one angle of its crank.

    Attributes:
        turn: whole turn that it is of.
        number: of the configuration in it.
        rows, columns: numbers of the paper's element coordinates and of the eight displacements of Case 2.
        b: B for these displacements, shape (8, 8).
        flexibility: F in the paper's order of coordinates, shape (8, 8).
        phi, coupler, psi: angles of crank, coupler and follower [rad].
    """

    turn: Configurations
    number: int
    rows: list[int]
    columns: list[int]
    b: FloatArray
    flexibility: FloatArray
    phi: float
    coupler: float
    psi: float


@dataclass
class Bench:
    """Shared calculations, made when a row first asks.

    Args:
        fmu: gives the ratchet's FMU.
        report: called with what is done and the fraction done, while the study runs.
        drawings: SVG texts by the names of their figures, as they are drawn.
    """

    fmu: Callable[[], Fmu]
    report: Callable[[str, float], None] = field(default=lambda _text, _done: None)
    drawings: dict[str, str] = field(default_factory=dict)

    @cached_property
    def study(self) -> Study:
        """All wheels of the paper, through the FMU."""
        return ratchet_study(self.fmu(), lambda n, of: self.report(f"Wheel {n} of {of} through the FMU", n / of))

    @cached_property
    def base(self) -> Wheel:
        """The wheel of the base case."""
        return self.wheel(*BASE_CASE)

    @property
    def struck(self) -> tuple[WedgeTooth, float]:
        """The tooth of the base case as a beam, and v_I [m/s]."""
        return self.base.tooth, self.base.impact_velocity

    def wheel(self, count: int, angle_deg: int) -> Wheel:
        """One of the study's wheels."""
        return next(w for w in self.study.wheels if (w.tooth_count, w.slope_angle_deg) == (count, angle_deg))

    @cached_property
    def stresses(self) -> dict[tuple[int, int], float]:
        """Sigma_max of each wheel [Pa], by nt and beta_0 [deg]."""
        return {case: self.wheel(*case).stress_max for case in CASES}

    def parameter(self, name: str, wheel: Wheel | None = None) -> float:
        """A parameter of the FMU, of a wheel of the study."""
        return float(self.study.parameters[name][self.study.wheels.index(wheel or self.base)])

    def run(self, stop_time: float, step: float, **values: float) -> Run:
        """A run of the ratchet's FMU with other values.

        Raises:
            FmuError: it fails.
        """
        run = perform(self.fmu(), Experiment(stop_time, step, values))
        if run.outcome.error is not None:
            raise run.outcome.error
        return run

    def first_impact(self, step: float = 0.4, **values: float) -> pd.Series:
        """The FMU's own record of the first impact, with other values and communication steps of `step` [s]."""
        return self.run(AFTER_IMPACT, step, **values).impacts.iloc[0]

    @cached_property
    def first_impacts(self) -> dict[tuple[int, int], pd.Series]:
        """The FMU's own record of the first impact of each wheel, by nt and beta_0 [deg]."""
        return {
            (count, angle): self.first_impact(tooth_count=count, tooth_slope_angle=math.radians(angle))
            for count, angle in CASES
        }

    @cached_property
    def ratchet(self) -> Mechanism:
        """The description of the base case."""
        return build_fmu.mechanism("ratchet")

    @cached_property
    def impact(self) -> AtImpact:
        """The base case at its first impact."""
        simulation = Simulation(self.ratchet)
        simulation.begin_step()
        simulation.go_on(AFTER_IMPACT, codes.STOP_AT_IMPACT)
        now = simulation.read()
        angles = [now[f"{part}_angle"] for part in PARTS]
        rates = [[now[f"impact_{part}_speed{end}"] for part in PARTS] for end in ("_before", "")]
        q = positions(angles)
        equations, closed = closed_ratchet(self.ratchet, q)
        # the face's row last: sorting keeps the order of the others
        order = sorted(range(len(equations.owners)), key=lambda k: equations.owners[k] == "face")
        return AtImpact(
            time=now["impact_time"],
            q=q,
            before=velocities(angles, rates[0]),
            after=velocities(angles, rates[1]),
            jacobian=equations.at(q, 0.0).jacobian[order],
            mass=mass_of(closed),
            gap=now["face_gap"],
        )

    @cached_property
    def start_rows(self) -> tuple[Rows, FloatArray, FloatArray]:
        """Of the base case at the start: rows of joints and slope, diagonal of M, F; shapes (7, ...), (9,), (9,)."""
        equations = Equations(self.ratchet, 0.0)
        # of all forces only the drive torque: the spring is relaxed
        return equations.at(equations.start, 0.0, np.zeros(9)), mass_of(self.ratchet), 1e-3 * np.eye(9)[2]

    @cached_property
    def path_generator(self) -> Configurations:
        """The four-bar path generator at each degree of a turn at 500 rpm, crank angle 0 first."""
        return turn(build_fmu.mechanism("four_bar_path_generator"), 500 * 2 * math.pi / 60, 360)

    def crank_at(self, degrees: int) -> AtAngle:
        """The path generator at an angle of its crank."""
        here = self.path_generator
        crank, coupler, rocker = (here.pose.position[:-1, here.pose.bodies.index(body), 2] for body in _BODIES)
        number = int(np.argmin(np.abs((crank - math.radians(degrees) + math.pi) % (2 * math.pi) - math.pi)))
        rows = [here.linkage.coordinates.index(name) for name in COORDINATES]
        columns = [here.coordinates.index(name) for name in PLACES]
        return AtAngle(
            turn=here,
            number=number,
            rows=rows,
            columns=columns,
            b=here.transfer[number][np.ix_(rows, columns)],
            flexibility=here.linkage.flexibility[np.ix_(rows, rows)],
            phi=float(crank[number]),
            coupler=float(coupler[number]),
            psi=float(rocker[number]),
        )


def tooth(count: int, angle_deg: float) -> Sawtooth:
    """The geometry of a wheel of the paper."""
    return sawtooth(count, math.radians(angle_deg), RADIUS, SLOPE_RATIO)


def mass_of(mechanism: Mechanism) -> FloatArray:
    """Diagonal of M."""
    return np.array([float(m) for b in mechanism.bodies for m in (b.mass, b.mass, b.inertia)])


def positions(angles: Sequence[float]) -> FloatArray:
    """Coordinates of crank, pawl and wheel from phi, gamma, psi, shape (9,)."""
    phi, gamma, psi = angles
    along = CRANK * math.cos(phi), CRANK * math.sin(phi)
    pawl = HINGES + along[0] + PAWL / 2 * math.cos(gamma), along[1] + PAWL / 2 * math.sin(gamma)
    return np.array([HINGES + along[0] / 2, along[1] / 2, phi, *pawl, gamma, 0.0, 0.0, psi])


def velocities(angles: Sequence[float], rates: Sequence[float]) -> FloatArray:
    """Their rates from those of the angles, shape (9,)."""
    (phi, gamma, _), (dphi, dgamma, dpsi) = angles, rates
    pin = -CRANK * math.sin(phi) * dphi, CRANK * math.cos(phi) * dphi
    pawl = pin[0] - PAWL / 2 * math.sin(gamma) * dgamma, pin[1] + PAWL / 2 * math.cos(gamma) * dgamma
    return np.array([pin[0] / 2, pin[1] / 2, dphi, *pawl, dgamma, 0.0, 0.0, dpsi])


def closed_ratchet(mechanism: Mechanism, q: FloatArray) -> tuple[Equations, Mechanism]:
    """The rows of the ratchet with slope and face closed, near q."""
    bodies = tuple(replace(b, start=tuple(q[3 * k : 3 * k + 3])) for k, b in enumerate(mechanism.bodies))
    contacts = tuple(replace(c, closed=True) if isinstance(c, PointLineContact) else c for c in mechanism.contacts)
    closed = replace(mechanism, bodies=bodies, contacts=contacts, held=())
    return Equations(closed, 0.0), closed


#: The paper's order of element coordinates.
COORDINATES = (
    *("arm.axial", "arm.transverse", "arm.rotation", "crank_bar.axial", "crank_bar.transverse"),
    *("coupler_bar.rotation", "coupler_bar.axial", "rocker_bar.axial"),
)
#: Its system forces: at the path point, and in Case 2 also at the joints.
PLACES = (
    *("arm.end.x", "arm.end.y", "arm.end.angle", "arm.start.x", "arm.start.y", "arm.start.angle"),
    *("coupler_bar.end.x", "coupler_bar.end.y"),
)
_BODIES = ("crank", "coupler", "rocker")


# How far numbers are off each other, and Phi_q, nu and gamma off differences of Phi along a motion.

#: Central differences of eighth order: weights at +-1, ... +-4 steps, of the first and of the second derivative.
_FIRST = (4 / 5, -1 / 5, 4 / 105, -1 / 280)
_SECOND = (-205 / 72, 8 / 5, -1 / 5, 8 / 315, -1 / 560)
_STEP = 0.02


def off_by(found: Any, wanted: Any) -> float:
    """The largest deviation [1], relative to the largest number wanted; arrays of one shape."""
    return float(np.abs(np.asarray(found) - np.asarray(wanted)).max() / np.abs(np.asarray(wanted)).max())


def each_off_by(found: Any, wanted: Any) -> float:
    """The largest deviation [1], each number relative to the one wanted; arrays of one shape."""
    return float(np.abs(np.asarray(found) / np.asarray(wanted) - 1).max())


def off_by_scale(found: FloatArray, wanted: FloatArray) -> float:
    """The largest deviation [1] of a matrix of mixed units, each entry in parts of the roots of both diagonal ones."""
    scale = np.sqrt(np.outer(wanted.diagonal(), wanted.diagonal()))
    return off_by(found / scale, wanted / scale)


def first_derivative(function: Callable[[Any], Any], at: Any, step: float, axis: Any = 1) -> FloatArray:
    """At a place, by central differences of eighth order, along an axis if the place is an array of coordinates."""
    near = ((w, k * step * axis) for k, w in enumerate(_FIRST, 1))
    return np.asarray(sum(w * (function(at + d) - function(at - d)) for w, d in near) / step)


def second_derivative(function: Callable[[Any], Any], at: Any, step: float) -> FloatArray:
    """At a place, by central differences of eighth order."""
    around = sum(w * (function(at + k * step) + function(at - k * step)) for k, w in enumerate(_SECOND[1:], 1))
    return np.asarray((_SECOND[0] * function(at) + around) / step**2)


def joint_deviations(
    equations: Equations, q: FloatArray, rate: FloatArray, acceleration: FloatArray, time: float = 0.4
) -> tuple[float, float, float]:
    """How far Phi_q, nu and gamma are off the derivatives of Phi, in parts of the largest entry (1 at least).

    Along q(t) = q + q' t + q'' t^2 / 2: d Phi / dt = Phi_q q' - nu and d2 Phi / dt2 = Phi_q q'' - gamma.

    Args:
        equations: rows at any coordinates, whether they close or not.
        q: coordinates of the motion at the instant, shape (coordinates,).
        rate: their rates there, shape (coordinates,).
        acceleration: held during the motion, shape (coordinates,).
        time: of the drivers [s].
    """
    rows = equations.at(q, time, rate)

    def phi(place: FloatArray, when: float = time) -> FloatArray:
        return np.array(equations.at(place, when).residual)

    def along(t: float) -> FloatArray:
        return phi(q + rate * t + acceleration * t * t / 2, time + t)

    columns = [first_derivative(phi, q, _STEP, axis) for axis in np.eye(len(q))]
    return (
        _relative(np.transpose(columns), rows.jacobian),
        _relative(first_derivative(along, 0.0, _STEP), rows.jacobian @ rate - rows.nu),
        _relative(second_derivative(along, 0.0, _STEP), rows.jacobian @ acceleration - rows.gamma),
    )


def _relative(found: FloatArray, wanted: FloatArray) -> float:
    return float(np.abs(found - wanted).max() / max(1.0, np.abs(wanted).max()))
