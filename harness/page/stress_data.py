"""What a page says of the stress that impacts leave, in beams where it follows from the jump of the speed alone."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from mechanism_fmu.fmu.parts.variables import Variable
from mechanism_fmu.stress import STEEL, RectangularTooth, WedgeTooth, maximum_stress

from ..analysis.impacts import HELD_RATIO

#: A wedge or bar of any size: its largest stress is the same (docs/explanation/stress.md).
_LIKE = {"WedgeTooth": WedgeTooth(0.02, 0.5), "RectangularTooth": RectangularTooth(0.02, 0.004)}
#: Speed at which it is worked out [m/s]; the stress is proportional to it.
_SPEED = 0.01


def stress_data(struck: tuple[str, str, str] | None, of_impact: Iterable[Variable]) -> dict[str, Any] | None:
    """The stress of each impact, as JSON; None of a model without such a beam.

    Keys: `jump`, the recorded name of v_I; `per`, stress per speed [Pa.s/m]; `speed`, `impulse` and `ratio`: a body
    whose jump is less than `ratio` times the closing speed is held, and `held` says so; `title`.

    Args:
        struck: as of `WebData`.
        of_impact: what is recorded of the last impact.
    """
    names = {v.name.removeprefix("impact_"): v.name for v in of_impact}
    if struck is None or struck[0] not in _LIKE or struck[2] not in names:
        return None
    kind, name, jump = struck
    stress = maximum_stress(_LIKE[kind], STEEL, _SPEED).stress
    known = {"closing_speed", "impulse"} <= set(names)
    return {
        "jump": names[jump],
        "per": stress / _SPEED,
        "speed": names["closing_speed"] if known else "",
        "impulse": names["impulse"] if known else "",
        "ratio": HELD_RATIO,
        "held": "held",
        "title": f"Largest bending stress in the {name} of steel, by the paper's two modes "
        "(docs/explanation/stress.md)",
    }
