"""What is kept of the impacts of one design, whichever way it ran."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from mechanism_fmu.stress import SequenceDamage

from ..description import Value
from ..tooth_damage import damage_of_impacts
from ..tooth_stress import STRESS_UNITS, tooth_of, with_stress
from .task import Quantity, Task, When


def tooth_parameters(task: Task) -> tuple[str, ...]:
    """The parameters that describe the struck tooth, if the task asks for its stress."""
    about_stress = any(
        quantity.when is When.ALL_IMPACTS or (quantity.when.of_impacts and quantity.name in STRESS_UNITS)
        for quantity in task.quantities
    )
    return ("tooth_length", "tooth_apex_angle") if about_stress else ()


def of_impacts(task: Task, impacts: pd.DataFrame, tooth_values: Mapping[str, Value]) -> dict[str, Value | None]:
    """What is asked of the impacts, by column; None where there was no impact.

    Args:
        task: says what is asked.
        impacts: a row for each, with the FMU's fields.
        tooth_values: of `tooth_parameters`.

    Raises:
        FmuError: a tooth that cannot be.
    """
    wanted = [quantity for quantity in task.quantities if quantity.when.of_impacts]
    if impacts.empty or not wanted:
        return {quantity.column: None for quantity in wanted}
    tooth = tooth_of(tooth_values)
    damage = None
    if tooth is not None:
        if any(quantity.when is When.ALL_IMPACTS for quantity in wanted):
            damage = damage_of_impacts(impacts, tooth, task.material)
        impacts = with_stress(impacts, tooth, task.material.material)
    return {quantity.column: _taken(impacts, damage, quantity) for quantity in wanted}


def _taken(impacts: pd.DataFrame, damage: SequenceDamage | None, quantity: Quantity) -> Value:
    if quantity.when is When.ALL_IMPACTS:
        return float(getattr(damage, quantity.name))
    column = impacts[quantity.name]
    number = float(column.iloc[0] if quantity.when is When.FIRST_IMPACT else column.max())
    return typed(number, quantity.type)


def typed(number: float, kind: str) -> Value:
    """A number as a value of an FMU's type."""
    return number if kind == "Real" else bool(number) if kind == "Boolean" else round(number)
