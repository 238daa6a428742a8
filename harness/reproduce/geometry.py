"""Geometry of the paper's ratchet by hand: where the tip starts, the angle of Fig. 7, mass and inertia of a wheel."""

from __future__ import annotations

import math
from itertools import pairwise

from ..paper import SLOPE_ANGLES_DEG, TOOTH_COUNTS
from .bench import CRANK, HINGES, PAWL, PHI, PSI, RADIUS, tooth

#: nt and beta_0 [deg] of the twenty wheels.
CASES = tuple((count, angle) for count in TOOTH_COUNTS for angle in SLOPE_ANGLES_DEG)

_STEEL, _THICKNESS = 7850.0, 0.02


def gamma_on_slope(angle_deg: float) -> float:
    """Gamma(0) [rad] with the tip on the line of the slope, phi = 77 deg and psi = 75 deg, as the text says."""
    pin = HINGES + CRANK * math.cos(PHI), CRANK * math.sin(PHI)
    normal = PSI + math.radians(angle_deg) - math.pi / 2
    root = RADIUS * math.cos(PSI), RADIUS * math.sin(PSI)
    height = (pin[0] - root[0]) * math.cos(normal) + (pin[1] - root[1]) * math.sin(normal)
    return normal + math.acos(-height / PAWL)


def slope_gap(angle_deg: float, gamma_deg: float) -> float:
    """Distance of the tip from the line of the slope at the start [m], positive outside the tooth."""
    gamma = math.radians(gamma_deg)
    tip = HINGES + CRANK * math.cos(PHI) + PAWL * math.cos(gamma), CRANK * math.sin(PHI) + PAWL * math.sin(gamma)
    normal = PSI + math.radians(angle_deg) - math.pi / 2
    return (tip[0] - RADIUS * math.cos(PSI)) * math.cos(normal) + (tip[1] - RADIUS * math.sin(PSI)) * math.sin(normal)


def alpha_star(count: int, angle_deg: float) -> float:
    """Alpha + alpha_2 [deg]."""
    shape = tooth(count, angle_deg)
    return math.degrees(float(shape.apex_angle) + float(shape.chord_angle))


def solid_wheel(count: int, angle_deg: float, bore: float) -> tuple[float, float]:
    """Mass [kg] and inertia about its hinge [kg m2] of a steel wheel with these teeth: a sum over triangles."""
    shape = tooth(count, angle_deg)
    x, y = (float(c) for c in shape.apex)
    theta = float(shape.pitch)
    corners = [(RADIUS, 0.0), (x, y), (RADIUS * math.cos(theta), -RADIUS * math.sin(theta))]
    area = second = 0.0
    for (px, py), (qx, qy) in pairwise(corners):
        part = (py * qx - px * qy) / 2
        area += part
        second += part / 6 * (px * px + py * py + px * qx + py * qy + qx * qx + qy * qy)
    plate = _STEEL * _THICKNESS
    hole = math.pi * bore**2
    return plate * (count * area - hole), plate * (count * second - hole * bore**2 / 2)
