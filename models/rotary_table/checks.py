"""What is wrong with parameter values that are each within their limits."""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import Finding

#: A brake that gives way so fast [s] costs millions of steps a second and shows nothing.
FASTEST = 1e-6


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the table cannot be run: value, limit and way out."""
    time = values.brake_damping / values.brake_stiffness
    return (
        Finding(
            FASTEST - time,
            "brake_damping / brake_stiffness = {:.3g} s is shorter than "
            f"{FASTEST:g} s, and steps would be as small. Give less brake_stiffness = {{:.3g}} N.m/rad, or more "
            "brake_damping = {:.3g} N.m.s/rad.",
            (time, values.brake_stiffness, values.brake_damping),
        ),
    )
