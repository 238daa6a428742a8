"""Outputs that many mechanisms have: angles, speeds, forces, energies, elastic members."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ..ports import Input, Output

# Outputs that many mechanisms have; `source` is as of `Output`.


def angle_output(name: str, source: str, description: str) -> Output:
    """An angle [rad], shown in degrees.

    Args:
        name: as of `Output`.
        source: as of `Output`.
        description: as of `Output`.
    """
    return Output(name, source, description, "rad", "deg", nominal=1.0)


def speed_output(name: str, source: str, description: str, nominal: float = 1.0) -> Output:
    """An angular velocity [rad/s], shown in rpm; `nominal` is a typical one [rad/s].

    Args:
        name: as of `Output`.
        source: as of `Output`.
        description: as of `Output`.
        nominal: typical magnitude [rad/s].
    """
    return Output(name, source, description, "rad/s", "rpm", nominal=nominal)


def body_angle_output(body: str, symbol: str) -> Output:
    """The absolute angle [rad] of a body: <body>_angle; `symbol` is its letter in the equations.

    Args:
        body: its name.
        symbol: its letter in the equations, for the description.
    """
    return angle_output(f"{body}_angle", f"{body}.angle", f"Absolute angle of the {body} ({symbol}), unwrapped")


def body_speed_output(body: str, symbol: str = "", nominal: float = 1.0) -> Output:
    """The angular velocity [rad/s] of a body: <body>_speed; `symbol` is its letter, if it has one.

    Args:
        body: its name.
        symbol: its letter in the equations, for the description; "" if it has none.
        nominal: typical magnitude [rad/s].
    """
    description = f"Rate of {body}_angle{f' ({symbol})' if symbol else ''}"
    return speed_output(f"{body}_speed", f"{body}.speed", description, nominal)


def body_motion_outputs(symbols: Mapping[str, str]) -> tuple[Output, ...]:
    """<body>_angle [rad] of several bodies, and then <body>_speed [rad/s] of each.

    Args:
        symbols: the letter of each body's angle in the equations, by the name of the body.
    """
    angles = [body_angle_output(body, symbol) for body, symbol in symbols.items()]
    return (*angles, *map(body_speed_output, symbols))


def force_output(name: str, source: str, description: str, inputs: Iterable[Input], nominal: float = 1.0) -> Output:
    """A force [N], with the inputs on which it depends at the same instant and its typical size [N].

    Args:
        name: as of `Output`.
        source: as of `Output`.
        description: as of `Output`.
        inputs: those on which it depends at the same instant: its `feedthrough`.
        nominal: typical magnitude [N].
    """
    return Output(name, source, description, "N", nominal=nominal, feedthrough=tuple(port.name for port in inputs))


def torque_output(name: str, source: str, description: str, inputs: Iterable[Input], nominal: float = 0.1) -> Output:
    """A torque [N.m], with the inputs on which it depends at the same instant and its typical size [N.m].

    Args:
        name: as of `Output`.
        source: as of `Output`.
        description: as of `Output`.
        inputs: those on which it depends at the same instant: its `feedthrough`.
        nominal: typical magnitude [N.m].
    """
    return Output(name, source, description, "N.m", nominal=nominal, feedthrough=tuple(port.name for port in inputs))


def shaft_torque_output(body: str, nominal: float = 0.1, shaft: str = "drive shaft") -> Output:
    """The torque [N.m] of the `CompliantShaft` "shaft" on a body: drive_shaft_torque.

    Args:
        body: on which it acts, for the description.
        nominal: its typical size [N.m].
        shaft: what it is called in the description.
    """
    return Output(
        "drive_shaft_torque",
        "shaft.torque",
        f"Torque of the {shaft} on the {body}, added to drive_torque",
        "N.m",
        nominal=nominal,
        feedthrough=("drive_angle", "drive_speed"),
    )


def whole_output(name: str, source: str, description: str) -> Output:
    """A whole number.

    Args:
        name: as of `Output`.
        source: as of `Output`.
        description: as of `Output`.
    """
    return Output(name, source, description, type="Integer")


def flag_output(name: str, source: str, description: str) -> Output:
    """Yes or no.

    Args:
        name: as of `Output`.
        source: as of `Output`.
        description: as of `Output`.
    """
    return Output(name, source, description, type="Boolean")


def active_output(contact: str, description: str) -> Output:
    """Whether a contact is closed: <contact>_active, which the report of a run shows as a band.

    Args:
        contact: its name.
        description: as of `Output`.
    """
    return flag_output(f"{contact}_active", f"{contact}.closed", description)


def friction_outputs(
    part: str,
    slip: str,
    inputs: Iterable[Input],
    positive: str = "",
    *,
    angular: bool = False,
    speed: float = 0.1,
    force: float = 0.1,
) -> tuple[Output, Output, Output]:
    """What rubs: <part>_slip_speed [m/s], <part>_friction_force [N], and <part>_sticks; of angles [rad/s] and [N.m].

    Args:
        part: name of a contact, joint or brake.
        slip: what slips on what, for the descriptions, e.g. "the slider on its guide".
        inputs: those on which the friction depends at the same instant: its `feedthrough`.
        positive: in which direction slip and friction are positive, e.g. "outwards"; "" where that needs no word.
        angular: whether the slip is a rate of an angle, and friction a torque: of pins and brakes.
        speed: typical slip speed [m/s, rad/s].
        force: typical friction [N, N.m].
    """
    slipping = f"{slip}, {positive} positive" if positive else slip
    per_time, effort, what = ("rad/s", "N.m", "torque") if angular else ("m/s", "N", "force")
    return (
        Output(
            f"{part}_slip_speed",
            f"{part}.slip_speed",
            f"Slip of {slipping}; 0 while it sticks",
            per_time,
            "rpm" if angular else None,
            nominal=speed,
        ),
        Output(
            f"{part}_friction_force",
            f"{part}.friction_force",
            f"Friction {what} of {slipping}",
            effort,
            nominal=force,
            feedthrough=tuple(port.name for port in inputs),
        ),
        flag_output(f"{part}_sticks", f"{part}.sticks", f"Whether {slip} sticks"),
    )


def energy_outputs(kinetic: str, spring: str, work: str, lost: str, nominal: float = 0.1) -> tuple[Output, ...]:
    """The energy ledger [J]: kinetic_energy + spring_energy = initial + work_done - energy_lost.

    Args:
        kinetic: description of kinetic_energy; that of the others in the same way.
        spring: of spring_energy.
        work: of work_done.
        lost: of energy_lost.
        nominal: typical size of all four [J].
    """
    ledger = (
        ("kinetic_energy", "energy.kinetic", kinetic),
        ("spring_energy", "energy.spring", spring),
        ("work_done", "energy.work", work),
        ("energy_lost", "energy.lost", lost),
    )
    return tuple(Output(name, source, description, "J", nominal=nominal) for name, source, description in ledger)


# Outputs of elastic members: how far they give way, and the forces and stresses in them.


def bent_point_outputs(
    name: str, end: str, what: str, inputs: Iterable[Input], nominal: float = 1.0, deviation: float = 1e-3
) -> tuple[Output, ...]:
    """<name>_x, _y [m] in the rigid motion, _x_elastic, _y_elastic [m] with the deflection, and _deviation [m].

    Args:
        name: e.g. "path".
        end: of a member, e.g. "arm.end".
        what: it is, for the descriptions, e.g. "coupler point".
        inputs: those on which accelerations depend at the same instant.
        nominal: typical coordinate [m].
        deviation: typical distance of the elastic point from the rigid one [m].
    """
    through = tuple(port.name for port in inputs)
    rigid, bent = f"of the {what} in the rigid motion", f"of the {what} with the deflection of the members"
    off = f"Distance of the {what} from where it is in the rigid motion"
    return (
        *(Output(f"{name}_{k}", f"{end}.{k}", f"{k} {rigid}", "m", nominal=nominal) for k in "xy"),
        *(
            Output(f"{name}_{k}_elastic", f"{end}.{k}_bent", f"{k} {bent}", "m", nominal=nominal, feedthrough=through)
            for k in "xy"
        ),
        Output(f"{name}_deviation", f"{end}.deviation", off, "m", nominal=deviation, feedthrough=through),
    )


def member_outputs(
    member: str, inputs: Iterable[Input], force: float = 1.0, moment: float = 0.1, stress: float = 1e6
) -> tuple[Output, ...]:
    """<member>_axial_force [N], _start_moment and _end_moment [N.m], and _stress [Pa] of an elastic member.

    Args:
        member: its name.
        inputs: those on which accelerations depend at the same instant.
        force: typical size [N].
        moment: typical size [N.m].
        stress: typical size [Pa].
    """
    through = tuple(port.name for port in inputs)
    largest = f"Largest normal stress in member {member}: axial and bending"
    return (
        Output(
            f"{member}_axial_force",
            f"{member}.axial_force",
            f"Force along member {member}, tension positive",
            "N",
            nominal=force,
            feedthrough=through,
        ),
        *(
            Output(
                f"{member}_{end}_moment",
                f"{member}.{end}_moment",
                f"Bending moment at the {end} of member {member}, positive when it bends to its left",
                "N.m",
                nominal=moment,
                feedthrough=through,
            )
            for end in ("start", "end")
        ),
        Output(f"{member}_stress", f"{member}.stress", largest, "Pa", nominal=stress, feedthrough=through),
    )


def hinged_beam_outputs(
    name: str, member: str, what: str, inputs: Iterable[Input], deflection: float = 1e-6, stress: float = 1e6
) -> tuple[Output, Output]:
    """<name>_tip_deflection [m] and <name>_bending_stress [Pa] of a member that hangs on a hinge at its start.

    Args:
        name: of the part.
        member: name of the member.
        what: the part, for the descriptions, e.g. "pawl".
        inputs: those on which accelerations depend at the same instant.
        deflection: typical size [m].
        stress: typical size [Pa].
    """
    through = tuple(port.name for port in inputs)
    bent = f"Deflection of the {what}'s tip from the tangent at its hinge, counter-clockwise positive"
    largest = f"Largest bending stress in the {what}"
    return (
        Output(
            f"{name}_tip_deflection", f"{member}.tip_deflection", bent, "m", nominal=deflection, feedthrough=through
        ),
        Output(
            f"{name}_bending_stress", f"{member}.bending_stress", largest, "Pa", nominal=stress, feedthrough=through
        ),
    )
