"""How the components of a machine fared: steps, steps taken back, time spent."""

from __future__ import annotations

from typing import Any

from ..clock import SECOND
from .machine import Machine
from .part import Part
from .watched import Watched

#: Units of the numbers of `statistics`.
STATISTICS_UNITS = {
    "steps": "1",
    "rollbacks": "1",
    "time_spent": "s",
    "time_per_step": "s",
    "shortest_step": "s",
    "longest_step": "s",
}

#: The columns of `statistics_rows`.
HEADINGS = (
    "component",
    "steps [1]",
    "rollbacks [1]",
    "time spent [s]",
    "a step takes [us]",
    "shortest step [s]",
    "longest step [s]",
)

#: What is none of the components: exchange of signals, observers.
REST = "(the rest)"


def statistics(machine: Machine) -> dict[str, dict[str, float]]:
    """By component, in the order in which they take their steps, ready for JSON; in `STATISTICS_UNITS`.

    The time is that of the component's own steps, saving and restoring, without what those who watch it do.
    """
    return {name: _of(part) for name, part in machine.parts.items()}


def statistics_rows(machine: Machine, wall_time: float) -> list[list[str]]:
    """The cells below `HEADINGS`, for `terminal.show_table`, with a last one for the master and the observers.

    Args:
        machine: after its run.
        wall_time: of the run [s].
    """
    rows, rest = [], wall_time
    for name, one in statistics(machine).items():
        rest -= one["time_spent"]
        rows.append(
            [
                name,
                f"{one['steps']:d}",
                f"{one['rollbacks']:d}",
                f"{one['time_spent']:.3g}",
                f"{one['time_per_step'] * 1e6:.3g}",
                f"{one['shortest_step']:.9g}",
                f"{one['longest_step']:.9g}",
            ]
        )
    return [*rows, [REST, "", "", f"{rest:.3g}", "", "", ""]]


def _of(part: Part) -> dict[str, Any]:
    own, component = part.statistics, part.component
    spent = (own.spent - (component.spent if isinstance(component, Watched) else 0)) / SECOND
    return {
        "steps": own.steps,
        "rollbacks": own.rollbacks,
        "time_spent": spent,
        "time_per_step": spent / own.steps if own.steps else 0.0,
        "shortest_step": own.least / SECOND,
        "longest_step": own.most / SECOND,
    }
