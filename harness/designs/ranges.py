"""Between which values a quantity lies, and in which designs it has them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt


def range_cells(values: npt.NDArray[np.float64], numbers: Sequence[int]) -> list[str]:
    """Smallest value, its design, largest value, its design, as text; "" each where there is no value at all.

    Args:
        values: of the quantity, NaN where there is none, shape (designs,).
        numbers: of the designs; of equal values the first counts.
    """
    there = np.flatnonzero(~np.isnan(values))
    if not there.size:
        return [""] * 4
    places = (there[np.argmin(values[there])], there[np.argmax(values[there])])
    return [text for place in places for text in (f"{values[place]:.6g}", str(numbers[place]))]
