"""Chain of n uniform rods that falls from the horizontal: against Lagrange's equations in the rods' angles.

The first rod is pinned to the ground, each other to the end of that before it. With the absolute angles q of the rods,
mass m and length l of each, and n_i = n - 1 - i rods beyond rod i = 0, ..., n - 1,

    sum_j M_ij (cos(q_i - q_j) q_j'' + sin(q_i - q_j) q_j'^2) = -m g l (n_i + 1/2) cos(q_i),
    M_ii = m l^2 (n_i + 1/3),    M_ij = m l^2 (min(n_i, n_j) + 1/2).

This is a full matrix and no constraint; the engine has 3n coordinates, 2n constraints and no such matrix.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt
from scipy.integrate import solve_ivp

from harness.report.plot import Curve, Plot
from mechanism_fmu.model import GROUND, Body, Mechanism, Output, Revolute, Settings
from mechanism_fmu.simulation import Simulation

from ..case import Case, Known, Origin, Run, steps_of

Vector = npt.NDArray[np.float64]

LENGTH, MASS, GRAVITY, STOP = 0.2, 0.5, 9.81, 1.5
COUNTS = (10, 50)
_NAMES = (("angle of the first rod", "rad"), ("x of the free end", "m"), ("y of the free end", "m"))

#: Of each count: `values` of `angles`, here as its three orders of 1e-13 take longer than a module may to be imported.
BY_ANGLES = {
    10: (-2.3175553384609, -1.74635916339, -0.3219411940289),
    50: (-1.4829408605366, -1.0821658464424, -9.066809407172),
}
#: The same by MuJoCo 4.0.0, as tests/unit/test_world_in_mujoco.py finds them: angles q(N) of its Runge-Kutta method of
#: fourth order with N steps, N = 24000 and 48000, extrapolated to q(48000) + (q(48000) - q(24000))/15.
BY_MUJOCO = {
    10: (-2.3175553384609, -1.74635916339, -0.32194119402898),
    50: (-1.4829408605366, -1.082165846442, -9.0668094071721),
}


def chain(count: int, tolerance: float) -> Mechanism:
    """So many rods, horizontal and at rest; outputs are their angles."""
    bodies, joints, before = [], [], GROUND.at(0, 0)
    for k in range(count):
        rod = Body(f"rod{k}", MASS, MASS * LENGTH**2 / 12, ((k + 0.5) * LENGTH, 0.0, 0.0))
        bodies.append(rod)
        joints.append(Revolute(f"pin{k}", before, rod.at(-LENGTH / 2, 0)))
        before = rod.at(LENGTH / 2, 0)
    outputs = tuple(Output(rod.name, rod.angle, "rad") for rod in bodies)
    return Mechanism(
        tuple(bodies), tuple(joints), gravity=(0.0, -GRAVITY), outputs=outputs, settings=Settings(tolerance)
    )


def run(tolerance: float) -> Run:
    """The quantities of each count, twice: for each of the two known values."""
    values: list[float] = []
    steps = 0
    for count in COUNTS:
        simulation = Simulation(chain(count, tolerance))
        simulation.advance(STOP)
        values += 2 * quantities(np.array([*simulation.read().values()]))
        steps += steps_of(simulation)
    return Run(tuple(values), steps)


def quantities(angle: Vector) -> tuple[float, ...]:
    """Angle of the first rod [rad] and place of the free end [m] from the angles of all, shape (count,)."""
    return float(angle[0]), float(LENGTH * np.cos(angle).sum()), float(LENGTH * np.sin(angle).sum())


def angles(count: int, tolerance: float = 1e-13) -> Vector:
    """The rods' angles [rad] after 1.5 s, shape (count,), by Lagrange's equations (see above)."""
    beyond = count - 1.0 - np.arange(count)
    inertia = MASS * LENGTH**2 * (np.minimum.outer(beyond, beyond) + 0.5 - np.eye(count) / 6)
    weight = MASS * GRAVITY * LENGTH * (beyond + 0.5)

    def rates(_time: float, y: Vector) -> Vector:
        angle, rate = y[:count], y[count:]
        apart = angle[:, None] - angle
        moment = -(inertia * np.sin(apart)) @ rate**2 - weight * np.cos(angle)
        return np.concatenate([rate, np.linalg.solve(inertia * np.cos(apart), moment)])

    found = solve_ivp(rates, (0.0, STOP), np.zeros(2 * count), "DOP853", rtol=tolerance, atol=tolerance / 100)
    ends: Vector = found.y[:count, -1]
    return ends


def _known() -> Iterator[Known]:
    sources: dict[Origin, dict[int, tuple[float, float, float]]]
    sources = {"second formulation": BY_ANGLES, "other program": BY_MUJOCO}
    for count in COUNTS:
        for origin, found in sources.items():
            for (name, unit), value in zip(_NAMES, found[count], strict=True):
                yield Known(f"n = {count}: {name}", unit, value, origin)


def _pictures() -> list[Plot]:
    """The chains as they fall, at every quarter of a second."""
    plots = []
    times = np.arange(0.0, STOP + 0.1, 0.25)
    for count in COUNTS:
        simulation = Simulation(chain(count, 1e-9))
        curves = []
        for time in times:
            simulation.advance(float(time))
            angle = np.array([*simulation.read().values()])
            x, y = (np.concatenate([[0.0], LENGTH * part(angle).cumsum()]) for part in (np.cos, np.sin))
            share = time / STOP
            colour = f"#{int(160 - 129 * share):02x}{int(200 - 89 * share):02x}{int(250 - 15 * share):02x}"
            curves.append(Curve(f"{time:.2f} s", x, y, colour))
        plots.append(Plot(f"n = {count}", "x [m]", "y [m]", curves, to_scale=True))
    return plots


CASE = Case(
    name="chain",
    title="Chain of rods",
    statement=(
        "n uniform rods of 0.2 m and 0.5 kg, pinned to each other and the first to the ground, horizontal and at rest; "
        "weight 9.81 m/s\u00b2; 1.5 s."
    ),
    source="the usual example of formulations whose effort grows as n or as n\u00b3; data of this project",
    known=tuple(_known()),
    run=run,
    model=chain,
    within=1e-10,
    remark=(
        "Three formulations: absolute coordinates of all rods with constraints (ours), absolute angles with a full "
        "matrix of inertia (Lagrange, DOP853 at 1e-13), and angles between rods by MuJoCo, whose steps of fourth "
        "order are halved and extrapolated. In 1.5 s the chain of 10 rods has swung to the other side, and begins to "
        "come down at its pin; that of 50 passes the vertical below its pin, and its end has turned over."
    ),
    drawings=_pictures,
)
