"""Which calls get or set some variables of an FMU: one for each type."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from ..description import Description


@dataclass
class Batch:
    """Variables of one type.

    Attributes:
        kind: name of the type in the functions of FMI.
        type: what it is to the harness.
        references: value references, each once.
        count: numbers that belong to them: more than references where there are arrays.
        places: of the variables among those that are asked for.
        offsets: of the variables among the numbers.
        bound: an instance's own way of getting them fast; None until it has one.
    """

    kind: str
    type: str
    references: list[int] = field(default_factory=list)
    count: int = 0
    places: list[int] = field(default_factory=list)
    offsets: list[int] = field(default_factory=list)
    bound: Any = None

    @property
    def is_whole(self) -> bool:
        """Whether all numbers are asked for; else there are arrays of which only some elements are."""
        return self.count == len(set(self.offsets))


def batches(names: Sequence[str], description: Description) -> list[Batch]:
    """The calls for variables by name."""
    found: dict[str, Batch] = {}
    begins: dict[tuple[str, int], int] = {}
    for place, name in enumerate(names):
        variable = description.variable(name)
        batch = found.setdefault(variable.fmi_type, Batch(variable.fmi_type, variable.type))
        key = variable.fmi_type, variable.reference
        if key not in begins:
            begins[key] = batch.count
            batch.references.append(variable.reference)
            batch.count += variable.elements
        batch.places.append(place)
        batch.offsets.append(begins[key] + variable.element)
    return list(found.values())
