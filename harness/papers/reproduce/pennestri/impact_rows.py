"""Section 3 of Pennestrì, Valentini, Vita: eqs (4) to (7), the inverse of A, Figs 1 and 2; and its rows by hand."""

from __future__ import annotations

import cmath
from collections.abc import Callable

import numpy as np

from mechanism_fmu.model.transitions import transition_table

from ..bench import (
    CRANK,
    HINGES,
    PAWL,
    RADIUS,
    AtImpact,
    Bench,
    FloatArray,
    each_off_by,
    first_derivative,
    off_by,
    tooth,
)
from ..figures.all_figures import redrawn
from ..row import Found, Row, Verdict, judged, within
from .motion_rows import IMPACT, MINIMUM_NORM, TABLE_2, augmented

# The rows of the guided ratchet at its impact, written down by hand, and differentiated by differences.


def distance_to_face(q: FloatArray) -> float:
    """Of the tip of the pawl from the face of the base case's tooth [m], positive outside; q of shape (9,).

    The face is the line from the root P0 to the apex of the tooth that follows, whose slope begins one pitch behind.
    """
    return _distances(q)[1]


def rows_by_hand(q: FloatArray) -> FloatArray:
    """Derivatives of hinges, slope and face in x, y and angle of crank, pawl and wheel, shape (8, 9)."""
    return np.transpose([first_derivative(_conditions, q, 1e-4, axis) for axis in np.eye(9)])


def _conditions(q: FloatArray) -> FloatArray:
    """Zero at the impact, shape (8,)."""
    crank, pawl, half = complex(q[0], q[1]), complex(q[3], q[4]), cmath.rect(CRANK / 2, q[2])
    hinge, pin = crank - half - HINGES, pawl - cmath.rect(PAWL / 2, q[5]) - crank - half
    return np.array([hinge.real, hinge.imag, pin.real, pin.imag, q[6], q[7], *_distances(q)])


def _distances(q: FloatArray) -> tuple[float, float]:
    """Of the tip of the pawl from the slope and from the face of the tooth ahead [m], positive outside."""
    shape = tooth(10, 90)
    apex = complex(*map(float, shape.apex))
    tip = complex(q[3], q[4]) + cmath.rect(PAWL / 2, q[5])
    root = complex(q[6], q[7]) + cmath.rect(RADIUS, q[8])
    # as the wheel's own x axis sees it; slope and face go from the root to the apex and to that a pitch ahead
    seen = (tip - root) * cmath.rect(1.0, -q[8])
    slope, face = apex - RADIUS, apex * cmath.rect(1.0, float(shape.pitch)) - RADIUS
    return (seen * slope.conjugate()).imag / abs(slope), -(seen * face.conjugate()).imag / abs(face)


def _face_rate(hit: AtImpact) -> float:
    """Of that distance just before the impact, by differences [m/s]."""
    return float(first_derivative(distance_to_face, hit.q, 1e-4, hit.before))


def _eq4(hit: AtImpact) -> Found:
    right = np.append(np.zeros(len(hit.mass) + len(hit.jacobian) - 1), -hit.approach)
    solved = np.linalg.solve(augmented(hit.mass, hit.jacobian), right)
    return within(
        off_by(solved[:9], hit.jump),
        1e-7,
        f"Δω = {solved[8]:.9f} rad/s from (4), {hit.jump[8]:.9f} from the engine; impulse p = {-solved[-1]:.9f} N s",
        f"Δφ' = {solved[2]:.9f}, Δγ' = {solved[5]:.9f} rad/s; e = 0",
        f"impulse of the slope {-solved[-2]:.9f} N s; ω before {hit.before[8]:.9f}, after {hit.after[8]:.9f} rad/s",
    )


def _fig1(bench: Bench) -> Found:
    hit, rate = bench.impact, _face_rate(bench.impact)
    return redrawn(
        bench,
        "fig01_gap",
        ("s", "n", "body i", "body j", "s > 0 open"),
        "redrawn: fig01_gap.svg; s of the tip from the face, ∂s/∂q = ("
        + ", ".join(f"{value:.4f}" for value in hit.jacobian[-1, 3:6])
        + ") for x, y, γ of the pawl at t_I; s(t_I) = 0",
        "the row of the gap is the last of A_21; positive s: open",
        f"s' by differences of the distance by hand {rate:.9f} m/s, (∂s/∂q) q' = {hit.approach:.9f} m/s",
        true=abs(hit.gap) < 1e-9 and abs(rate / hit.approach - 1) < 1e-6,
    )


def _inverse(hit: AtImpact) -> FloatArray:
    """Of A of eq (5), by the partitioned formula, shape (17, 17)."""
    inverse_mass, a21 = np.diag(1 / hit.mass), hit.jacobian
    core = np.linalg.inv(a21 @ inverse_mass @ a21.T)
    across = inverse_mass @ a21.T @ core
    return np.block([[inverse_mass - across @ a21 @ inverse_mass, across], [across.T, -core]])


def _eq5(hit: AtImpact) -> Found:
    matrix, rows = augmented(hit.mass, hit.jacobian), rows_by_hand(hit.q)
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


def _partitioned(hit: AtImpact) -> Found:
    matrix, inverse = augmented(hit.mass, hit.jacobian), _inverse(hit)
    return within(
        float(np.abs(inverse @ matrix - np.eye(17)).max() / (np.abs(inverse) @ np.abs(matrix)).max()),
        1e-13,
        "printed A⁻¹ times A = 1 for the ratchet at its impact (17 × 17), to rounding",
        "needs A_21 of full row rank: A_21 M⁻¹ A_12 is inverted; (7) does not need it",
    )


