"""Section 3 of Pennestrì, Valentini, Vita: eqs (4) to (7), the inverse of A, Figs 1 and 2; and its rows by hand."""

from __future__ import annotations

import math

import numpy as np

from mechanism_fmu.model.transitions import transition_table

from ....run.checks import Verdict
from ..bench import AFTER_IMPACT, CRANK, HINGES, PAWL, RADIUS, Bench, FloatArray, off_by, tooth
from ..figures.all_figures import redrawn
from ..row import Found, Row, judged, within
from .motion_rows import IMPACT, MINIMUM_NORM, TABLE_2, augmented

# The rows of the guided ratchet at its impact, written down by hand, and differentiated by differences.

_STEP = 1e-4


def distance_to_face(q: FloatArray) -> float:
    """Of the tip of the pawl from the face of the base case's tooth [m], positive outside; q of shape (9,).

    The face is the line from the root P0 to the apex of the tooth that follows, whose slope begins one pitch behind.
    """
    return _distance(q, *_face(float(q[8])))


def rows_by_hand(q: FloatArray) -> FloatArray:
    """Derivatives of hinges, slope and face in x, y and angle of crank, pawl and wheel, shape (8, 9)."""
    columns = []
    for k in range(9):
        step = _STEP * np.eye(9)[k]
        near = _conditions(q + step) - _conditions(q - step)
        far = _conditions(q + 2 * step) - _conditions(q - 2 * step)
        columns.append((8 * near - far) / (12 * _STEP))
    return np.transpose(columns)


def _conditions(q: FloatArray) -> FloatArray:
    """Zero at the impact, shape (8,)."""
    xc, yc, phi, xp, yp, gamma, xw, yw, _ = (float(value) for value in q)
    half = CRANK / 2
    return np.array(
        [
            xc - half * math.cos(phi) - HINGES,
            yc - half * math.sin(phi),
            xp - PAWL / 2 * math.cos(gamma) - xc - half * math.cos(phi),
            yp - PAWL / 2 * math.sin(gamma) - yc - half * math.sin(phi),
            xw,
            yw,
            _distance(q, *_slope(float(q[8]))),
            _distance(q, *_face(float(q[8]))),
        ]
    )


def _slope(psi: float) -> tuple[float, float]:
    """Direction from P0 along the slope [rad], and the side that is outside."""
    shape = tooth(10, 90)
    x, y = float(shape.apex[0]) - RADIUS, float(shape.apex[1])
    return psi + math.atan2(y, x), 1.0


def _face(psi: float) -> tuple[float, float]:
    """Direction from P0 along the face of the tooth ahead [rad], and the side that is outside."""
    shape = tooth(10, 90)
    pitch = float(shape.pitch)
    x, y = float(shape.apex[0]), float(shape.apex[1])
    # the apex of the tooth ahead, turned forward by a pitch
    ahead = math.cos(pitch) * x - math.sin(pitch) * y - RADIUS, math.sin(pitch) * x + math.cos(pitch) * y
    return psi + math.atan2(ahead[1], ahead[0]), -1.0


def _distance(q: FloatArray, direction: float, side: float) -> float:
    tip = q[3] + PAWL / 2 * math.cos(q[5]), q[4] + PAWL / 2 * math.sin(q[5])
    root = q[6] + RADIUS * math.cos(q[8]), q[7] + RADIUS * math.sin(q[8])
    return float(side * (-math.sin(direction) * (tip[0] - root[0]) + math.cos(direction) * (tip[1] - root[1])))


def _eq4(bench: Bench) -> Found:
    hit = bench.impact
    right = np.zeros(len(hit.mass) + len(hit.jacobian))
    right[-1] = -(hit.jacobian[-1] @ hit.before)
    solved = np.linalg.solve(augmented(hit.mass, hit.jacobian), right)
    jump = np.asarray(solved[:9], dtype=np.float64)
    wanted = hit.after - hit.before
    p = -solved[-1]
    return within(
        off_by(jump, wanted),
        1e-7,
        f"Δω = {jump[8]:.9f} rad/s from (4), {wanted[8]:.9f} from the engine; impulse p = {p:.9f} N s",
        f"Δφ' = {jump[2]:.9f}, Δγ' = {jump[5]:.9f} rad/s; e = 0",
        f"impulse of the slope {-solved[-2]:.9f} N s; ω before {hit.before[8]:.9f}, after {hit.after[8]:.9f} rad/s",
    )


def _fig1(bench: Bench) -> Found:
    hit = bench.impact
    row = ", ".join(f"{value:.4f}" for value in hit.jacobian[-1, 3:6])
    moved = [distance_to_face(hit.q + step * hit.before) for step in (-1e-6, 1e-6)]
    rate = (moved[1] - moved[0]) / 2e-6
    return redrawn(
        bench,
        "fig01_gap",
        ("s", "n", "body i", "body j", "s > 0 open"),
        f"redrawn: fig01_gap.svg; s of the tip from the face, ∂s/∂q = ({row}) for x, y, γ of the pawl at t_I; s(t_I) "
        "= 0",
        "the row of the gap is the last of A_21; positive s: open",
        f"s' by differences of the distance by hand {rate:.9f} m/s, (∂s/∂q) q' = {hit.jacobian[-1] @ hit.before:.9f} "
        "m/s",
        true=abs(hit.gap) < 1e-9 and abs(rate / float(hit.jacobian[-1] @ hit.before) - 1) < 1e-6,
    )


