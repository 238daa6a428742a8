"""What is wrong, or odd, with parameter values that are each within their limits."""

from __future__ import annotations

import math
from collections.abc import Iterator
from types import SimpleNamespace

from .start import crank_pin, tip_distance, tooth

#: Slopes less than this above the line between two roots [rad] make no tooth.
_FLAT = 1e-6

#: A length that moves the crank pin less than this per metre is no way out.
_USEFUL_GAIN = 0.1


def objections(values: SimpleNamespace) -> list[str]:
    """Why the ratchet cannot be built or cannot start: value, limit and way out, one message each."""
    # A start position has a meaning only on teeth that exist.
    return list(_profile(values)) or list(_start(values) if values.guided else _free_start(values))


def warnings(values: SimpleNamespace) -> list[str]:
    """What is legal, but not what a real ratchet would do. `values` must be free of objections."""
    if not values.guided:
        return []
    return list(_guided_warnings(values))


def _guided_warnings(values: SimpleNamespace) -> Iterator[str]:
    if values.pawl_angle_start:
        yield "pawl_angle_start is not used by the guided pawl, whose tip starts on the slope; set guided = false."
    tip, slope = tip_distance(values), tooth(values).slope_length
    if tip > slope:
        yield (
            f"At the start, the pawl's tip lies on the extended slope, {tip - slope:.6g} m beyond the apex "
            f"of the tooth ({tip:.6g} m from the root; slope: {slope:.6g} m). The guided model follows "
            "that line, as the paper's does; a real pawl would rest on the next tooth. For a slope that is long "
            "enough give fewer teeth or a larger slope_ratio."
        )


def _profile(values: SimpleNamespace) -> Iterator[str]:
    flattest = math.pi / 2 - math.pi / values.tooth_count
    if values.tooth_slope_angle <= flattest + _FLAT:
        yield (
            f"tooth_slope_angle = {_degrees(values.tooth_slope_angle)} gives teeth without height: with "
            f"tooth_count = {values.tooth_count:g} give more than {_degrees(flattest)}, or fewer teeth."
        )
        return
    bluntest = math.cos(tooth(values).chord_angle)
    if values.slope_ratio <= bluntest:
        yield (
            f"slope_ratio = {values.slope_ratio:.6g} gives blunt teeth (apex angle "
            f"{_degrees(tooth(values).apex_angle)}, not below 90 deg), of which no length is left as a beam: "
            f"give more than {bluntest:.6g}."
        )


def _start(values: SimpleNamespace) -> Iterator[str]:
    pin, b = crank_pin(values), values.pawl_length
    outwards = values.wheel_angle_start + values.tooth_slope_angle - math.pi / 2
    nearest, farthest = pin.height, math.hypot(pin.height, pin.distance)
    at = (
        f"at crank_angle_start = {_degrees(values.crank_angle_start)} and "
        f"wheel_angle_start = {_degrees(values.wheel_angle_start)}"
    )
    if pin.height <= 0:
        yield (
            f"The crank pin starts {-pin.height:.6g} m behind the slope of the tooth {at}. "
            f"{_way_out(values, -pin.height, outwards)}"
        )
    elif pin.distance <= 0:
        yield (
            f"The crank pin starts {-pin.distance:.6g} m behind the root of the tooth along the slope, {at}; "
            "no pawl can stand before the tooth face. "
            f"{_way_out(values, -pin.distance, outwards - math.pi / 2)}"
        )
    elif b < nearest:
        yield (
            f"pawl_length = {b:.6g} m is {nearest - b:.6g} m too short: from the crank pin it does not reach "
            f"the slope of the tooth {at}. Give at least {nearest:.6g} m and less than {farthest:.6g} m."
        )
    elif tip_distance(values) <= 0:
        gap = tip_distance(values) * math.sin(tooth(values).apex_angle + tooth(values).pitch)
        yield (
            f"pawl_length = {b:.6g} m is {b - farthest:.6g} m too long: its tip would start inside the "
            f"tooth, {-gap:.6g} m behind the face, {at}. Give at least {nearest:.6g} m and less than "
            f"{farthest:.6g} m, the distance from the crank pin to the root of the tooth."
        )


def _free_start(values: SimpleNamespace) -> Iterator[str]:
    """A free pawl must reach the teeth; where exactly it rests, assembly finds."""
    pin, b, r = crank_pin(values), values.pawl_length, values.wheel_inner_radius
    distance, tips = math.hypot(pin.x, pin.y), math.hypot(*tooth(values).apex)
    at = f"the crank pin starts {distance:.6g} m from the wheel's hinge"
    if values.pawl_angle_start:
        return
    if b < distance - tips:
        yield (
            f"pawl_length = {b:.6g} m is {distance - tips - b:.6g} m too short: {at}, and the tips of the teeth at "
            f"{tips:.6g} m. Give more than {distance - tips:.6g} m, or change crank_angle_start."
        )
    elif b > distance + r or distance < abs(b - r):
        yield (
            f"pawl_length = {b:.6g} m does not fit: {at}, and its tip cannot come to the roots of the teeth at "
            f"{r:.6g} m. Give between {abs(distance - r):.6g} m and {distance + r:.6g} m, or change crank_angle_start."
        )


def _way_out(values: SimpleNamespace, missing: float, direction: float) -> str:
    """Which length brings the crank pin forward by `missing` along the global polar angle `direction`."""
    gains = {
        "crank_length": math.cos(values.crank_angle_start - direction),
        "hinge_distance": math.cos(direction),
    }
    name, gain = max(gains.items(), key=lambda item: item[1])
    if gain < _USEFUL_GAIN:
        return "Neither crank_length nor hinge_distance can help; change crank_angle_start or wheel_angle_start."
    length = getattr(values, name)
    return (
        f"{name} = {length:.6g} m is {missing / gain:.6g} m too short: give more than "
        f"{length + missing / gain:.6g} m, or change crank_angle_start or wheel_angle_start."
    )


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.6g} deg"
