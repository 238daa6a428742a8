"""Animation of a whole machine, and charts of its recorded signals."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from ..fmu.description import Variable
from ..machine.connection import own_of, part_of
from ..machine.running import MachineRun
from ..machine.structure import dependency_order
from .animation import MOST_IMPACTS, flags, legend, picture_data, player, rounded, times_data
from .motion import QUANTITIES, Contact, contacts_among, intervals, joined
from .page import HOW_TO_ZOOM, chart, charts, section, table
from .plot import Curve, FloatArray, Lane, Plot, interactive, strongest, thin
from .scene import Scene, names_of
from .style import COLOURS, IMPACT_COLOUR

# A whole machine in motion: the pictures of its components beside each other, with one player for all.

HEADING = "The machine in motion"

#: Of one picture, before it is scaled to the screen [px].
_SIZE = [300, 230]


def in_power_flow(run: MachineRun) -> list[str]:
    """The components in the order in which power passes over bonds; where none says so, as they take their steps."""
    bonds = run.machine.plan.bonds
    pairs = [(part_of(bond.flow.source), part_of(bond.flow.target)) for bond in bonds]
    return dependency_order(list(run.statistics), pairs)[0]


def machine_animation(run: MachineRun) -> str:
    """The section; one that says why there is nothing to see, if so."""
    data, figures, blank = _pictures(run)
    if data is None:
        note = "None of the components has a picture: their FMUs bring no resources/drawing.json that can be shown."
        return section(HEADING, note=note)
    note = (
        f"Each component at a scale of its own, from the side where power comes in; {len(data['time'])} moments of the "
        "run, between which angles and lengths go on evenly."
    )
    shown = len(data["impacts"])
    if shown < len(run.impacts):
        note += f" Of {len(run.impacts)} impacts the {shown} strongest of each component flash."
    if blank:
        note += f" Not shown: {' '.join(blank)}"
    return section(HEADING, player(data, f'<div class="panels">{"".join(figures)}</div>'), note=note)


def _pictures(run: MachineRun) -> tuple[dict[str, Any] | None, list[str], list[str]]:
    """What the player needs, None when there is no picture; a figure for each component with one; others' reasons."""
    table = run.seen.table
    panels, lamps, figures, blank = [], [], [], []
    for number, name in enumerate(in_power_flow(run), start=1):
        caption = f"<figcaption>{number} {escape(name)}</figcaption>"
        picture = None if table.empty else _picture(run, name, table)
        if picture is None:
            drawing = run.drawings[name]
            reason = drawing.objection or ("There is nothing to draw." if drawing.shapes else "Its FMU has no picture.")
            blank.append(f"{number} {name}: {reason}")
            continue
        found = _contacts(run, name, table)
        lamps += [_lamp(contact, table) for contact in found]
        panels.append(picture | {"size": _SIZE, "impacts": rounded(_struck(run, name), 9)})
        label = f"{name} at the time shown below"
        figures.append(
            f'<figure><svg role="img" aria-label="{escape(label)}"></svg>{caption}'
            f"{legend(picture['shapes'], [_own(contact) for contact in found])}</figure>"
        )
    if not panels:
        return None, figures, blank
    times, whose = _all_impacts(run)
    clock = times_data(table["time"].to_numpy())
    shared = {"impacts": times, "whose": whose, "contacts": lamps, "flash": IMPACT_COLOUR}
    return clock | shared | {"panels": panels}, figures, blank


def _picture(run: MachineRun, name: str, table: pd.DataFrame) -> dict[str, Any] | None:
    """Of one component; None when it has none."""
    shapes = run.drawings[name].shapes
    if not shapes:
        return None
    columns, constants = {}, {}
    for own in sorted(names_of(shapes)):
        whole = f"{name}.{own}"
        if whole in table:
            columns[own] = table[whole].to_numpy()
        else:
            constants[own] = float(run.seen.constants[whole])
    variables = run.machine.fmus[name].description.variables
    return picture_data(Scene(shapes, columns, constants), {own for own in columns if variables[own].unit == "rad"})


