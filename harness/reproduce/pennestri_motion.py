"""Sections 1 to 3 of Pennestrì, Valentini, Vita: contributions, eqs (1) to (7), Figs 1 and 2."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from mechanism_fmu.model.transitions import transition_table
from mechanism_fmu.simulation import Simulation

from .bench import AFTER_IMPACT, Bench, FloatArray, closed_ratchet
from .differences import joint_deviations
from .row import Found, Row, Verdict, judged, within

ACCELERATION = "mechanism_fmu/engine/dynamics/acceleration.py"
MINIMUM_NORM = "mechanism_fmu/engine/dynamics/minimum_norm.py"
IMPACT = "mechanism_fmu/engine/contacts/impact.py"
#: What rounding and the location of the impact leave, relative to the largest number compared.
_ROUNDING = 1e-8


def _off(found: FloatArray, wanted: FloatArray) -> float:
    """The largest deviation, relative to the largest number wanted."""
    return float(np.abs(found - wanted).max() / np.abs(wanted).max())


def gauss(root: FloatArray, jacobian: FloatArray, gamma: FloatArray, free: FloatArray) -> FloatArray:
    """Eq (3), as it is printed; `root` is the diagonal of M^-1/2."""
    d = jacobian * root
    return np.asarray(free + root * (np.linalg.pinv(d) @ (gamma - jacobian @ free)))


def _augmented(mass: FloatArray, jacobian: FloatArray) -> FloatArray:
    """The matrix of eqs (1) and (4)."""
    rows = len(jacobian)
    return np.block([[np.diag(mass), jacobian.T], [jacobian, np.zeros((rows, rows))]])


def _eq1(bench: Bench) -> Found:
    _, rows, mass, force = bench.start_rows
    solved = np.linalg.solve(_augmented(mass, rows.jacobian), np.concatenate([force, rows.gamma]))[: len(mass)]
    engine = _engine_acceleration(bench)
    return within(
        _off(solved, engine),
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
    jacobian, nu, gamma = joint_deviations(equations, hit.q, hit.before, np.linspace(1.0, -0.5, 9))
    return within(
        max(jacobian, nu, gamma),
        1e-7,
        "−(Ψ_q q')_q q' − 2 Ψ_qt q' − Ψ_tt of all 8 rows = differences of Ψ along a motion, to 1e-7",
        "Ψ_q, ν and γ by central differences of eighth order at the impact",
    )


def _eq2(bench: Bench) -> Found:
    _, rows, mass, force = bench.start_rows
    root = 1 / np.sqrt(mass)
    free = force / mass
    return within(
        _off(root * root * mass, np.ones(9)),
        1e-14,
        f"M^-1/2 M^-1/2 M = 1; D has {rows.jacobian.shape[0]} × {rows.jacobian.shape[1]} entries; "
        f"q''_f of the crank = {free[2]:.6f} rad/s² (1 N mm on 0.09e-3 kg m²)",
    )


def _eq3(bench: Bench) -> Found:
    _, rows, mass, force = bench.start_rows
    root, free = 1 / np.sqrt(mass), force / mass
    found = gauss(root, rows.jacobian, rows.gamma, free)
    engine = _engine_acceleration(bench)
    doubled = np.vstack([rows.jacobian, rows.jacobian[4:6]])
    again = gauss(root, doubled, np.concatenate([rows.gamma, rows.gamma[4:6]]), free)
    return within(
        max(_off(found, engine), _off(again, engine)),
        _ROUNDING,
        f"crank at the start: {found[2]:.9f} rad/s², the same with the wheel's hinge stated twice; "
        f"engine {engine[2]:.9f}",
        f"with the hinge stated twice the matrix of (1) has {len(_augmented(mass, doubled))} rows and the rank "
        f"{np.linalg.matrix_rank(_augmented(mass, doubled))}, so (1) cannot be inverted there",
    )


def _redundant(bench: Bench) -> Found:
    joints = bench.ratchet.joints
    hinges = (replace(joint, name=f"{joint.name}_again") for joint in joints if joint.name.endswith("_hinge"))
    twice = replace(bench.ratchet, joints=(*joints, *hinges))
    simulation = Simulation(twice)
    simulation.advance(AFTER_IMPACT)
    now = simulation.read()
    hit = bench.impact
    deviation = max(abs(now["impact_time"] / hit.time - 1), abs(now["impact_wheel_speed"] / hit.after[8] - 1))
    return within(
        deviation,
        1e-7,
        f"hinges of crank and wheel stated twice: t_I = {now['impact_time']:.7f} s, ω(t_I+) = {now['impact_wheel_speed']:.9f} rad/s, "
        "as with single ones",
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
    equations, _ = closed_ratchet(bench.ratchet, state[:9])
    rows = equations.at(state[:9], 0.0, state[9:18])
    force = np.zeros(9)
    force[2], force[8] = 1e-3, -15e-3 * (state[8] - math.radians(75))
    stabilised = rows.gamma - 20 * (rows.jacobian @ state[9:18]) - rows.residual
    found = gauss(1 / np.sqrt(hit.mass), rows.jacobian, stabilised, force / hit.mass)
    return within(
        _off(found, engine),
        1e-6,
        f"rows {hit.rows} → {hit.rows + 1} at t_I; crank just after: {found[2]:.6f} rad/s² from (3), "
        f"{engine[2]:.6f} from the engine",
        "the same nine coordinates before and after; the face's row is appended, nothing is derived anew",
        verdict=Verdict.HOLDS,
    )


def _eq4(bench: Bench) -> Found:
    hit = bench.impact
    right = np.zeros(len(hit.mass) + len(hit.jacobian))
    right[-1] = -(hit.jacobian[-1] @ hit.before)
    solved = np.linalg.solve(_augmented(hit.mass, hit.jacobian), right)
    jump, wanted = solved[:9], hit.after - hit.before
    p = -solved[-1]
    return within(
        _off(jump, wanted),
        1e-7,
        f"Δω = {jump[8]:.9f} rad/s from (4), {wanted[8]:.9f} from the engine; impulse p = {p:.9f} N s",
        f"Δφ' = {jump[2]:.9f}, Δγ' = {jump[5]:.9f} rad/s; e = 0",
        f"impulse of the slope {-solved[-2]:.9f} N s; ω before {hit.before[8]:.9f}, after {hit.after[8]:.9f} rad/s",
    )


def _fig1(bench: Bench) -> Found:
    hit = bench.impact
    return judged(
        abs(hit.gap) < 1e-9,
        f"s of the tip from the face, ∂s/∂q = {np.array2string(hit.jacobian[-1, 3:6], precision=4)} "
        "for x, y, γ of the pawl at t_I; s(t_I) = 0",
        "the row of the gap is the last of A_21; positive s: open; drawn as fig01_gap.svg",
        verdict=Verdict.REPRODUCED,
    )


def _inverse(bench: Bench) -> tuple[FloatArray, FloatArray]:
    """A of eq (5), and its inverse by the partitioned formula."""
    hit = bench.impact
    inverse_mass, a21 = np.diag(1 / hit.mass), hit.jacobian
    core = np.linalg.inv(a21 @ inverse_mass @ a21.T)
    across = inverse_mass @ a21.T @ core
    return _augmented(hit.mass, a21), np.block(
        [[inverse_mass - across @ a21 @ inverse_mass, across], [across.T, -core]]
    )


def _eq5(bench: Bench) -> Found:
    matrix, _ = _inverse(bench)
    hit = bench.impact
    return judged(
        matrix.shape == (17, 17) and not matrix[9:, 9:].any(),
        f"A_11 = M is 9 × 9, A_21 = A_12ᵀ is {hit.jacobian.shape[0]} × 9 (three hinges, slope, face), A_22 = 0",
        "A_12 is [Ψ_qᵀ, (∂s/∂q)ᵀ], side by side: see erratum X-A12",
        verdict=Verdict.REPRODUCED,
    )


def _partitioned(bench: Bench) -> Found:
    matrix, inverse = _inverse(bench)
    scale = np.abs(inverse) @ np.abs(matrix)
    return within(
        float((np.abs(inverse @ matrix - np.eye(17)) / scale.max()).max()),
        1e-13,
        "printed A⁻¹ times A = 1 for the ratchet at its impact (17 × 17), to rounding",
        "needs A_21 of full row rank: A_21 M⁻¹ A_12 is inverted; (7) does not need it",
    )


def _eq6(bench: Bench) -> Found:
    hit = bench.impact
    v = -(hit.jacobian[-1] @ hit.before)
    return judged(
        v > 0,
        f"v = (0, …, 0, {v:.9f} m/s): the closing speed of the tip at the face, e = 0",
        f"e = 0.5 would make it {1.5 * v:.9f} m/s",
        verdict=Verdict.REPRODUCED,
    )


def _d1(bench: Bench) -> Found:
    hit = bench.impact
    d1 = hit.jacobian / np.sqrt(hit.mass)
    values = np.linalg.svd(d1, compute_uv=False)
    return judged(
        np.linalg.matrix_rank(d1) == 8,
        f"D₁ is {d1.shape[0]} × {d1.shape[1]}, rank 8, singular values {values[0]:.4f} to {values[-1]:.4f}",
        "A_21 M⁻¹ A_12 = D₁ D₁ᵀ",
        verdict=Verdict.REPRODUCED,
    )


def _eq7(bench: Bench) -> Found:
    hit = bench.impact
    root = 1 / np.sqrt(hit.mass)
    v = np.zeros(len(hit.jacobian))
    v[-1] = -(hit.jacobian[-1] @ hit.before)
    found = root * (np.linalg.pinv(hit.jacobian * root) @ v)
    _, inverse = _inverse(bench)
    partitioned = inverse[:9, 9:] @ v
    wanted = hit.after - hit.before
    return within(
        max(_off(found, wanted), _off(partitioned, wanted)),
        1e-7,
        f"Δω = {found[8]:.9f} rad/s from (7), {partitioned[8]:.9f} from the partitioned inverse, "
        f"{wanted[8]:.9f} from the engine",
        f"ω(t_I+) = {hit.before[8] + found[8]:.9f} rad/s; Δφ' = {found[2]:.9f}, Δγ' = {found[5]:.9f} rad/s",
    )


def _shares(bench: Bench) -> Found:
    hit = bench.impact
    root = 1 / np.sqrt(hit.mass)
    rows = np.vstack([hit.jacobian[:-1], hit.jacobian[:-1], hit.jacobian[-1:]])
    v = np.zeros(len(rows))
    v[-1] = -(hit.jacobian[-1] @ hit.before)
    found = root * (np.linalg.pinv(rows * root) @ v)
    return within(
        _off(found, hit.after - hit.before),
        1e-7,
        f"all {hit.rows} rows stated twice: Δω = {found[8]:.9f} rad/s, as with single rows",
        f"matrix of (4) then: {9 + len(rows)} rows, rank {np.linalg.matrix_rank(_augmented(hit.mass, rows))}; "
        "the inverse above does not exist",
        verdict=Verdict.HOLDS,
    )


def _event(bench: Bench) -> Found:
    hit = bench.impact
    coarse = bench.run(AFTER_IMPACT, 0.4)
    fine = bench.run(AFTER_IMPACT, 0.01)
    times = [float(run.impacts["time"].iloc[0]) for run in (coarse, fine)]
    return within(
        max(abs(time - hit.time) for time in times),
        1e-7,
        f"s = 0 at t_I = {hit.time:.7f} s, with steps of 0.4 s and of 0.01 s alike; then (7), then on from x+",
        f"s(t_I) = {abs(hit.gap):.1g} m; the instant is located within the integrator's step",
        verdict=Verdict.HOLDS,
    )


def _fig2(bench: Bench) -> Found:
    table = transition_table(bench.ratchet)
    return judged(
        "face.touches" in table and "eq (7)" in table,
        "drawn as the flow chart of what the engine does: fig02_procedure.svg; modes and guards of the ratchet "
        "come from `mechanism-fmu modes`, which is no flow chart",
        *(line for line in table.splitlines() if "face.gap" in line),
        verdict=Verdict.HOLDS_IN_PART,
    )


def _contribution(text: str, *rows: str) -> Found:
    return Found(text, Verdict.HOLDS, (f"rows {', '.join(rows)}",))


ROWS = (
    Row(
        "P-contribution1",
        "section 1",
        "The formulation of Udwadia and Kalaba is extended to impacts.",
        "eq (7)",
        (IMPACT,),
        lambda _bench: _contribution("eq (7), for any mechanism, e from 0 to 1, redundant rows", "P-eq7", "P-features"),
    ),
    Row(
        "P-contribution2",
        "section 1",
        "An engineering model of impacts in ratchet mechanisms.",
        "section 4",
        ("mechanism_fmu/stress/recovery.py", "models/ratchet/model.py"),
        lambda _bench: _contribution("from impact to bending stress, eqs (8) to (16)", "P-eq8 to P-eq16"),
    ),
    Row(
        "P-contribution3",
        "section 1",
        "A procedure of optimal design of ratchet mechanisms.",
        "a study of 20 wheels",
        ("harness/study.py", "harness/designs/search.py"),
        lambda _bench: Found(
            "the paper's procedure is a table of 20 wheels, reproduced; it states no objective or constraint and names "
            "no optimum. A search with both is this project's",
            Verdict.HOLDS_IN_PART,
        ),
        "mechanism-fmu study ratchet",
    ),
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
    Row(
        "P-eq3",
        "eq (3)",
        "Acceleration by the pseudoinverse.",
        "q'' = q''_f + M^-1/2 D⁺ (γ − Ψ_q q''_f)",
        (ACCELERATION, MINIMUM_NORM),
        _eq3,
    ),
    Row(
        "P-redundant",
        "claim, section 2",
        "Redundant constraints do no harm.",
        "in words",
        (MINIMUM_NORM, "mechanism_fmu/kinematics/rank.py"),
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
    Row("P-fig1", "Fig. 1", "Impact between bodies: the distance s.", "drawing lost", (IMPACT,), _fig1),
    Row("P-eq4", "eq (4)", "The jump of the rates, with impulses.", "one linear system", (IMPACT,), _eq4),
    Row("P-eq5", "eq (5)", "The blocks of A.", "A_11 = M, A_22 = 0, A_21 = A_12ᵀ", (IMPACT,), _eq5),
    Row(
        "P-inverse",
        "section 3, no number",
        "The partitioned inverse of A.",
        "A⁻¹ in four blocks",
        (IMPACT,),
        _partitioned,
    ),
    Row("P-eq6", "eq (6)", "The right-hand side v.", "(0, …, −(1 + e) ∂s/∂q q')", (IMPACT,), _eq6),
    Row("P-D1", "section 3, no number", "D₁.", "D₁ = A_21 M^-1/2", (IMPACT,), _d1),
    Row("P-eq7", "eq (7)", "The jump of the rates.", "Δq' = M^-1/2 D₁⁺ v", (IMPACT, MINIMUM_NORM), _eq7),
    Row(
        "P-features",
        "claim, section 3",
        "(7) shares the features of (3): redundant constraints, varying structure.",
        "in words",
        (IMPACT, MINIMUM_NORM),
        _shares,
    ),
    Row(
        "P-fig2",
        "Fig. 2",
        "Flow chart of the procedure with logical functions.",
        "drawing lost",
        ("mechanism_fmu/engine/stepping/stepper.py", "mechanism_fmu/model/transitions.py"),
        _fig2,
        "mechanism-fmu modes build/Ratchet.fmu",
    ),
    Row(
        "P-event",
        "section 5",
        "When s = 0 an event function stops the solver, (7) follows, and it restarts.",
        "in words",
        ("mechanism_fmu/engine/stepping/events.py", "mechanism_fmu/engine/stepping/stepper.py"),
        _event,
    ),
)
