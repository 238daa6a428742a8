"""What a task asks of the impacts of one design, whichever way it ran."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import pandas as pd

from ..description import Value
from ..tooth_damage import damage_of_impacts
from ..tooth_stress import tooth_of, with_stress
from .quantities import asks_for_stress
from .task import Task, When

#: What makes an impact the largest, the first of them that there is.
_SIZES = ("stress_max", "velocity", "closing_speed", "impulse")


def wants_stress(task: Task) -> bool:
    """Whether the task asks for what impacts do to a tooth."""
    return any(asks_for_stress(quantity) for quantity in task.quantities)


def of_impacts(task: Task, table: pd.DataFrame, tooth_values: Mapping[str, Value]) -> dict[str, Value | None]:
    """What is asked of the impacts, by column; None where there was no impact, or no stress as the wheel was held.

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
        else _number(table[quantity.name].iloc[rows[quantity.when]].item())
        for quantity in wanted
    }


def _number(value: Value) -> Value | None:
    """None for the stress of an impact in which the wheel is held."""
    return None if isinstance(value, float) and math.isnan(value) else value


def _largest(table: pd.DataFrame) -> int:
    """Where the largest impact stands; of equal ones the first."""
    size = next((name for name in _SIZES if name in table and table[name].notna().any()), None)
    return 0 if size is None else int(np.nanargmax(table[size].abs().to_numpy(dtype=np.float64)))
