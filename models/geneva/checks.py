"""What is wrong with parameter values that are each within their limits."""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import Finding
from mechanism_fmu.model.findings import at_most

from .geometry import geneva


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the drive cannot be built: value, limit and way out."""
    geometry = geneva(values)
    limits = {
        "no locking disc is left beside it": geometry.slot_depth,
        "the slots run into each other where they end": geometry.slot_spacing,
    }
    return tuple(
        Finding(
            at_most(most, values.pin_diameter),
            "pin_diameter = {:.6g} m is too thick for slot_count = {:g} and centre_distance = {:.6g} m: "
            f"{reason}. Give less than {{:.6g}} m, or a larger centre_distance.",
            (values.pin_diameter, values.slot_count, values.centre_distance, most),
        )
        for reason, most in limits.items()
    )
