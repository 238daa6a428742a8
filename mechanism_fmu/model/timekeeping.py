"""What escapements have in common: ports of a clock or watch, and the drop of an anchor."""

from __future__ import annotations

import math

from .drawing import Polyline, Wheel
from .findings import Finding, at_most
from .forces import Oscillation
from .four_bar import angle_between
from .functions import Number, cos, minimum, sin
from .port_builders import (
    angle_parameter,
    body_angle_output,
    body_speed_output,
    damping_parameter,
    energy_outputs,
    impact_outputs,
    inertia_parameter,
    length_parameter,
    mass_parameter,
    whole_output,
)
from .ports import Input, Output, Parameter

#: What swings is timed by the `Oscillation` of this name.
BEAT = "beat"


def drive_input(start: float | str, what: str, *, usual: tuple[float | str, float | str]) -> Input:
    """The torque that drives the escape wheel: drive_torque, of the `Torque` "drive".

    Args:
        start: before the first value arrives [N.m].
        what: has it, e.g. "mainspring".
        usual: as of `Parameter`.
    """
    text = f"Torque of the {what} on the escape wheel, counter-clockwise positive"
    # a text becomes a number where the port is made
    return Input("drive_torque", "drive.torque", start, text, "N.m", -1e6, 1e6, "mN.m", usual=usual)  # type: ignore[arg-type]


def nominal_period_parameter(start: float) -> Parameter:
    """nominal_period [s], on which `rate` counts.

    Args:
        start: default value [s].
    """
    text = "Period of a clock that keeps time, to which rate refers"
    return Parameter("nominal_period", start, text, "s", 1e-6, 1e6)


def beat(body: str, nominal_period: Number) -> Oscillation:
    """The `Oscillation` that `timekeeping_outputs` reads: of a body that swings about angle 0.

    Args:
        body: its name.
        nominal_period: of a clock that keeps time [s].
    """
    return Oscillation(BEAT, body, nominal_period=nominal_period)


def timekeeping_outputs(body: str, symbol: str, energy: float, power: float) -> tuple[Output, ...]:
    """Motion of escape wheel and oscillator, what a watchmaker reads, the ticks (impacts), and energies.

    Args:
        body: what swings.
        symbol: letter of its angle in the equations.
        energy: a typical one [J].
        power: a typical one [W].
    """
    watch = (
        Output("period", f"{BEAT}.period", "Last whole period; 0 before the first", "s"),
        Output("amplitude", f"{BEAT}.amplitude", f"Amplitude of the {body}; 0 until known", "rad", "deg"),
        Output("rate", f"{BEAT}.rate", "Gain on nominal_period over the last period; 0 until known", "s/d"),
        Output("power", f"{BEAT}.power", "Mean power through the escapement over it", "W", "mW", nominal=power),
        whole_output("swings", f"{BEAT}.passages", f"Passages of the {body} through 0 upwards, since the start"),
        Output("swing_time", f"{BEAT}.last_passage", "Time of the last of them; -1 before the first", "s"),
    )
    fields = (
        Output("closing_speed", "closing_speed", "Closing speed, {impact}", "m/s", nominal=0.01),
        Output("impulse", "impulse", "Impulse along the common normal, {impact}", "N.s", nominal=1e-5),
        whole_output("contact", "contact", "Number of the struck contact, in the order of the model, {impact}"),
    )
    return (
        body_angle_output("wheel", "psi"),
        body_angle_output(body, symbol),
        body_speed_output("wheel"),
        body_speed_output(body),
        *watch,
        *impact_outputs("Ticks: impacts", fields),
        *energy_outputs(
            kinetic="Kinetic energy of all parts",
            spring="Energy of the hairspring; 0 without one",
            work="Work done by drive_torque and weights since the start",
            lost="Energy lost in impacts and dampers since the start",
            nominal=energy,
        ),
    )


def pendulum_parameters(length: float, damping: float, start: float | str) -> tuple[Parameter, ...]:
    """A pendulum, and gravity.

    Args:
        length: default value of pendulum_length [m].
        damping: default value of pendulum_damping [N.m.s/rad].
        start: default value of pendulum_angle_start [rad].
    """
    inertia = "Moment of inertia of the pendulum about its centre of mass"
    return (
        mass_parameter("pendulum_mass", 1.0, "Mass of pendulum and anchor"),
        length_parameter("pendulum_length", length, "From the arbor to the centre of mass", usual=(0.2, 1.5)),
        inertia_parameter("pendulum_inertia", 2e-4, inertia),
        damping_parameter("pendulum", damping, usual=(0.0, 4 * damping)),
        angle_parameter("pendulum_angle_start", start, "Angle of the pendulum at the start", -0.3, 0.3),
        Parameter("gravity", 9.81, "Gravitational acceleration, downwards", "m/s2", 1e-3, 1e3),
    )


def wheel_shape(teeth: int, radius: float) -> Wheel:
    """How an escape wheel with pointed teeth is drawn, which turns counter-clockwise about the origin.

    Args:
        teeth: how many.
        radius: of the circle of their tips [m].
    """
    pitch = 2.0 * math.pi / teeth
    root = radius * (1.0 - 0.8 * pitch)
    return Wheel(
        "escape wheel", (0.0, 0.0), "wheel_angle", teeth, ((root, -0.5 * pitch), (radius, 0.0), (root, -0.1 * pitch))
    )


