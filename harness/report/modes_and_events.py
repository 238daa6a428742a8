"""The mechanism's modes and transitions, and the events of a run."""

from __future__ import annotations

from mechanism_fmu.statechart import diagram

from ..run.experiment import Run
from ..run.logic import UNITS, counts_of
from .page import section, table

#: A longer table is in events.csv.
_MOST_EVENTS = 100

_HEADING = "Modes and transitions"


def modes_section(run: Run) -> str:
    """The state charts with how often each transition happened; "" when the FMU describes none."""
    if run.logic.objection:
        return section(_HEADING, note=run.logic.objection)
    logic = run.logic.chosen(run.parameters)
    if logic is None or not logic.regions or not run.parameters:
        return ""
    note = (
        "The state charts run beside each other. An arrow has its event, [its guard, a product of logical functions] "
        "and / what it resets"
    )
    if run.logic.contacts and run.logic.impact_law and any(region.part.endswith(".slip") for region in logic.regions):
        again = "; one that would add energy is repeated by Poisson's" if run.logic.energy_guard else ""
        note += f". Impacts with friction are {run.logic.impact_law.capitalize()}'s{again}"
    if not run.reports_events:
        note += ". How often each happened in this run is not known: the FMU reports no single events."
        return section(_HEADING, f'<div class="scroll">{diagram(logic)}</div>', note=note)
    note += "; how often it happened in this run stands beside it, and what never happened is grey."
    if run.events_lost:
        note += f" {run.events_lost} events that the FMU could not report are not counted."
    return section(_HEADING, f'<div class="scroll">{diagram(logic, counts_of(logic, run.events))}</div>', note=note)


def events_section(run: Run) -> str:
    """The first events, a row each, folded at first; "" when there were none."""
    if run.events.empty:
        return ""
    headings = [f"{name.replace('_', ' ')} [{unit}]".removesuffix(" [1]") for name, unit in UNITS.items()]
    rows = [
        [str(number), f"{time:.9g}", guard, old or "all open", new or "all open", f"{impulse:.6g}"]
        for number, (time, guard, old, new, impulse) in enumerate(
            run.events.head(_MOST_EVENTS).itertuples(index=False), 1
        )
    ]
    notes = []
    if len(run.events) > _MOST_EVENTS:
        notes.append(f"The first {_MOST_EVENTS} of {len(run.events)}; all are in events.csv.")
    if run.events_lost:
        notes.append(f"{run.events_lost} more did not fit into the FMU's buffer; use a shorter communication step.")
    drawn = table(["#", *headings], rows, numeric=(0, 1, 5))
    return section("Events", drawn, note=" ".join(notes), folded=True)
