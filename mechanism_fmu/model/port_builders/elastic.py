"""Outputs of elastic members: how far they give way, and the forces and stresses in them."""

from __future__ import annotations

from collections.abc import Iterable

from ..ports import Input, Output


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
