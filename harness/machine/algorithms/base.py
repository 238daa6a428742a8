"""The interface of master algorithms."""

from __future__ import annotations

from typing import Protocol

from ..machine import Machine


class Algorithm(Protocol):
    """Takes a machine from one communication point to the next.

    When it is called, the outputs were exchanged at `begin`; when it returns, they were at the time that it returns.
    """

    def advance(self, machine: Machine, begin: int, end: int) -> int:
        """Take one step from `begin`, not beyond `end` [ns]; the time reached, later than `begin`.

        Raises:
            FmuError: a component refuses or fails.
        """
