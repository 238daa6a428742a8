"""Outputs of a mechanism that declares none: what can be read of each of its parts, with units."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

from .mechanism import Mechanism, turns
from .port_builders.outputs import (
    active_output,
    body_angle_output,
    body_speed_output,
    energy_outputs,
    friction_outputs,
    whole_output,
)
from .port_builders.records import event_buffer_outputs, impact_outputs
from .ports import Output
from .sources import MOST_CONTACTS_OF_A_MODE

#: Units that people rather read otherwise.
_DISPLAYED = {"rad": "deg", "rad/s": "rpm"}


def default_outputs(mechanism: Mechanism, taken: Collection[str] = ()) -> tuple[Output, ...]:
    """Outputs of all bodies, force elements, markers, joints and contacts, of energies, impacts and events.

    Of bodies: <body>_x, _y [m] of the centre of mass, _angle [rad] and _speed [rad/s]; of force elements, markers,
    oscillations and joints: <part>_<quantity>, with the unit of the quantity; of contacts: <contact>_force [N, or N.m
    of stops and locks], _gap [m, rad] and _active; of what may rub: <part>_slip_speed [m/s, rad/s], _friction_force
    [N, N.m] and _sticks; the energies [J]; where there are contacts, impacts and events as
    `impact_outputs` and `event_buffer_outputs` have them; with friction, too, impacts_by_poisson.

    Args:
        mechanism: that declares none; its numbers may be symbolic.
        taken: names that are not to be used: "_out" is appended then.
    """
    names = {*taken, *(port.name for port in mechanism.inputs), *(known.name for known in mechanism.calculated)}
    found = []
    for output in _outputs(mechanism):
        while output.name in names:
            output = replace(output, name=f"{output.name}_out")
        names.add(output.name)
        found.append(output)
    return tuple(found)


def _outputs(mechanism: Mechanism) -> Iterator[Output]:
    for body in mechanism.bodies:
        yield from (
            Output(f"{body.name}_{axis}", f"{body.name}.{axis}", f"{axis} of the centre of mass of {body.name}", "m")
            for axis in "xy"
        )
        yield replace(body_angle_output(body.name, ""), description=f"Absolute angle of {body.name}, unwrapped")
        yield body_speed_output(body.name)
    yield from _of_forces(mechanism)
    yield from _of_joints(mechanism)
    yield from _of_contacts(mechanism)
    yield from _of_friction(mechanism)
    yield from energy_outputs(
        kinetic="Kinetic energy of all bodies",
        spring="Energy of springs",
        work="Work done by forces, drivers and inputs since the start",
        lost="Energy lost in impacts, friction and dampers since the start",
    )
    if mechanism.contacts or mechanism.functions or mechanism.patterns or mechanism.rubs_or_may:
        yield whole_output("event_count", "event.count", "Events since the start")
        if len(mechanism.contacts) <= MOST_CONTACTS_OF_A_MODE:
            yield from event_buffer_outputs(_event(mechanism))
    if mechanism.contacts:
        yield from impact_outputs("Impacts", _impact(mechanism))
        if mechanism.rubs_or_may:
            yield whole_output(
                "impacts_by_poisson", "impact.by_poisson", "Rounds of impacts by Poisson's law instead of the given one"
            )


def _of_forces(mechanism: Mechanism) -> Iterator[Output]:
    for force in (*mechanism.forces, *mechanism.sensors):
        for name, quantity in force.quantities.items():
            entries = {f"{force.name}.{entry}" for entry in quantity.feedthrough}
            yield Output(
                f"{force.name}_{name}",
                f"{force.name}.{name}",
                f"{quantity.description}: {force.name}",
                quantity.unit,
                _DISPLAYED.get(quantity.unit),
                feedthrough=tuple(port.name for port in mechanism.inputs if port.target in entries),
            )


def _of_joints(mechanism: Mechanism) -> Iterator[Output]:
    """Constraint forces: they depend on all inputs at the same instant."""
    for joint in mechanism.joints:
        for name, effort in joint.efforts.items():
            what = name.replace("_", " along ") if name in ("force_x", "force_y") else name.replace("_", " ")
            yield Output(
                f"{joint.name}_{name}",
                f"{joint.name}.{name}",
                f"Constraint {what} of {joint.name}",
                effort.unit,
                feedthrough=tuple(port.name for port in mechanism.inputs),
            )


def _of_contacts(mechanism: Mechanism) -> Iterator[Output]:
    for contact in mechanism.contacts:
        force, gap = ("N.m", "rad") if contact.angular else ("N", "m")
        what = "Torque" if contact.angular else "Normal force"
        through = tuple(port.name for port in mechanism.inputs)
        name = contact.name
        if "force" in contact.readings:
            yield Output(f"{name}_force", f"{name}.force", f"{what} of {name}, 0 when open", force, feedthrough=through)
        if "gap" in contact.readings:
            yield Output(f"{name}_gap", f"{name}.gap", f"Gap of {name}, 0 when closed", gap, _DISPLAYED.get(gap))
        if "closed" in contact.readings:
            yield active_output(name, f"Whether {name} is closed")


def _of_friction(mechanism: Mechanism) -> Iterator[Output]:
    names = mechanism.rubs_or_may
    for part in mechanism.rubbing:
        if part.name in names:
            for output in friction_outputs(part.name, part.name, mechanism.inputs, angular=turns(part)):
                yield replace(output, nominal=None)


def impact_units(mechanism: Mechanism) -> tuple[str, str]:
    """Units of closing speeds and impulses: of stops and locks where all contacts are such, else of forces.

    Args:
        mechanism: whose contacts they are of.
    """
    angular = bool(mechanism.contacts) and all(contact.angular for contact in mechanism.contacts)
    return ("rad/s", "N.m.s") if angular else ("m/s", "N.s")


def impact_remark(mechanism: Mechanism) -> str:
    """What is said of closing speeds and impulses beside their units: "" unless stops and locks are among others.

    Args:
        mechanism: whose contacts they are of.
    """
    return "; of stops and locks per radian" if len({contact.angular for contact in mechanism.contacts}) > 1 else ""


def _event(mechanism: Mechanism) -> tuple[Output, ...]:
    """What is reported of an event, from which the harness makes its table."""
    return (
        Output("time", "time", "Time, {event}", "s"),
        whole_output("guard", "guard", "Guard, as a code, {event}"),
        whole_output("subject", "subject", "Number of the contact, pattern or logical function, {event}"),
        whole_output("old_mode", "old_mode", "Sum of 2^c over the contacts closed before, {event}"),
        whole_output("new_mode", "new_mode", "Sum of 2^c over the contacts closed after, {event}"),
        Output("impulse", "impulse", f"Total impulse{impact_remark(mechanism)}, {{event}}", impact_units(mechanism)[1]),
    )


def _impact(mechanism: Mechanism) -> tuple[Output, ...]:
    """What is reported of an impact."""
    speed, impulse = impact_units(mechanism)
    mixed = impact_remark(mechanism)
    fields = (
        whole_output("contact", "contact", "Number of the contact, from 0, {impact}"),
        Output("closing_speed", "closing_speed", f"Speed before{mixed}, {{impact}}", speed),
        Output("impulse", "impulse", f"Impulse{mixed}, {{impact}}", impulse),
    )
    toothed = [body for body in mechanism.bodies if body.tooth_length is not None]
    if len(toothed) != 1:
        return fields
    jump = f"v_I: tooth length times jump of the speed of {toothed[0].name}, {{impact}}"
    return (*fields, Output("velocity", "velocity", jump, "m/s"))
