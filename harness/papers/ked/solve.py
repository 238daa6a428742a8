"""Elastodynamic solution of a turn, from the description of a mechanism to its results."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from mechanism_fmu.elastodynamics import (
    DRIVE,
    Cycle,
    ElasticCycle,
    LinkageError,
    PeriodicResponse,
    Shaking,
    SpeedSweep,
    crank_hinge,
    critical_speeds,
    deflection_of,
    elastic_cycle,
    elastic_ports,
    fed_back,
    flywheel,
    growth_per_period,
    instantaneous_modes,
    joint_forces,
    momentum_shaking,
    peak,
    periodic_response,
    quasi_static,
    shaking,
    speed_sweep,
    stress_of,
    system_forces,
    torque_fluctuation,
    turn,
    unlike_bodies,
)

from ...errors import UsageError
from .solution import Bent, FedBack, FloatArray, Largest, Rigid, Solution

#: The turn is calculated at so many angles at least: the series through them is to be exact.
_LEAST = 360
#: Harmonics of the crank for which critical speeds are given.
_HARMONICS = 8
#: Speeds of the sweep: how many, and between which parts of the speed.
_SPEEDS, _SLOWEST, _FASTEST = 31, 0.4, 1.4
#: What is to be said of the periodic motion where joints rub.
_JUMPS = (
    "Coulomb friction jumps where the slip of a joint turns around; at these angles the series of the periodic motion "
    "cannot fulfil its equations. Deviation and stress follow from it all the same: more angles change them little"
)
#: Steps by which a disturbance is followed: so many in a period of the slowest mode, as far as that goes in a turn.
_A_PERIOD, _MOST_STEPS = 20, 4000
#: Angles of the equations there: enough for five digits of a curve, in a quarter of the time.
_COARSE = 180


@dataclass(frozen=True)
class Turn:
    """One turn at even times, its end included.

    Attributes:
        cycle: bent quasi-statically.
        equations: of its periodic motion.
        place: whose path is looked at.
        order: which of its angles come in which order from 0 deg on, shape (angles,).
        angle: in that order [rad].
    """

    cycle: Cycle
    equations: ElasticCycle
    place: str
    order: npt.NDArray[np.int64]
    angle: FloatArray

    def deflection(self, u: FloatArray) -> FloatArray:
        """Of the place, shape (angles, 3), from displacements u of the angles as they come, shape (angles, m)."""
        return deflection_of(self.cycle.configurations, _closed(u), self.place)[:-1]


def prepared(mechanism: Any, speed: float, damping: float, samples: int) -> Turn:
    """The turn of a described mechanism at a constant speed of its crank.

    Args:
        mechanism: with members.
        speed: of its crank [rad/s].
        damping: ratio of every mode.
        samples: angles of the turn that are wanted; it has a multiple of them.

    Raises:
        UsageError: it cannot be analysed; the message says why.
    """
    count = samples * math.ceil(_LEAST / samples)
    try:
        cycle = quasi_static(turn(mechanism, speed, count))
        equations = elastic_cycle(cycle, damping)
        places = elastic_ports(mechanism).places or _tip(cycle)
    except (LinkageError, ValueError) as error:
        raise UsageError(str(error)) from error
    pose = cycle.configurations.pose
    crank = pose.bodies.index(elastic_ports(mechanism).crank)
    steps = np.round(pose.position[:-1, crank, 2] / (2 * math.pi / count)).astype(np.int64) % count
    order = np.argsort(steps)
    angle: FloatArray = steps[order].astype(np.float64) * (2 * math.pi / count)
    return Turn(cycle, equations, places[0], order, angle)


def solved(turned: Turn, speed: float, damping: float, samples: int, fluctuation: float | None = None) -> Solution:
    """What the turn comes to, at `samples` angles.

    Args:
        turned: the turn.
        speed: of its crank [rad/s].
        damping: ratio of every mode.
        samples: of `prepared`.
        fluctuation: coefficient that a flywheel is to keep to; None: no flywheel.

    Raises:
        UsageError: there is no periodic motion, or the coefficient cannot be.
    """
    cycle, shown = turned.cycle, slice(None, None, len(turned.order) // samples)
    modes = instantaneous_modes(turned.equations.stiffness, turned.equations.mass)
    response, notes = _periodic(turned.equations)
    moving = response.samples(turned.equations.samples)
    order = turned.order[shown]
    rigid = _rigid(turned, order, speed, fluctuation)
    if rigid.rubs:
        notes = (_JUMPS,)
    return Solution(
        speed=speed,
        damping=damping,
        place=turned.place,
        members=tuple(element.member.name for element in cycle.configurations.linkage.elements),
        angle=turned.angle[shown],
        rigid=rigid,
        static=_bent(turned, cycle.displacement[:-1], cycle.stress[:-1], order),
        dynamic=_bent(turned, moving, stress_of(cycle.configurations, _closed(moving))[:-1], order),
        frequencies=modes.hertz[order],
        frequency_range=np.column_stack([modes.hertz.min(axis=0), modes.hertz.max(axis=0)]),
        critical=critical_speeds(modes, _HARMONICS),
        residual=response.residual,
        growth=growth_per_period(turned.equations, _steps(turned.equations, float(modes.hertz[:, 0].max()))),
        feedback=_fed_back(turned),
        jump=_jump(turned, moving),
        notes=(*unlike_bodies(cycle.configurations.linkage.mechanism), *notes),
    )


def swept(
    turned: Turn, speed: float, progress: Callable[[str, float], None], speeds: Sequence[float] | None = None
) -> SpeedSweep:
    """Largest deviations at `speeds` [rad/s], or else at speeds around one.

    Raises:
        UsageError: at one of them there is no periodic motion.
    """
    factors = np.linspace(_SLOWEST, _FASTEST, _SPEEDS) if speeds is None else np.asarray(speeds) / speed

    def deviation(u: FloatArray) -> FloatArray:
        return np.asarray(np.linalg.norm(turned.deflection(u)[:, :2], axis=1))

    def done(number: int) -> None:
        progress(f"Speed {number + 1} of {len(factors)}", (number + 1) / len(factors))

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what is left of the equations at the speed itself has its verdict
        try:
            return speed_sweep(turned.equations, speed, factors, deviation, _COARSE, done)
        except ValueError as error:
            raise UsageError(str(error)) from error


def _steps(equations: ElasticCycle, hertz: float) -> int:
    """Steps of the turn, so that the slowest mode has enough of them in each of its own periods."""
    wanted = _A_PERIOD * hertz * equations.period
    return max(equations.samples, math.ceil(min(wanted, _MOST_STEPS)))


def _fed_back(turned: Turn) -> FedBack:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that it does not converge is said in its own words
        found = fed_back(turned.equations)
    deviation = np.linalg.norm(turned.deflection(found.displacement)[:, :2], axis=1)
    return FedBack(found.converged, len(found.changes), float(found.changes.min()), float(deviation.max()))


def _periodic(equations: ElasticCycle) -> tuple[PeriodicResponse, tuple[str, ...]]:
    """The periodic motion, and what is to be said of it."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            found = periodic_response(equations)
        except ValueError as error:
            raise UsageError(str(error)) from error
    return found, tuple(str(one.message) for one in said)


