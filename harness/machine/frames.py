"""What pictures of a machine need: its signals at few moments, whatever is recorded, with constant memory."""

from __future__ import annotations

import math
from array import array
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from ..description import Value
from ..errors import FmuError
from ..slave import Observable
from .impacts import Impacts
from .machine import Machine
from .readings import readings

#: Moments that are spread over the run; as many more are kept for impacts.
FRAMES = 400

#: A communication point that is due but for its last bits [part of the time between two frames].
_SLACK = 1e-6


@dataclass(frozen=True)
class Seen:
    """What was seen of a run.

    Attributes:
        table: `time` [s] and the signals by their names in the machine, as float64; a row for each moment.
            What cannot be read is nan.
        constants: parameters and calculated parameters by name, after the initialization; {} if it failed.
    """

    table: pd.DataFrame
    constants: Mapping[str, Value]


class Frames:
    """An observer that keeps signals at evenly spread communication points, and at those of impacts."""

    def __init__(
        self,
        machine: Machine,
        signals: Sequence[str],
        constants: Sequence[str],
        stop_time: float,
        impacts: Impacts | None = None,
    ) -> None:
        """Bind what is to be read, before the run.

        Args:
            machine: whose signals they are.
            signals: names of numbers that move.
            constants: names of those that do not: they are read once.
            stop_time: of the run [s].
            impacts: another observer, before this one: tells where there were impacts.
        """
        self._readings = readings(machine, [machine.description.variable(name) for name in signals])
        self._names = ["time", *(name for reading in self._readings for name in reading.names)]
        self._constant_names = tuple(constants)
        self._constants: dict[str, Value] = {}
        self._numbers = array("d")
        self._span = stop_time / FRAMES
        self._number = 1
        self._struck = 0
        self._impacts = impacts

    def started(self, unit: Observable, time: float) -> None:
        """Keep what is constant, and the first frame."""
        self._constants = dict(zip(self._constant_names, unit.get(self._constant_names), strict=True))
        self._keep(time)

    def stepped(self, unit: Observable, time: float) -> None:
        """Keep a frame when one is due, or an impact has come and there is room for it."""
        if time >= (self._number - _SLACK) * self._span:
            self._number = int(time / self._span + _SLACK) + 1
            self._keep(time)
        elif self._impacts is not None and self._impacts.struck and self._struck < FRAMES:
            self._struck += 1
            self._keep(time)

    def seen(self) -> Seen:
        """What was kept so far."""
        rows = np.array(self._numbers).reshape(-1, len(self._names))
        return Seen(pd.DataFrame(rows, columns=self._names), self._constants)

    def _keep(self, time: float) -> None:
        self._numbers.append(time)
        for reading in self._readings:
            try:
                self._numbers.extend(reading.read())
            except FmuError:  # what is no number is no picture; it need not be the end of the run
                self._numbers.extend([math.nan] * len(reading.names))
