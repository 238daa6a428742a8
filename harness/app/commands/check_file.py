"""Check of a model file of the user's own: everything about it, without a build."""

from __future__ import annotations

import os
import sys
from dataclasses import asdict
from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING

from rich.markup import escape

from ...errors import UsageError
from ..output import give
from ..terminal import FAILED, console, error_console, show_table, show_wide_table

if TYPE_CHECKING:
    from mechanism_fmu.fmu.own.report import FileReport


def check_mechanism(file: str) -> int:
    """Show what is in a model file, and what is wrong with it; 1 where there are mistakes."""
    if "numba" not in sys.modules:
        os.environ.setdefault("NUMBA_DISABLE_JIT", "1")  # as plain Python it has started before a compiler has
    from mechanism_fmu.fmu.own.find import WrongUseError
    from mechanism_fmu.fmu.own.report import report_on

    try:
        report = report_on(file)
    except WrongUseError as error:
        raise UsageError(str(error)) from error
    give(asdict(report))
    if report.name:
        console.print(f"[bold]{escape(report.name)}[/]: {escape(report.description)}", soft_wrap=True)
    _show_bodies(report)
    _show_ports(report)
    if report.degrees_of_freedom is not None:
        console.print(f"Degrees of freedom: {report.degrees_of_freedom}")
    for row in report.redundant:
        console.print(f"Redundant: {escape(row)}", soft_wrap=True)
    if report.singular:
        console.print("The start is a singular configuration: the motion can branch there.", soft_wrap=True)
    for warning in report.warnings:
        error_console.print(f"[yellow]Warning[/]: {escape(warning)}", soft_wrap=True)
    for mistake in report.mistakes:
        error_console.print(f"[bold red]Mistake[/]: {escape(mistake)}", soft_wrap=True)
    if report.picture:
        shown = Path(f"{Path(file).stem}_overlap.svg")
        shown.write_text(report.picture, encoding="utf-8")
        error_console.print(f"The bodies are drawn in [bold]{escape(str(shown))}[/].", soft_wrap=True)
    if report.mistakes:
        return FAILED
    console.print(f"No mistakes. Build it: mechanism-fmu build {escape(file)}", soft_wrap=True)
    return 0


def _show_bodies(report: FileReport) -> None:
    rows = []
    for body in report.bodies:
        x, y, angle = body.guess if body.pose is None else body.pose
        numbers = (body.mass, body.inertia, x, y, degrees(angle))
        rows.append((body.name, *(f"{number:.6g}" for number in numbers)))
    found = all(body.pose is not None for body in report.bodies)
    where = "at the start, assembled" if found else "where assembly begins"
    headings = ["body", "mass [kg]", "inertia [kg.m2]", "x [m]", "y [m]", "angle [deg]"]
    if rows:
        show_table(f"Bodies {where}", headings, rows, numeric=range(1, 6))
    for what, parts in (("Joints", report.joints), ("Forces", report.forces), ("Contacts", report.contacts)):
        if parts:
            names = ", ".join(
                f"{name} ({kind}{', closed' if what == 'Contacts' and name in report.closed else ''})"
                for name, kind in parts
            )
            console.print(f"{what}: {escape(names)}", soft_wrap=True)


def _show_ports(report: FileReport) -> None:
    rows = [
        (kind, port.name, f"{port.start:.6g}", port.unit, port.description)
        for kind, ports in (("parameter", report.parameters), ("input", report.inputs))
        for port in ports
    ]
    drawn = [port for port in report.calculated if port.name.startswith("drawing_")]
    calculated = [port for port in report.calculated if port not in drawn]
    rows += [("calculated", port.name, f"{port.value:.6g}", port.unit, port.description) for port in calculated]
    if rows:
        show_wide_table("Parameters and inputs", ["kind", "name", "start", "unit", "what"], rows)
    if drawn:
        console.print(f"[dim]And {len(drawn)} numbers of its drawing.[/]")
    shown = [port for port in report.outputs if "[" not in port.name]
    buffered = len(report.outputs) - len(shown)
    title = "Outputs" + ("" if report.own_outputs else ", the default ones: the file declares none")
    if shown:
        texts = [(port.name, port.unit, port.source, port.description) for port in shown]
        show_wide_table(title, ["name", "unit", "reads", "what"], texts)
    if buffered:
        console.print(f"[dim]And {buffered} outputs of single impacts and events of a step.[/]")
