"""Ports and parameters that many models have in common, so that they have one name and one meaning everywhere."""

from __future__ import annotations

from collections.abc import Callable

from ..codes import IMPACT_BUFFER_LENGTH
from .ports import Input, Output, Parameter

#: What a model tells of an impact: from the prefix of the names, the prefix of the sources, and which impact it is.
ImpactFields = Callable[[str, str, str], tuple[Output, ...]]


def shaft_inputs(speed: float, angle: float = 0.0) -> tuple[Input, Input]:
    """Speed [rad/s] and angle [rad] of the driven end of the `CompliantShaft` "shaft", with their start values."""
    end = "of the driven end of the drive shaft (it acts when"
    return (
        Input("drive_speed", "shaft.speed", speed, f"Speed {end} drive_damping > 0)", "rad/s", -1e6, 1e6, "rpm"),
        Input("drive_angle", "shaft.angle", angle, f"Angle {end} drive_stiffness > 0)", "rad", -1e6, 1e6, "deg"),
    )


def drive_torque_input(body: str, start: float = 0.0) -> Input:
    """Torque on a body from outside, by the `Torque` "drive"."""
    return _torque("drive", start, f"Torque on the {body}")


def load_torque_input(body: str, start: float = 0.0) -> Input:
    """Torque of what a body drives, by the `Torque` "load"."""
    return _torque("load", start, f"External torque on the {body}")


def _torque(force: str, start: float, what: str) -> Input:
    description = f"{what}, counter-clockwise positive"
    return Input(f"{force}_torque", f"{force}.torque", start, description, "N.m", -1e6, 1e6)


def angle_output(body: str, symbol: str) -> Output:
    """The absolute angle of a body."""
    description = f"Absolute angle of the {body} ({symbol}), unwrapped"
    return Output(f"{body}_angle", f"{body}.angle", description, "rad", "deg", nominal=1.0)


def speed_output(body: str) -> Output:
    """The angular velocity of a body."""
    return Output(f"{body}_speed", f"{body}.speed", f"Rate of {body}_angle", "rad/s", "rpm", nominal=1.0)


def whole_output(name: str, source: str, description: str) -> Output:
    """A whole number."""
    return Output(name, source, description, type="Integer")


def flag_output(name: str, source: str, description: str) -> Output:
    """Yes or no."""
    return Output(name, source, description, type="Boolean")


def shaft_torque_output(body: str) -> Output:
    """The torque of the `CompliantShaft` "shaft"."""
    return Output(
        "drive_shaft_torque",
        "shaft.torque",
        f"Torque of the drive shaft on the {body}, added to drive_torque",
        "N.m",
        nominal=0.1,
        feedthrough=("drive_angle", "drive_speed"),
    )


def energy_outputs(kinetic: str, spring: str, work: str, lost: str) -> tuple[Output, ...]:
    """The energy ledger: kinetic + spring = initial + work - lost; the arguments are its descriptions."""
    names = {"kinetic_energy": kinetic, "spring_energy": spring, "work_done": work, "energy_lost": lost}
    sources = ("kinetic", "spring", "work", "lost")
    return tuple(
        Output(name, f"energy.{source}", description, "J", nominal=0.1)
        for (name, description), source in zip(names.items(), sources, strict=True)
    )


def impact_outputs(what: str, fields: ImpactFields) -> tuple[Output, ...]:
    """Counters of impacts, the last one, and those of the last communication step.

    Args:
        what: whose impacts, e.g. "Impacts of the driver on its backstop".
        fields: what is told of each besides its time.
    """
    step = f"impacts[1..{IMPACT_BUFFER_LENGTH}]"
    buffered: list[Output] = []
    for k in range(1, IMPACT_BUFFER_LENGTH + 1):
        prefix, of = f"impacts[{k}].", f"impact {k} of the last communication step"
        buffered += [Output(f"{prefix}time", f"{prefix}time", f"Time, {of}", "s"), *fields(prefix, prefix, of)]
    return (
        whole_output("impact_count", "impact.count", f"{what} since the start"),
        flag_output("impact", "impact.any", "At least one impact in the last communication step"),
        Output("impact_time", "impact.time", "Time of the last impact; -1 before the first", "s"),
        *fields("impact_", "impact.", "last impact"),
        whole_output("impacts_in_step", "impact.in_step", f"Impacts of the last communication step held in {step}"),
        whole_output("impacts_lost", "impact.lost", f"Impacts since the start that did not fit into {step}"),
        *buffered,
    )


