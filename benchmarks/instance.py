"""The engine's ratchet at some instant, and the plain ratchet in the same state."""

from __future__ import annotations

from typing import Any

import numpy as np

import models
from mechanism_fmu import codes
from mechanism_fmu.engine import status
from mechanism_fmu.engine.outputs import read_outputs
from mechanism_fmu.engine.starting.begin import begin
from mechanism_fmu.engine.stepping.stepper import advance
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.tables.layout import field_of, pack, state_of

from .plain import OUTPUTS
from .reference import FACE, State

Array = np.ndarray[Any, np.dtype[Any]]

#: Instants to look at [s]: the tip slides towards the face, which it meets at 0.94 s; slope and face are closed.
INSTANTS = {"before impact": 0.2, "after impact": 1.0}


class Instance:
    """The engine, started from rest and brought to the end of its own step that contains `time` [s].

    Attributes:
        block: of the engine.
        inputs: a view of the inputs' values [N m].
        state: that the plain ratchet must have to be the same.
    """

    def __init__(self, time: float) -> None:
        model = models.load("ratchet").MODEL
        mechanism = model.build(model.values())
        self.block: Array = pack(compile_mechanism(mechanism))
        self.inputs: Array = field_of(self.block, "inputs")
        self._shown = [[port.name for port in mechanism.outputs].index(name) for name in OUTPUTS]
        _require_ok(begin(self.block, 0.0))
        clock, y = field_of(self.block, "clock"), field_of(self.block, "y_end")
        self.advance(time)
        self.advance(float(clock[codes.STEP_END]))
        on_face = bool(field_of(self.block, "contact_mode")[FACE] == codes.CLOSED)
        self.state = State(float(clock[codes.TIME]), y[:9].copy(), y[9:18].copy(), on_face)
        self._saved = state_of(self.block).copy()

    def advance(self, target: float) -> None:
        """Go on to `target` [s]."""
        _require_ok(advance(self.block, target))

    def outputs(self) -> Array:
        """Values of `OUTPUTS` at the time reached, shape (6,)."""
        read_outputs(self.block)
        return field_of(self.block, "outputs")[self._shown]

    def go_back(self) -> None:
        """Return to `state`."""
        state_of(self.block)[:] = self._saved


def _require_ok(outcome: int) -> None:
    if outcome != status.OK:
        raise RuntimeError(status.ADVICE[outcome])
