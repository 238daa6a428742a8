"""Start position of the ratchet, and what is wrong, or odd, with parameter values."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace

from mechanism_fmu.model import Finding
from mechanism_fmu.model.findings import at_most, either, first, size, where
from mechanism_fmu.model.four_bar import angle_between, root
from mechanism_fmu.model.functions import Number, atan2, cos, sin, sqrt, where_positive
from mechanism_fmu.model.sawtooth import Sawtooth, sawtooth

# Where the ratchet stands at the start: the crank pin and the pawl against the tooth.


@dataclass(frozen=True)
class Pin:
    """The crank pin at the start.

    Attributes:
        x, y: in the global frame, origin at the wheel's hinge [m].
        height: distance from the line of the slope, positive outside the tooth [m].
        distance: from the struck root along the slope, positive towards the apex [m].
    """

    x: Number
    y: Number
    height: Number
    distance: Number


def tooth(values: SimpleNamespace) -> Sawtooth:
    """Geometry of the wheel's teeth."""
    return sawtooth(values.tooth_count, values.tooth_slope_angle, values.wheel_inner_radius, values.slope_ratio)


def crank_pin(values: SimpleNamespace) -> Pin:
    """The crank pin at the start."""
    x = values.hinge_distance + values.crank_length * cos(values.crank_angle_start)
    y = values.crank_length * sin(values.crank_angle_start)
    # in wheel axes, from the root that is struck
    c, s = cos(values.wheel_angle_start), sin(values.wheel_angle_start)
    along, across = c * x + s * y - values.wheel_inner_radius, c * y - s * x
    cb, sb = cos(values.tooth_slope_angle), sin(values.tooth_slope_angle)
    return Pin(x, y, height=sb * along - cb * across, distance=-cb * along - sb * across)


def pawl_angle(values: SimpleNamespace) -> Number:
    """Start angle gamma [rad] of the pawl: given, on the slope (guided), or near the wheel, for assembly to close."""
    guided = where_positive(values.guided, angle_on_slope(values), angle_near_wheel(values))
    given = values.pawl_angle_start * values.pawl_angle_start * (1 - values.guided)
    return where_positive(given, values.pawl_angle_start, guided)


def starts_on_slope(values: SimpleNamespace) -> Number:
    """1 when assembly puts the pawl's tip on a slope, 0 when the pawl's start angle is given (free pawl only)."""
    return where_positive(values.pawl_angle_start * values.pawl_angle_start * (1 - values.guided), 0.0, 1.0)


def angle_on_slope(values: SimpleNamespace) -> Number:
    """Pawl angle [rad] with the tip on the line of the slope of tooth 0, the pawl pointing towards the face.

    The normal of the slope has the polar angle psi + beta_0 - pi/2, and the tip lies on the slope when
    height + b cos(gamma - that angle) = 0. Needs |height| <= b.
    """
    height, b = crank_pin(values).height, values.pawl_length
    normal_angle = values.wheel_angle_start + values.tooth_slope_angle - math.pi / 2
    return normal_angle + angle_between(-height, b * b)


def angle_near_wheel(values: SimpleNamespace) -> Number:
    """Pawl angle [rad] with the tip on the circle of the roots, where turning counter-clockwise presses on the wheel.

    From the pin, D away from the wheel's hinge: cos(angle between pawl and centre) = (D^2 + b^2 - r^2) / (2 D b).
    """
    pin, b, r = crank_pin(values), values.pawl_length, values.wheel_inner_radius
    square = pin.x * pin.x + pin.y * pin.y
    return 2 * math.pi + atan2(-pin.y, -pin.x) - angle_between(square + b * b - r * r, 4 * square * b * b)


def tip_distance(values: SimpleNamespace) -> Number:
    """Start distance of the guided pawl's tip from the struck root, along the slope [m]. Needs |height| <= b."""
    pin, b = crank_pin(values), values.pawl_length
    return pin.distance - root(b * b - pin.height * pin.height)


