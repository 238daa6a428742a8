"""What a master needs of a simulation unit: the smallest of interfaces, so that a test can fake it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

from .description import Description, Value


class Slave(Protocol):
    """One instance of a co-simulation unit.

    Every method raises `FmuError` when the unit refuses or fails.
    """

    @property
    def description(self) -> Description:
        """What the unit says about itself."""

    def initialize(self, start_time: float, stop_time: float) -> None:
        """Fix the parameters and find a consistent state at `start_time` [s]."""

    def set(self, values: Mapping[str, Value]) -> None:
        """Set variables by name."""

    def set_slopes(self, slopes: Mapping[str, float]) -> None:
        """Let inputs change linearly in the next step, by so much in a second; for units that take slopes."""

    def get(self, names: Sequence[str]) -> list[Value]:
        """Values of variables, in the order of `names`."""

    def step(self, time: float, size: float) -> None:
        """Advance from communication point `time` by `size` [s]; a step that is not completed is an error."""

    def terminate(self) -> None:
        """End the simulation run."""
