"""A mechanism in motion: where the model room and the engine meet."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import codes
from .engine import status
from .engine.assembly import assemble, start
from .engine.events import gap
from .engine.layout import field_of, state_of
from .engine.outputs import read_outputs
from .engine.pack import pack, write_tables
from .engine.stepper import advance
from .model import Mechanism, MechanismError

Array = np.ndarray[Any, np.dtype[Any]]


class SimulationError(RuntimeError):
    """The motion cannot go on; the message gives the time, the reason and what to do."""


class Simulation:
    """One mechanism, from assembly through its motion.

    Args:
        mechanism: its numbers are checked and written as tables.
        start_time: [s].

    Raises:
        MechanismError: the mechanism cannot be right, or cannot be assembled (with what is left of each joint).
    """

    def __init__(self, mechanism: Mechanism, start_time: float = 0.0) -> None:
        self._mechanism = mechanism
        self._block = pack(mechanism.compile())
        self._input_names = [port.name for port in mechanism.inputs]
        self._output_names = [port.name for port in (*mechanism.outputs, *mechanism.calculated)]
        self.inputs: Array = field_of(self._block, "inputs")
        self.outputs: Array = field_of(self._block, "outputs")
        self.state: Array = state_of(self._block)
        self._begin(start_time)

    @property
    def time(self) -> float:
        """The time reached [s]."""
        return float(field_of(self._block, "clock")[codes.TIME])

    def advance(self, target: float) -> None:
        """Go on to time `target` [s] with the inputs held.

        Raises:
            SimulationError: the motion cannot be continued; the time reached is the last good one.
        """
        outcome = advance(self._block, target)
        if outcome != status.OK:
            raise SimulationError(f"t = {self.time:.9g} s: {status.ADVICE[outcome]}")

    def read(self) -> dict[str, float]:
        """All outputs and calculated parameters at the current time, by name (SI units)."""
        read_outputs(self._block)
        return dict(zip(self._output_names, self.outputs.tolist(), strict=True))

    def read_array(self) -> Array:
        """All outputs and calculated parameters at the current time, shape (outputs,): a view, valid until the next read."""
        read_outputs(self._block)
        return self.outputs

    def set_input(self, name: str, value: float) -> None:
        """Set an input from now on (SI units)."""
        self.inputs[self._input_names.index(name)] = value

    def retable(self, mechanism: Mechanism) -> None:
        """Replace the numbers by those of another mechanism of the same structure, leaving the state as it is."""
        write_tables(self._block, mechanism.compile())

    def field(self, name: str) -> Array:
        """A view of a field of the instance's block (see `engine.layout`), for tests and diagnosis."""
        return field_of(self._block, name)

    def pulling_contacts(self) -> list[tuple[str, float]]:
        """Closed contacts that have pulled, with the first time [s] at which they did."""
        times = field_of(self._block, "pull_time")
        now = self.time
        return [
            (contact.name, float(t)) for contact, t in zip(self._mechanism.contacts, times, strict=True) if t <= now
        ]

    def _begin(self, time: float) -> None:
        outcome = assemble(self._block)
        if outcome == status.NOT_ASSEMBLED:
            raise MechanismError(f"{status.ADVICE[outcome]} Left open: {self._residuals()}.")
        outcome = start(self._block, time)
        if outcome == status.START_INSIDE:
            raise MechanismError(f"{status.ADVICE[outcome]} {self._penetrations()}")
        if outcome != status.OK:
            raise MechanismError(status.ADVICE[outcome])

    def _residuals(self) -> str:
        """What is left of each joint and closed contact at the closest position found."""
        residual = field_of(self._block, "residual")
        parts, row = [], 0
        for joint in self._mechanism.joints:
            parts.append(f"{joint.name} by {np.abs(residual[row : row + joint.rows]).max():.6g}")
            row += joint.rows
        for contact in self._mechanism.contacts:
            if contact.closed:
                parts.append(f"{contact.name} by {abs(residual[row]):.6g}")
                row += 1
        return ", ".join(parts) + " (m, or rad between directions)"

    def _penetrations(self) -> str:
        y = field_of(self._block, "y_end")
        found = []
        for c, contact in enumerate(self._mechanism.contacts):
            distance = 0.0 if contact.closed else gap(self._block, c, y)[0]
            if distance < 0:
                found.append(
                    f"Contact {contact.name!r}: the point of {contact.body_i!r} is {-distance:.6g} m behind the line on "
                    f"{contact.body_j!r}; change the start angles or the lengths."
                )
        return " ".join(found)
