"""Bouncing block with friction: it strikes with its corners, slides and sticks in the impact."""

from __future__ import annotations

import math

import numpy as np

from mechanism_fmu.model import GROUND, Mechanism, Output, PointLineContact, rigid_body

from ..case import Case, Program, Run, Vector
from ..programs import engine, outputs

WIDTH, HEIGHT, MASS, GRAVITY, STOP = 0.2, 0.1, 1.0, 9.81, 0.5
INERTIA = MASS * (WIDTH**2 + HEIGHT**2) / 12
RESTITUTION, FRICTION = 0.5, 0.3
#: Place of the centre [m], angle [rad], and their rates.
START, RATES = (0.0, 0.3, 0.4), (1.0, 0.0, 1.0)
CORNERS = tuple((x * WIDTH / 2, y * HEIGHT / 2) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))


def block() -> Mechanism:
    """The block above the floor, with contacts at its corners, and Newton's law with Coulomb's friction as it is."""
    body = rigid_body(
        "block", START[:2], mass=MASS, inertia=INERTIA, angle=START[2], velocity=RATES[:2], speed=RATES[2]
    )
    floor = GROUND.line((0.0, 0.0), (1.0, 0.0))
    contacts = tuple(
        PointLineContact(f"corner{k}", body.at(*corner), floor, restitution=RESTITUTION, friction=FRICTION)
        for k, corner in enumerate(CORNERS)
    )
    place = (Output("x", body.x, "Of the centre", "m"), Output("y", body.y, "Of the centre", "m"))
    return Mechanism(
        (body,),
        contacts=contacts,
        gravity=(0.0, -GRAVITY),
        outputs=(*place, Output("angle", body.angle, "Of the block", "rad")),
        energy_guard=False,
    )


def scipy(tolerance: float) -> Run:
    """Scipy: flight by DOP853, an event for each corner, the impact of one corner by hand."""
    from scipy.integrate import solve_ivp

    def arm(angle: float, corner: tuple[float, float]) -> tuple[float, float]:
        c, s = math.cos(angle), math.sin(angle)
        return c * corner[0] - s * corner[1], s * corner[0] + c * corner[1]

    def derivative(_t: float, y: Vector) -> Vector:
        return np.array([y[3], y[4], y[5], 0.0, -GRAVITY, 0.0])

    def gap(corner: tuple[float, float]) -> object:
        def value(_t: float, y: Vector) -> float:
            return float(y[1]) + arm(y[2], corner)[1]

        value.terminal, value.direction = True, -1  # type: ignore[attr-defined]
        return value

    gaps = [gap(corner) for corner in CORNERS]

    def run() -> Vector:
        now, y = 0.0, np.array([*START, *RATES])
        while now < STOP:
            found = solve_ivp(
                derivative, (now, STOP), y, "DOP853", rtol=tolerance, atol=tolerance, events=gaps, first_step=1e-6
            )
            now, y = found.t[-1], found.y[:, -1]
            for corner, times in zip(CORNERS, found.t_events, strict=True):
                if len(times):
                    y = struck(y, arm(y[2], corner))
        return y[:3]

    return run


def struck(y: Vector, arm: tuple[float, float]) -> Vector:
    """Place and rates (6,) after an impact at a corner: it sticks, or slides on against the impulse of friction."""
    normal, along = np.array([0.0, 1.0, arm[0]]), np.array([1.0, 0.0, -arm[1]])
    inverse = 1.0 / np.array([MASS, MASS, INERTIA])
    rows = np.array([normal, along])
    speed = rows @ y[3:]
    matrix = rows * inverse @ rows.T
    impulse = np.linalg.solve(matrix, [-(1 + RESTITUTION) * speed[0], -speed[1]])
    if abs(impulse[1]) > FRICTION * impulse[0]:
        side = math.copysign(FRICTION, impulse[1])
        impulse[0] = -(1 + RESTITUTION) * speed[0] / (matrix[0, 0] + side * matrix[0, 1])
        impulse[1] = side * impulse[0]
    after = y.copy()
    after[3:] += inverse * (impulse @ rows)
    return after


def pymunk(steps: float) -> Run:
    """Pymunk: a polygon on a segment, both with the square root of the numbers, as it multiplies them."""
    import pymunk as pm

    space = pm.Space()
    # without slop; what it gives back after a penetration is what it does by itself
    space.gravity, space.iterations, space.collision_slop = (0.0, -GRAVITY), 30, 0.0
    body = pm.Body(MASS, INERTIA)
    body.position, body.angle = START[:2], START[2]
    body.velocity, body.angular_velocity = RATES[:2], RATES[2]
    floor, shape = pm.Segment(space.static_body, (-10.0, 0.0), (10.0, 0.0), 0.0), pm.Poly(body, CORNERS)
    for one in (floor, shape):
        one.elasticity, one.friction = math.sqrt(RESTITUTION), math.sqrt(FRICTION)
    space.add(body, shape, floor)

    def run() -> Vector:
        for _ in range(int(steps)):
            space.step(STOP / steps)
        return np.array([*body.position, body.angle])

    return run


CASE = Case(
    name="block",
    title="Bouncing block with friction",
    statement=(
        "A block of 0.2 m x 0.1 m and 1 kg, leaning by 0.4 rad, is thrown from 0.3 m at 1 m/s and 1 rad/s on a floor "
        "with restitution 0.5 and friction 0.3 (Newton's law, Coulomb's friction), 0.5 s. Compared: place of its "
        "centre [m] and angle [rad] at the end."
    ),
    programs=(
        engine(block(), outputs, STOP),
        Program("scipy", "DOP853 with events, impacts by hand", (1e-4, 1e-6, 1e-8, 1e-10, 1e-12), scipy),
        Program("pymunk", "polygon, semi-implicit Euler", (250, 1000, 4000, 16000, 64000), pymunk, "steps"),
    ),
    floor=2e-13,
    cannot={
        "MuJoCo": "It has no coefficient of restitution: its contacts are springs and dampers with constants of time.",
        "Exudyn": "Its contacts are springs and dampers that take time; restitution of its spheres sets such a damper.",
    },
    within=1e-9,
)
