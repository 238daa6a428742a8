"""When a component had its first impact in its last step."""

from __future__ import annotations

import math

from ..clock import SECOND
from ..description import Description
from .component import Component

_COUNT, _TIME = "impacts_in_step", "impacts[1].time"


def reports_impacts(description: Description) -> bool:
    """Whether a component has the buffer of impacts that this project's FMUs have (docs/fmu.md)."""
    return {_COUNT, _TIME} <= description.variables.keys()


class ImpactTimes:
    """Reads the buffer of impacts (`reports_impacts`).

    Attributes:
        reports: whether the component has it.
    """

    def __init__(self, component: Component) -> None:
        self.reports = reports_impacts(component.description)
        self._component = component
        self._time = component.reals([_TIME] if self.reports else [])

    def first(self) -> int | None:
        """The first nanosecond that is not before the first impact of the last step; None when it had none."""
        if not self.reports or not self._component.get((_COUNT,))[0]:
            return None
        self._time.read()
        return math.ceil(self._time.values[0] * SECOND)
