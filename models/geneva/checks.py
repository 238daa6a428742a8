"""What is wrong with parameter values that are each within their limits."""

from __future__ import annotations

from collections.abc import Iterator
from types import SimpleNamespace

from .geometry import geneva


def objections(values: SimpleNamespace) -> list[str]:
    """Why the drive cannot be built: value, limit and way out, one message each."""
    return list(_pin(values))


def _pin(values: SimpleNamespace) -> Iterator[str]:
    geometry = geneva(values)
    limits = {
        "no locking disc is left beside it": geometry.slot_depth,
        "the slots run into each other where they end": geometry.slot_spacing,
    }
    for reason, most in limits.items():
        if values.pin_diameter >= most:
            yield (
                f"pin_diameter = {values.pin_diameter:.6g} m is too thick for slot_count = {values.slot_count:g} and "
                f"centre_distance = {values.centre_distance:.6g} m: {reason}. Give less than {most:.6g} m, or a larger "
                "centre_distance."
            )