def locking_friction(values: SimpleNamespace) -> Number:
    """Coefficient of friction [1] from which on the pawl locks itself on the slope at the start: tan of an angle.

    A light pawl only pushes along itself. It slides down the slope as long as this direction, from pin to tip, is
    outside the cone of friction about the slope's normal: tan(angle between the two) > friction. The slope is that of
    tooth 0, or, under a free pawl, that of the root at which its tip stands.
    """
    pin, gamma = crank_pin(values), pawl_angle(values)
    tip = atan2(pin.y + values.pawl_length * sin(gamma), pin.x + values.pawl_length * cos(gamma))
    root_angle = where_positive(values.guided, values.wheel_angle_start, tip)
    off = root_angle + values.tooth_slope_angle - math.pi / 2 - gamma
    return size(sin(off)) / _larger(size(cos(off)), _ALONG)


# What is wrong, or odd, with parameter values that are each within their limits.

#: A pawl that lies along the slope to this angle [rad] has no friction at which it locks itself.
_ALONG = 1e-9

#: Slopes less than this above the line between two roots [rad] make no tooth.
_FLAT = 1e-6

#: A length that moves the crank pin less than this per metre is no way out.
_USEFUL_GAIN = 0.1

#: Where the crank pin and the tooth start, with `_placed`.
_AT = "at crank_length = {:.6g} m, crank_angle_start = {:.6g} deg and wheel_angle_start = {:.6g} deg"


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the ratchet cannot be built or cannot start: value, limit and way out; at most one applies."""
    # A start position has a meaning only on teeth that exist.
    return first(
        *profile_findings(values),
        *where(values.guided, *_start(values)),
        *where(1 - values.guided, *_free_start(values)),
    )


def warnings(values: SimpleNamespace) -> tuple[Finding, ...]:
    """What is legal, but not what a real ratchet would do; it means something only where nothing is objected to."""
    tip, slope, locks = tip_distance(values), tooth(values).slope_length, locking_friction(values)
    stuck = Finding(
        at_most(locks, values.friction),
        "friction = {:.6g} locks the pawl on the slope, at the start from {:.6g} on: its tip does not slide down to "
        "the root, but takes the wheel along from where it stands. For a pawl that comes to the tooth face give less.",
        (values.friction, locks),
    )
    return stuck, *where(
        values.guided,
        Finding(
            size(values.pawl_angle_start),
            "pawl_angle_start is not used by the guided pawl, whose tip starts on the slope; set guided = false.",
        ),
        Finding(
            tip - slope,
            "At the start, the pawl's tip lies on the extended slope, {:.6g} m beyond the apex "
            "of the tooth ({:.6g} m from the root; slope: {:.6g} m). The guided model follows "
            "that line, as the paper's does; a real pawl would rest on the next tooth. For a slope that is long "
            "enough give fewer teeth or a larger slope_ratio.",
            (tip - slope, tip, slope),
        ),
    )


def profile_findings(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the numbers of the teeth give no sawteeth: flat, blunt, or without a notch between them."""
    flattest = math.pi / 2 - math.pi / values.tooth_count
    shape = tooth(values)
    bluntest = cos(shape.chord_angle)
    # the face there is that of the tooth turned by the pitch; with four teeth or more, blunt teeth come first
    at_root, shallowest = shape.apex_angle + shape.pitch, sin(shape.pitch - shape.chord_angle) / sin(shape.pitch)
    return (
        Finding(
            at_most(values.tooth_slope_angle, flattest + _FLAT),
            "tooth_slope_angle = {:.6g} deg gives teeth without height: with "
            "tooth_count = {:g} give more than {:.6g} deg, or fewer teeth.",
            (_degrees(values.tooth_slope_angle), values.tooth_count, _degrees(flattest)),
        ),
        Finding(
            at_most(values.slope_ratio, bluntest),
            "slope_ratio = {:.6g} gives blunt teeth (apex angle "
            "{:.6g} deg, not below 90 deg), of which no length is left as a beam: "
            "give more than {:.6g}.",
            (values.slope_ratio, _degrees(shape.apex_angle), bluntest),
        ),
        Finding(
            at_most(math.pi, at_root),
            "slope_ratio = {:.6g} leaves no notch: where slope and face meet, the free angle is {:.6g} deg, not below "
            "180 deg, so that a tip on the slope is behind the face. With tooth_count = {:g} give more than {:.6g}, or "
            "more teeth.",
            (values.slope_ratio, _degrees(at_root), values.tooth_count, shallowest),
        ),
    )


