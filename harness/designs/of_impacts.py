"""What a task asks of the impacts of one design, whichever way it ran."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from ..description import Value
from ..tooth_damage import damage_of_impacts
from ..tooth_stress import STRESS_UNITS, tooth_of, with_stress
from .task import Task, When

#: What tells the largest impact, the first of them that the FMU reports: v_I decides the stress.
_SIZES = ("velocity", "closing_speed", "impulse")


def wants_stress(task: Task) -> bool:
    """Whether the task asks for what impacts do to a tooth."""
    return any(
        quantity.when is When.ALL_IMPACTS or (quantity.when.of_impacts and quantity.name in STRESS_UNITS)
        for quantity in task.quantities
    )


def of_impacts(task: Task, table: pd.DataFrame, tooth_values: Mapping[str, Value]) -> dict[str, Value | None]:
    """What is asked of the impacts, by column; None where there was no impact.

    Args:
        task: of the design.
        table: a row for each impact, as of `ImpactCollector`.
        tooth_values: the FMU's `TOOTH`, if it has them.

    Raises:
        FmuError: the FMU reports a tooth that cannot be.
    """
    wanted = [quantity for quantity in task.quantities if quantity.when.of_impacts]
    if table.empty:
        return {quantity.column: None for quantity in wanted}
    tooth = tooth_of(tooth_values)
    damage = None
    if tooth is not None:
        if any(quantity.when is When.ALL_IMPACTS for quantity in wanted):
            damage = damage_of_impacts(table, tooth, task.material)
        table = with_stress(table, tooth, task.material.material)
    rows = {When.FIRST_IMPACT: 0, When.LARGEST_IMPACT: _largest(table)}
    return {
        quantity.column: float(getattr(damage, quantity.name))
        if quantity.when is When.ALL_IMPACTS
        else table[quantity.name].iloc[rows[quantity.when]].item()
        for quantity in wanted
    }


def _largest(table: pd.DataFrame) -> int:
    """Where the largest impact stands; of equal ones the first."""
    size = next((name for name in _SIZES if name in table), None)
    return 0 if size is None else int(table[size].abs().to_numpy().argmax())
