"""The ratchet of the paper simulated plainly, with numpy and scipy: what the engine is measured against.

An engineer's own program, which shares no code with `mechanism_fmu`: nine coordinates, the pseudoinverse of
numpy, eqs (2), (3) and (7) of Pennestrì, Valentini, Vita, Baumgarte, and `solve_ivp` (RK45) that the event
stops and that is restarted after the impact. It is the slow half of the benchmarks and an independent oracle.

    python -m benchmarks.reference > models/ratchet/reference.csv      (the base case; takes a few seconds)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.integrate import OdeSolution, solve_ivp

from .curve_file import print_curve
from .ratchet import Parameters, Ratchet, Vector, build, rotation

CRANK_ANGLE, PAWL_ANGLE, WHEEL_ANGLE = 2, 5, 8
SLOPE, FACE = 0, 1

#: With e > 0 the tip comes back again and again; it stays when it would leave slower than this [m/s].
STICK_SPEED = 1e-6

QUARTER_TURN = np.array([[0.0, -1.0], [1.0, 0.0]])


@dataclass(frozen=True)
class Impact:
    """An impact: time [s], q and qd before and after (9,), closing speed [m/s], impulses [N s] (pushing > 0).

    `sticks`: the tip stays on the face, because e = 0 or because it would leave slower than STICK_SPEED.
    """

    time: float
    q: Vector
    before: Vector
    after: Vector
    closing_speed: float
    slope_impulse: float
    face_impulse: float
    sticks: bool


@dataclass(frozen=True)
class State:
    """Time [s], q and qd (9,), and whether the tip rests on the face."""

    time: float
    q: Vector
    qd: Vector
    on_face: bool = False


@dataclass(frozen=True)
class Trajectory:
    """A simulation: the solver's interpolants from impact to impact, and the impacts."""

    pieces: tuple[OdeSolution, ...]
    impacts: tuple[Impact, ...]

    def at(self, time: float) -> tuple[Vector, Vector]:
        """Coordinates q and rates qd, (9,) each, at `time` [s]; just before the impact at the time of one."""
        piece = next(piece for piece in self.pieces if time <= piece.t_max)
        y = piece(time)
        return y[:9], y[9:]


def constraints(r: Ratchet, q: Vector, qd: Vector, closed: Sequence[int]) -> tuple[Vector, Vector, Vector]:
    """Residuals Phi (m,), Jacobian Phi_q (m, 9) and gamma (m,) of the pins and of the `closed` contacts."""
    m = 2 * len(r.pins) + len(closed)
    phi, jacobian, gamma = np.zeros(m), np.zeros((m, 9)), np.zeros(m)
    for k, pin in enumerate(r.pins):
        rows = slice(2 * k, 2 * k + 2)
        for sign, body, point in ((1.0, pin.i, pin.point_i), (-1.0, pin.j, pin.point_j)):
            if body is None:
                phi[rows] += sign * point
                continue
            x, y, angle = 3 * body, 3 * body + 1, 3 * body + 2
            arm = rotation(q[angle]) @ point
            phi[rows] += sign * (q[x : y + 1] + arm)
            jacobian[rows, x : y + 1] += sign * np.eye(2)
            jacobian[rows, angle] += sign * (QUARTER_TURN @ arm)
            gamma[rows] += sign * arm * qd[angle] ** 2
    for k, contact in enumerate(closed, 2 * len(r.pins)):
        phi[k], jacobian[k], gamma[k] = contact_row(r, q, qd, contact)
    return phi, jacobian, gamma


def contact_row(r: Ratchet, q: Vector, qd: Vector, contact: int) -> tuple[float, Vector, float]:
    """Gap s = n . (A^T (tip - hinge) - root) of SLOPE or FACE, its row ds/dq (9,) and its gamma."""
    normal = rotation(q[WHEEL_ANGLE]) @ r.normals[contact]
    turned = QUARTER_TURN @ normal
    arm = rotation(q[PAWL_ANGLE]) @ r.tip
    distance = q[3:5] + arm - q[6:8]
    speed = qd[3:5] + QUARTER_TURN @ arm * qd[PAWL_ANGLE] - qd[6:8]
    row = np.zeros(9)
    row[3:5], row[PAWL_ANGLE] = normal, normal @ (QUARTER_TURN @ arm)
    row[6:8], row[WHEEL_ANGLE] = -normal, turned @ distance
    gamma = (
        normal @ arm * qd[PAWL_ANGLE] ** 2
        - 2 * turned @ speed * qd[WHEEL_ANGLE]
        + normal @ distance * qd[WHEEL_ANGLE] ** 2
    )
    return float(normal @ distance - r.normals[contact] @ r.root), row, float(gamma)


def forces(r: Ratchet, q: Vector) -> Vector:
    """Applied forces F, shape (9,): drive torque on the crank, load torque and spring on the wheel."""
    p, F = r.parameters, np.zeros(9)
    spring = p.spring_stiffness * (q[WHEEL_ANGLE] - p.spring_free_angle) + p.spring_preload
    F[CRANK_ANGLE], F[WHEEL_ANGLE] = p.drive_torque, p.load_torque - spring
    return F


