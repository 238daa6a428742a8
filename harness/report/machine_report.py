"""report.html of a machine's run: what it is made of, how its parts fared, what impacts have done to them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from mechanism_fmu.stress import SequenceDamage

from ..fmu.values import engineering, in_display_unit, real_time_factor
from ..machine.connection import changes
from ..machine.observers.bonds import HEADINGS as BOND_HEADINGS, bond_rows
from ..machine.observers.component_impacts import THOUSAND, ComponentImpacts, Cycles, cycles_of
from ..machine.observers.watched import HEADINGS as PART_HEADINGS
from ..machine.running import MachineRun
from ..run.master import Ending
from ..run.results import software, write_text
from .impact_sections import fatigue_section, impacts_section, severity_section, stress_section
from .machine_signals import in_power_flow, machine_animation, signals_sections
from .page import cards, chart, facts, page, points, section, table, versions_section
from .parameters import Origin, Row, inputs_section, parameters_section
from .plot import Curve, Plot, interactive
from .style import IMPACT_COLOUR

# What a machine is made of, and how its parts fared, as tables.


def bonds_section(run: MachineRun) -> str:
    """The energies over power bonds; "" without bonds."""
    if not run.bonds:
        return ""
    headings = [heading.replace("\n", " ") for heading in BOND_HEADINGS]
    note = (
        "Each side of a bond knows the other's quantity only from communication points; the coupling makes or loses "
        "the difference of what one gives and the other takes. A smaller step makes less."
    )
    return section("Energy over bonds", table(headings, bond_rows(run.bonds), numeric=range(1, 6)), note=note)


def statistics_section(run: MachineRun) -> str:
    """Steps, steps taken back, time and impacts by component."""
    struck = {name: f"{len(one.impacts)}" for name, one in run.by_component.items()}
    rows = [[*row, struck.get(row[0], "")] for row in run.rows]
    headings = [*PART_HEADINGS, "impacts [1]"]
    return section("Steps and time", table(headings, rows, numeric=range(1, len(headings))))


def messages_section(run: MachineRun) -> str:
    """What the FMUs have warned of; "" if of nothing."""
    rows = [[m.instance, f"{m.time:.9g}", m.status.name.lower(), m.text] for m in run.messages]
    if not rows:
        return ""
    headings = ["component", "t [s]", "status", "message"]
    return section("Warnings of the FMUs", table(headings, rows, numeric=[1], long=True))


def run_section(run: MachineRun) -> str:
    """How the machine was run."""
    plan = run.machine.plan
    policy = plan.policy
    rows = [
        ("stop time", f"{policy.stop_time:g} s"),
        ("step", f"{policy.step:g} s"),
        ("algorithm", str(policy.scheme)),
        *([] if policy.tolerance is None else [("tolerance", f"{policy.tolerance:g}")]),
        ("extrapolation", str(policy.extrapolation)),
        ("material of teeth", run.card.name),
        ("recorded", f"{len(run.units['results']) - 1} signals, {_how_often(plan.recording.every)}"),
        ("results", run.results.name),
    ]
    return section("Run", facts("value", rows))


def _how_often(every: int) -> str:
    return "at each communication point" if every == 1 else f"one of {every} communication points, and around impacts"


def components_section(run: MachineRun) -> str:
    """The components: their FMUs, and how these run."""
    plans = {component.name: component for component in run.machine.plan.components}
    rows = []
    for name in in_power_flow(run):
        plan, fmu = plans[name], run.machine.fmus[name]
        built = "" if plan.source.path is not None else plan.source.flavour
        process = "its own" if plan.apart else "the run's"
        description = fmu.description
        version = f"{description.fmi}.0"
        rows.append([name, fmu.path.name, description.model, description.generation_tool, built, version, process])
    headings = ["component", "FMU", "model", "made by", "built as", "FMI", "process"]
    return section("Components", table(headings, rows))


def connections_section(run: MachineRun) -> str:
    """What follows what."""
    rows = [[c.source, c.target, changes(c, run.machine.description), c.rate] for c in run.machine.plan.connections]
    return section("Connections", table(["from", "to", "by", "rate"], rows)) if rows else ""


def set_parameters_section(run: MachineRun) -> str:
    """What the file sets; "" if nothing."""
    description = run.machine.description
    rows = [
        Row(description.variable(name), *in_display_unit(value, name, description), Origin.SET, marked=False)
        for name, value in run.machine.plan.start_values.items()
    ]
    note = "What the machine's file sets; all others have the defaults of their FMUs."
    return parameters_section(rows, note) if rows else ""


def made_with_section(run: MachineRun) -> str:
    """The FMUs' identities and the versions of everything else."""
    fmus = {f"GUID of {name}": fmu.description.guid for name, fmu in run.machine.fmus.items()}
    return versions_section(fmus | software())