def _contacts(run: MachineRun, name: str, table: pd.DataFrame) -> list[Contact]:
    """Those of a component, by the names that their variables have in the machine."""
    outputs = [v for v in run.machine.description.of("output") if v.name in table and part_of(v.name) == name]
    return contacts_among(outputs, lambda whole: bool(table[whole].any()))


def _own(contact: Contact) -> Contact:
    return Contact(own_of(contact.name), contact.variable, contact.colour)


def _lamp(contact: Contact, table: pd.DataFrame) -> dict[str, Any]:
    return {"name": contact.name, "colour": contact.colour, "active": flags(table[contact.variable])}


def _struck(run: MachineRun, name: str) -> FloatArray:
    """Times of the impacts of a component that are shown [s]."""
    struck = run.by_component.get(name)
    if struck is None or "time" not in struck.impacts:
        return np.empty(0)
    times = strongest(struck.impacts, MOST_IMPACTS)
    return times[np.isfinite(times)]


def _all_impacts(run: MachineRun) -> tuple[list[float], Sequence[str]]:
    """Times of all impacts that are shown, in their order, and which component each is of."""
    pairs = sorted((time, name) for name in run.by_component for time in rounded(_struck(run, name), 9))
    return [time for time, _ in pairs], [name for _, name in pairs]


# Charts of what was recorded of a machine: for each component, one for each unit.

#: Points of a curve; a chart of half a screen's width shows no more.
_POINTS = 1000
#: Points of a curve that is still being read.
_WHILE_READING = 16 * _POINTS
#: More of them in one chart have no colours of their own.
_CURVES = 6
#: More vertical lines than this hide the curves.
_MOST_MARKS = 60
#: Rows that are read at once.
_ROWS = 1 << 16
#: Parts of a curve's height that nobody sees.
_FINENESS = 1e-5
#: Gaps between bands that are shorter than this part of the run are not seen.
_INVISIBLE = 1 / 1000

#: What a component's own table of impacts has, and not a chart.
_ELSEWHERE = ("impact", "event")


def signals_sections(run: MachineRun) -> list[str]:
    """A section for each component of which something recorded has changed, and a table of what has not."""
    curves = _curves(run.results, list(run.units["results"]))
    known = run.machine.description.variables
    variables = [known[name] for name in curves]
    moving = [variable for variable in variables if _moves(curves[variable.name][1])]
    sections: list[str] = []
    for name in in_power_flow(run):
        own = [variable for variable in moving if part_of(variable.name) == name]
        drawn = [*_plots(run, name, own, curves), *_bands(run, own, curves)]
        if drawn:
            sections.append(section(f"Signals of {name}", charts(*drawn), note="" if sections else _NOTE))
    still = [[v.name, f"{_first(curves[v.name][1]):.9g}", v.unit or "1"] for v in variables if v not in moving]
    if not sections:
        note = "No signal was recorded that has changed; [record] in the machine's file chooses them."
        sections.append(section("Signals", note=note))
    if still:
        drawn_table = table(["signal", "value", "unit"], still, numeric=[1], long=True)
        sections.append(section("Recorded signals that did not change", drawn_table))
    return sections


_NOTE = (
    "Signals as recorded, with every peak. Angles count from their start. Dotted red lines mark impacts of the "
    f"component. {HOW_TO_ZOOM}"
)


def _curves(file: Path, names: Sequence[str]) -> dict[str, tuple[FloatArray, FloatArray]]:
    """Time [s] and values of each recorded signal, thinned while they are read: the memory does not grow with the run.

    Args:
        file: of the results.
        names: of its columns, `time` first.
    """
    found: dict[str, tuple[FloatArray, FloatArray]] = {name: (np.empty(0), np.empty(0)) for name in names[1:]}
    for rows in _read(file, names):
        time = rows["time"].to_numpy(dtype=np.float64)
        for name, (times, values) in found.items():
            own = rows[name].to_numpy(dtype=np.float64)
            time_kept, kept = thin(time, own, _POINTS)
            found[name] = thin(np.append(times, time_kept), np.append(values, kept), _WHILE_READING)
    return {name: thin(times, values, _POINTS) for name, (times, values) in found.items()}


