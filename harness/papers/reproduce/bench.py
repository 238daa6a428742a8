"""Shared data of several rows: the study, the ratchet at its impact, the path generator; and differences of numbers."""

from __future__ import annotations

import math
from collections.abc import Callable
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

from ...fmu import Fmu
from ...run.experiment import Experiment, Run, perform
from ..study.study import Study, ratchet_study
from ..study.wheels import BASE_CASE, SLOPE_ANGLES_DEG, TOOTH_COUNTS, Wheel

# What several rows need: the study of twenty wheels, the guided ratchet at its impact, the path generator.

FloatArray = npt.NDArray[np.float64]

#: Table 1 and section 5: d, a, b, r [m], L/h.
HINGES, CRANK, PAWL, RADIUS, SLOPE_RATIO = 0.130, 0.110, 0.100, 0.100, 1.115
#: Section 5: phi and psi at the start [rad].
PHI, PSI = math.radians(77), math.radians(75)
#: The first impact comes before this time [s].
AFTER_IMPACT = 1.2


@dataclass(frozen=True)
class AtImpact:
    """The guided ratchet at its first impact, in the nine coordinates of its bodies.

    Attributes:
        time: t_I [s].
        q: coordinates, shape (9,).
        before, after: their rates just before and just after, as the engine has them, shape (9,).
        rows: number of rows that hold before the impact; row `face` is added by it.
        jacobian: A_21: rows that hold, then the face's, shape (rows + 1, 9).
        mass: diagonal of M, shape (9,).
        gap: s at t_I, as the FMU gives it [m].
    """

    time: float
    q: FloatArray
    before: FloatArray
    after: FloatArray
    rows: int
    jacobian: FloatArray
    mass: FloatArray
    gap: float


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

    def wheel(self, count: int, angle_deg: int) -> Wheel:
        """One of the study's wheels."""
        return next(w for w in self.study.wheels if (w.tooth_count, w.slope_angle_deg) == (count, angle_deg))

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

    @cached_property
    def first_impacts(self) -> dict[tuple[int, int], pd.Series]:
        """The FMU's own record of the first impact of each wheel, by nt and beta_0 [deg]."""
        found = {}
        for wheel in self.study.wheels:
            case = wheel.tooth_count, wheel.slope_angle_deg
            run = self.run(AFTER_IMPACT, 0.4, tooth_count=case[0], tooth_slope_angle=math.radians(case[1]))
            found[case] = run.impacts.iloc[0]
        return found

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
        angles = [now[f"{part}_angle"] for part in ("crank", "pawl", "wheel")]
        rates = [[now[f"impact_{part}_speed{end}"] for part in ("crank", "pawl", "wheel")] for end in ("_before", "")]
        q = positions(angles)
        equations, closed = closed_ratchet(self.ratchet, q)
        jacobian = equations.at(q, 0.0).jacobian
        order = [k for k, owner in enumerate(equations.owners) if owner != "face"]
        order += [k for k, owner in enumerate(equations.owners) if owner == "face"]
        return AtImpact(
            time=now["impact_time"],
            q=q,
            before=velocities(angles, rates[0]),
            after=velocities(angles, rates[1]),
            rows=len(order) - 1,
            jacobian=jacobian[order],
            mass=mass_of(closed),
            gap=now["face_gap"],
        )

    @cached_property
    def start_rows(self) -> tuple[FloatArray, Rows, FloatArray, FloatArray]:
        """Of the base case at the start: q, rows of joints and slope, diagonal of M, F; shapes (9,), (7, ...)."""
        equations = Equations(self.ratchet, 0.0)
        q = equations.start
        force = np.zeros(9)
        force[2] = 1e-3  # the drive torque; the spring is relaxed
        return q, equations.at(q, 0.0, np.zeros(9)), mass_of(self.ratchet), force

    @cached_property
    def path_generator(self) -> Configurations:
        """The four-bar path generator at each degree of a turn at 500 rpm, crank angle 0 first."""
        return turn(build_fmu.mechanism("four_bar_path_generator"), 500 * 2 * math.pi / 60, 360)


def tooth(count: int, angle_deg: float) -> Sawtooth:
    """The geometry of a wheel of the paper."""
    return sawtooth(count, math.radians(angle_deg), RADIUS, SLOPE_RATIO)


def mass_of(mechanism: Mechanism) -> FloatArray:
    """Diagonal of M."""
    return np.array([float(m) for b in mechanism.bodies for m in (b.mass, b.mass, b.inertia)])


def positions(angles: Any) -> FloatArray:
    """Coordinates of crank, pawl and wheel from phi, gamma, psi, shape (9,)."""
    phi, gamma, psi = angles
    pin = HINGES + CRANK * math.cos(phi), CRANK * math.sin(phi)
    crank = HINGES + CRANK / 2 * math.cos(phi), CRANK / 2 * math.sin(phi), phi
    pawl = pin[0] + PAWL / 2 * math.cos(gamma), pin[1] + PAWL / 2 * math.sin(gamma), gamma
    return np.array([*crank, *pawl, 0.0, 0.0, psi])


def velocities(angles: Any, rates: Any) -> FloatArray:
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
    "arm.axial",
    "arm.transverse",
    "arm.rotation",
    "crank_bar.axial",
    "crank_bar.transverse",
    "coupler_bar.rotation",
    "coupler_bar.axial",
    "rocker_bar.axial",
)


#: Its system forces: at the path point, and in Case 2 also at the joints.
PLACES = (*(f"arm.end.{c}" for c in ("x", "y", "angle")), *(f"arm.start.{c}" for c in ("x", "y", "angle")))
PLACES += ("coupler_bar.end.x", "coupler_bar.end.y")


_BODIES = ("crank", "coupler", "rocker")


