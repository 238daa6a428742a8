"""Parameters and inputs that many mechanisms have."""

from __future__ import annotations

from ... import codes
from ..ports import Input, Parameter, Range
from ..quantities import quantity

# Parameters by what they measure, with the limits that keep the numerics sound; `start` is in the SI unit, or a text
# with a unit, such as "200 mm".


def length_parameter(
    name: str, start: float | str, description: str, minimum: float = 1e-9, *, usual: Range | None = None
) -> Parameter:
    """A length [m], from `minimum` to 1 km; not zero if nothing else is said.

    Args:
        name: as of `Parameter`.
        description: as of `Parameter`.
        start: default value [m], or a text with a unit of its kind, e.g. "200 mm".
        minimum: least value [m].
        usual: as of `Parameter`.
    """
    return Parameter(name, quantity(start, "m", f"{name}: start"), description, "m", minimum, 1e3, usual=usual)


def angle_parameter(
    name: str,
    start: float | str,
    description: str,
    minimum: float = -1e3,
    maximum: float = 1e3,
    *,
    usual: Range | None = None,
) -> Parameter:
    """An angle [rad], shown in degrees.

    Args:
        name: as of `Parameter`.
        description: as of `Parameter`.
        start: default value [rad], or a text with a unit of its kind, e.g. "30 deg".
        minimum: inclusive limits [rad].
        maximum: inclusive limits [rad].
        usual: as of `Parameter`.
    """
    return Parameter(
        name,
        quantity(start, "rad", f"{name}: start"),
        description,
        "rad",
        minimum,
        maximum,
        display_unit="deg",
        usual=usual,
    )


def speed_parameter(name: str, start: float | str, description: str, *, usual: Range | None = None) -> Parameter:
    """An angular velocity [rad/s], shown in rpm.

    Args:
        name: as of `Parameter`.
        description: as of `Parameter`.
        start: default value [rad/s], or a text with a unit of its kind, e.g. "60 rpm".
        usual: as of `Parameter`.
    """
    return Parameter(
        name,
        quantity(start, "rad/s", f"{name}: start"),
        description,
        "rad/s",
        -1e6,
        1e6,
        display_unit="rpm",
        usual=usual,
    )


def mass_parameter(name: str, start: float | str, description: str) -> Parameter:
    """A mass [kg], not zero.

    Args:
        name: as of `Parameter`.
        description: as of `Parameter`.
        start: default value [kg], or a text with a unit of its kind, e.g. "20 g".
    """
    return Parameter(name, quantity(start, "kg", f"{name}: start"), description, "kg", 1e-18, 1e9)


def inertia_parameter(name: str, start: float | str, description: str) -> Parameter:
    """A moment of inertia [kg.m2], not zero.

    Args:
        name: as of `Parameter`.
        description: as of `Parameter`.
        start: default value [kg.m2], or a text with a unit of its kind, e.g. "20 kg.cm2".
    """
    return Parameter(name, quantity(start, "kg.m2", f"{name}: start"), description, "kg.m2", 1e-30, 1e12)


def stiffness_parameter(name: str, start: float | str, description: str, *, usual: Range | None = None) -> Parameter:
    """Stiffness of a torsion spring [N.m/rad], which may be zero.

    Args:
        name: as of `Parameter`.
        description: as of `Parameter`.
        start: default value [N.m/rad], or a text with a unit of its kind, e.g. "2 N.mm/rad".
        usual: as of `Parameter`.
    """
    return Parameter(name, quantity(start, "N.m/rad", f"{name}: start"), description, "N.m/rad", 0.0, 1e6, usual=usual)


def torque_parameter(name: str, start: float | str, description: str, *, usual: Range | None = None) -> Parameter:
    """A torque [N.m].

    Args:
        name: as of `Parameter`.
        description: as of `Parameter`.
        start: default value [N.m], or a text with a unit of its kind, e.g. "5 N.mm".
        usual: as of `Parameter`.
    """
    return Parameter(name, quantity(start, "N.m", f"{name}: start"), description, "N.m", -1e6, 1e6, usual=usual)


