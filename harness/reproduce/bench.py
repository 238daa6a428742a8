"""What several rows need: the study of twenty wheels, the guided ratchet at its impact, the path generator."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

import build_fmu
from mechanism_fmu import codes
from mechanism_fmu.elastodynamics import Configurations, turn
from mechanism_fmu.kinematics.equations import Equations, Rows
from mechanism_fmu.model import Mechanism, PointLineContact
from mechanism_fmu.model.sawtooth import Sawtooth, sawtooth
from mechanism_fmu.simulation import Simulation

from ..experiment import Experiment, Run, perform
from ..fmu import Fmu
from ..paper import BASE_CASE
from ..study import Study, ratchet_study
from ..wheels import Wheel

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
    """

    fmu: Callable[[], Fmu]
    report: Callable[[str, float], None] = field(default=lambda _text, _done: None)

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