def _tip(cycle: Cycle) -> tuple[str]:
    """The end of a member that gives way most, quasi-statically."""
    members = [element.member.name for element in cycle.configurations.linkage.elements]
    places = [f"{member}.{end}" for member in members for end in ("start", "end")]
    return (max(places, key=lambda place: float(cycle.deviation(place).max())),)


def _bent(turned: Turn, u: FloatArray, stress: FloatArray, order: npt.NDArray[np.int64]) -> Bent:
    deflection = turned.deflection(u)
    part, largest = peak(deflection[:, :2])
    first = int(np.flatnonzero(turned.order == 0)[0])
    ends = turned.cycle.configurations.ends[:-1]
    worst = np.argmax(stress, axis=0)
    return Bent(
        deflection=deflection[order],
        stress=stress[order],
        ends=np.einsum("teim,tm->tei", np.broadcast_to(ends, (len(u), *ends.shape[1:])), u)[order],
        largest_deviation=largest,
        largest_stress=stress.max(axis=0),
        stress_at=turned.angle[np.argsort(turned.order)[worst]],
        largest_at=(turned.angle[first] + 2 * math.pi * part) % (2 * math.pi),
    )


def _rigid(turned: Turn, order: npt.NDArray[np.int64], speed: float, fluctuation: float | None) -> Rigid:
    cycle, pose = turned.cycle, turned.cycle.configurations.pose
    members = [element.member for element in cycle.configurations.linkage.elements]
    starts, ends = (
        np.stack([pose.place(m.body, point) for m, point in zip(members, points, strict=True)], axis=1)[order]
        for points in ([m.start for m in members], [m.end for m in members])
    )
    name, _, end = turned.place.rpartition(".")
    torque = cycle.reactions.of(DRIVE)[:, 0]
    angle = np.linspace(0.0, 2 * math.pi, len(torque))
    power = cycle.power
    most = max(float(np.abs(part).max()) for part in (power.drives, power.kinetic))
    about = crank_hinge(cycle.configurations.linkage.mechanism)
    on_frame = shaking(cycle, about)
    joints = joint_forces(cycle.configurations, cycle.reactions)

    def largest(values: FloatArray) -> Largest:
        sizes = np.abs(values[:-1])
        worst = int(np.argmax(sizes))
        return Largest(float(sizes[worst]), float(turned.angle[np.argsort(turned.order)[worst]]))

    try:
        wheel = None if fluctuation is None else flywheel(angle, torque, speed, fluctuation)
    except LinkageError as error:
        raise UsageError(str(error)) from error
    return Rigid(
        path=(starts if end == "start" else ends)[:, [m.name for m in members].index(name)],
        starts=starts,
        ends=ends,
        torque=torque[order],
        fluctuation=torque_fluctuation(angle, torque),
        power_gap=float(np.abs(power.balance).max()) / most if most > 0.0 else 0.0,
        shaking=Shaking(about, on_frame.force[order], on_frame.moment[order]),
        shaking_gap=on_frame.gap(momentum_shaking(cycle, about)),
        joints=tuple(
            replace(j, force=j.force[order], friction=j.friction[order], lost_power=j.lost_power[order]) for j in joints
        ),
        largest_shaking=(largest(np.linalg.norm(on_frame.force, axis=1)), largest(on_frame.moment)),
        largest_forces=tuple(largest(joint.force) for joint in joints),
        largest_friction=tuple(largest(joint.friction) for joint in joints),
        lost_energy=np.array([np.trapezoid(joint.lost_power, pose.time) for joint in joints]),
        flywheel=None if wheel is None else replace(wheel, speed=wheel.speed[order]),
        flywheel_speeds=(speed, speed) if wheel is None else (float(wheel.speed.min()), float(wheel.speed.max())),
    )


def _jump(turned: Turn, moving: FloatArray) -> float:
    """The quasi-static deflection by the largest step of friction, in parts of the motion, measured as its residual."""
    friction = system_forces(turned.cycle.configurations, turned.cycle.reactions.friction)
    if not friction.any():
        return 0.0
    steps = np.linalg.solve(turned.equations.stiffness, np.diff(friction, axis=0)[:, :, None])[:, :, 0]
    return turned.equations.size(np.asarray(steps, dtype=np.float64)) / turned.equations.size(moving)


def _closed(u: FloatArray) -> FloatArray:
    """With the first row at the end again, as the configurations of a turn have it."""
    return np.vstack([u, u[:1]])
