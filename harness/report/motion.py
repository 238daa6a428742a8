"""Charts of a run over time: quantities, active contacts."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
import pandas as pd

from ..fmu.description import Variable
from ..fmu.values import in_display_unit
from ..run.checks import energy_residual
from ..run.experiment import Run
from .plot import Curve, FloatArray, Lane, Plot, strongest, thin
from .style import COLOURS

# Which contacts are active, and what sticks: Boolean outputs named `<contact>_active` or `<part>_sticks`, as bands over
# time.

#: What Boolean outputs end with that report contacts.
SUFFIX, STICKS = "_active", "_sticks"

#: Gaps shorter than this part of the run are narrower than a pixel, and are not drawn.
_INVISIBLE = 1 / 2000


@dataclass(frozen=True)
class Contact:
    """A contact that is active or not.

    Attributes:
        name: for the reader, e.g. "holding pawl".
        variable: the FMU's Boolean output, e.g. "holding_pawl_active".
        colour: the same wherever the report shows it.
    """

    name: str
    variable: str
    colour: str


def contacts(run: Run) -> list[Contact]:
    """The contacts whose activity was recorded, and what stuck, in the FMU's order."""
    recorded = [v for v in run.description.of("output") if v.name in run.results]
    return contacts_among(recorded, lambda name: bool(run.results[name].any()))


def contacts_among(outputs: Iterable[Variable], ever: Callable[[str], bool]) -> list[Contact]:
    """The contacts whose activity some outputs report; and what sticks by them, if it ever was true."""
    return contacts_named([v.name for v in outputs if v.type == "Boolean"], ever)


def contacts_named(booleans: Iterable[str], ever: Callable[[str], bool]) -> list[Contact]:
    """As `contacts_among`, by the names of Boolean outputs."""
    variables = [name for name in booleans if name.endswith(SUFFIX) or (name.endswith(STICKS) and ever(name))]
    return [
        Contact(name.removesuffix(SUFFIX).replace("_", " "), name, COLOURS[i % len(COLOURS)])
        for i, name in enumerate(variables)
    ]


def intervals(time: FloatArray, active: npt.NDArray[np.bool_]) -> FloatArray:
    """When a Boolean signal is true: from the first sample that says so to the next that does not, or the last one.

    Args:
        time: shape (samples,), increasing.
        active: shape (samples,).

    Returns:
        Shape (intervals, 2): begin and end, in the unit of `time`.
    """
    if len(time) == 0:
        return np.empty((0, 2))
    edges = np.flatnonzero(np.diff(active.astype(np.int8), prepend=0, append=0))
    return np.asarray(time[np.minimum(edges, len(time) - 1)], dtype=np.float64).reshape(-1, 2)


def joined(spans: FloatArray, shortest_gap: float) -> FloatArray:
    """Intervals with every gap below `shortest_gap` closed.

    Args:
        spans: shape (intervals, 2), in order, as of `intervals`.
        shortest_gap: the least that stays open, in the same unit.

    Returns:
        Shape (fewer, 2).
    """
    opens = spans[1:, 0] - spans[:-1, 1] >= shortest_gap
    begins = np.concatenate((spans[:1, 0], spans[1:, 0][opens]))
    ends = np.concatenate((spans[:-1, 1][opens], spans[-1:, 1]))
    return np.column_stack((begins, ends))


def lanes_plot(run: Run) -> Plot | None:
    """A lane for each contact of a run, the first one on top; None without contacts."""
    found = [] if run.results.empty else contacts(run)
    if not found:
        return None
    time = run.results["time"].to_numpy(dtype=np.float64)
    shortest = float(time[-1] - time[0]) * _INVISIBLE
    lanes = []
    for contact in found:
        spans = intervals(time, run.results[contact.variable].to_numpy(dtype=bool))
        lanes.append(Lane(contact.name, joined(spans, shortest), contact.colour, contact.variable))
    return Plot("Active contacts", "time [s]", "", [], lanes=lanes, range=_range(time))


def _range(time: FloatArray) -> tuple[float, float]:
    return float(time[0]), float(time[-1])


# Charts of a run over time: one row for each quantity, with a common time axis.

