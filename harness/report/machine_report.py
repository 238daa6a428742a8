"""report.html of a machine's run."""

from __future__ import annotations

from pathlib import Path

from ..machine.performed import MachineRun
from ..master import Ending
from ..results import write_text
from ..terminal import real_time_factor
from .inputs import inputs_section
from .machine_animation import machine_animation
from .machine_signals import signals_sections
from .machine_tables import (
    bonds_section,
    components_section,
    connections_section,
    made_with_section,
    messages_section,
    run_section,
    set_parameters_section,
    statistics_section,
)
from .machine_teeth import damage_cards, teeth_sections
from .page import cards, page, points, section


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
    return section(f"This run ended early, at {run.outcome.final_time:.9g} s", note=reason, css_class="banner")


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
    told = [f"{caution.instance}: {caution.text}" for caution in run.cautions]
    for name, struck in run.by_component.items():
        if struck.objection:
            told.append(f"{name}: {struck.objection}")
        if struck.lost:
            told.append(f"{name}: {struck.lost} impacts could not be reported by the FMU; take a shorter step.")
    return section("Before you believe these numbers", points(told), css_class="banner") if told else ""


def _notes(run: MachineRun) -> str:
    return section("Notes", points(run.machine.notes)) if run.machine.notes else ""
