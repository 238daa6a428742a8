"""What looks on while a unit is simulated."""

from __future__ import annotations

from typing import Protocol

from .slave import Observable


class Observer(Protocol):
    """Called by the master at communication points."""

    def started(self, unit: Observable, time: float) -> None:
        """After the initialization, at the start time [s]."""

    def stepped(self, unit: Observable, time: float) -> None:
        """After every completed step, at its end [s]."""
