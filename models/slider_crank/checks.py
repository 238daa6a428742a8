"""What is wrong, or odd, with parameter values that are each within their limits."""

from __future__ import annotations

import math
from types import SimpleNamespace

from mechanism_fmu.model import Finding
from mechanism_fmu.model.conditions import size
from mechanism_fmu.model.findings import at_most, first

from .geometry import rise

#: A rod that is at a right angle to the slider's line to this fraction of its length cannot say where the slider goes.
_UPRIGHT = 1e-9
#: Lengths are those of a change point when they are off by less than this fraction of their sum.
_CHANGES_WITHIN = 1e-6


def objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    """Why the linkage cannot be assembled at the start: value, limit and way out."""
    distance = size(rise(values))
    return (
        Finding(
            at_most(values.rod_length * (1 - _UPRIGHT), distance),
            "rod_length = {:.6g} m does not reach the slider's line: at crank_angle_start = {:.6g} deg, with "
            "crank_length = {:.6g} m and offset = {:.6g} m, the crank pin is {:.6g} m away from it. Give more than "
            "{:.6g} m, or change crank_angle_start.",
            (
                values.rod_length,
                values.crank_angle_start * (180 / math.pi),
                values.crank_length,
                values.offset,
                distance,
                distance,
            ),
        ),
    )


def warnings(values: SimpleNamespace) -> tuple[Finding, ...]:
    """What the crank cannot do; it means something only where nothing is objected to."""
    crank, rod, offset = values.crank_length, values.rod_length, size(values.offset)
    needed = crank + offset
    flat = _CHANGES_WITHIN * (rod + needed)
    return first(
        *(
            Finding(
                flat - size(excess),
                "Change point: with rod_length = {:.6g} m, crank_length = {:.6g} m and |offset| = {:.6g} m, crank and "
                "rod can both stand at a right angle to the slider's line. There the constraints lose a rank, and "
                f"whether crank and slider go on together or apart is undetermined. Give a rod {way} by more than "
                "{:.3g} m, or keep the motion away from there.",
                (rod, crank, offset, flat),
            )
            for excess, way in ((rod - needed, "longer"), (crank - offset - rod, "longer or shorter"))
        ),
        Finding(
            needed - rod,
            "The crank cannot turn fully: rod_length = {:.6g} m is shorter than crank_length + |offset| = {:.6g} m. It "
            "swings between positions where the rod is at a right angle to the slider's line. For full turns give "
            "a rod_length of more than {:.6g} m.",
            (rod, needed, needed),
        ),
    )
