"""What cannot be right is refused here, by name, with the limit and the way out."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

#: Any array of real numbers.
FloatArray = npt.NDArray[np.float64]

#: Largest impact velocity [m/s], of either sign; far beyond any beam theory, it only keeps the stress finite.
LARGEST_VELOCITY = 1e6


def require_within(name: str, value: float, low: float, high: float, unit: str, advice: str) -> None:
    """Refuse a `value` outside the closed interval `low`..`high`, NaN included.

    Raises:
        ValueError: with name, value, unit, limits and advice.
    """
    if not low <= value <= high:
        shown = f"{name} = {value:g} {unit}".rstrip()
        raise ValueError(f"{shown}, but it must lie between {low:g} and {high:g}: {advice}.")


def require_impact_velocity(value: float) -> None:
    """Refuse an impact velocity [m/s] that is negative or not finite.

    Raises:
        ValueError: with the value and the way out.
    """
    require_within(
        "impact velocity",
        value,
        0.0,
        LARGEST_VELOCITY,
        "m/s",
        "give the tooth's length times the jump of the wheel's rate in the impact, without sign",
    )


def require_all_within(name: str, values: FloatArray, low: float, high: float, unit: str, advice: str) -> None:
    """Refuse an array that has any value outside `low`..`high`, and name the first one.

    Raises:
        ValueError: with name, value, unit, limits and advice.
    """
    outside = values[~((values >= low) & (values <= high))]
    if outside.size:
        require_within(name, float(outside.flat[0]), low, high, unit, advice)