def fraction_parameter(name: str, start: float, description: str) -> Parameter:
    """A number from 0 to 1, such as a coefficient of restitution.

    Args:
        name: as of `Parameter`.
        description: as of `Parameter`.
        start: default value [1], 0..1.
    """
    return Parameter(name, start, description, "1", 0.0, 1.0)


def flag_parameter(name: str, start: bool, description: str) -> Parameter:
    """Yes or no; the function of the mechanism gets 1 or 0.

    Args:
        name: as of `Parameter`.
        description: as of `Parameter`.
        start: whether it is on by default.
    """
    return Parameter(name, float(start), description, type="Boolean")


# Parameters of parts; their names begin with the part's.


def body_parameters(body: str, mass: float, inertia: float) -> tuple[Parameter, Parameter]:
    """<body>_mass [kg] and <body>_inertia [kg.m2] about the centre of mass.

    Args:
        body: its name.
        mass: default value [kg].
        inertia: default value [kg.m2].
    """
    return (
        mass_parameter(f"{body}_mass", mass, f"Mass of the {body}"),
        inertia_parameter(f"{body}_inertia", inertia, f"Moment of inertia of the {body} about its centre of mass"),
    )


def rotor_parameters(body: str, mass: float, inertia: float) -> tuple[Parameter, Parameter]:
    """<body>_mass [kg] and <body>_inertia [kg.m2] of a body that turns about its centre of mass.

    Args:
        body: its name.
        mass: default value [kg].
        inertia: default value [kg.m2].
    """
    return (
        mass_parameter(f"{body}_mass", mass, f"Mass of the {body}; it matters for nothing but friction"),
        inertia_parameter(f"{body}_inertia", inertia, f"Moment of inertia of the {body} about its hinge"),
    )


def link_parameters(
    body: str, length: float | str, mass: float, inertia: float, centre: float | str, origin: str
) -> tuple[Parameter, ...]:
    """<body>_length [m], _mass [kg], _inertia [kg.m2] and _centre [m] of a bar.

    Args:
        body: its name.
        length: between its pins [m].
        mass: [kg].
        inertia: about the centre of mass [kg.m2].
        centre: distance [m] of the centre of mass from `origin`, along the bar; it may lie behind it.
        origin: the pin from which it counts, e.g. "its hinge".
    """
    away = f"Distance of the {body}'s centre of mass from {origin}, along it"
    size, place = (quantity(value, "m", f"{body}_length, {body}_centre") for value in (length, centre))
    return (
        length_parameter(f"{body}_length", length, f"Length of the {body}"),
        *body_parameters(body, mass, inertia),
        length_parameter(f"{body}_centre", centre, away, -1e3, usual=(min(-size / 2, place), max(size, place))),
    )


def damping_parameter(body: str, start: float = 0.0, *, usual: Range | None = None) -> Parameter:
    """<body>_damping [N.m.s/rad]: viscous, of the body's rotation.

    Args:
        body: its name.
        start: default value [N.m.s/rad].
        usual: as of `Parameter`.
    """
    return Parameter(f"{body}_damping", start, f"Damping of the {body}'s rotation", "N.m.s/rad", 0.0, 1e6, usual=usual)


def shaft_parameters(damping: float | str, stiffest: float = 100.0) -> tuple[Parameter, Parameter]:
    """drive_stiffness [N.m/rad], 0 at first, and drive_damping [N.m.s/rad] of the `CompliantShaft` "shaft".

    Args:
        damping: default value of drive_damping [N.m.s/rad].
        stiffest: end of the usual range of drive_stiffness [N.m/rad].
    """
    lag = "Damping of the drive shaft: torque per lag of speed"
    start = quantity(damping, "N.m.s/rad", "drive_damping")
    most = min(2 * start or 0.02 * stiffest, 1e9)
    stiff, damped = ((0.0, end) if end > 0.0 else None for end in (stiffest, most))
    return (
        Parameter("drive_stiffness", 0.0, "Stiffness of the drive shaft", "N.m/rad", 0.0, 1e9, usual=stiff),
        Parameter("drive_damping", start, lag, "N.m.s/rad", 0.0, 1e9, usual=damped),
    )


