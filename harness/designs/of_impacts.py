"""What a task asks of the impacts of one design, whichever way it ran."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import pandas as pd

from ..declared import Struck
from ..description import Description, Value
from ..tooth_damage import damage_of_impacts
from ..tooth_stress import beam_of, with_stress
from .quantities import asks_for_stress
from .task import Task, When

#: What makes an impact the largest, the first of them that there is.
_SIZES = ("stress_max", "velocity", "closing_speed", "impulse")


def wants_stress(task: Task) -> bool:
    """Whether the task asks for what impacts do to a beam."""
    return any(asks_for_stress(quantity) for quantity in task.quantities)


def struck_in(task: Task, description: Description) -> Struck | None:
    """What impacts strike, if the task asks for what they do to it."""
    return description.analysis.struck if wants_stress(task) else None


def of_impacts(
    task: Task, table: pd.DataFrame, struck: Struck | None, values: Mapping[str, Value]
) -> dict[str, Value | None]:
    """What is asked of the impacts, by column; None where there was no impact, or no stress as the body was held.

    Args:
        task: of the design.
        table: a row for each impact, as of `ImpactCollector`.
        struck: what impacts strike, if the FMU declares it and the task `wants_stress`.
        values: of its variables.

    Raises:
        FmuError: the FMU reports a beam that cannot be.
    """
    wanted = [quantity for quantity in task.quantities if quantity.when.of_impacts]
    if table.empty:
        return {quantity.column: None for quantity in wanted}
    damage = None
    if struck is not None:
        beam = beam_of(struck, values)
        if any(quantity.when is When.ALL_IMPACTS for quantity in wanted):
            damage = damage_of_impacts(table, struck, beam, task.material)
        table = with_stress(table, struck, beam, task.material.material)
    rows = {When.FIRST_IMPACT: 0, When.LARGEST_IMPACT: _largest(table)}
    return {
        quantity.column: float(getattr(damage, quantity.name))
        if quantity.when is When.ALL_IMPACTS
        else _number(table[quantity.name].iloc[rows[quantity.when]].item())
        for quantity in wanted
    }


def _number(value: Value) -> Value | None:
    """None for the stress of an impact in which the body is held."""
    return None if isinstance(value, float) and math.isnan(value) else value


def _largest(table: pd.DataFrame) -> int:
    """Where the largest impact stands; of equal ones the first."""
    size = next((name for name in _SIZES if name in table and table[name].notna().any()), None)
    return 0 if size is None else int(np.nanargmax(table[size].abs().to_numpy(dtype=np.float64)))
