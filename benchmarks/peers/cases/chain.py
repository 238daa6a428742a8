"""Chain of 50 bars that falls: smooth motion, where every code is at its best."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from mechanism_fmu.model import GROUND, Mechanism, Output, Revolute, rigid_body

from ..case import Case, Program, Run, Vector
from ..programs import engine, outputs, solve_exudyn

COUNT, LENGTH, MASS, GRAVITY, STOP = 50, 0.1, 1.0, 9.81, 0.5
INERTIA = MASS * LENGTH**2 / 12
#: Of all bars at the start [rad]. From 0 the chain's free end would fall freely, and its place would test nothing.
ANGLE = -0.5


def chain() -> Mechanism:
    """Bars in one straight line, the first pinned to the ground; outputs are the angles of all."""
    bodies, joints, before = [], [], GROUND.at(0.0, 0.0)
    cosine, sine = LENGTH * math.cos(ANGLE), LENGTH * math.sin(ANGLE)
    for k in range(COUNT):
        bar = rigid_body(
            f"bar{k}", (k * cosine, k * sine), mass=MASS, inertia=INERTIA, centre=(LENGTH / 2, 0.0), angle=ANGLE
        )
        joints.append(Revolute(f"pin{k}", bar.at(0.0, 0.0), before))
        bodies.append(bar)
        before = bar.at(LENGTH, 0.0)
    angles = tuple(Output(f"angle{k}", bar.angle, f"Of bar {k}", "rad") for k, bar in enumerate(bodies))
    return Mechanism(tuple(bodies), tuple(joints), gravity=(0.0, -GRAVITY), outputs=angles)


def ends(angles: Vector) -> Vector:
    """Places of the far ends of all bars [m], x and then y, shape (2 COUNT,), from their angles (COUNT,)."""
    return np.concatenate([np.cumsum(LENGTH * np.cos(angles)), np.cumsum(LENGTH * np.sin(angles))])


def mujoco(steps: float) -> Run:
    """MuJoCo: hinges, i.e. the angles between bars as coordinates, and its explicit Runge-Kutta of fourth order."""
    import mujoco as mj

    body = (
        '<body pos="{at} 0 0"><joint axis="0 -1 0"/>'
        f'<inertial pos="{LENGTH / 2} 0 0" mass="{MASS}" diaginertia="{INERTIA} {INERTIA} {INERTIA}"/>'
    )
    bars = "".join(body.format(at=0.0 if k == 0 else LENGTH) for k in range(COUNT)) + "</body>" * COUNT
    model = mj.MjModel.from_xml_string(
        f'<mujoco><option timestep="{STOP / steps!r}" integrator="RK4" gravity="0 0 -{GRAVITY}">'
        f'<flag contact="disable" constraint="disable"/></option><worldbody>{bars}</worldbody></mujoco>'
    )
    data = mj.MjData(model)
    data.qpos[0] = ANGLE

    def run() -> Vector:
        mj.mj_step(model, data, int(steps))
        return ends(np.cumsum(data.qpos))

    return run


def scipy(tolerance: float) -> Run:
    """Scipy: the bars' angles as coordinates, Lagrange's equations in closed form, a Cholesky solution, DOP853."""
    from scipy.integrate import solve_ivp
    from scipy.linalg import cho_factor, cho_solve

    order = np.arange(COUNT)
    # bars beyond both, and half of the farther one: how much mass moves with a pair of angles
    beyond = COUNT - 1 - np.maximum.outer(order, order) + 0.5
    inertia = MASS * LENGTH**2 * (beyond - np.diag(np.full(COUNT, 0.25))) + np.diag(np.full(COUNT, INERTIA))
    weight = MASS * GRAVITY * LENGTH * (COUNT - order - 0.5)

    def derivative(_t: float, y: Vector) -> Vector:
        angle, rate = y[:COUNT], y[COUNT:]
        apart = angle[:, None] - angle
        force = -(inertia * np.sin(apart)) @ rate**2 - weight * np.cos(angle)
        factor = cho_factor(inertia * np.cos(apart), check_finite=False, overwrite_a=True)
        return np.concatenate([rate, cho_solve(factor, force, check_finite=False)])

    start = np.concatenate([np.full(COUNT, ANGLE), np.zeros(COUNT)])

    def run() -> Vector:
        found = solve_ivp(derivative, (0.0, STOP), start, "DOP853", rtol=tolerance, atol=tolerance)
        return ends(found.y[:COUNT, -1])

    return run


def pymunk(steps: float) -> Run:
    """Pymunk: bodies and pivot joints, semi-implicit Euler, 30 iterations a step, its own correction of drift."""
    import pymunk as pm

    space = pm.Space()
    space.gravity, space.iterations = (0.0, -GRAVITY), 30
    bars, before, at = [], space.static_body, (0.0, 0.0)
    for k in range(COUNT):
        bar = pm.Body(MASS, INERTIA)
        bar.position = ((k + 0.5) * LENGTH * math.cos(ANGLE), (k + 0.5) * LENGTH * math.sin(ANGLE))
        bar.angle = ANGLE
        pivot = pm.PivotJoint(before, bar, at, (-LENGTH / 2, 0.0))
        space.add(bar, pivot)
        bars.append(bar)
        before, at = bar, (LENGTH / 2, 0.0)

    def run() -> Vector:
        for _ in range(int(steps)):
            space.step(STOP / steps)
        far = [bar.local_to_world((LENGTH / 2, 0.0)) for bar in bars]
        return np.array([*(point.x for point in far), *(point.y for point in far)])

    return run


def exudyn_tree(steps: float) -> Run:
    """Exudyn: a kinematic tree, i.e. the angles between bars as coordinates, explicit Runge-Kutta of fourth order."""
    import exudyn as ex
    from exudyn import itemInterface as item  # noqa: N813

    inertias, centres, turns, offsets = ex.Matrix3DList(), ex.Vector3DList(), ex.Matrix3DList(), ex.Vector3DList()
    for k in range(COUNT):
        inertias.Append(np.diag([INERTIA] * 3))
        centres.Append([LENGTH / 2, 0.0, 0.0])
        turns.Append(np.eye(3))
        offsets.Append([LENGTH if k else 0.0, 0.0, 0.0])
    container = ex.SystemContainer()
    system = container.AddSystem()
    zero = [0.0] * COUNT
    node = system.AddNode(
        item.NodeGenericODE2(
            numberOfODE2Coordinates=COUNT,
            referenceCoordinates=zero,
            initialCoordinates=[ANGLE, *zero[1:]],
            initialCoordinates_t=zero,
        )
    )
    system.AddObject(
        item.ObjectKinematicTree(
            nodeNumber=node,
            jointTypes=[ex.JointType.RevoluteZ] * COUNT,
            linkParents=list(range(-1, COUNT - 1)),
            jointTransformations=turns,
            jointOffsets=offsets,
            linkInertiasCOM=inertias,
            linkCOMs=centres,
            linkMasses=[MASS] * COUNT,
            gravity=[0.0, -GRAVITY, 0.0],
        )
    )
    system.Assemble()

    def run() -> Vector:
        solve_exudyn(system, ex.DynamicSolverType.RK44, STOP, int(steps))
        assert container is not None  # the system lives as long as what holds it
        return ends(np.cumsum(system.GetNodeOutput(node, ex.OutputVariableType.Coordinates)))

    return run


def exudyn_joints(steps: float) -> Run:
    """Exudyn: planar rigid bodies and revolute joints, generalised alpha, sparse."""
    import exudyn as ex
    from exudyn import itemInterface as item  # noqa: N813

    container = ex.SystemContainer()
    system = container.AddSystem()

    def marker(body: Any, x: float) -> Any:
        return system.AddMarker(item.MarkerBodyPosition(bodyNumber=body, localPosition=[x, 0.0, 0.0]))

    before, bars = marker(system.AddObject(item.ObjectGround()), 0.0), []
    for k in range(COUNT):
        middle = (k + 0.5) * LENGTH
        start = [middle * math.cos(ANGLE), middle * math.sin(ANGLE), ANGLE]
        node = system.AddNode(item.NodeRigidBody2D(referenceCoordinates=start))
        bar = system.AddObject(item.ObjectRigidBody2D(mass=MASS, inertia=INERTIA, nodeNumber=node))
        near = marker(bar, -LENGTH / 2)
        system.AddObject(item.ObjectJointRevolute2D(markerNumbers=[before, near]))
        system.AddLoad(item.LoadForceVector(markerNumber=marker(bar, 0.0), loadVector=[0.0, -MASS * GRAVITY, 0.0]))
        before = marker(bar, LENGTH / 2)
        bars.append(bar)
    system.Assemble()

    def run() -> Vector:
        solve_exudyn(system, ex.DynamicSolverType.GeneralizedAlpha, STOP, int(steps))
        assert container is not None
        position = ex.OutputVariableType.Position
        far = np.array([system.GetObjectOutputBody(bar, position, [LENGTH / 2, 0.0, 0.0]) for bar in bars])
        return np.concatenate([far[:, 0], far[:, 1]])

    return run


CASE = Case(
    name="chain",
    title="Chain of 50 bars",
    statement=(
        "50 bars of 0.1 m and 1 kg, pinned to each other and the first to the ground, straight and at rest "
        "at -0.5 rad, fall for 0.5 s. Compared: places of the far ends of all bars [m]."
    ),
    programs=(
        engine(chain(), lambda simulation: ends(outputs(simulation)), STOP),
        Program("MuJoCo", "hinges, RK4", (50, 100, 200, 500, 1000, 2000, 4000, 8000, 16000), mujoco, "steps"),
        Program("scipy", "angles, DOP853", (1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13), scipy),
        Program("pymunk", "pivots, semi-implicit Euler", (250, 1000, 4000, 16000), pymunk, "steps"),
        Program("Exudyn", "tree of hinges, RK4", (50, 100, 200, 400, 800, 1600), exudyn_tree, "steps"),
        Program("Exudyn", "joints, generalised alpha", (50, 100, 200, 400, 800, 1600, 3200), exudyn_joints, "steps"),
    ),
    floor=7e-14,
    cannot={},
    within=1e-9,
)
