"""What is wrong with parameter values that are each within their limits."""

from __future__ import annotations

from types import SimpleNamespace

from mechanism_fmu.model import Finding
from mechanism_fmu.model.findings import either

#: Of one radius over the other. Beyond this, rounding of the fast gear's angle would turn the slow one to and fro.
MOST_RATIO = 1000.0


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the gears cannot mesh: value, limit and way out."""
    R1, R2 = values.pinion_radius, values.wheel_radius
    return (
        Finding(
            either(R1 - MOST_RATIO * R2, R2 - MOST_RATIO * R1),
            "pinion_radius = {:.6g} m and wheel_radius = {:.6g} m differ by more than a factor of "
            f"{MOST_RATIO:g}, which no pair of gears bridges. Give radii that are closer, or use one gear train after "
            "the other.",
            (R1, R2),
        ),
    )
