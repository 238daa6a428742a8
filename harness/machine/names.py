"""Names of a machine's variables: "ratchet.wheel_angle" is `wheel_angle` of the part `ratchet`."""

from __future__ import annotations


def part_of(name: str) -> str:
    """The part that a variable of a machine belongs to."""
    return name.partition(".")[0]


def own_of(name: str) -> str:
    """What the part itself calls the variable."""
    return name.partition(".")[2]
