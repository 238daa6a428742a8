"""Impacts of a run, collected from the FMU's buffer of the impacts of the last communication step."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

import numpy as np
import numpy.typing as npt
import pandas as pd

from ..fmu.description import Description, Value, Variable
from ..fmu.interface import Observable

# Buffers of an FMU: what happened in the last communication step, one slot for each happening.


class Buffer:
    """The variables `<name>[1].<field>`, `<name>[2].<field>`, ..., of which `<name>_in_step` are filled.

    Attributes:
        fields: the first slot's variables by field name; {} when the FMU has no such buffer.
    """

    def __init__(self, description: Description, name: str, fields: Iterable[str] | None = None) -> None:
        """Find the buffer `name` of an FMU, with all `fields` that the first slot has, or with those that are given."""
        slots: dict[int, dict[str, Variable]] = {}
        for variable in description.variables.values():
            match = re.fullmatch(rf"{name}\[(\d+)\]\.(\w+)", variable.name)
            if match is not None:
                slots.setdefault(int(match[1]), {})[match[2]] = variable
        if fields is None:
            fields = slots[min(slots)] if slots else ()
        wanted = list(fields)
        whole = [slots[number] for number in sorted(slots) if slots[number].keys() >= set(wanted)]
        self._filled = f"{name}_in_step"
        if self._filled not in description.variables:
            whole = []
        self.fields = {field: whole[0][field] for field in wanted} if whole else {}
        self._slots = [[slot[field].name for field in wanted] for slot in whole]

    def read(self, unit: Observable) -> list[list[Value]]:
        """The values of each filled slot, in the order of `fields`."""
        if not self._slots:
            return []
        filled = int(unit.get((self._filled,))[0])
        return [unit.get(slot) for slot in self._slots[:filled]]


class Collector:
    """An observer that keeps what stands in a buffer after every step.

    Attributes:
        lost: how much did not fit into the buffer, when the FMU counts it.
    """

    def __init__(self, description: Description, buffer: Buffer, counter: str) -> None:
        self._buffer = buffer
        self._counters = (counter,) if counter in description.variables else ()
        self._rows: list[list[Value]] = []
        self.lost = 0

    def started(self, unit: Observable, time: float) -> None:
        """No step, nothing in the buffer."""

    def stepped(self, unit: Observable, time: float) -> None:
        """Keep what the step that ends at `time` has left."""
        new = self._buffer.read(unit)
        self._rows += new
        if new and self._counters:
            self.lost = self._lost_of(int(unit.get(self._counters)[0]))

    def _lost_of(self, counted: int) -> int:
        """How much did not fit so far, by the FMU's counter: of what did not fit, unless a collector knows better."""
        return counted


#: A body whose beam's tip moves by less than this share of the closing speed is held. Rounding leaves some 1e-16 of it,
#: and a heavy one, the paper's wheel of 5.6 kg, moves by 7.5e-3 of it where it is free.
HELD_RATIO = 1e-9

#: The buffer has one unit for all contacts, that of points on lines.
UNITS_OF_STOPS = (
    "Of stops and locks of an angle, as a holding pawl, the closing speed is in rad/s and the impulse in N.m.s."
)


class ImpactCollector(Collector):
    """An observer that keeps the impacts in `impacts[1].time`, `impacts[1].velocity`, ... after every step.

    An FMU without these variables has no impacts.

    Attributes:
        fields: what is known of an impact, in the FMU's order; the first slot's variables by field name.
        lost: impacts that did not fit into the buffer (`impacts_lost` of the FMU).
    """

    def __init__(self, description: Description) -> None:
        super().__init__(description, Buffer(description, "impacts"), "impacts_lost")
        self.fields = self._buffer.fields

    def table(self) -> pd.DataFrame:
        """One row for each impact, in the order of time, with a column for each field."""
        return pd.DataFrame(self._rows, columns=list(self.fields))


def contact_name(number: int, names: Sequence[str]) -> str:
    """A contact for people; `names` are those of the FMU, in the order of their numbers, () when it has none."""
    return names[number] if 0 <= number < len(names) else f"contact {number}"


def one_of_each_instant(impacts: pd.DataFrame) -> pd.DataFrame:
    """The first row of each instant: impacts of one instant share the jump of the body's speed and the energy lost.

    Args:
        impacts: as of `ImpactCollector.table`. Without a column `instant` every row is an instant of its own.
    """
    return impacts.drop_duplicates("instant") if "instant" in impacts else impacts


def body_held(impacts: pd.DataFrame, jump: str) -> npt.NDArray[np.bool_]:
    """Whether the struck body kept its speed though something struck with an impulse, for each row.

    Another contact that is closed, as a stop or lock, takes the impulse; then no jump makes the body's beam vibrate.

    Args:
        impacts: as of `ImpactCollector.table`; without `closing_speed` and `impulse` none is known.
        jump: the column with v_I [m/s].
    """
    if not {"closing_speed", "impulse"} <= set(impacts):
        return np.zeros(len(impacts), dtype=bool)
    velocity, speed, impulse = (
        impacts[name].abs().to_numpy(dtype=np.float64) for name in (jump, "closing_speed", "impulse")
    )
    return np.asarray((velocity <= HELD_RATIO * speed) & (impulse > 0.0))
