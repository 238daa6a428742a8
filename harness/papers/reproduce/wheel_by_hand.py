"""Geometry of the paper's ratchet by hand: where the tip starts, the angle of Fig. 7, mass and inertia of a wheel.

Points of the plane are complex numbers.
"""

from __future__ import annotations

import cmath
import math

import numpy as np

from .bench import CRANK, HINGES, PAWL, PHI, PSI, RADIUS, tooth

_STEEL, _THICKNESS = 7850.0, 0.02
#: Crank pin and root P0 at the start [m].
_PIN, _ROOT = HINGES + cmath.rect(CRANK, PHI), cmath.rect(RADIUS, PSI)


def gamma_on_slope(angle_deg: float) -> float:
    """Gamma(0) [rad] with the tip on the line of the slope, phi = 77 deg and psi = 75 deg, as the text says."""
    return _normal(angle_deg) + math.acos(-_height(_PIN, angle_deg) / PAWL)


def slope_gap(angle_deg: float, gamma_deg: float) -> float:
    """Distance of the tip from the line of the slope at the start [m], positive outside the tooth."""
    return _height(_PIN + cmath.rect(PAWL, math.radians(gamma_deg)), angle_deg)


def _normal(angle_deg: float) -> float:
    """Direction across the slope at the start, out of the tooth [rad]."""
    return PSI + math.radians(angle_deg) - math.pi / 2


def _height(point: complex, angle_deg: float) -> float:
    """Of a point above the line of the slope at the start [m]."""
    return ((point - _ROOT) * cmath.rect(1.0, -_normal(angle_deg))).real


def alpha_star(count: int, angle_deg: float) -> float:
    """Alpha + alpha_2 [deg]."""
    shape = tooth(count, angle_deg)
    return math.degrees(float(shape.apex_angle) + float(shape.chord_angle))


def solid_wheel(count: int, angle_deg: float, bore: float) -> tuple[float, float]:
    """Mass [kg] and inertia about its hinge [kg m2] of a steel wheel with these teeth: a sum over triangles."""
    shape = tooth(count, angle_deg)
    corners = np.array([RADIUS, complex(*map(float, shape.apex)), cmath.rect(RADIUS, -float(shape.pitch))])
    p, q = corners[:-1], corners[1:]
    areas = (p * q.conj()).imag / 2
    seconds = areas / 6 * (abs(p) ** 2 + (p * q.conj()).real + abs(q) ** 2)
    hole = math.pi * bore**2
    return (
        _STEEL * _THICKNESS * float(count * areas.sum() - hole),
        _STEEL * _THICKNESS * float(count * seconds.sum() - hole * bore**2 / 2),
    )
