"""Ratchet of the paper to half a second behind its impact: sliding on a slope, and an impact without bounce."""

from __future__ import annotations

import numpy as np

from mechanism_fmu.simulation import Simulation
from models.ratchet.model import MODEL

from ...base_case import STOP
from ...many.mjcf import WHEEL, mjcf
from ...ratchet import Parameters, build, rotation, unit
from ...reference import CRANK_ANGLE, PAWL_ANGLE, WHEEL_ANGLE, simulate
from ..case import Case, Program, Run, Vector
from ..programs import engine

#: Part of its drift that a joint of pymunk keeps in a second. Of 1 to 0 in seven values this one came nearest; that of
#: pymunk's default, 1.8e-3, leaves an error of 1e-4 at any step.
CORRECTION = 1e-100


def read(simulation: Simulation) -> Vector:
    """Angle [rad] and speed [rad/s] of the wheel, shape (2,)."""
    found = simulation.read()
    return np.array([found["wheel_angle"], found["wheel_speed"]])


def scipy(tolerance: float) -> Run:
    """Scipy: the program of benchmarks/reference.py, RK45 with an event."""

    def run() -> Vector:
        q, rates = simulate(build(Parameters()), STOP, tolerance, 1e-3 * tolerance).at(STOP)
        return np.array([q[WHEEL_ANGLE], rates[WHEEL_ANGLE]])

    return run


def mujoco(steps: float) -> Run:
    """MuJoCo: the model of benchmarks/many/mjcf.py."""
    import mujoco as mj

    parameters = Parameters()
    model = mj.MjModel.from_xml_string(mjcf(parameters, STOP / steps))
    data = mj.MjData(model)
    data.ctrl[0] = parameters.drive_torque

    def run() -> Vector:
        mj.mj_step(model, data, int(steps))
        return np.array([data.qpos[WHEEL] + parameters.wheel_angle_start, data.qvel[WHEEL]])

    return run


def pymunk(steps: float) -> Run:
    """Pymunk: pivots, and a groove on the wheel along the tooth's slope, whose end is the tooth's face."""
    import pymunk as pm

    parameters = Parameters()
    start = build(parameters).start
    space = pm.Space()
    space.iterations = 30
    crank = pm.Body(parameters.crank_mass, parameters.crank_inertia)
    pawl = pm.Body(parameters.pawl_mass, parameters.pawl_inertia)
    wheel = pm.Body(parameters.wheel_mass, parameters.wheel_inertia)
    for body, angle in ((crank, CRANK_ANGLE), (pawl, PAWL_ANGLE), (wheel, WHEEL_ANGLE)):
        body.position, body.angle = tuple(start[angle - 2 : angle].tolist()), float(start[angle])
    half_crank, half_pawl = parameters.crank_length / 2, parameters.pawl_length / 2
    root = np.array([parameters.wheel_inner_radius, 0.0])
    tip = start[3:5] + rotation(start[PAWL_ANGLE]) @ np.array([half_pawl, 0.0])
    # from the root outwards, a little beyond where the tip is at first
    out = unit(parameters.tooth_slope_angle)
    length = 1.5 * float((rotation(-start[WHEEL_ANGLE]) @ tip - root) @ out)
    ground = space.static_body
    space.add(
        *(crank, pawl, wheel),
        pm.PivotJoint(ground, crank, (parameters.hinge_distance, 0.0), (-half_crank, 0.0)),
        pm.PivotJoint(crank, pawl, (half_crank, 0.0), (-half_pawl, 0.0)),
        pm.PivotJoint(ground, wheel, (0.0, 0.0), (0.0, 0.0)),
        pm.GrooveJoint(wheel, pawl, tuple(root.tolist()), tuple((root + length * out).tolist()), (half_pawl, 0.0)),
    )

    for joint in space.constraints:
        joint.error_bias = CORRECTION

    def run() -> Vector:
        for _ in range(int(steps)):
            # Torques hold for one step. A DampedRotarySpring without damping gives the same, more slowly.
            spring = parameters.spring_stiffness * (wheel.angle - parameters.spring_free_angle)
            crank.torque, wheel.torque = parameters.drive_torque, -spring
            space.step(STOP / steps)
        return np.array([wheel.angle, wheel.angular_velocity])

    return run


CASE = Case(
    name="ratchet",
    title="Ratchet of the paper",
    statement=(
        "The base case of [the paper](../papers.md): a crank drives a pawl along a tooth's slope until it strikes the "
        f"face, without bounce, and turns the wheel against its spring; {STOP} s. Compared: angle [rad] and speed "
        "[rad/s] of the wheel at the end."
    ),
    programs=(
        engine(MODEL.build(MODEL.values()), read, STOP),
        Program("MuJoCo", "slide and limit, Euler", (500, 1500, 5000, 15000, 50000), mujoco, "steps"),
        Program("scipy", "RK45 with an event, pseudoinverse", (1e-4, 1e-6, 1e-8, 1e-10, 1e-12), scipy),
        Program("pymunk", "groove, semi-implicit Euler", (500, 1500, 5000, 15000, 50000), pymunk, "steps"),
    ),
    floor=1e-14,
    cannot={
        "MuJoCo": "States it nearly: constraints and the face are soft, of two steps; a tip that leaves is not held.",
        "Exudyn": "It has the joints, but no impact that takes no time at the face: only springs and dampers.",
    },
    within=1e-9,
)