# What impacts have done to the components of a machine: tables, stress, damage.

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
    plot = Plot(
        "Stress left by each impact", "time [s]", label, [points], from_zero=True, legend=False, range=(0.0, end)
    )
    left_out = len(struck.impacts) - len(strong)
    note = f"Without the {left_out} weakest." if left_out else ""
    return section(f"Impacts on the {what} of {name}", chart(interactive(plot, height=260)), note=note)


def write_machine_report(run: MachineRun, path: Path) -> Path:
    """Write the report of a machine's run as one file that works offline.

    Raises:
        UsageError: the disk refuses.
    """
    return write_text(path, lambda file: file.write(machine_report(run)))


def machine_report(run: MachineRun) -> str:
    """The report as HTML, from what the run has left; nothing is computed again but stress and charts."""
    plan = run.machine.plan
    policy = plan.policy
    parts = ", ".join(component.name for component in plan.components)
    subtitle = f"{parts}  ·  {policy.stop_time:g} s in steps of {policy.step:g} s  ·  {policy.scheme}"
    body = [_banner(run), _cautions(run), cards(_key_figures(run)), machine_animation(run), bonds_section(run)]
    body += [_notes(run), messages_section(run)]
    body += [*teeth_sections(run), *signals_sections(run), inputs_section(run.machine.inputs, run.machine.description)]
    body += [statistics_section(run), run_section(run), components_section(run)]
    body += [connections_section(run), set_parameters_section(run), made_with_section(run)]
    return page(plan.title, subtitle, [part for part in body if part])


def _banner(run: MachineRun) -> str:
    if run.outcome.ending is Ending.COMPLETED:
        return ""
    reason = str(run.outcome.error) if run.outcome.error else "It was interrupted by the user."
    return section(f"This run ended early, at {run.outcome.final_time:.9g} s", note=reason, banner=True)


def _key_figures(run: MachineRun) -> list[tuple[str, str]]:
    outcome = run.outcome
    figures = [
        ("simulated", f"{outcome.final_time:.6g} s"),
        ("steps", f"{outcome.steps}"),
        (f"{run.wall_time:.3g} s on the clock", real_time_factor(outcome.final_time, run.wall_time)),
        ("impacts", f"{len(run.impacts)}"),
    ]
    return figures + damage_cards(run)


def _cautions(run: MachineRun) -> str:
    """What to know before believing the numbers; "" if there is nothing."""
    warnings = [f"{caution.instance}: {caution.text}" for caution in run.cautions]
    for name, struck in run.by_component.items():
        if struck.objection:
            warnings.append(f"{name}: {struck.objection}")
        if struck.lost:
            warnings.append(f"{name}: {struck.lost} impacts could not be reported by the FMU; take a shorter step.")
    return section("Before you believe these numbers", points(warnings), banner=True) if warnings else ""


def _notes(run: MachineRun) -> str:
    return section("Notes", points(run.machine.notes)) if run.machine.notes else ""
