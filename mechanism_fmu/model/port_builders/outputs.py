"""Outputs that many mechanisms have: angles, speeds, forces, energies, impacts and events, elastic members."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from ...codes import EVENT_BUFFER_LENGTH, IMPACT_BUFFER_LENGTH, MOST_KEPT
from ..errors import MechanismError
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


# Outputs that report impacts and events: of the last one, and of all those of the last communication step.
#
# What is reported of one impact is a tuple of fields. A field is an `Output` without its place: the name is that after
# "impact_" or "impacts[k].", the source that after "impact." or "impacts[k]." (see `Output`), and "{impact}" in the
# description is replaced by which impact it is:
#
#     Output("cam_speed", "speed:cam", "Speed of the cam just after, {impact}", "rad/s", "rpm")

_STEP = "of the last communication step"


def impact_outputs(what: str, fields: Sequence[Output], kept: int = IMPACT_BUFFER_LENGTH) -> tuple[Output, ...]:
    """Counters of impacts, the last one, and those of the last communication step, from which runs make tables.

    Args:
        what: whose impacts, e.g. "Impacts of the driver on its backstop".
        fields: what is reported of each, with "{impact}" in the descriptions, besides its time, its instant (a counter:
            all impacts of one instant have the same) and the energy that all impacts of this instant lost [J].
        kept: how many impacts of a step are kept, 8 to 1000.

    Raises:
        MechanismError: as many cannot be kept.
    """
    time = Output("time", "time", "Time, {impact}", "s")
    instant = whole_output("instant", "instant", "Number of the instant, the same for all its impacts, {impact}")
    lost = Output("energy_lost", "energy_lost", "Energy lost at the instant, {impact}", "J")
    fields = (*fields, lost)
    return (*last_impact_outputs(what, fields), *impact_buffer_outputs((time, instant, *fields), kept))


def impact_speed_fields(*bodies: str, nominal: float = 1.0) -> tuple[Output, ...]:
    """Fields <body>_speed_before and <body>_speed [rad/s]: of bodies, just before and after the instant of an impact.

    Args:
        bodies: names.
        nominal: a typical speed [rad/s].
    """
    moments = (("_before", "before"), ("", "after"))
    return tuple(
        speed_output(
            f"{body}_speed{suffix}",
            f"speed{suffix}:{body}",
            f"Speed of the {body} just {moment} the instant: {{impact}}",
            nominal,
        )
        for suffix, moment in moments
        for body in bodies
    )


def last_impact_outputs(what: str, fields: Sequence[Output]) -> tuple[Output, ...]:
    """Counter of impacts, whether there was one in the last step, and time [s] and fields of the last one.

    Args:
        what: as of `impact_outputs`.
        fields: as of `impact_outputs`.
    """
    return (
        whole_output("impact_count", "impact.count", f"{what} since the start"),
        flag_output("impact", "impact.any", f"At least one impact in {_STEP.removeprefix('of ')}"),
        Output("impact_time", "impact.time", "Time of the last impact; -1 before the first", "s"),
        *(_placed(field, "impact_", "impact.", "last impact") for field in fields),
    )


def impact_buffer_outputs(fields: Sequence[Output], kept: int = IMPACT_BUFFER_LENGTH) -> tuple[Output, ...]:
    """The impacts of the last communication step: how many, how many did not fit, and the fields of each.

    Args:
        fields: as of `impact_outputs`, and with the time.
        kept: as of `impact_outputs`.

    Raises:
        MechanismError: as many cannot be kept.
    """
    _require_room(kept, IMPACT_BUFFER_LENGTH)
    slots = f"impacts[1..{kept}]"
    return (
        whole_output("impacts_in_step", "impact.in_step", f"Impacts {_STEP} held in {slots}"),
        whole_output("impacts_lost", "impact.lost", f"Impacts since the start that did not fit into {slots}"),
        *_buffer("impact", kept, fields),
    )


def event_buffer_outputs(fields: Sequence[Output], kept: int = EVENT_BUFFER_LENGTH) -> tuple[Output, ...]:
    """The events of the last communication step: how many, and the fields of each.

    Args:
        fields: as of impacts, with "{event}" in the descriptions; runs make a table if all that an event has are there.
        kept: how many events of a step are kept, 16 to 1000.

    Raises:
        MechanismError: as many cannot be kept.
    """
    _require_room(kept, EVENT_BUFFER_LENGTH)
    slots = f"events[1..{kept}]"
    return (
        whole_output("events_in_step", "event.in_step", f"Events {_STEP} held in {slots}"),
        *_buffer("event", kept, fields),
    )


def _require_room(kept: int, least: int) -> None:
    if not least <= kept <= MOST_KEPT:
        raise MechanismError(f"kept = {kept}: of a step {least} to {MOST_KEPT} can be kept.")


def _buffer(kind: str, length: int, fields: Sequence[Output]) -> Iterator[Output]:
    for k in range(1, length + 1):
        prefix = f"{kind}s[{k}]."
        yield from (_placed(field, prefix, prefix, f"{kind} {k} {_STEP}") for field in fields)


def _placed(field: Output, prefix: str, source: str, which: str) -> Output:
    description = field.description.replace("{impact}", which).replace("{event}", which)
    return replace(field, name=f"{prefix}{field.name}", source=f"{source}{field.source}", description=description)


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
