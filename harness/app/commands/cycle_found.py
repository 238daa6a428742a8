"""What `mechanism-fmu cycle` does: a periodic motion found, shown and written."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd
from rich.markup import escape

import build_fmu
from mechanism_fmu.periodic import (
    Cycle,
    CycleError,
    Direction,
    MechanismError,
    Problem,
    Section,
    SimulationError,
    find_cycle,
    problem_of,
    quantity,
    section_of,
)

from ...errors import HarnessError, UsageError
from ...run.results import write_json, write_text
from ..execution import require_writable
from ..output import give, note
from ..terminal import console, show_note, show_progress, show_table

_KINDS = (".csv", ".json")
#: A multiplier below this [1] is no more than rounding and the tolerance of the integration leave of 0.
_GONE = 1e-6


@dataclass(frozen=True)
class Asked:
    """The options of the command, as they were written; what they are: `mechanism_fmu.periodic`."""

    section: str | None = None
    direction: Direction = "rising"
    passages: int = 1
    period: str | None = None
    unknowns: tuple[str, ...] = ()
    advances: tuple[str, ...] = ()
    settle: int = 0
    settings: tuple[str, ...] = ()
    longest: str | None = None
    tolerance: float = 1e-11


def find(name: str, asked: Asked, output: Path | None) -> int:
    """Find the periodic motion, show and write it, and return the exit code.

    Args:
        name: of a ready-made model, or file of the user's own.
        asked: the options.
        output: file to write, or None.

    Raises:
        UsageError: the options cannot be; the message says what can.
        HarnessError: there is no such motion, or it has no multipliers.
    """
    require_writable(output, _KINDS)
    if (asked.section is None) == (asked.period is None):
        raise UsageError(
            "Say where a cycle ends: --section OUTPUT for a free period, or --period 0.5s for that of a drive; one of "
            "the two."
        )
    model = build_fmu.model_of(name)
    try:
        name_of_section = (asked.section or "").partition("=")[0]
        problem = problem_of(
            model, asked.unknowns, asked.settings, asked.advances, asked.tolerance, section=name_of_section
        )
        end = _end(problem, asked)
        with show_progress("Looking for the cycle ...") as progress:
            found = find_cycle(problem, end, asked.settle, progress)
    except MechanismError as error:
        raise UsageError(str(error)) from error
    except (CycleError, SimulationError) as error:
        raise HarnessError(str(error)) from error
    give(as_data(found))
    _show(found, model.name)
    if output is not None:
        _write(found, output)
        note("files", str(output))
        console.print(f"Written: {escape(str(output))}", soft_wrap=True)
    return 0


def as_data(found: Cycle) -> dict[str, Any]:
    """What is found, as plain numbers and texts, in SI units."""
    return {
        "period": found.period,
        "start": {u.name: float(x) for u, x in zip(found.problem.unknowns, found.start, strict=True)},
        "multipliers": [{"real": m.real, "imaginary": m.imag, "size": abs(m)} for m in found.multipliers.tolist()],
        "multiplier_errors": found.margins.tolist(),
        "stable": found.stable,
        "undecided": found.undecided,
        "residual": found.residual,
        "next_cycle": found.again,
        "iterations": found.iterations,
        "matrix": found.matrix.tolist(),
        "moved": found.moved,
        "events": _events(found),
    }


def verdict(found: Cycle) -> str:
    """Whether it is stable, in a sentence."""
    largest = float(abs(found.multipliers[0]))
    if found.undecided:
        return f"Undecided: the largest multiplier has the size {largest:.9f}, which is 1 as far as it is known."
    if not found.stable:
        return f"Not stable: a small disturbance grows {largest:.6g} times each cycle."
    if largest < _GONE:
        return "Stable: a small disturbance is gone after one cycle."
    return f"Stable: of a small disturbance {100.0 * largest:.3g} % is left after one cycle, in the long run."


def _end(problem: Problem, asked: Asked) -> Section | float:
    longest = None if asked.longest is None else _seconds(asked.longest, "--longest")
    if asked.section is None:
        return _seconds(asked.period or "", "--period")
    return section_of(problem, asked.section, asked.direction, asked.passages, longest, asked.advances)


def _seconds(text: str, option: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float(quantity(text, "s", option))
    if not 0.0 < value < math.inf:
        raise UsageError(f"{option} is {value:g} s, but must be positive and finite.")
    return value


def _events(found: Cycle) -> list[dict[str, Any]]:
    return [
        {
            "time": event.time,
            "event": event.guard,
            "closing_speed": found.closing.get(event.time) if event.guard.endswith(".gap") else None,
            "closed": list(event.new_mode),
        }
        for event in found.events
    ]


def _show(found: Cycle, name: str) -> None:
    console.print(f"[bold]A cycle of {escape(name)}[/]: {found.period:.11g} s", soft_wrap=True)
    rows = [
        [unknown.name, f"{value:.11g}", unknown.unit, f"{unknown.advance:.9g}" if unknown.advance else ""]
        for unknown, value in zip(found.problem.unknowns, found.start.tolist(), strict=True)
    ]
    show_table("Its beginning", ["unknown", "value", "unit", "advances by"], rows, numeric=(1, 3))
    events = [
        [
            f"{event['time']:.9f}",
            event["event"],
            "" if event["closing_speed"] is None else f"{event['closing_speed']:.6g}",
            ", ".join(event["closed"]),
        ]
        for event in _events(found)
    ]
    if events:
        headings = ["time [s]", "event", "closing speed [m/s or rad/s]", "closed then"]
        show_table("Its events", headings, events, numeric=(0, 2))
    numbers = [
        [*(_number(part, margin) for part in (m.real, m.imag, abs(m))), f"{margin:.0e}"]
        for m, margin in zip(found.multipliers.tolist(), found.margins.tolist(), strict=True)
    ]
    show_table("Its multipliers", ["real", "imaginary", "size", "known within"], numbers, numeric=range(4))
    for moved, change in found.moved.items():
        if moved not in {unknown.name for unknown in found.problem.unknowns}:
            unit = "rad" if moved.endswith(".angle") else "m"
            show_note(f"{moved} moves on by {change:.9g} {unit} each cycle.")
    console.print(
        f"[dim]End less beginning {found.residual:.0e}, of the next cycle {found.again:.0e}, over the scales of the "
        f"unknowns; {found.iterations} iterations.[/]",
        soft_wrap=True,
    )
    said = verdict(found)
    note("notes", said)
    console.print(f"[bold]{escape(said)}[/]", soft_wrap=True)


def _number(value: float, margin: float) -> str:
    return "0" if abs(value) <= margin else f"{value:.9f}"


def _write(found: Cycle, output: Path) -> None:
    """JSON has all; CSV one row a number: kind, name, value."""
    data = as_data(found)
    if output.suffix == ".json":
        write_json(output, data)
        return
    rows: list[tuple[str, str, float | None]] = [("period", "", found.period)]
    rows += [("start", name, value) for name, value in data["start"].items()]
    for k, multiplier in enumerate(data["multipliers"], start=1):
        rows += [("multiplier", f"{part}[{k}]", value) for part, value in multiplier.items()]
    rows += [("moved", name, value) for name, value in found.moved.items()]
    rows += [("event", event["event"], event["time"]) for event in data["events"]]
    rows += [("stable", "", float(found.stable)), ("residual", "", found.residual)]
    table = pd.DataFrame(rows, columns=["kind", "name", "value"])
    write_text(output, lambda target: table.to_csv(target, index=False))
