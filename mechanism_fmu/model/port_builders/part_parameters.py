"""Parameters of parts; their names begin with the part's."""

from __future__ import annotations

from ..ports import Parameter
from .quantity_parameters import inertia_parameter, length_parameter, mass_parameter


def body_parameters(body: str, mass: float, inertia: float) -> tuple[Parameter, Parameter]:
    """<body>_mass [kg] and <body>_inertia [kg.m2] about the centre of mass."""
    return (
        mass_parameter(f"{body}_mass", mass, f"Mass of the {body}"),
        inertia_parameter(f"{body}_inertia", inertia, f"Moment of inertia of the {body} about its centre of mass"),
    )


def rotor_parameters(body: str, mass: float, inertia: float) -> tuple[Parameter, Parameter]:
    """<body>_mass [kg] and <body>_inertia [kg.m2] of a body that turns about its centre of mass."""
    return (
        mass_parameter(f"{body}_mass", mass, f"Mass of the {body}; it matters for nothing but friction"),
        inertia_parameter(f"{body}_inertia", inertia, f"Moment of inertia of the {body} about its hinge"),
    )


def link_parameters(
    body: str, length: float, mass: float, inertia: float, centre: float, origin: str
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
    return (
        length_parameter(f"{body}_length", length, f"Length of the {body}"),
        *body_parameters(body, mass, inertia),
        length_parameter(f"{body}_centre", centre, away, minimum=-1e3),
    )


def damping_parameter(body: str, start: float = 0.0) -> Parameter:
    """<body>_damping [N.m.s/rad]: viscous, of the body's rotation."""
    return Parameter(f"{body}_damping", start, f"Damping of the {body}'s rotation", "N.m.s/rad", 0.0, 1e6)


def shaft_parameters(damping: float) -> tuple[Parameter, Parameter]:
    """drive_stiffness [N.m/rad], 0 at first, and drive_damping [N.m.s/rad] of the `CompliantShaft` "shaft"."""
    lag = "Damping of the drive shaft: torque per lag of speed"
    return (
        Parameter("drive_stiffness", 0.0, "Stiffness of the drive shaft", "N.m/rad", 0.0, 1e9),
        Parameter("drive_damping", damping, lag, "N.m.s/rad", 0.0, 1e9),
    )


def joint_friction_parameter(hinges: str = "all hinges") -> Parameter:
    """joint_friction_radius [m]: Coulomb friction of the hinges, `friction_radius` of `Revolute`."""
    description = f"Coefficient of friction times pin radius, of {hinges}"
    return Parameter("joint_friction_radius", 0.0, description, "m", 0.0, 1.0)


def settings_parameters() -> tuple[Parameter, ...]:
    """How the engine integrates, with the names of `Settings`: Baumgarte gains [1/s], tolerance, most steps."""
    return (
        Parameter("baumgarte_alpha", 10.0, "Baumgarte gain on the rates of the constraints", "1/s", 0.0, 1e4),
        Parameter("baumgarte_beta", 1.0, "Baumgarte gain on the constraints, squared in use", "1/s", 0.0, 1e4),
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
    )
