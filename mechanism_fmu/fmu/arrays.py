"""Outputs that are numbered elements of something: `impacts[1].time`, `impacts[2].time`, ... belong together."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from .variables import Variable

_ELEMENT = re.compile(r"(?P<array>.+)\[(?P<index>\d+)\](?P<field>\.\w+)")


def numbered(variables: Iterable[Variable]) -> Iterator[list[Variable]]:
    """Discrete outputs `name[1].field`, `name[2].field`, ... that differ in nothing else and lie equally far apart."""
    groups: dict[tuple[str, str], list[Variable]] = {}
    for variable in variables:
        match = _ELEMENT.fullmatch(variable.name)
        if match and variable.causality == "output" and variable.variability == "discrete":
            groups.setdefault((match["array"], match["field"]), []).append(variable)
    for (array, field), elements in groups.items():
        first, apart = elements[0], stride(elements)
        expected = [
            (f"{array}[{k + 1}]{field}", first.value_reference + k * apart, _nature(first))
            for k in range(len(elements))
        ]
        if [(v.name, v.value_reference, _nature(v)) for v in elements] == expected:
            yield elements


def _nature(variable: Variable) -> Variable:
    """All that the elements of an array share."""
    return replace(variable, name="", description="", value_reference=0, source="", dependencies=())


def stride(elements: Sequence[Variable]) -> int:
    """How many value references the elements lie apart; 0 of a single one."""
    return 0 if len(elements) == 1 else elements[1].value_reference - elements[0].value_reference


def array_name(first: Variable) -> str:
    """What an array is called whose first element this is: `impacts.time`."""
    match = _ELEMENT.fullmatch(first.name)
    assert match is not None  # `numbered` has matched it
    return match["array"] + match["field"]


def common_description(descriptions: Sequence[str]) -> str:
    """The first description, with k for the numbers that count the elements."""
    split = [re.split(r"(\d+)", description) for description in descriptions]
    if len(split) == 1 or len({len(parts) for parts in split}) > 1:
        return descriptions[0]
    indices = [str(k) for k in range(1, len(split) + 1)]
    return "".join("k" if list(column) == indices else column[0] for column in zip(*split, strict=True))
