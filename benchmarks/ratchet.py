"""The ratchet of the paper as numbers for `benchmarks.reference`; shares no code with `mechanism_fmu`.

Source: Pennestrì, Valentini, Vita, "Dynamic Analysis of Intermittent-Motion Mechanisms Through the Combined
Use of Gauss Principle and Logical Functions", Tables 1 and 2, Figs. 4 and 5. SI units and radians throughout.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]

#: Bodies, each with the coordinates (x, y, angle) of its centre of mass.
CRANK, PAWL, WHEEL = 0, 1, 2


@dataclass(frozen=True)
class Parameters:
    """Tables 1 and 2 of the paper and its base case, under the names and in the units of the FMU."""

    tooth_count: int = 10
    tooth_slope_angle: float = math.pi / 2
    hinge_distance: float = 0.130
    crank_length: float = 0.110
    pawl_length: float = 0.100
    wheel_inner_radius: float = 0.100
    slope_ratio: float = 1.115
    crank_mass: float = 0.1000
    crank_inertia: float = 0.0900e-3
    pawl_mass: float = 0.0976
    pawl_inertia: float = 0.0853e-3
    wheel_mass: float = 5.6264
    wheel_inertia: float = 32.7948e-3
    spring_stiffness: float = 15e-3
    spring_free_angle: float = math.radians(75)
    spring_preload: float = 0.0
    drive_torque: float = 1e-3
    load_torque: float = 0.0
    restitution: float = 0.0
    crank_angle_start: float = math.radians(77)
    wheel_angle_start: float = math.radians(75)
    baumgarte_alpha: float = 10.0
    baumgarte_beta: float = 1.0


@dataclass(frozen=True)
class Pin:
    """Point `point_i` of body `i` stays on point `point_j` of body `j`, or of the ground when `j` is None."""

    i: int
    point_i: Vector
    j: int | None
    point_j: Vector


@dataclass(frozen=True)
class Ratchet:
    """The mechanism that parameters describe.

    Attributes:
        parameters: where it comes from.
        mass: diagonal of the mass matrix M, shape (9,).
        pins: the revolute joints.
        tip: of the pawl, in the frame of the pawl.
        root: of the struck tooth, in the frame of the wheel.
        normals: unit normals of SLOPE and FACE in the frame of the wheel, towards the open side.
        start: q at the start, shape (9,); all rates are zero.
    """

    parameters: Parameters
    mass: Vector
    pins: tuple[Pin, ...]
    tip: Vector
    root: Vector
    normals: tuple[Vector, Vector]
    start: Vector


def build(p: Parameters) -> Ratchet:
    """Build the mechanism, with the pawl's tip on the slope and pointing towards the face."""
    pitch = 2 * math.pi / p.tooth_count
    alpha_2 = p.tooth_slope_angle - math.pi / 2 + pitch / 2
    apex_angle = math.atan2(math.sin(alpha_2), p.slope_ratio - math.cos(alpha_2))
    lean = math.pi - p.tooth_slope_angle - apex_angle - pitch  # of the face past the radius, clockwise
    slope_normal = unit(p.tooth_slope_angle - math.pi / 2)
    face_normal = np.array([-math.sin(lean), -math.cos(lean)])

    phi, psi = p.crank_angle_start, p.wheel_angle_start
    hinge, root = np.array([p.hinge_distance, 0.0]), np.array([p.wheel_inner_radius, 0.0])
    half_crank, half_pawl = np.array([p.crank_length / 2, 0.0]), np.array([p.pawl_length / 2, 0.0])
    pin = hinge + p.crank_length * unit(phi)
    height = slope_normal @ (rotation(-psi) @ pin - root)
    gamma = psi + p.tooth_slope_angle - math.pi / 2 + math.acos(-height / p.pawl_length)
    crank, pawl = hinge + rotation(phi) @ half_crank, pin + rotation(gamma) @ half_pawl
    masses = [p.crank_mass, p.crank_inertia, p.pawl_mass, p.pawl_inertia, p.wheel_mass, p.wheel_inertia]
    return Ratchet(
        parameters=p,
        mass=np.repeat(masses, [2, 1, 2, 1, 2, 1]),
        pins=(
            Pin(CRANK, -half_crank, None, hinge),
            Pin(PAWL, -half_pawl, CRANK, half_crank),
            Pin(WHEEL, np.zeros(2), None, np.zeros(2)),
        ),
        tip=half_pawl,
        root=root,
        normals=(slope_normal, face_normal),
        start=np.array([*crank, phi, *pawl, gamma, 0.0, 0.0, psi]),
    )


def unit(angle: float) -> Vector:
    """Unit vector with a polar angle."""
    return np.array([math.cos(angle), math.sin(angle)])


def rotation(angle: float) -> Vector:
    """Rotation matrix."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s], [s, c]])
