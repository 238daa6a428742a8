"""What a machine is made of, and how its parts fared, as tables."""

from __future__ import annotations

from ..machine.bonds import HEADINGS as BOND_HEADINGS
from ..machine.bonds import bond_rows
from ..machine.connection import changes
from ..machine.performed import MachineRun
from ..machine.statistics import HEADINGS as PART_HEADINGS
from ..numbers import in_display_unit
from ..versions import software
from .machine_animation import in_power_flow
from .page import facts, section, table, versions_section
from .parameters import Origin, Row, parameters_section


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
