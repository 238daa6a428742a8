"""Inputs, outputs and parameters of the cam drive."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Calculated, Output, Parameter
from mechanism_fmu.model.port_builders import (
    JOINT_FRICTION,
    SETTINGS,
    angle_output,
    damping_parameter,
    drive_torque_input,
    energy_outputs,
    flag_output,
    impact_outputs,
    length_parameter,
    load_torque_input,
    rotor_parameters,
    shaft_inputs,
    shaft_parameters,
    shaft_torque_output,
    speed_output,
    start_parameters,
    whole_output,
)

from .geometry import timing
from .shapes import form

INPUTS = (
    *shaft_inputs(speed=2 * math.pi),
    drive_torque_input("cam"),
    load_torque_input("follower"),
)
_ALL_INPUTS = tuple(port.name for port in INPUTS)


def _impact(prefix: str, source: str, of: str) -> tuple[Output, ...]:
    """What is known of an impact: of the roller on the cam, for there is no other."""
    return (
        Output(
            f"{prefix}closing_speed",
            f"{source}closing_speed",
            f"Speed at which the roller comes to the cam, {of}",
            "m/s",
            nominal=0.1,
        ),
        Output(f"{prefix}impulse", f"{source}impulse", f"Impulse on the roller, {of}", "N.s", nominal=0.01),
        *(
            Output(
                f"{prefix}{body}_speed",
                f"{source}speed:{body}",
                f"Speed of the {body} just after, {of}",
                "rad/s",
                "rpm",
                nominal=1.0,
            )
            for body in ("cam", "follower")
        ),
    )


OUTPUTS = (
    angle_output("cam", "theta"),
    angle_output("follower", "psi"),
    speed_output("cam"),
    speed_output("follower"),
    Output(
        "contact_force",
        "contact.force",
        "Force of the cam on the roller, along their common normal; negative: a guided roller is pulled; 0 when open",
        "N",
        nominal=1.0,
        feedthrough=_ALL_INPUTS,
    ),
    Output("contact_gap", "contact.gap", "Distance between cam and roller", "m", nominal=1e-3),
    flag_output("contact_active", "contact.closed", "The roller is on the cam"),
    Output(
        "cam_contact_angle",
        "contact.alpha_i",
        "Angle of the cam's profile nearest to the roller (alpha), unwrapped",
        "rad",
        "deg",
        nominal=1.0,
    ),
    Output(
        "roller_contact_angle",
        "contact.alpha_j",
        "Angle on the roller nearest to the cam, from the arm's direction; the pressure angle is this less 270 deg",
        "rad",
        "deg",
        nominal=1.0,
    ),
    shaft_torque_output("cam"),
    whole_output("event_count", "event.count", "Events since the start: lift-offs and impacts"),
    *impact_outputs("Impacts of the roller on the cam", _impact),
    *energy_outputs(
        "Kinetic energy of cam and follower",
        "Energy of the return spring, without its preload",
        "Work done by drive shaft, preload, drive_torque and load_torque since the start",
        "Energy lost in impacts, friction and the damper since the start",
    ),
)


def _angle(name: str, degrees: float, description: str, least: float) -> Parameter:
    return Parameter(name, math.radians(degrees), description, "rad", least, 2 * math.pi, display_unit="deg")


PARAMETERS = (
    length_parameter("base_radius", 0.03, "Radius of the cam's base circle"),
    Parameter("lift", 0.0216, "Radius of the upper dwell less that of the base circle", "m", 0.0, 1e3),
    _angle("rise_angle", 150, "Angle of the cam over which it lifts the roller, cycloidal, turning forwards", 0.01),
    _angle("dwell_angle", 30, "Angle of the cam over which the roller rests on the upper dwell", 0.0),
    _angle("return_angle", 150, "Angle of the cam over which the roller comes down, cycloidal", 0.01),
    length_parameter("roller_radius", 0.01, "Radius of the roller"),
    length_parameter("hinge_distance", 0.08, "Distance between the hinges of follower and cam"),
    length_parameter("follower_length", 0.06, "Distance of the roller's centre from the follower's hinge"),
    *rotor_parameters("cam", 0.8, 1e-3),
    *rotor_parameters("follower", 0.1, 1.5e-4),
    *start_parameters("cam", 2 * math.pi, " (theta); the follower's follows", "the follower's follows"),
    Parameter("spring_stiffness", 0.1, "Stiffness of the return spring", "N.m/rad", 0.0, 1e6),
    Parameter("spring_preload", 0.02, "Torque of the return spring on the base circle", "N.m", -1e6, 1e6),
    damping_parameter("follower"),
    *shaft_parameters(damping=1.0),
    Parameter(
        "unilateral",
        0.0,
        "Whether the roller can leave the cam; if not, it is guided and only a warning tells that it would",
        type="Boolean",
    ),
    Parameter("restitution", 0.0, "Coefficient of restitution of the roller on the cam (unilateral)", "1", 0.0, 1.0),
    JOINT_FRICTION,
    *SETTINGS,
)


def calculated(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """The follower's swing, when it happens, and what drawings need."""
    at = timing(values)
    angles = {
        "follower_low_angle": (at.low, "Angle of the follower on the base circle"),
        "follower_high_angle": (at.high, "Angle of the follower on the upper dwell"),
        "follower_swing": (at.high - at.low, "Swing of the follower from the base circle to the upper dwell"),
        "rise_start_angle": (at.rise_start, "Cam angle at which the rise begins, turning forwards"),
        "rise_end_angle": (at.rise_end, "Cam angle at which the rise ends and the upper dwell begins"),
        "return_start_angle": (at.return_start, "Cam angle at which the upper dwell ends and the return begins"),
        "return_end_angle": (at.return_end, "Cam angle at which the return ends"),
    }
    return (
        *(Calculated(name, value, description, "rad", "deg") for name, (value, description) in angles.items()),
        *form(values),
    )
