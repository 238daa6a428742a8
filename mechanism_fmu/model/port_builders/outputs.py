"""Outputs that many mechanisms have; `source` is as of `Output`."""

from __future__ import annotations

from collections.abc import Iterable

from ..ports import Input, Output


def angle_output(name: str, source: str, description: str) -> Output:
    """An angle [rad], shown in degrees."""
    return Output(name, source, description, "rad", "deg", nominal=1.0)


def speed_output(name: str, source: str, description: str, nominal: float = 1.0) -> Output:
    """An angular velocity [rad/s], shown in rpm; `nominal` is a typical one [rad/s]."""
    return Output(name, source, description, "rad/s", "rpm", nominal=nominal)


def body_angle_output(body: str, symbol: str) -> Output:
    """The absolute angle [rad] of a body: <body>_angle; `symbol` is its letter in the equations."""
    return angle_output(f"{body}_angle", f"{body}.angle", f"Absolute angle of the {body} ({symbol}), unwrapped")


def body_speed_output(body: str, symbol: str = "", nominal: float = 1.0) -> Output:
    """The angular velocity [rad/s] of a body: <body>_speed; `symbol` is its letter, if it has one."""
    description = f"Rate of {body}_angle{f' ({symbol})' if symbol else ''}"
    return speed_output(f"{body}_speed", f"{body}.speed", description, nominal)


def force_output(name: str, source: str, description: str, inputs: Iterable[Input], nominal: float = 1.0) -> Output:
    """A force [N], with the inputs on which it depends at the same instant and its typical size [N]."""
    return Output(name, source, description, "N", nominal=nominal, feedthrough=tuple(port.name for port in inputs))


def torque_output(name: str, source: str, description: str, inputs: Iterable[Input], nominal: float = 0.1) -> Output:
    """A torque [N.m], with the inputs on which it depends at the same instant and its typical size [N.m]."""
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
    """A whole number."""
    return Output(name, source, description, type="Integer")


def flag_output(name: str, source: str, description: str) -> Output:
    """Yes or no."""
    return Output(name, source, description, type="Boolean")


def active_output(contact: str, description: str) -> Output:
    """Whether a contact is closed: <contact>_active, which the report of a run shows as a band."""
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