def acceleration(r: Ratchet, q: Vector, qd: Vector, closed: Sequence[int] = (SLOPE,)) -> Vector:
    """Accelerations, shape (9,), by eqs (2) and (3), with Baumgarte's gamma - 2 alpha Phi' - beta^2 Phi."""
    p = r.parameters
    phi, jacobian, gamma = constraints(r, q, qd, closed)
    gamma = gamma - 2 * p.baumgarte_alpha * (jacobian @ qd) - p.baumgarte_beta**2 * phi
    free = forces(r, q) / r.mass
    D = jacobian / np.sqrt(r.mass)
    return free + (np.linalg.pinv(D) @ (gamma - jacobian @ free)) / np.sqrt(r.mass)


def impact(r: Ratchet, time: float, q: Vector, qd: Vector) -> Impact:
    """Velocity jump and impulses by eqs (6) and (7): the tip meets the face; pins and slope stay closed."""
    _, jacobian, _ = constraints(r, q, qd, (SLOPE, FACE))
    closing_speed, e = -(jacobian[-1] @ qd), r.parameters.restitution
    sticks = bool(e * closing_speed < STICK_SPEED)
    v = np.zeros(len(jacobian))
    v[-1] = closing_speed if sticks else (1 + e) * closing_speed
    D1_inverse = np.linalg.pinv(jacobian / np.sqrt(r.mass))
    jump = (D1_inverse @ v) / np.sqrt(r.mass)
    impulses = D1_inverse.T @ (np.sqrt(r.mass) * jump)
    return Impact(time, q, qd, qd + jump, closing_speed, impulses[-2], impulses[-1], sticks)


def kinetic_energy(r: Ratchet, qd: Vector) -> float:
    """Kinetic energy [J]."""
    return float(r.mass @ qd**2 / 2)


def spring_energy(r: Ratchet, q: Vector) -> float:
    """Energy of the wheel's spring [J]."""
    p = r.parameters
    return p.spring_stiffness / 2 * float(q[WHEEL_ANGLE] - p.spring_free_angle) ** 2


def advance(
    r: Ratchet, state: State, until: float, rtol: float, atol: float
) -> tuple[State, OdeSolution, Impact | None]:
    """Integrate up to `until` [s] or the next impact, whichever comes first, and take the impact.

    Raises:
        RuntimeError: `solve_ivp` gave up.
    """
    closed = (SLOPE, FACE) if state.on_face else (SLOPE,)

    def derivative(_t: float, y: Vector) -> Vector:
        return np.concatenate([y[9:], acceleration(r, y[:9], y[9:], closed)])

    def gap(_t: float, y: Vector) -> float:
        return contact_row(r, y[:9], y[9:], FACE)[0]

    gap.terminal, gap.direction = True, -1  # type: ignore[attr-defined]
    # A bounce may be shorter than the step that the solver would try first, which would then miss its end.
    first_step = min(1e-6, until - state.time) if r.parameters.restitution > 0 else None
    solution = solve_ivp(
        derivative,
        (state.time, until),
        np.concatenate([state.q, state.qd]),
        rtol=rtol,
        atol=atol,
        dense_output=True,
        events=None if state.on_face else gap,
        first_step=first_step,
    )
    if solution.status < 0:
        raise RuntimeError(f"solve_ivp stopped at t = {solution.t[-1]:g} s: {solution.message}")
    end = State(solution.t[-1], solution.y[:9, -1], solution.y[9:, -1], state.on_face)
    if solution.status == 0:
        return end, solution.sol, None
    hit = impact(r, end.time, end.q, end.qd)
    return State(end.time, end.q, hit.after, on_face=hit.sticks), solution.sol, hit


def step(r: Ratchet, state: State, duration: float = 1e-3, rtol: float = 1e-9, atol: float = 1e-12) -> State:
    """Advance by one communication step of `duration` [s], through all its impacts."""
    until = state.time + duration
    while state.time < until:
        state, _, _ = advance(r, state, until, rtol, atol)
    return state


def simulate(r: Ratchet, stop_time: float, rtol: float = 1e-9, atol: float = 1e-12) -> Trajectory:
    """Simulate from the start to `stop_time` [s]."""
    state = State(0.0, r.start, np.zeros(9))
    pieces, impacts = [], []
    while state.time < stop_time:
        state, piece, hit = advance(r, state, stop_time, rtol, atol)
        pieces.append(piece)
        if hit is not None:
            impacts.append(hit)
    return Trajectory(tuple(pieces), tuple(impacts))


def main() -> None:
    """Print the reference curve of the base case: CSV, 0..6 s every 0.01 s."""
    trajectory = simulate(build(Parameters()), stop_time=6.0, rtol=1e-12, atol=1e-14)
    angles = [WHEEL_ANGLE, CRANK_ANGLE, PAWL_ANGLE]
    moments = ((time, *trajectory.at(time)) for time in (k / 100 for k in range(601)))
    print_curve(
        "time,wheel_angle,crank_angle,pawl_angle,wheel_speed,crank_speed,pawl_speed",
        ((time, *q[angles], *qd[angles]) for time, q, qd in moments),
        digits=12,
    )


if __name__ == "__main__":
    main()