def _start(values: SimpleNamespace) -> tuple[Finding, ...]:
    pin, b, tip = crank_pin(values), values.pawl_length, tip_distance(values)
    outwards = values.wheel_angle_start + values.tooth_slope_angle - math.pi / 2
    nearest, farthest = pin.height, _distance(pin.height, pin.distance)
    gap = tip * sin(tooth(values).apex_angle + tooth(values).pitch)
    return (
        *_pin_behind(
            "The crank pin starts {:.6g} m behind the slope of the tooth " + _AT + ".",
            values,
            -pin.height,
            outwards,
        ),
        *_pin_behind(
            "The crank pin starts {:.6g} m behind the root of the tooth along the slope, " + _AT + "; "
            "no pawl can stand before the tooth face.",
            values,
            -pin.distance,
            outwards - math.pi / 2,
        ),
        Finding(
            nearest - b,
            "pawl_length = {:.6g} m is {:.6g} m too short: from the crank pin it does not reach "
            "the slope of the tooth " + _AT + ". Give at least {:.6g} m and less than {:.6g} m.",
            (b, nearest - b, *_placed(values), nearest, farthest),
        ),
        Finding(
            at_most(tip, 0.0),
            "pawl_length = {:.6g} m is {:.6g} m too long: its tip would start inside the "
            "tooth, {:.6g} m behind the face, " + _AT + ". Give at least {:.6g} m and less than "
            "{:.6g} m, the distance from the crank pin to the root of the tooth.",
            (b, b - farthest, -gap, *_placed(values), nearest, farthest),
        ),
    )


def _free_start(values: SimpleNamespace) -> tuple[Finding, ...]:
    """A free pawl must reach the teeth; where exactly it rests, assembly finds, unless its angle is given."""
    pin, b, r = crank_pin(values), values.pawl_length, values.wheel_inner_radius
    distance, tips = _distance(pin.x, pin.y), _distance(*tooth(values).apex)
    at = "the crank pin starts {:.6g} m from the wheel's hinge"
    return where(
        at_most(size(values.pawl_angle_start), 0.0),
        Finding(
            distance - tips - b,
            "pawl_length = {:.6g} m is {:.6g} m too short: " + at + ", and the tips of the teeth at "
            "{:.6g} m. Give more than {:.6g} m, or change crank_angle_start.",
            (b, distance - tips - b, distance, tips, distance - tips),
        ),
        Finding(
            either(b - (distance + r), size(b - r) - distance),
            "pawl_length = {:.6g} m does not fit: " + at + ", and its tip cannot come to the roots of the teeth at "
            "{:.6g} m. Give between {:.6g} m and {:.6g} m, or change crank_angle_start.",
            (b, distance, r, size(distance - r), distance + r),
        ),
    )


def _pin_behind(text: str, values: SimpleNamespace, missing: Number, direction: Number) -> tuple[Finding, ...]:
    """Where `missing` >= 0: which length brings the crank pin forward by it along the polar angle `direction`."""
    crank, hinge = cos(values.crank_angle_start - direction), cos(direction)
    shown = (missing, *_placed(values))

    def longer(applies: Number, name: str, gain: Number) -> Finding:
        length, more = getattr(values, name), missing / _larger(gain, _USEFUL_GAIN)
        return Finding(
            applies,
            f"{text} {name} = {{:.6g}} m is {{:.6g}} m too short: give more than "
            "{:.6g} m, or change crank_angle_start or wheel_angle_start.",
            (*shown, length, more, length + more),
        )

    helpless = Finding(
        _USEFUL_GAIN - _larger(hinge, crank),
        f"{text} Neither crank_length nor hinge_distance can help; change crank_angle_start or wheel_angle_start.",
        shown,
    )
    return where(
        at_most(0.0, missing),
        *first(helpless, longer(hinge - crank, "hinge_distance", hinge), longer(1.0, "crank_length", crank)),
    )


def _placed(values: SimpleNamespace) -> tuple[Number, Number, Number]:
    return values.crank_length, _degrees(values.crank_angle_start), _degrees(values.wheel_angle_start)


def _degrees(angle: Number) -> Number:
    """As `math.degrees` multiplies."""
    return angle * (180 / math.pi)


def _distance(x: Number, y: Number) -> Number:
    return sqrt(x * x + y * y)


def _larger(a: Number, b: Number) -> Number:
    return where_positive(a - b, a, b)
