"""What impacts have done to the components of a machine: tables, stress, damage."""

from __future__ import annotations

from dataclasses import dataclass

from mechanism_fmu.stress import SequenceDamage

from ..machine.cycles import THOUSAND, Cycles, cycles_of
from ..machine.impacts import ComponentImpacts
from ..machine.performed import MachineRun
from ..numbers import engineering
from .fatigue import fatigue_section
from .impacts import impacts_section
from .interactive import interactive
from .machine_animation import in_power_flow
from .page import chart, section, table
from .plot import Curve, Plot
from .severity import severity_section
from .stress import stress_section
from .style import IMPACT_COLOUR

#: The chart of stresses has no more points than this.
_MOST_POINTS = 2000

_DEFINITION = (
    "Damage of the run by Miner's rule, times 1,000, by the number of cycles in the run. A cycle is a stroke where the "
    "component counts its strokes{counters}, else the whole run. All impacts count for one {what}; 1 is "
    "failure."
)


@dataclass(frozen=True)
class _Worn:
    """A component whose beam is damaged."""

    name: str
    what: str
    counter: str
    impacts: int
    damage: SequenceDamage
    cycles: Cycles

    @property
    def by_thousand(self) -> str:
        return f"{self.cycles.damage_of_thousand(self.damage.damage):.3g}"


def damage_cards(run: MachineRun) -> list[tuple[str, str]]:
    """Key figures: the damage by a thousand cycles of each component that has a beam."""
    return [(f"damage per {THOUSAND:,} {one.cycles.of}, {one.name}", one.by_thousand) for one in _worn(run)]


def teeth_sections(run: MachineRun) -> list[str]:
    """Damage of all components, then of each with impacts: stress, fatigue and the impacts themselves."""
    sections = [_damage_section(run)]
    for name in in_power_flow(run):
        struck = run.by_component.get(name)
        if struck is None or struck.impacts.empty:
            continue
        if struck.struck is not None and struck.beam is not None:
            what, beam = struck.struck, struck.beam
            sections.append(_stresses(name, struck, what.name, run.outcome.final_time))
            heading = f"Stress in the {what.name} of {name}"
            sections.append(stress_section(struck.impacts, what, beam, run.card, heading))
            if struck.damage is not None:
                heading = f"Fatigue of the {what.name} of {name}"
                sections.append(fatigue_section(struck.impacts, what, beam, run.card, struck.damage, heading))
            sections.append(severity_section(struck.impacts, run.units["impacts"], what))
        sections.append(impacts_section(struck.impacts, run.units["impacts"], f"Impacts of {name}"))
    return sections


def _damage_section(run: MachineRun) -> str:
    rows = [
        [
            *(one.name, f"{one.impacts}", engineering(one.damage.stress, "Pa"), f"{one.damage.damage:.3g}"),
            *(f"{one.cycles.count}", one.by_thousand, one.cycles.counted),
        ]
        for one in _worn(run)
    ]
    if not rows:
        return ""
    what = " or ".join(dict.fromkeys(one.what for one in _worn(run)))
    counters = ", ".join(dict.fromkeys(f"an output '{one.counter}'" for one in _worn(run) if one.counter))
    counters = f" ({counters})" if counters else ""
    headings = [
        *("component", "impacts [1]", "largest stress", "damage of the run [1]", "cycles in the run [1]"),
        *(f"damage per {THOUSAND:,} cycles [1]", "a cycle"),
    ]
    return section(
        f"Fatigue damage per {THOUSAND:,} cycles",
        table(headings, rows, numeric=range(1, 6)),
        note=_DEFINITION.format(what=what, counters=counters),
    )


def _worn(run: MachineRun) -> list[_Worn]:
    return [
        _Worn(
            name,
            struck.struck.name,
            struck.struck.strokes,
            len(struck.impacts),
            struck.damage,
            cycles_of(name, struck.struck.strokes, run.seen.table),
        )
        for name in in_power_flow(run)
        if (struck := run.by_component.get(name)) is not None
        and struck.damage is not None
        and struck.struck is not None
    ]


def _stresses(name: str, struck: ComponentImpacts, what: str, end: float) -> str:
    """The largest stress after each impact, over the run until `end` [s]."""
    strong = struck.impacts.nlargest(_MOST_POINTS, "stress_max").sort_values("time", kind="stable")
    points = Curve("impacts", strong["time"], strong["stress_max"], IMPACT_COLOUR, line=False, dots=True)
    label = "largest bending stress after an impact [Pa]"
    plot = Plot("", "time [s]", label, [points], from_zero=True, legend=False)
    left_out = len(struck.impacts) - len(strong)
    figure = interactive(plot, height=300)
    figure["layout"]["xaxis"]["range"] = [0.0, end]
    note = f"Without the {left_out} weakest." if left_out else ""
    return section(f"Impacts on the {what} of {name}", chart(figure), note=note)
