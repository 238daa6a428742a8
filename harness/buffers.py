"""Buffers of an FMU: what happened in the last communication step, one slot for each happening."""

from __future__ import annotations

import re
from collections.abc import Iterable

from .description import Description, Value, Variable
from .slave import Observable


class Buffer:
    """The variables `<name>[1].<field>`, `<name>[2].<field>`, ..., of which `<name>_in_step` are filled.

    Attributes:
        fields: the first slot's variables by field name; {} when the FMU has no such buffer.
    """

    def __init__(self, description: Description, name: str, fields: Iterable[str] | None = None) -> None:
        """Find the buffer `name` of an FMU, with all `fields` that the first slot has, or with those that are given."""
        slots: dict[int, dict[str, Variable]] = {}
        for variable in description.variables.values():
            match = re.fullmatch(rf"{name}\[(\d+)\]\.(\w+)", variable.name)
            if match is not None:
                slots.setdefault(int(match[1]), {})[match[2]] = variable
        if fields is None:
            fields = slots[min(slots)] if slots else ()
        wanted = list(fields)
        whole = [slots[number] for number in sorted(slots) if slots[number].keys() >= set(wanted)]
        self._filled = f"{name}_in_step"
        if self._filled not in description.variables:
            whole = []
        self.fields = {field: whole[0][field] for field in wanted} if whole else {}
        self._slots = [[slot[field].name for field in wanted] for slot in whole]

    def read(self, unit: Observable) -> list[list[Value]]:
        """The values of each filled slot, in the order of `fields`."""
        if not self._slots:
            return []
        filled = int(unit.get((self._filled,))[0])
        return [unit.get(slot) for slot in self._slots[:filled]]