def _operations(hit: AtImpact) -> Found:
    """Multiplications of a factorisation of A against one of A_21 M^-1 A_12; M is diagonal."""
    rows, coordinates = hit.jacobian.shape
    whole, core = ((size**3 - size) // 3 for size in (rows + coordinates, rows))
    product = rows * (rows + 1) // 2 * coordinates + rows * coordinates
    return judged(
        core + product < whole / 2,
        f"of {coordinates} coordinates and {rows} rows: {whole} multiplications to factorise A, {core} + {product} "
        "for A_21 M⁻¹ A_12 with a diagonal M; counted, not timed, and without regard to zeros in A",
    )


def _eq6(bench: Bench) -> Found:
    v, rate = -bench.impact.approach, _face_rate(bench.impact)
    closing = float(bench.study.base_case.impacts.iloc[0]["closing_speed"])
    return within(
        each_off_by([v, v], [closing, -rate]),
        1e-6,
        f"v = (0, …, 0, {v:.9f} m/s), e = 0: {closing:.9f} m/s is the closing speed that the FMU records, {-rate:.9f} "
        "m/s that of the tip at the face by hand",
        f"e = 0.5 would make it {1.5 * v:.9f} m/s",
    )


def _d1(hit: AtImpact) -> Found:
    root = 1 / np.sqrt(hit.mass)
    d1 = hit.jacobian * root
    values = np.linalg.svd(d1, compute_uv=False)
    return within(
        off_by(np.linalg.pinv(d1) * root[:, None], _inverse(hit)[:9, 9:]),
        1e-9,
        f"D₁ is {d1.shape[0]} × {d1.shape[1]} of rank {np.linalg.matrix_rank(d1)}; M^-1/2 D₁⁺ by singular values is "
        "the block M⁻¹ A_12 (A_21 M⁻¹ A_12)⁻¹ of the printed inverse, so that (7) follows from (4)",
        f"singular values {values[0]:.4f} to {values[-1]:.4f}",
    )


def _jump(hit: AtImpact, rows: FloatArray) -> FloatArray:
    """Eq (7), as it is printed, with e = 0: rows in any number, the face's last."""
    root = 1 / np.sqrt(hit.mass)
    return np.asarray(root * (np.linalg.pinv(rows * root) @ np.append(np.zeros(len(rows) - 1), -hit.approach)))


def _eq7(hit: AtImpact) -> Found:
    found = _jump(hit, hit.jacobian)
    partitioned = _inverse(hit)[:9, -1] * -hit.approach
    return within(
        max(off_by(found, hit.jump), off_by(partitioned, hit.jump)),
        1e-7,
        f"Δω = {found[8]:.9f} rad/s from (7), {partitioned[8]:.9f} from the partitioned inverse, {hit.jump[8]:.9f} "
        "from the engine",
        f"ω(t_I+) = {hit.before[8] + found[8]:.9f} rad/s; Δφ' = {found[2]:.9f}, Δγ' = {found[5]:.9f} rad/s",
    )


def _shares(hit: AtImpact) -> Found:
    held = hit.jacobian[:-1]
    rows = np.vstack([held, hit.jacobian])
    found = _jump(hit, rows)
    return within(
        off_by(found, hit.jump),
        1e-7,
        f"all {len(held)} rows stated twice: Δω = {found[8]:.9f} rad/s, as with single rows",
        f"matrix of (4) then: {9 + len(rows)} rows, rank {np.linalg.matrix_rank(augmented(hit.mass, rows))}; the "
        "inverse above does not exist",
        verdict=Verdict.HOLDS,
    )


def _event(bench: Bench) -> Found:
    hit = bench.impact
    return within(
        max(abs(float(bench.first_impact(step)["time"]) - hit.time) for step in (0.4, 0.01)),
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


def at_impact(find: Callable[[AtImpact], Found]) -> Callable[[Bench], Found]:
    """A finding about the base case at its first impact."""
    return lambda bench: find(bench.impact)


ROWS = (
    Row("P-fig1", "Fig. 1", "Impact between bodies: the distance s.", "drawing lost", (IMPACT,), _fig1),
    Row("P-eq4", "eq (4)", "The jump of the rates, with impulses.", "one linear system", (IMPACT,), at_impact(_eq4)),
    Row("P-eq5", "eq (5)", "The blocks of A.", "A_11 = M, A_22 = 0, A_21 = A_12ᵀ", (IMPACT,), at_impact(_eq5)),
    Row(
        "P-inverse",
        "section 3, no number",
        "The partitioned inverse of A.",
        "A⁻¹ in four blocks",
        (IMPACT,),
        at_impact(_partitioned),
    ),
    Row(
        "P-partition",
        "claim, section 3",
        "(4) can be solved efficiently by its partition.",
        "in words",
        (IMPACT,),
        at_impact(_operations),
    ),
    Row("P-eq6", "eq (6)", "The right-hand side v.", "(0, …, −(1 + e) ∂s/∂q q')", (IMPACT,), _eq6),
    Row("P-D1", "section 3, no number", "D₁.", "D₁ = A_21 M^-1/2", (IMPACT,), at_impact(_d1)),
    Row("P-eq7", "eq (7)", "The jump of the rates.", "Δq' = M^-1/2 D₁⁺ v", (IMPACT, MINIMUM_NORM), at_impact(_eq7)),
    Row(
        "P-features",
        "claim, section 3",
        "(7) shares the features of (3): redundant constraints, varying structure.",
        "in words",
        (IMPACT, MINIMUM_NORM),
        at_impact(_shares),
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
