"""Sections 1 and 2 of Pennestrì, Valentini, Vita: contributions, eqs (1) to (3) and their claims."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from scipy.linalg import sqrtm

from mechanism_fmu.simulation import Simulation

from ..bench import AFTER_IMPACT, Bench, FloatArray, closed_ratchet, each_off_by, joint_deviations, off_by
from ..row import Found, Row, Verdict, within

IMPACT, ACCELERATION = "mechanism_fmu/engine/contacts/impact.py", "mechanism_fmu/engine/dynamics/acceleration.py"
MINIMUM_NORM = "mechanism_fmu/engine/dynamics/minimum_norm.py"
#: Where eq (3) lives.
EQ3 = (ACCELERATION, MINIMUM_NORM)

#: Diagonal of M by Table 2, inertias in 10^-3 kg m2.
TABLE_2 = np.array([0.1, 0.1, 0.09e-3, 0.0976, 0.0976, 0.0853e-3, 5.6264, 5.6264, 32.7948e-3])
#: What rounding and the location of the impact leave, relative to the largest number compared.
_ROUNDING = 1e-8


def gauss(mass: FloatArray, jacobian: FloatArray, gamma: FloatArray, force: FloatArray) -> FloatArray:
    """Eq (3), as it is printed; `mass` is the diagonal of M."""
    root, free = 1 / np.sqrt(mass), force / mass
    return np.asarray(free + root * (np.linalg.pinv(jacobian * root) @ (gamma - jacobian @ free)))


def augmented(mass: FloatArray, jacobian: FloatArray) -> FloatArray:
    """The matrix of eqs (1) and (4)."""
    rows = len(jacobian)
    return np.block([[np.diag(mass), jacobian.T], [jacobian, np.zeros((rows, rows))]])


def _eq1(bench: Bench) -> Found:
    rows, mass, force = bench.start_rows
    solved = np.linalg.solve(augmented(mass, rows.jacobian), np.concatenate([force, rows.gamma]))[: len(mass)]
    engine = _engine_acceleration(bench)
    return within(
        off_by(solved, engine),
        _ROUNDING,
        f"crank at the start: {solved[2]:.9f} rad/s² from (1), {engine[2]:.9f} from the engine",
        f"9 coordinates, {len(rows.jacobian)} rows (three hinges, slope); wheel {solved[8]:.9f} rad/s²",
    )


def _engine_acceleration(bench: Bench) -> FloatArray:
    simulation = Simulation(bench.ratchet)
    simulation.read()
    return np.array(simulation.field("dy_at")[9:18])


def _gamma(bench: Bench) -> Found:
    """Gamma of all rows against the second derivative of Phi along a motion, the rows closed at the impact."""
    hit = bench.impact
    equations, _ = closed_ratchet(bench.ratchet, hit.q)
    return within(
        max(joint_deviations(equations, hit.q, hit.before, np.linspace(1.0, -0.5, 9))),
        1e-7,
        "−(Ψ_q q')_q q' − 2 Ψ_qt q' − Ψ_tt of all 8 rows = differences of Ψ along a motion, to 1e-7",
        "Ψ_q, ν and γ by central differences of eighth order at the impact",
    )


def _eq2(bench: Bench) -> Found:
    rows, mass, force = bench.start_rows
    d = rows.jacobian @ np.linalg.inv(sqrtm(np.diag(mass)))
    core = rows.jacobian @ np.linalg.inv(np.diag(mass)) @ rows.jacobian.T
    free = np.linalg.solve(np.diag(mass), force)
    return within(
        max(off_by(d @ d.T, core), abs(free[2] / (1e-3 / 0.09e-3) - 1), off_by(mass, TABLE_2)),
        1e-12,
        f"D Dᵀ = Ψ_q M⁻¹ Ψ_qᵀ with D = Ψ_q M^-1/2 ({d.shape[0]} × {d.shape[1]}) by scipy's root of M, M of Table 2; "
        f"q''_f of the crank = {free[2]:.6f} rad/s², 1 N mm on 0.09e-3 kg m²",
    )


def _eq3(bench: Bench) -> Found:
    rows, mass, force = bench.start_rows
    twice = [*range(len(rows.jacobian)), 4, 5]
    doubled = augmented(mass, rows.jacobian[twice])
    found, engine = gauss(mass, rows.jacobian, rows.gamma, force), _engine_acceleration(bench)
    again = gauss(mass, rows.jacobian[twice], rows.gamma[twice], force)
    return within(
        max(off_by(found, engine), off_by(again, engine)),
        _ROUNDING,
        f"crank at the start: {found[2]:.9f} rad/s², the same with the wheel's hinge stated twice; engine "
        f"{engine[2]:.9f}",
        f"with the hinge stated twice the matrix of (1) has {len(doubled)} rows and the rank "
        f"{np.linalg.matrix_rank(doubled)}, so (1) cannot be inverted there",
    )


def _redundant(bench: Bench) -> Found:
    joints, hit = bench.ratchet.joints, bench.impact
    hinges = (replace(joint, name=f"{joint.name}_again") for joint in joints if joint.name.endswith("_hinge"))
    simulation = Simulation(replace(bench.ratchet, joints=(*joints, *hinges)))
    simulation.advance(AFTER_IMPACT)
    now = simulation.read()
    return within(
        each_off_by([now["impact_time"], now["impact_wheel_speed"]], [hit.time, hit.after[8]]),
        1e-7,
        f"hinges of crank and wheel stated twice: t_I = {now['impact_time']:.7f} s, ω(t_I+) = "
        f"{now['impact_wheel_speed']:.9f} rad/s, as with single ones",
        "10 rows of joints instead of 6, of rank 6, in the motion as well as in the impact",
        verdict=Verdict.HOLDS,
    )


def _topology(bench: Bench) -> Found:
    hit = bench.impact
    simulation = Simulation(bench.ratchet)
    simulation.advance(hit.time)
    simulation.advance(hit.time + 1e-9)
    simulation.read()
    state, engine = np.array(simulation.field("y_at")), np.array(simulation.field("dy_at")[9:18])
    q, rate = state[:9], state[9:18]
    rows = closed_ratchet(bench.ratchet, q)[0].at(q, 0.0, rate)
    # drive torque and spring; rows stabilised by alpha = 10, beta = 1
    force = np.array([0, 0, 1e-3, 0, 0, 0, 0, 0, -15e-3 * (q[8] - math.radians(75))])
    found = gauss(hit.mass, rows.jacobian, rows.gamma - 20 * (rows.jacobian @ rate) - rows.residual, force)
    return within(
        off_by(found, engine),
        1e-6,
        f"rows {len(rows.jacobian) - 1} → {len(rows.jacobian)} at t_I; crank just after: {found[2]:.6f} rad/s² from "
        f"(3), {engine[2]:.6f} from the engine",
        "the same nine coordinates before and after; the face's row is appended, nothing is derived anew",
        verdict=Verdict.HOLDS,
    )


ROWS = (
    Row(
        "P-gamma",
        "section 2",
        "γ is what of the second derivative of the constraints has no accelerations.",
        "γ = −(Ψ_q q')_q q' − 2 Ψ_qt q' − Ψ_tt",
        ("mechanism_fmu/engine/constraints/rows.py",),
        _gamma,
    ),
    Row("P-eq1", "eq (1)", "Motion with multipliers, as DAE.", "[M Ψ_qᵀ; Ψ_q 0]", (ACCELERATION,), _eq1),
    Row("P-eq2", "eq (2)", "M^-1/2, D and the free acceleration.", "D = Ψ_q M^-1/2", (ACCELERATION,), _eq2),
    Row("P-eq3", "eq (3)", "Acceleration by the pseudoinverse.", "q'' = q''_f + M^-1/2 D⁺ (γ − Ψ_q q''_f)", EQ3, _eq3),
    Row(
        "P-redundant",
        "claim, section 2",
        "Redundant constraints do no harm.",
        "in words",
        (MINIMUM_NORM, "mechanism_fmu/kinematics/mobility.py"),
        _redundant,
    ),
    Row(
        "P-topology",
        "claim, section 2",
        "Sudden changes of topology do no harm.",
        "in words",
        ("mechanism_fmu/engine/contacts/transition.py",),
        _topology,
    ),
    Row(
        "P-efficiency",
        "claim, section 2",
        "The formulation is numerically efficient.",
        "refers to other papers",
        (ACCELERATION,),
        Found("the papers it refers to are not at hand, and nothing is timed here", Verdict.NOT_DETERMINED),
    ),
)