def at_angle(bench: Bench, degrees: int) -> tuple[int, FloatArray]:
    """Number of the configuration at an angle of the crank, and B for the eight displacements there, shape (8, 8)."""
    here = bench.path_generator
    crank = here.pose.position[:-1, here.pose.bodies.index("crank"), 2]
    number = int(np.argmin(np.abs((crank - math.radians(degrees) + math.pi) % (2 * math.pi) - math.pi)))
    rows = [here.linkage.coordinates.index(name) for name in COORDINATES]
    columns = [here.coordinates.index(name) for name in PLACES]
    return number, here.transfer[number][np.ix_(rows, columns)]


def angles_at(bench: Bench, number: int) -> tuple[float, float, float]:
    """Phi, lambda, psi [rad] of crank, coupler and follower."""
    position = bench.path_generator.pose.position[number, :, 2]
    phi, coupler, psi = (float(position[bench.path_generator.pose.bodies.index(b)]) for b in _BODIES)
    return phi, coupler, psi


# How far numbers are off each other, and Phi_q, nu and gamma off differences of Phi along a motion.

#: Central differences of eighth order: weights at +-1, ... +-4 steps, of the first and of the second derivative.
_FIRST = (4 / 5, -1 / 5, 4 / 105, -1 / 280)
_SECOND = (-205 / 72, 8 / 5, -1 / 5, 8 / 315, -1 / 560)
_STEP = 0.02


def off_by(found: Any, wanted: Any) -> float:
    """The largest deviation [1], relative to the largest number wanted; arrays of one shape."""
    return float(np.abs(np.asarray(found) - np.asarray(wanted)).max() / np.abs(np.asarray(wanted)).max())


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

    def phi(place: FloatArray, when: float) -> FloatArray:
        return np.array(equations.at(place, when).residual)

    def along(t: float) -> FloatArray:
        return phi(q + rate * t + acceleration * t * t / 2, time + t)

    columns = [_first(lambda t, k=k: phi(q + t * np.eye(len(q))[k], time)) for k in range(len(q))]
    jacobian = _relative(np.transpose(columns), rows.jacobian)
    velocity = _relative(_first(along), rows.jacobian @ rate - rows.nu)
    second = _relative(_second(along), rows.jacobian @ acceleration - rows.gamma)
    return jacobian, velocity, second


def _first(function: object) -> FloatArray:
    f = function
    return np.asarray(
        sum(w * (f(k * _STEP) - f(-k * _STEP)) for k, w in enumerate(_FIRST, start=1)) / _STEP  # type: ignore[operator]
    )


def _second(function: object) -> FloatArray:
    f = function
    around = sum(w * (f(k * _STEP) + f(-k * _STEP)) for k, w in enumerate(_SECOND[1:], start=1))  # type: ignore[operator]
    return np.asarray((_SECOND[0] * f(0.0) + around) / _STEP**2)  # type: ignore[operator]


def _relative(found: FloatArray, wanted: FloatArray) -> float:
    return float(np.abs(found - wanted).max() / max(1.0, np.abs(wanted).max()))


# Geometry of the paper's ratchet by hand: where the tip starts, the angle of Fig. 7, mass and inertia of a wheel.

#: nt and beta_0 [deg] of the twenty wheels.
CASES = tuple((count, angle) for count in TOOTH_COUNTS for angle in SLOPE_ANGLES_DEG)

_STEEL, _THICKNESS = 7850.0, 0.02


def gamma_on_slope(angle_deg: float) -> float:
    """Gamma(0) [rad] with the tip on the line of the slope, phi = 77 deg and psi = 75 deg, as the text says."""
    pin = HINGES + CRANK * math.cos(PHI), CRANK * math.sin(PHI)
    normal = PSI + math.radians(angle_deg) - math.pi / 2
    root = RADIUS * math.cos(PSI), RADIUS * math.sin(PSI)
    height = (pin[0] - root[0]) * math.cos(normal) + (pin[1] - root[1]) * math.sin(normal)
    return normal + math.acos(-height / PAWL)


def slope_gap(angle_deg: float, gamma_deg: float) -> float:
    """Distance of the tip from the line of the slope at the start [m], positive outside the tooth."""
    gamma = math.radians(gamma_deg)
    tip = HINGES + CRANK * math.cos(PHI) + PAWL * math.cos(gamma), CRANK * math.sin(PHI) + PAWL * math.sin(gamma)
    normal = PSI + math.radians(angle_deg) - math.pi / 2
    return (tip[0] - RADIUS * math.cos(PSI)) * math.cos(normal) + (tip[1] - RADIUS * math.sin(PSI)) * math.sin(normal)


def alpha_star(count: int, angle_deg: float) -> float:
    """Alpha + alpha_2 [deg]."""
    shape = tooth(count, angle_deg)
    return math.degrees(float(shape.apex_angle) + float(shape.chord_angle))


def solid_wheel(count: int, angle_deg: float, bore: float) -> tuple[float, float]:
    """Mass [kg] and inertia about its hinge [kg m2] of a steel wheel with these teeth: a sum over triangles."""
    shape = tooth(count, angle_deg)
    x, y = (float(c) for c in shape.apex)
    theta = float(shape.pitch)
    corners = [(RADIUS, 0.0), (x, y), (RADIUS * math.cos(theta), -RADIUS * math.sin(theta))]
    area = second = 0.0
    for (px, py), (qx, qy) in pairwise(corners):
        part = (py * qx - px * qy) / 2
        area += part
        second += part / 6 * (px * px + py * py + px * qx + py * qy + qx * qx + qy * qy)
    plate = _STEEL * _THICKNESS
    hole = math.pi * bore**2
    return plate * (count * area - hole), plate * (count * second - hole * bore**2 / 2)