def length_parameter(name: str, start: float, description: str, least: float = 1e-6) -> Parameter:
    """A length, positive unless `least` [m] says otherwise."""
    return Parameter(name, start, description, "m", least, 1e3)


def link_parameters(
    body: str, length: float, mass: float, inertia: float, centre: float, origin: str
) -> tuple[Parameter, ...]:
    """Length, mass, inertia and centre of mass of a link; `origin` says where the centre's distance counts from."""
    about = f"Moment of inertia of the {body} about its centre of mass"
    along = f"Distance of the {body}'s centre of mass from {origin}, along it"
    return (
        length_parameter(f"{body}_length", length, f"Length of the {body}"),
        Parameter(f"{body}_mass", mass, f"Mass of the {body}", "kg", 1e-12, 1e6),
        Parameter(f"{body}_inertia", inertia, about, "kg.m2", 1e-12, 1e6),
        length_parameter(f"{body}_centre", centre, along, -1e3),
    )


def rotor_parameters(body: str, mass: float, inertia: float) -> tuple[Parameter, Parameter]:
    """Mass and inertia of a body that turns about its centre of mass."""
    return (
        Parameter(f"{body}_mass", mass, f"Mass of the {body}; it matters for nothing but friction", "kg", 1e-12, 1e6),
        Parameter(f"{body}_inertia", inertia, f"Moment of inertia of the {body} about its hinge", "kg.m2", 1e-12, 1e6),
    )


def start_parameters(body: str, speed: float, angle_is: str, follows: str) -> tuple[Parameter, Parameter]:
    """Angle (0 at first) and speed of a body at the start.

    Args:
        body: its name.
        speed: at first [rad/s].
        angle_is: which angle is meant, as " (theta); 0: outermost".
        follows: what the speed brings with it.
    """
    what = f"{body.capitalize()} angle at the start{angle_is}"
    fast = f"{body.capitalize()} speed at the start; {follows}"
    return (
        Parameter(f"{body}_angle_start", 0.0, what, "rad", -1e3, 1e3, display_unit="deg"),
        Parameter(f"{body}_speed_start", speed, fast, "rad/s", -1e6, 1e6, display_unit="rpm"),
    )


def damping_parameter(body: str, start: float = 0.0) -> Parameter:
    """Viscous damping of a body's rotation."""
    return Parameter(f"{body}_damping", start, f"Damping of the {body}'s rotation", "N.m.s/rad", 0.0, 1e6)


def shaft_parameters(damping: float) -> tuple[Parameter, Parameter]:
    """Stiffness (0 at first) and damping of the drive shaft."""
    return (
        Parameter("drive_stiffness", 0.0, "Stiffness of the drive shaft", "N.m/rad", 0.0, 1e9),
        Parameter(
            "drive_damping", damping, "Damping of the drive shaft: torque per lag of speed", "N.m.s/rad", 0.0, 1e9
        ),
    )


#: Coulomb friction of the hinges.
JOINT_FRICTION = Parameter(
    "joint_friction_radius", 0.0, "Coefficient of friction times pin radius, of all hinges", "m", 0.0, 1.0
)

#: How the engine integrates.
SETTINGS = (
    Parameter("baumgarte_alpha", 10.0, "Baumgarte gain on the rates of the constraints", "1/s", 0.0, 1e4),
    Parameter("baumgarte_beta", 1.0, "Baumgarte gain on the constraints, squared in use", "1/s", 0.0, 1e4),
    Parameter("relative_tolerance", 1e-9, "Relative tolerance of the integration", "1", 1e-13, 1e-3),
)