def joint_friction_parameter(hinges: str = "all hinges") -> Parameter:
    """joint_friction_radius [m]: Coulomb friction of the hinges, `friction_radius` of `Revolute`.

    Args:
        hinges: which they are, for the description.
    """
    description = f"Coefficient of friction times pin radius, of {hinges}"
    return Parameter("joint_friction_radius", 0.0, description, "m", 0.0, 1.0, usual=(0.0, 2e-3))


def settings_parameters(alpha: float = 0.0, beta: float = 0.0) -> tuple[Parameter, ...]:
    """How the engine integrates, with the names of `Settings`: Baumgarte gains [1/s], tolerance, most steps, method.

    Args:
        alpha: default of the gain on the rates [1/s], 10 in Pennestri et al.
        beta: default of the gain on the rows [1/s], 1 in Pennestri et al.
    """
    return (
        Parameter(
            "baumgarte_alpha",
            alpha,
            "Baumgarte gain on the rates of the constraints",
            "1/s",
            0.0,
            1e4,
            usual=(0.0, 20.0),
        ),
        Parameter(
            "baumgarte_beta",
            beta,
            "Baumgarte gain on the constraints, squared in use",
            "1/s",
            0.0,
            1e4,
            usual=(0.0, 20.0),
        ),
        Parameter("relative_tolerance", 1e-9, "Relative tolerance of the integration", "1", 1e-13, 1e-3),
        Parameter(
            "max_internal_steps",
            200_000,
            "Most internal steps of one communication step, which ends early when it needs more",
            "1",
            10,
            1e9,
            "Integer",
        ),
        Parameter(
            "integration_method",
            codes.AUTOMATIC,
            "0: explicit, and implicit where the motion is stiff; 1: explicit, 2: implicit",
            "1",
            codes.AUTOMATIC,
            codes.IMPLICIT_METHOD,
            "Integer",
        ),
    )


# Inputs that many mechanisms have.


def shaft_inputs(speed: float, angle: float = 0.0, shaft: str = "drive shaft") -> tuple[Input, Input]:
    """Speed and angle of the driven end of the `CompliantShaft` "shaft": drive_speed and drive_angle.

    Args:
        speed: before the first value arrives [rad/s].
        angle: before the first value arrives [rad].
        shaft: what it is called in the descriptions.
    """
    end = f"of the driven end of the {shaft} (it acts when"
    return (
        Input("drive_speed", "shaft.speed", speed, f"Speed {end} drive_damping > 0)", "rad/s", -1e6, 1e6, "rpm"),
        Input("drive_angle", "shaft.angle", angle, f"Angle {end} drive_stiffness > 0)", "rad", -1e6, 1e6, "deg"),
    )


def torque_input(force: str, body: str, start: float = 0.0, *, usual: Range | None = None) -> Input:
    """The torque [N.m] of a `Torque` on a body: <force>_torque.

    Args:
        force: name of the `Torque`, e.g. "drive".
        body: on which it acts, for the description.
        start: before the first value arrives [N.m].
        usual: as of `Parameter`.
    """
    return _torque(force, f"Torque on the {body}", start, usual)


def load_torque_input(body: str, start: float = 0.0, *, usual: Range | None = None) -> Input:
    """The torque [N.m] of what a body drives, by the `Torque` "load": load_torque.

    Args:
        body: on which it acts, for the description.
        start: before the first value arrives [N.m].
        usual: as of `Parameter`.
    """
    return _torque("load", f"External torque on the {body}", start, usual)


def _torque(force: str, what: str, start: float, usual: Range | None) -> Input:
    description = f"{what}, counter-clockwise positive"
    return Input(f"{force}_torque", f"{force}.torque", start, description, "N.m", -1e6, 1e6, usual=usual)
