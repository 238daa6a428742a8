"""Start position of the free ratchet, and what is wrong with parameter values."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Finding
from mechanism_fmu.model.findings import at_most, first, size, where
from mechanism_fmu.model.four_bar import angle_between
from mechanism_fmu.model.functions import Number, cos, minimum, sin, where_positive
from mechanism_fmu.model.sawtooth import Sawtooth

from ..ratchet.start import crank_pin, profile_findings, tooth

#: Of the wheel. How many copies an outline has belongs to the structure, which no parameter changes.
TOOTH_COUNT = 20


def with_teeth(values: SimpleNamespace) -> SimpleNamespace:
    """Parameter values as `models.ratchet` has them, with the number of teeth."""
    return SimpleNamespace(**{**vars(values), "tooth_count": TOOTH_COUNT})


def sharp_tooth(values: SimpleNamespace) -> Sawtooth:
    """Geometry of the teeth before their tips are rounded."""
    return tooth(with_teeth(values))


def nose_height(values: SimpleNamespace) -> Number:
    """How far the line on which the nose's middle slides down the slope of tooth 0 is from the crank pin [m]."""
    return crank_pin(values).height - values.nose_radius


def pawl_angle(values: SimpleNamespace) -> Number:
    """Start angle gamma [rad] of the pawl: given, or with the nose on the slope of tooth 0, pointing to the face.

    The normal of the slope has the polar angle psi + beta_0 - pi/2, and the nose touches the slope when
    height + b cos(gamma - that angle) = nose_radius.
    """
    b, normal_angle = values.pawl_length, values.wheel_angle_start + values.tooth_slope_angle - math.pi / 2
    on_slope = normal_angle + angle_between(-1.0 * nose_height(values), b * b)
    return where_positive(size(values.pawl_angle_start), values.pawl_angle_start, on_slope)


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the ratchet cannot be built or cannot start; what the nose is inside of, the engine finds."""
    height, b = nose_height(values), values.pawl_length
    solved = 1.0 - where_positive(size(values.pawl_angle_start), 1.0, 0.0)
    placed = (values.crank_length, *(angle * (180 / math.pi) for angle in _placed(values)))
    at = "at crank_length = {:.6g} m, crank_angle_start = {:.6g} deg and wheel_angle_start = {:.6g} deg"
    tip, largest = values.tooth_tip_radius, _largest_tip(values)
    return first(
        *profile_findings(with_teeth(values)),
        Finding(
            at_most(largest, tip),
            "tooth_tip_radius = {:.6g} m is too large: its rounding takes more than there is of the face or of the "
            "slope. Give less than {:.6g} m.",
            (tip, largest),
        ),
        *where(
            solved,
            Finding(
                -1.0 * height,
                "The crank pin starts {:.6g} m behind the line on which the nose slides down the slope, " + at + ". "
                "Give a longer crank, change one of these angles, or give pawl_angle_start.",
                (-1.0 * height, *placed),
            ),
            Finding(
                height - b,
                "pawl_length = {:.6g} m is {:.6g} m too short: from the crank pin, its nose does not reach the slope "
                "of the tooth " + at + ". Give at least {:.6g} m, or pawl_angle_start.",
                (b, height - b, *placed, height),
            ),
        ),
    )


def _largest_tip(values: SimpleNamespace) -> Number:
    """The radius [m] of a rounding that leaves next to nothing of the face or of the slope: its tangents are as long.

    They have the length r/tan(alpha/2), with alpha at the apex.
    """
    tooth = sharp_tooth(values)
    shorter = minimum(tooth.face_length, tooth.slope_length)
    return (1 - 1e-6) * shorter * sin(tooth.apex_angle) / (1.0 + cos(tooth.apex_angle))


def _placed(values: SimpleNamespace) -> tuple[Number, Number]:
    return values.crank_angle_start, values.wheel_angle_start
