"""What a conformance test needs to know of an FMU beyond its modelDescription.xml."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from tests.fmu.conformance.host import Fmu, Instance, Value


@dataclass(frozen=True)
class Subject:
    """An FMU under test.

    Attributes:
        fmu: unzipped.
        rough: parameters of a run that is not the default one, with several impacts if the mechanism has any.
        inputs: range of each input in which the motion stays smooth enough for short tests.
        until: a time [s] by which the rough run has had its impacts.
        impossible: parameter values that are each within their limits, and that no mechanism can have together; empty
            where all can.
        impacts: whether the mechanism has contacts that can strike; one without has no events but those of friction.
        sticks: whether friction has events in the rough run: something comes to rest, reverses, or is torn off.
        native: whether no Python runs in it.
    """

    fmu: Fmu
    rough: Mapping[str, Value]
    inputs: Mapping[str, tuple[float, float]]
    until: float
    impossible: Mapping[str, Value] = field(default_factory=dict)
    impacts: bool = True
    sticks: bool = False
    native: bool = False

    @property
    def event_categories(self) -> set[str]:
        """Log categories in which the rough run tells its impacts and other events."""
        return {"logEvents"} if self.impacts or self.sticks else set()

    def assert_struck(self, one: Instance) -> None:
        """After the rough run there have been impacts, or the FMU knows of none."""
        if self.impacts:
            assert one["impact_count"] > 0
        else:
            assert not [name for name in self.fmu.variables if name.startswith(("impact", "event"))]

    def reference(self, one: Instance, until: float | None = None) -> dict[str, Value]:
        """All outputs at the end of the rough run."""
        one.begin(self.rough).run(until or self.until, 0.05)
        return one.outputs()