def _read(file: Path, names: Sequence[str]) -> Iterator[pd.DataFrame]:
    if file.suffix == ".csv":
        yield from pd.read_csv(file, header=0, names=list(names), chunksize=_ROWS)
        return
    import pyarrow.parquet as pq

    with pq.ParquetFile(file) as parquet:
        for batch in parquet.iter_batches(_ROWS):
            yield batch.to_pandas()


def _moves(values: FloatArray) -> bool:
    finite = values[np.isfinite(values)]
    return bool(finite.size) and float(np.ptp(finite)) > 0.0


def _first(values: FloatArray) -> float:
    return float(values[0]) if values.size else float("nan")


def _plots(
    run: MachineRun, name: str, variables: Sequence[Variable], curves: dict[str, tuple[FloatArray, FloatArray]]
) -> Iterator[str]:
    """The charts of a component's numbers, as many as it takes to keep the curves distinct."""
    shown = [v for v in variables if v.type != "Boolean" and not _own_signals(v).startswith(_ELSEWHERE)]
    units = dict.fromkeys(v.unit for v in shown)
    for unit in sorted(units, key=lambda one: list(QUANTITIES).index(one) if one in QUANTITIES else len(QUANTITIES)):
        alike = [v for v in shown if v.unit == unit]
        for begin in range(0, len(alike), _CURVES):
            yield chart(interactive(_plot(run, name, alike[begin : begin + _CURVES], curves), height=240))


def _plot(
    run: MachineRun, name: str, group: Sequence[Variable], curves: dict[str, tuple[FloatArray, FloatArray]]
) -> Plot:
    """Curves of one unit, shown in the display unit of the first."""
    unit = group[0].unit
    known = run.machine.description.units.displayed.get(unit, {})
    display = group[0].display_unit if group[0].display_unit in known else ""
    factor, offset = known.get(display, (1.0, 0.0))
    from_start = unit == "rad"
    drawn = []
    for place, variable in enumerate(group):
        times, values = curves[variable.name]
        values = factor * (values - values[0] if from_start else values) + (0.0 if from_start else offset)
        if not variable.continuous:
            times, values = times.repeat(2)[1:], values.repeat(2)[:-1]
        words = variable.description or _own_signals(variable)
        drawn.append(Curve(words, _short(times), _short(values), COLOURS[place], about=variable.name))
    quantity = "Angles from their start" if from_start else QUANTITIES.get(unit, "Values")
    label = f"{'angle change' if from_start else quantity.lower()} [{display or unit or '1'}]"
    return Plot(quantity, "time [s]", label, drawn, marks=_marks(run, name), range=(0.0, _end(run)))


def _bands(
    run: MachineRun, variables: Sequence[Variable], curves: dict[str, tuple[FloatArray, FloatArray]]
) -> Iterator[str]:
    """A chart with a lane for each contact, which is filled while it is active."""
    lanes = contacts_among(variables, lambda whole: bool(curves[whole][1].any()))
    if not lanes:
        return
    end = _end(run)
    drawn = []
    for lane in lanes:
        times, values = curves[lane.variable]
        spans = joined(intervals(times, values != 0.0), end * _INVISIBLE)
        drawn.append(Lane(own_of(lane.name), spans, lane.colour, lane.variable))
    plot = Plot("Active contacts", "time [s]", "", [], lanes=drawn, range=(0.0, end))
    yield chart(interactive(plot))


def _end(run: MachineRun) -> float:
    return max(run.outcome.final_time, 1e-300)


def _marks(run: MachineRun, name: str) -> FloatArray:
    struck = run.by_component.get(name)
    return np.empty(0) if struck is None or "time" not in struck.impacts else strongest(struck.impacts, _MOST_MARKS)


def _short(values: FloatArray) -> FloatArray:
    """As many decimals as can be seen."""
    finite = values[np.isfinite(values)]
    span = float(np.ptp(finite)) if finite.size else 0.0
    if not 0.0 < span < np.inf:
        return values
    return np.round(values, int(np.ceil(-np.log10(span * _FINENESS))))


def _own_signals(variable: Variable) -> str:
    return own_of(variable.name)