def anchor_shape(body: str, at: tuple[float, float], arm: float, aside: float) -> Polyline:
    """How an anchor is drawn that is part of a body.

    Args:
        body: its name.
        at: the arbor [m].
        arm: from there to the pallets [m].
        aside: angle between the line of centres and the line to a pallet [rad].
    """
    out, inside = 1.0, 0.55
    ends = [
        (reach * arm * math.sin(side * aside), -reach * arm * math.cos(aside))
        for side in (-1, 1)
        for reach in (out, inside)
    ]
    (left, near_left), (right, near_right) = (ends[0], ends[1]), (ends[2], ends[3])
    up = (0.0, 0.25 * arm)
    return Polyline(
        "anchor",
        at,
        f"{body}_angle",
        (left, (0.5 * near_left[0], near_left[1] * 0.6), (0.5 * near_right[0], near_right[1] * 0.6), right, up),
    )


def polar(radius: Number, angle: Number) -> tuple[Number, Number]:
    """The point (x, y) [m] at a radius [m] and an angle [rad]."""
    return radius * cos(angle), radius * sin(angle)


# The drop of an anchor: how far the wheel turns freely from where a tooth leaves one pallet to where another meets the
# other. Tooth tips are circles of a radius rho about points on the wheel's circle; pallets lie between two circles
# about the anchor's arbor, and the lines from there to the pallets touch the wheel's circle. What a tooth must pass,
# and where the next one stops, is rho beyond the pallet.


def anchor_drop(teeth: int, radius: Number, span: float, thickness: Number, tip_radius: Number) -> Number:
    """By how much the wheel turns freely after a tooth has left either pallet: the smaller of both angles [rad].

    Args:
        teeth: of the wheel.
        radius: of the circle of their tips' centres [m].
        span: angle between the line of centres and the radius to a pallet [rad].
        thickness: of the pallets, between circles about the arbor at which teeth leave them [m].
        tip_radius: of the teeth [m].

    Source: law of cosines for the angle at the wheel's axis at which a tooth is at a distance from the arbor.
    """
    pitch, arm = 2.0 * math.pi / teeth, radius * math.tan(span)
    below = math.floor(2.0 * span / pitch)  # pitches between teeth that are nearer to each other than pallets
    reach = 0.5 * thickness + tip_radius
    inside = 2.0 * _seen(radius, span, arm - reach) - below * pitch
    outside = (below + 1) * pitch - 2.0 * _seen(radius, span, arm + reach)
    return minimum(inside, outside)


def _seen(radius: Number, span: float, distance: Number) -> Number:
    """Angle at the wheel's axis, from the line of centres to a tooth at a distance from the arbor [rad]."""
    d = radius / math.cos(span)
    return angle_between((radius * radius + d * d - distance * distance) / (2.0 * radius * d))


def anchor_room(teeth: int, radius: float, span: float) -> float:
    """What half the thickness of the pallets and the tip's radius must be below together [m]: there the drop is 0.

    Args:
        teeth: as of `anchor_drop`.
        radius: likewise [m].
        span: likewise [rad].

    Source: law of cosines, as of `anchor_drop`, for the distance.
    """
    half_pitch, arm, d = math.pi / teeth, radius * math.tan(span), radius / math.cos(span)
    below = math.floor(span / half_pitch)
    near, far = (
        math.sqrt(radius * radius + d * d - 2.0 * radius * d * math.cos(count * half_pitch))
        for count in (below, below + 1)
    )
    return min(arm - near, far - arm)


def drop_finding(
    drop: Number,
    most: Number,
    thickness: Number,
    tip_radius: Number,
    what: str = "pallet_thickness",
    tip: str = "tip_radius",
) -> Finding:
    """What is said where a tooth cannot leave one pallet before another tooth is on the other pallet.

    Args:
        drop: of the anchor [rad].
        most: radius of tips with which it is 0 [m].
        thickness: of the pallets, or of teeth between round pallets [m].
        tip_radius: of the teeth, or of round pallets [m].
        what: name of the thickness.
        tip: name of the parameter that is the radius.
    """
    return Finding(
        at_most(most, tip_radius),
        f"The anchor jams: with {what} = {{:.6g}} m and {tip} = {{:.6g}} m its drop is {{:.4g}} deg, but it must "
        "be positive: a tooth cannot leave one pallet before another is on the other. Between them is room for "
        f"{tip} below {{:.6g}} m; give less, or a smaller {what}.",
        (thickness, tip_radius, drop * (180.0 / math.pi), most),
    )


def lock_finding(lock: Number, arm: Number, tip_radius: Number) -> Finding:
    """What is said where the other pallet is not yet in the way of the tooth that is to drop onto it.

    Args:
        lock: angle of the anchor by which the tooth drops behind the pallet's corner [rad].
        arm: from arbor to pallet [m].
        tip_radius: of the teeth [m].
    """
    degrees = 180.0 / math.pi
    least = tip_radius / arm
    return Finding(
        at_most(lock, least),
        "The anchor does not hold: lock_angle = {:.4g} deg, but a tip with tip_radius = {:.6g} m, {:.4g} m from the "
        "arbor, needs more than {:.4g} deg to drop behind the corner of the other pallet, which is not yet in its way. "
        "Give a larger lock_angle, or a smaller tip_radius.",
        (lock * degrees, tip_radius, arm, least * degrees),
    )
