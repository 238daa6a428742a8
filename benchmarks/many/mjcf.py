"""The ratchet of the paper for MuJoCo, as near as it can come; shares no code with `mechanism_fmu`.

Crank, pawl and wheel on hinges. The pawl's tip is a point mass of its own, which slides on the wheel along the tooth's
slope and is connected to the end of the pawl (`equality/connect`); the limit of its slide is the tooth's face. The mass
is taken from the pawl, whose remaining mass, centre and inertia make up for it exactly. Alike are thus all bodies,
joints, springs and torques, the sliding on the slope, pushed or pulled, and an impact that leaves the tip at the face.
Not alike: constraints are soft by construction (here as stiff as MuJoCo takes them: impedance 0.9999, time constant two
steps, and a limit damped so much that it does not throw the tip back), the impact is what that limit does in a few
steps, and the face does not hold a tip that would leave it.
"""

from __future__ import annotations

import math

import numpy as np

from ..ratchet import Parameters, build, rotation, unit
from ..reference import PAWL_ANGLE

#: Of the pawl [kg], at its tip.
_TIP_MASS = 0.01

_STIFF = "0.9999 0.9999 0.001"

#: Coordinates of MuJoCo's state behind the time.
CRANK, PAWL, WHEEL, SLIDE = 0, 1, 2, 3


def mjcf(p: Parameters, step: float) -> str:
    """The model's text for a time step [s]; angles count from the start, torques are those of crank and wheel."""
    angle = float(build(p).start[PAWL_ANGLE])
    phi, psi = p.crank_angle_start, p.wheel_angle_start
    tip = np.array([p.hinge_distance, 0.0]) + p.crank_length * unit(phi) + p.pawl_length * unit(angle)
    tip = rotation(-psi) @ tip
    along = -unit(p.tooth_slope_angle)
    to_face = float((tip - np.array([p.wheel_inner_radius, 0.0])) @ along)
    mass = p.pawl_mass - _TIP_MASS
    centre = (p.pawl_mass / 2 - _TIP_MASS) * p.pawl_length / mass
    inertia = p.pawl_inertia + (p.pawl_mass / 4 - _TIP_MASS) * p.pawl_length**2 - mass * centre**2
    return f"""
<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <option timestep="{step!r}" gravity="0 0 0" integrator="Euler" solver="Newton" jacobian="dense">
    <flag contact="disable" island="disable"/>
  </option>
  <worldbody>
    <body pos="{p.hinge_distance!r} 0 0" quat="{_turned(phi)}">
      <joint name="crank" axis="0 0 1"/>
      {_inertial(p.crank_length / 2, p.crank_mass, p.crank_inertia)}
      <body pos="{p.crank_length!r} 0 0" quat="{_turned(angle - phi)}">
        <joint axis="0 0 1"/>
        {_inertial(centre, mass, inertia)}
        <site name="end of the pawl" pos="{p.pawl_length!r} 0 0"/>
      </body>
    </body>
    <body quat="{_turned(psi)}">
      <joint name="wheel" axis="0 0 1" stiffness="{p.spring_stiffness!r}" springref="{p.spring_free_angle - psi!r}"/>
      {_inertial(0.0, p.wheel_mass, p.wheel_inertia)}
      <body pos="{float(tip[0])!r} {float(tip[1])!r} 0">
        <joint type="slide" axis="{float(along[0])!r} {float(along[1])!r} 0" range="{-to_face!r} 1"
          solreflimit="{2 * step!r} 20" solimplimit="{_STIFF}"/>
        {_inertial(0.0, _TIP_MASS, 1e-12)}
        <site name="tip"/>
      </body>
    </body>
  </worldbody>
  <equality>
    <connect site1="end of the pawl" site2="tip" solref="{2 * step!r} 1" solimp="{_STIFF}"/>
  </equality>
  <actuator><motor joint="crank"/><motor joint="wheel"/></actuator>
</mujoco>
"""


def _turned(angle: float) -> str:
    return f"{math.cos(angle / 2)!r} 0 0 {math.sin(angle / 2)!r}"


def _inertial(x: float, mass: float, inertia: float) -> str:
    """Of a body in the plane; the moments about the axes in it count for nothing, but must be possible."""
    return f'<inertial pos="{x!r} 0 0" mass="{mass!r}" diaginertia="{inertia / 2!r} {inertia / 2!r} {inertia!r}"/>'
