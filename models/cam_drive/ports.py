"""Inputs, outputs and parameters of the cam drive, and how it is drawn from them."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Bar, Calculated, Disc, Hinge, Output, Parameter, Striker, Wheel, port_builders as ports

from .geometry import radius_at, timing

# How the cam drive is drawn from its variables: cam, follower arm, roller, hinges.
#
# The cam's outline takes radii that follow from the parameters, `outline_cam_<degrees>`.

#: Angles of the profile at which the outline is drawn [deg].
_DEGREES = tuple(range(0, 360, 10))

_CAM_HINGE, _FOLLOWER_HINGE = (0.0, 0.0), ("-hinge_distance", 0.0)


def _name(degrees: int) -> str:
    return f"outline_cam_{degrees:03d}"


SHAPES = (
    Wheel("cam", _CAM_HINGE, "cam_angle", 1, tuple((_name(d), math.radians(d)) for d in _DEGREES)),
    Bar("follower", _FOLLOWER_HINGE, "follower_angle", "follower_length"),
    Disc("roller", "follower", "roller_radius"),
    Hinge(_CAM_HINGE),
    Hinge(_FOLLOWER_HINGE),
    Striker("follower"),
)


def form(values: SimpleNamespace) -> tuple[Calculated, ...]:
    """The radii of the outline."""
    return tuple(
        Calculated(
            _name(degrees),
            radius_at(values, math.radians(degrees)),
            f"Drawing: radius of the cam at {degrees} deg of its profile",
            "m",
        )
        for degrees in _DEGREES
    )


INPUTS = (
    *ports.shaft_inputs(speed=2 * math.pi),
    ports.torque_input("drive", "cam", usual=(-0.1, 0.1)),
    ports.load_torque_input("follower", usual=(-0.05, 0.05)),
)

#: What is known of an impact: of the roller on the cam, for there is no other.
_IMPACT = (
    Output(
        "closing_speed", "closing_speed", "Speed at which the roller comes to the cam, {impact}", "m/s", nominal=0.1
    ),
    Output("impulse", "impulse", "Impulse on the roller, {impact}", "N.s", nominal=0.01),
    *ports.impact_speed_fields("cam", "follower"),
)

OUTPUTS = (
    *ports.body_motion_outputs({"cam": "theta", "follower": "psi"}),
    ports.force_output(
        "contact_force",
        "contact.force",
        "Force of the cam on the roller, along their common normal; negative: a guided roller is pulled; 0 when open",
        INPUTS,
    ),
    Output("contact_gap", "contact.gap", "Distance between cam and roller", "m", nominal=1e-3),
    ports.active_output("contact", "The roller is on the cam"),
    *ports.friction_outputs("contact", "the cam on the roller, along their common tangent", INPUTS, "forwards"),
    ports.angle_output(
        "cam_contact_angle",
        "contact.alpha_i",
        "Angle of the cam's profile nearest to the roller (alpha), unwrapped",
    ),
    ports.angle_output(
        "roller_contact_angle",
        "contact.alpha_j",
        "Angle on the roller nearest to the cam, from the arm's direction; the pressure angle is this less 270 deg",
    ),
    ports.shaft_torque_output("cam"),
    ports.whole_output("event_count", "event.count", "Events since the start: lift-offs and impacts"),
    *ports.impact_outputs("Impacts of the roller on the cam", _IMPACT),
    *ports.energy_outputs(
        kinetic="Kinetic energy of cam and follower",
        spring="Energy of the return spring, without its preload",
        work="Work done by drive shaft, preload, drive_torque and load_torque since the start",
        lost="Energy lost in impacts, friction and the damper since the start",
    ),
)


def _cam_angle(name: str, degrees: float, description: str, minimum: float) -> Parameter:
    return ports.angle_parameter(name, math.radians(degrees), description, minimum, 2 * math.pi)


PARAMETERS = (
    ports.length_parameter("base_radius", 0.03, "Radius of the cam's base circle"),
    ports.length_parameter("lift", 0.0216, "Radius of the upper dwell less that of the base circle", minimum=0.0),
    _cam_angle("rise_angle", 150, "Angle of the cam over which it lifts the roller, cycloidal, turning forwards", 0.01),
    _cam_angle("dwell_angle", 30, "Angle of the cam over which the roller rests on the upper dwell", 0.0),
    _cam_angle("return_angle", 150, "Angle of the cam over which the roller comes down, cycloidal", 0.01),
    ports.length_parameter("roller_radius", 0.01, "Radius of the roller"),
    ports.length_parameter("hinge_distance", 0.08, "Distance between the hinges of follower and cam"),
    ports.length_parameter("follower_length", 0.06, "Distance of the roller's centre from the follower's hinge"),
    *ports.rotor_parameters("cam", 0.8, 1e-3),
    *ports.rotor_parameters("follower", 0.1, 1.5e-4),
    ports.angle_parameter("cam_angle_start", 0.0, "Cam angle at the start (theta); the follower's follows"),
    ports.speed_parameter(
        "cam_speed_start", 2 * math.pi, "Cam speed at the start; the follower's follows", usual=(0.0, 10 * math.pi)
    ),
    ports.stiffness_parameter("spring_stiffness", 0.1, "Stiffness of the return spring"),
    ports.torque_parameter("spring_preload", 0.02, "Torque of the return spring on the base circle"),
    ports.damping_parameter("follower", usual=(0.0, 1e-2)),
    *ports.shaft_parameters(damping=1.0),
    ports.flag_parameter(
        "unilateral",
        False,
        "Whether the roller can leave the cam; if not, it is guided and only a warning says that it would",
    ),
    ports.fraction_parameter("restitution", 0.0, "Coefficient of restitution of the roller on the cam (unilateral)"),
    ports.joint_friction_parameter(),
    Parameter(
        "contact_friction", 0.0, "Coefficient of friction of the cam on a roller that does not turn", "1", 0.0, 10.0
    ),
    *ports.settings_parameters(),
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