def _inverse(bench: Bench) -> tuple[FloatArray, FloatArray]:
    """A of eq (5), and its inverse by the partitioned formula."""
    hit = bench.impact
    inverse_mass, a21 = np.diag(1 / hit.mass), hit.jacobian
    core = np.linalg.inv(a21 @ inverse_mass @ a21.T)
    across = inverse_mass @ a21.T @ core
    return augmented(hit.mass, a21), np.block([[inverse_mass - across @ a21 @ inverse_mass, across], [across.T, -core]])


def _eq5(bench: Bench) -> Found:
    matrix, _ = _inverse(bench)
    hit = bench.impact
    rows = rows_by_hand(hit.q)
    # numbering, scale and sign of rows are free: what they span is not
    spans = [np.linalg.pinv(block) @ block for block in (hit.jacobian, rows)]
    return within(
        max(
            float(np.abs(spans[0] - spans[1]).max()),
            off_by(matrix[:9, :9], np.diag(TABLE_2)),
            *map(abs, matrix[9:, 9:].ravel()),
        ),
        1e-6,
        f"A_11 = M of Table 2, A_21 = A_12ᵀ spans the {len(rows)} rows of hinges, slope and face written by hand and "
        "differentiated by differences, A_22 = 0",
        "A_12 is [Ψ_qᵀ, (∂s/∂q)ᵀ], side by side: see misprint X-A12",
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


def _operations(bench: Bench) -> Found:
    """Multiplications of a factorisation of A against one of A_21 M^-1 A_12; M is diagonal."""
    rows, coordinates = bench.impact.jacobian.shape
    whole, core = ((size**3 - size) // 3 for size in (rows + coordinates, rows))
    product = rows * (rows + 1) // 2 * coordinates + rows * coordinates
    return judged(
        core + product < whole / 2,
        f"of {coordinates} coordinates and {rows} rows: {whole} multiplications to factorise A, {core} + {product} "
        "for A_21 M⁻¹ A_12 with a diagonal M; counted, not timed, and without regard to zeros in A",
    )


def _eq6(bench: Bench) -> Found:
    hit = bench.impact
    v = -(hit.jacobian[-1] @ hit.before)
    closing = float(bench.study.base_case.impacts.iloc[0]["closing_speed"])
    rate = (distance_to_face(hit.q + 1e-6 * hit.before) - distance_to_face(hit.q - 1e-6 * hit.before)) / 2e-6
    return within(
        max(abs(v / closing - 1), abs(v / rate + 1)),
        1e-6,
        f"v = (0, …, 0, {v:.9f} m/s), e = 0: {closing:.9f} m/s is the closing speed that the FMU records, {-rate:.9f} "
        "m/s that of the tip at the face by hand",
        f"e = 0.5 would make it {1.5 * v:.9f} m/s",
    )


def _d1(bench: Bench) -> Found:
    hit = bench.impact
    d1 = hit.jacobian / np.sqrt(hit.mass)
    values = np.linalg.svd(d1, compute_uv=False)
    _, inverse = _inverse(bench)
    found = np.linalg.pinv(d1) / np.sqrt(hit.mass)[:, None]
    return within(
        off_by(found, inverse[:9, 9:]),
        1e-9,
        f"D₁ is {d1.shape[0]} × {d1.shape[1]} of rank {np.linalg.matrix_rank(d1)}; M^-1/2 D₁⁺ by singular values is "
        "the block M⁻¹ A_12 (A_21 M⁻¹ A_12)⁻¹ of the printed inverse, so that (7) follows from (4)",
        f"singular values {values[0]:.4f} to {values[-1]:.4f}",
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
        max(off_by(found, wanted), off_by(partitioned, wanted)),
        1e-7,
        f"Δω = {found[8]:.9f} rad/s from (7), {partitioned[8]:.9f} from the partitioned inverse, {wanted[8]:.9f} from "
        "the engine",
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
        off_by(found, hit.after - hit.before),
        1e-7,
        f"all {hit.rows} rows stated twice: Δω = {found[8]:.9f} rad/s, as with single rows",
        f"matrix of (4) then: {9 + len(rows)} rows, rank {np.linalg.matrix_rank(augmented(hit.mass, rows))}; the "
        "inverse above does not exist",
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
    return redrawn(
        bench,
        "fig02_procedure",
        ("assemble: close Ψ = 0", "logical functions: which rows hold?", "s = 0 and s", "(3)", "(7)"),
        "redrawn: fig02_procedure.svg, what this program does; the paper's chart may differ. Its logical functions "
        "are the guards that `mechanism-fmu modes` lists",
        *(line for line in table.splitlines() if "face.gap" in line),
        true="face.touches" in table and "eq (7)" in table,
    )


ROWS = (
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
    Row(
        "P-partition",
        "claim, section 3",
        "(4) can be solved efficiently by its partition.",
        "in words",
        (IMPACT,),
        _operations,
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