#: What a unit measures, in the plural.
QUANTITIES = {
    "rad": "Angles",
    "rad/s": "Speeds",
    "m": "Lengths",
    "m/s": "Speeds",
    "N": "Forces",
    "N.m": "Torques",
    "J": "Energies",
    "W": "Powers",
    "Pa": "Stresses",
    "V": "Voltages",
    "A": "Currents",
}

#: The balance, in the legend.
_BALANCE = "kinetic + spring − initial − work + lost"
#: More vertical lines than this hide the curves.
_MOST_MARKS = 150


@dataclass(frozen=True)
class _Curve:
    """One of them: in the legend it has the FMU's description of its variable, at the pointer the variable's name."""

    variable: str
    name: str
    values: pd.Series[float]


@dataclass(frozen=True)
class _Row:
    """Curves of one quantity."""

    title: str
    curves: list[_Curve]

    @property
    def moves(self) -> bool:
        """Whether any of its curves changes: else its chart would be empty but for level lines."""
        return any(curve.values.nunique() > 1 for curve in self.curves)


def motion_plots(run: Run) -> list[Plot]:
    """All continuous outputs, the energy balance, and the inputs that vary: a chart for each quantity, over time.

    The last one has a lane for each contact, which shows when it is active. In each a line marks every impact.

    [] when there is nothing of that kind.
    """
    rows = [row for row in _rows(run) if row.moves]
    marks = strongest(run.impacts, _MOST_MARKS)
    plots = []
    for row in rows:
        time = run.results["time"].to_numpy(dtype=np.float64)
        curves = [
            Curve(
                curve.name,
                *thin(time, curve.values.to_numpy(dtype=np.float64)),
                COLOURS[i % len(COLOURS)],
                about=curve.variable,
            )
            for i, curve in enumerate(row.curves)
        ]
        plots.append(Plot(row.title, "time [s]", "", curves, marks=marks, range=_range(time)))
    lanes = lanes_plot(run)
    return plots if lanes is None else [*plots, replace(lanes, marks=marks)]


def still(run: Run) -> str:
    """What has no chart because nothing of its kind changes, with values, as a sentence; "" when there is none."""
    names = [curve.variable for row in _rows(run) if not row.moves for curve in row.curves]
    values = [
        f"{run.description.variable(name).description or name}: "
        + " ".join(in_display_unit(float(run.results[name].iloc[0]), name, run.description, digits=6))
        for name in names
        if name in run.results
    ]
    return f"Not drawn, for it did not change: {'; '.join(values)}." if values else ""


def _rows(run: Run) -> list[_Row]:
    if run.results.empty:
        return []
    outputs = [v for v in run.description.of("output") if v.continuous and _is_motion(v, run)]
    residual = energy_residual(run.results)
    rows = []
    for unit in dict.fromkeys(v.unit for v in outputs):
        rows.append(_quantity(unit, [v for v in outputs if v.unit == unit], run))
        if unit == "J" and residual is not None:
            rows.append(_Row("Balance [J]", [_Curve("balance", _BALANCE, residual)]))
    varying = [v for v in run.description.of("input") if v.name in run.results and run.results[v.name].nunique() > 1]
    for unit in dict.fromkeys(v.unit for v in varying):
        row = _quantity(unit, [v for v in varying if v.unit == unit], run)
        rows.append(replace(row, title=f"Input {row.title[0].lower()}{row.title[1:]}"))
    return rows


def _is_motion(variable: Variable, run: Run) -> bool:
    """Whether it belongs in the chart: fields of the last impact have their own table."""
    return variable.name in run.results and not variable.name.startswith("impact")


def _quantity(unit: str, variables: list[Variable], run: Run) -> _Row:
    """The curves of a quantity, in the display unit of its first variable.

    Angles count from their start: bodies that point in different directions would leave each other no space.
    """
    known = run.description.units.displayed.get(unit, {})
    shown = variables[0].display_unit if variables[0].display_unit in known else ""
    factor, offset = known.get(shown, (1.0, 0.0))
    from_start = unit == "rad"
    curves = []
    for variable in variables:
        values, name = factor * run.results[variable.name] + offset, variable.description or variable.name
        if from_start:
            name += f", from {values.iloc[0] + 0.0:.5g} {shown or unit}"
            values = values - values.iloc[0]
        curves.append(_Curve(variable.name, name, values))
    title = "Angle change" if from_start else QUANTITIES.get(unit, "Values")
    return _Row(f"{title} [{shown or unit or '1'}]", curves)
