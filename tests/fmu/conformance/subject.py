"""What a conformance test needs to know of an FMU beyond its modelDescription.xml."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from tests.fmu.conformance.host import Fmu, Instance, Value


@dataclass(frozen=True)
class Subject:
    """An FMU under test.

    Attributes:
        fmu: unzipped.
        rough: parameters of a run with several impacts.
        inputs: range of each input in which the motion stays smooth enough for short tests.
        until: a time [s] by which the rough run has had impacts.
        impossible: parameter values that are each within their limits, and that no mechanism can have together.
        native: whether no Python runs in it.
    """

    fmu: Fmu
    rough: Mapping[str, Value]
    inputs: Mapping[str, tuple[float, float]]
    until: float
    impossible: Mapping[str, Value]
    native: bool = False

    def reference(self, one: Instance, until: float | None = None) -> dict[str, Value]:
        """All outputs at the end of the rough run."""
        one.begin(self.rough).run(until or self.until, 0.05)
        return one.outputs()
