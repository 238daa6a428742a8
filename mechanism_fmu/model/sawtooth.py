"""Geometry of a sawtooth wheel (Pennestrì et al., Figs. 4, 5 and 7)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .body import Point
from .functions import Number, atan2, cos, sin, sqrt, where_positive


@dataclass(frozen=True)
class Sawtooth:
    """The teeth at one root of the wheel.

    Wheel axes: origin at the wheel's hinge, x through the root P0 = (r, 0), y counter-clockwise. From P0 the
    slope runs clockwise to the apex T of its tooth; the face of the neighbouring tooth ends in P0 and stops
    the pawl.

    Attributes:
        pitch: theta, angle between two roots [rad].
        chord: h, distance between two roots [m].
        chord_angle: alpha_2, from the chord to the slope at the root [rad]; > 0, or the tooth has no height.
        slope_length: L, from the root to the apex [m].
        face_length: F, from the apex to the next root [m].
        apex_angle: alpha, between slope and face at the apex [rad]; the wedge angle of the beam model.
        beam_length: l of the right-angled beam model of Fig. 7 [m].
        apex: T [m].
        slope_direction, slope_normal: unit vectors along the slope away from the root, and out of the tooth.
        face_direction, face_normal: unit vectors along the face away from the root, and out of its tooth.
        boundary_normal: unit normal, towards the next tooth (clockwise), of the line that runs outwards from T and
            bisects the free angle there: on it, the slope before T and the face behind T are equally far.
    """

    pitch: Number
    chord: Number
    chord_angle: Number
    slope_length: Number
    face_length: Number
    apex_angle: Number
    beam_length: Number
    apex: Point
    slope_direction: Point
    slope_normal: Point
    face_direction: Point
    face_normal: Point
    boundary_normal: Point


def sawtooth(tooth_count: Number, slope_angle: Number, inner_radius: Number, slope_ratio: Number) -> Sawtooth:
    """Geometry of a wheel of equal teeth.

    Args:
        tooth_count: nt, >= 3.
        slope_angle: beta_0, between the slope and the radius at its root [rad], > pi/2 - pi/nt.
        inner_radius: r, of the roots [m], > 0.
        slope_ratio: c_prop = L / h, > 0.
    """
    r = inner_radius
    theta = 2 * math.pi / tooth_count
    h = 2 * r * sin(theta / 2)
    alpha_2 = slope_angle - math.pi / 2 + theta / 2
    L = slope_ratio * h
    slope = (-cos(slope_angle), -sin(slope_angle))
    apex = (r + L * slope[0], L * slope[1])
    # The face of this tooth runs from the next root, one pitch clockwise, to the apex; turned by one pitch it
    # is the face that ends in P0.
    dx, dy = apex[0] - r * cos(theta), apex[1] + r * sin(theta)
    F = sqrt(dx * dx + dy * dy)
    # Teeth without height may have a face without length: they are refused, but not by a division by zero.
    divisor = where_positive(F, F, 1.0)
    face = ((dx * cos(theta) - dy * sin(theta)) / divisor, (dx * sin(theta) + dy * cos(theta)) / divisor)
    slope_normal, face_normal = (sin(slope_angle), -cos(slope_angle)), (face[1], -face[0])
    # Normal of the next tooth's face, which begins in T, minus normal of the slope, which ends there.
    bx = cos(theta) * face_normal[0] + sin(theta) * face_normal[1] - slope_normal[0]
    by = cos(theta) * face_normal[1] - sin(theta) * face_normal[0] - slope_normal[1]
    B = sqrt(bx * bx + by * by)
    B = where_positive(B, B, 1.0)
    # L cos(alpha): from the apex to the foot of the perpendicular from P0 on the line of the face. The foot
    # lies beyond the next root when alpha + alpha_2 < 90 deg; the beam then ends at that root (Fig. 7, left).
    foot = L * (L - h * cos(alpha_2)) / divisor
    return Sawtooth(
        pitch=theta,
        chord=h,
        chord_angle=alpha_2,
        slope_length=L,
        face_length=F,
        apex_angle=atan2(h * sin(alpha_2), L - h * cos(alpha_2)),
        beam_length=where_positive(foot - F, F, foot),
        apex=apex,
        slope_direction=slope,
        slope_normal=slope_normal,
        face_direction=face,
        face_normal=face_normal,
        boundary_normal=(bx / B, by / B),
    )


def wheel_outline(tooth: Sawtooth, tooth_count: int, inner_radius: float) -> list[Point]:
    """The wheel as a polygon in wheel axes [m]: root, apex, next root, ..., clockwise from P0; plain numbers only."""
    points = []
    for k in range(tooth_count):
        c, s = cos(k * tooth.pitch), -sin(k * tooth.pitch)
        for x, y in ((inner_radius, 0.0), tooth.apex):
            points.append((c * x - s * y, s * x + c * y))
    return points
