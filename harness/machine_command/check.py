"""`machine check`: what is in a machine's file, without running it."""

from __future__ import annotations

from ..machine.connection import changes
from ..machine.prepared import Prepared
from ..machine.recorded import chosen
from ..machine.structure import structure_of
from ..terminal import console, show_table, show_wide_table
from .prepare import prepared
from .run import show_notes


def check_file(name: str) -> int:
    """Show the components of a machine in their order, its connections, and what is to be said of it."""
    with prepared(name) as machine:
        _show(machine)
        console.print("The file has no mistakes.")
    return 0


def _show(machine: Prepared) -> None:
    plan = machine.plan
    order = structure_of(machine.descriptions, plan.connections).order
    rows = []
    for name in order:
        fmu = machine.fmus[name]
        abilities = {
            "put back": fmu.description.saves_state,
            "takes slopes": fmu.description.takes_slopes,
            "gives slopes": fmu.description.gives_slopes,
            "event mode": fmu.description.has_event_mode,
        }
        can = ", ".join(ability for ability, there in abilities.items() if there)
        rows.append([name, fmu.path.name, fmu.description.generation_tool, can])
    show_wide_table(f"{plan.title}: components, in the order of who follows whom", _COMPONENTS, rows)
    connections = [[c.source, c.target, changes(c, machine.description), c.rate] for c in plan.connections]
    show_wide_table("Connections", ["from", "to", "by", "rate"], connections)
    policy = plan.policy
    pairs = [
        ("stop time", f"{policy.stop_time:g} s"),
        ("step", f"{policy.step:g} s"),
        ("algorithm", policy.scheme.value + ("" if policy.tolerance is None else f", {policy.tolerance:g}")),
        ("extrapolation", policy.extrapolation.value),
        ("bonds", ", ".join(bond.name for bond in plan.bonds) or "none"),
        ("recorded", f"{len(chosen(plan.recording.signals, machine.description))} signals"),
    ]
    show_table("Run", ["what", "value"], pairs)
    show_notes(machine)


_COMPONENTS = ["component", "FMU", "made by", "can be or do"]
