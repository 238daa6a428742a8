"""Slider-crank with play in the slider's pin: flight, an impact without bounce, sliding along the hole."""

from __future__ import annotations

import numpy as np

from mechanism_fmu.simulation import Simulation

from ...world.cases.clearance_slider_crank import (
    CRANK,
    CRANK_INERTIA,
    CRANK_MASS,
    GRAVITY,
    PIN_PLAY,
    ROD,
    ROD_INERTIA,
    ROD_MASS,
    SLIDER_MASS,
    SPEED,
    Pin,
    with_play,
)
from ..case import Case, Program, Run, Vector
from ..programs import engine

STOP = 0.03
#: Part of its drift that a joint of pymunk keeps in a second, as in the ratchet.
CORRECTION = 1e-100


def read(simulation: Simulation) -> Vector:
    """Angle of the crank [rad] and place of the slider [m], shape (2,)."""
    found = simulation.read()
    return np.array([found["angle"], found["slider"]])


class Plain(Pin):
    """Equations in the angles of crank and rod [rad] and the slider's place [m], for scipy."""

    def force(self, y: Vector) -> tuple[float, Vector]:
        """Force of the wall that keeps the gap closed [N], and the accelerations with it (3,)."""
        free, inverse = self.free(y)
        _, row, bend = self.row(y)
        multiplier = -(bend + float(row @ free)) / float(row @ inverse @ row)
        return multiplier, free + inverse @ row * multiplier

    def struck(self, y: Vector) -> Vector:
        """State (6,) after an impact without bounce."""
        _, inverse = self.free(y)
        _, row, _ = self.row(y)
        after = y.copy()
        after[3:] -= inverse @ row * float(row @ y[3:]) / float(row @ inverse @ row)
        return after


def scipy(tolerance: float) -> Run:
    """Scipy: DOP853, an event where the pin strikes, another one where the wall would pull."""
    from scipy.integrate import solve_ivp

    plain = Plain()

    def flies(_t: float, y: Vector) -> Vector:
        return np.concatenate([y[3:], plain.free(y)[0]])

    def touches(_t: float, y: Vector) -> Vector:
        return np.concatenate([y[3:], plain.force(y)[1]])

    def gap(_t: float, y: Vector) -> float:
        return plain.row(y)[0]

    def push(_t: float, y: Vector) -> float:
        return plain.force(y)[0]

    for event in (gap, push):
        event.terminal, event.direction = True, -1  # type: ignore[attr-defined]

    def run() -> Vector:
        now, y, closed = 0.0, plain.start, False
        while now < STOP:
            motion, event = (touches, push) if closed else (flies, gap)
            found = solve_ivp(
                motion, (now, STOP), y, "DOP853", rtol=tolerance, atol=1e-3 * tolerance, events=event, first_step=1e-7
            )
            now, y = found.t[-1], found.y[:, -1]
            if found.status == 1:
                y, closed = (y if closed else plain.struck(y)), not closed
        return y[[0, 2]]

    return run


def mujoco(steps: float) -> Run:
    """MuJoCo: hinges, a slide, and a tendon from the rod's end to the slider, whose limit is the clearance."""
    import mujoco as mj

    step = STOP / steps

    def inertial(x: float, mass: float, inertia: float) -> str:
        return f'<inertial pos="{x} 0 0" mass="{mass}" diaginertia="{inertia} {inertia} {inertia}"/>'

    # as stiff, and damped, as the face of benchmarks/many/mjcf.py
    model = mj.MjModel.from_xml_string(f"""
<mujoco>
  <option timestep="{step!r}" gravity="0 -{GRAVITY} 0" integrator="Euler" solver="Newton" jacobian="dense">
    <flag contact="disable"/>
  </option>
  <worldbody>
    <body><joint axis="0 0 1"/>{inertial(CRANK / 2, CRANK_MASS, CRANK_INERTIA)}
      <body pos="{CRANK} 0 0"><joint axis="0 0 1"/>{inertial(ROD / 2, ROD_MASS, ROD_INERTIA)}
        <site name="end" pos="{ROD} 0 0"/>
      </body>
    </body>
    <body pos="{CRANK + ROD} 0 0"><joint type="slide" axis="1 0 0"/>{inertial(0.0, SLIDER_MASS, 1e-3)}
      <site name="pin"/>
    </body>
  </worldbody>
  <tendon>
    <spatial limited="true" range="0 {PIN_PLAY}" solreflimit="{2 * step!r} 20" solimplimit="0.9999 0.9999 0.001">
      <site site="end"/><site site="pin"/>
    </spatial>
  </tendon>
</mujoco>""")
    data = mj.MjData(model)
    data.qvel[:2] = SPEED, -1.5 * SPEED

    def run() -> Vector:
        mj.mj_step(model, data, int(steps))
        return np.array([data.qpos[0], CRANK + ROD + data.qpos[2]])

    return run


def pymunk(steps: float) -> Run:
    """Pymunk: pivots, a groove, and a slide joint from the rod's end to the slider: no farther than the clearance."""
    import pymunk as pm

    space = pm.Space()
    space.gravity, space.iterations = (0.0, -GRAVITY), 30
    crank, rod = pm.Body(CRANK_MASS, CRANK_INERTIA), pm.Body(ROD_MASS, ROD_INERTIA)
    slider = pm.Body(SLIDER_MASS, float("inf"))  # its guide keeps it from turning
    crank.position, rod.position, slider.position = (CRANK / 2, 0.0), (CRANK + ROD / 2, 0.0), (CRANK + ROD, 0.0)
    crank.angular_velocity, rod.angular_velocity = SPEED, -SPEED / 2
    crank.velocity = rod.velocity = (0.0, SPEED * CRANK / 2)
    ground = space.static_body
    space.add(
        *(crank, rod, slider),
        pm.PivotJoint(ground, crank, (0.0, 0.0), (-CRANK / 2, 0.0)),
        pm.PivotJoint(crank, rod, (CRANK / 2, 0.0), (-ROD / 2, 0.0)),
        pm.GrooveJoint(ground, slider, (-1.0, 0.0), (1.0, 0.0), (0.0, 0.0)),
        pm.SlideJoint(rod, slider, (ROD / 2, 0.0), (0.0, 0.0), 0.0, PIN_PLAY),
    )
    for joint in space.constraints:
        joint.error_bias = CORRECTION

    def run() -> Vector:
        for _ in range(int(steps)):
            space.step(STOP / steps)
        return np.array([crank.angle, slider.position.x])

    return run


CASE = Case(
    name="clearance",
    title="Slider-crank with clearance",
    statement=(
        "The slider-crank of `docs/examples/gallery/slider_crank_clearance.py`, with play of 0.5 mm at 150 rad/s, "
        f"without bounce and friction, {STOP} s. Compared: angle of the crank [rad] and place of the slider [m] at "
        "the end."
    ),
    programs=(
        engine(with_play(0.0, 1e-9), read, STOP),
        Program("MuJoCo", "limit of a tendon, Euler", (500, 1500, 5000, 15000, 50000), mujoco, "steps"),
        Program("scipy", "DOP853 with events, multiplier by hand", (1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13), scipy),
        Program("pymunk", "slide joint, semi-implicit Euler", (500, 1500, 5000, 15000, 50000), pymunk, "steps"),
    ),
    floor=1e-12,
    cannot={
        "MuJoCo": "States it nearly, as a soft limit of two steps; with bounce not at all.",
        "pymunk": "Without bounce only: its slide joint has none, and its circles touch from outside, not in a hole.",
        "Exudyn": "Its joints have no clearance with an impact that takes no time: only springs and dampers.",
    },
    within=1e-8,
)
