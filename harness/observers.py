"""What looks on while a slave is simulated."""

from __future__ import annotations

from typing import Protocol

from .slave import Slave


class Observer(Protocol):
    """Called by the master at communication points; it may read the slave, never set it."""

    def started(self, slave: Slave, time: float) -> None:
        """After the initialization, at the start time [s]."""

    def stepped(self, slave: Slave, time: float) -> None:
        """After every completed step, at its end [s]."""
