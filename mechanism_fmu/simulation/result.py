"""What comes of a run: a table, impacts and events, statistics of the solver, a plot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..model.default_ports import impact_remark, impact_units
from ..model.mechanism import Mechanism
from ..model.ports import Input, Output
from ..moving import Event, Impact

if TYPE_CHECKING:
    import pandas as pd

_DTYPES = {"Real": "float64", "Integer": "int64", "Boolean": "bool"}
#: Units of the columns of impacts and events, but for those that depend on the contacts (`impact_units`).
_UNITS = {"time": "s", "velocity": "m/s", "energy_lost": "J"}


@dataclass(frozen=True)
class Statistics:
    """What a run has cost.

    Attributes:
        communication_steps: rows of the table, but for the first.
        accepted_steps: of the engine's own.
        rejected_steps: of the engine's own, whose error was too large.
        evaluations: of the accelerations, in all steps that were tried, those to find events among them.
        events: all kinds, impacts among them.
        impacts: of all contacts.
        wall_time: [s], the start with it.
    """

    communication_steps: int
    accepted_steps: int
    rejected_steps: int
    evaluations: int
    events: int
    impacts: int
    wall_time: float


@dataclass(frozen=True)
class Result:
    """A run.

    Attributes:
        mechanism: that was run.
        names: of the columns of the table: "time", inputs, outputs.
        numbers: the table, shape (rows, columns), in SI units.
        units: by name; "1" for numbers without one.
        descriptions: by name.
        types: FMI types of outputs, by name.
        impacts, events: all, in the order of time.
        statistics: of the solver.

    Source: that of its numbers is `simulate`; between rows, linear interpolation.
    """

    mechanism: Mechanism = field(repr=False)
    names: tuple[str, ...] = field(repr=False)
    numbers: np.ndarray[Any, np.dtype[Any]] = field(repr=False)
    units: Mapping[str, str] = field(repr=False)
    descriptions: Mapping[str, str] = field(repr=False)
    types: Mapping[str, str] = field(repr=False)
    impacts: Sequence[Impact] = field(repr=False)
    events: Sequence[Event] = field(repr=False)
    statistics: Statistics

    @classmethod
    def of(
        cls,
        mechanism: Mechanism,
        shown: Sequence[Output],
        rows: Sequence[Sequence[float]],
        impacts: Sequence[Impact],
        events: Sequence[Event],
        statistics: Statistics,
    ) -> Result:
        """A run of `mechanism`, whose rows have the time, all inputs, and the outputs `shown`.

        Args:
            mechanism: that was run.
            shown: its outputs that were read.
            rows: values in SI units, shape (times, 1 + inputs + outputs).
            impacts: all of the run.
            events: all of the run.
            statistics: of the run.
        """
        ports: list[Input | Output] = [*mechanism.inputs, *shown]
        return cls(
            mechanism,
            ("time", *(port.name for port in ports)),
            np.array(rows),
            {"time": "s"} | {port.name: port.unit for port in ports},
            {"time": "Time"} | {port.name: port.description for port in ports},
            {output.name: output.type for output in shown},
            tuple(impacts),
            tuple(events),
            statistics,
        )

    @cached_property
    def table(self) -> pd.DataFrame:
        """A row for each communication point; `table.attrs` has "units" and "descriptions" by name."""
        import pandas as pd

        columns = zip(self.names, self.numbers.T, strict=True)
        table = pd.DataFrame({name: column.astype(self._type(name)) for name, column in columns})
        table.attrs.update(units=dict(self.units), descriptions=dict(self.descriptions))
        return table

    @cached_property
    def impact_table(self) -> pd.DataFrame:
        """A row for each impact, with the fields of `Impact`; `attrs["units"]` by name.

        Where all contacts are stops and locks, closing speeds are in rad/s and impulses in N.m.s; where some are, those
        of these are so, whatever the units of the column (`attrs["descriptions"]` says it).
        """
        return self._table(self.impacts, Impact)

    @cached_property
    def event_table(self) -> pd.DataFrame:
        """A row for each event, with the fields of `Event`; modes are joined by "+", units as of `impact_table`."""
        return self._table(self.events, Event)

    def __getitem__(self, name: str) -> np.ndarray[Any, np.dtype[Any]]:
        """A column, shape (rows,).

        Raises:
            KeyError: there is none of that name.
        """
        if name not in self.names:
            raise KeyError(f"{name!r}; there are: {', '.join(self.names)}")
        column: np.ndarray[Any, np.dtype[Any]] = self.numbers[:, self.names.index(name)]
        return column

    def at(self, time: float) -> dict[str, float]:
        """All columns at a time [s]: between two rows interpolated linearly, and whole numbers those of the row before.

        Args:
            time: [s], within the run.

        Raises:
            ValueError: the run was not there.
        """
        times = self["time"]
        if not times[0] <= time <= times[-1]:
            raise ValueError(f"t = {time:g} s is not within the run, from {times[0]:g} s to {times[-1]:g} s.")
        before = int(np.searchsorted(times, time, side="right")) - 1
        return {
            name: float(np.interp(time, times, self[name]) if self._type(name) == "float64" else self[name][before])
            for name in self.names
        }

    def per_turn(self, value: str, angle: str) -> np.ndarray[Any, np.dtype[Any]]:
        """How much a column changes in each whole turn of an angle since the start, shape (turns,).

        Turns end where the angle first comes 2 pi further, in the sense in which it goes over the run; between two rows
        both are taken as linear. Of the work of sliding of a joint with play, that is its wear per turn.

        Args:
            value: name of the column.
            angle: name of that of the angle [rad], which counts turns.

        Raises:
            KeyError: there is no such column.
        """
        angles = self[angle]
        turned = np.maximum.accumulate(np.sign(angles[-1] - angles[0]) * (angles - angles[0]))
        ends = 2.0 * np.pi * np.arange(int(turned[-1] / (2.0 * np.pi)) + 1)
        after = np.maximum(1, np.searchsorted(turned, ends))
        share = (ends - turned[after - 1]) / (turned[after] - turned[after - 1])
        share[0], after[0] = 0.0, 1
        column = self[value]
        return np.diff(column[after - 1] + share * (column[after] - column[after - 1]))

    def to_csv(self, path: Path | str) -> None:
        """Write the table; headings have the units, as in "speed [rad/s]".

        Args:
            path: of the file.
        """
        headings = [name if self.units[name] == "1" else f"{name} [{self.units[name]}]" for name in self.names]
        self.table.to_csv(path, index=False, header=headings)

    def plot(self, *names: str) -> Any:
        """A plotly `Figure` of columns over time, one chart for each unit: `.show()` it, or `.write_html("run.html")`.

        Args:
            names: of columns; without any, all real ones that change.

        Raises:
            KeyError: there is no such column.
            ModuleNotFoundError: plotly, of the extra `plot`, is not installed.
        """
        try:
            from .plot import Curve, figure
        except ModuleNotFoundError as error:
            raise ModuleNotFoundError(
                'plot draws with plotly, which is not installed: python -m pip install "mechanism_fmu[plot]"',
                name=error.name,
            ) from None

        chosen = names or [name for name in self.names[1:] if self._type(name) == "float64" and np.ptp(self[name]) > 0]
        curves = [Curve(name, self[name], self.units[name], self.descriptions[name]) for name in chosen]
        return figure(self["time"], curves, [impact.time for impact in self.impacts])

    def _type(self, name: str) -> str:
        return _DTYPES[self.types.get(name, "Real")]

    def _table(self, records: Sequence[Any], kind: type[Any]) -> pd.DataFrame:
        import pandas as pd

        rows = [["+".join(value) if isinstance(value, tuple) else value for value in record] for record in records]
        table = pd.DataFrame(rows, columns=list(kind._fields))
        speed, impulse = impact_units(self.mechanism)
        units = {**_UNITS, "closing_speed": speed, "impulse": impulse}
        table.attrs["units"] = {name: units.get(name, "1") for name in kind._fields}
        remark = impact_remark(self.mechanism)
        said = {"closing_speed": f"Speed before{remark}", "impulse": f"Impulse{remark}"}
        table.attrs["descriptions"] = {name: said[name] for name in kind._fields if name in said}
        return table
