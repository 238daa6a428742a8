"""A mechanism's logic to and from JSON data."""

from __future__ import annotations

from dataclasses import MISSING, asdict, fields
from typing import Any, TypeVar

from .records import Definition, Logic, Region, Transition

_Record = TypeVar("_Record", Definition, Region, Transition)


def encode(logic: Logic) -> dict[str, Any]:
    """Data for `json.dumps`; the same for the same logic."""
    return asdict(logic)


def decode(data: Any) -> Logic:
    """The logic that `encode` wrote.

    Raises:
        ValueError: it wrote something else; the message says what is wrong.
    """
    if not isinstance(data, dict):
        raise ValueError("a variant is no object")
    logic = Logic(
        _records(data, "definitions", Definition),
        _records(data, "regions", Region),
        _records(data, "transitions", Transition),
    )
    states = {region.part: region.states for region in logic.regions}
    if len(states) < len(logic.regions) or not all(states.values()):
        raise ValueError("two regions have the same name, or one has no states")
    for arrow in logic.transitions:
        if not {arrow.source, arrow.target} <= set(states.get(arrow.part, ())):
            raise ValueError(f"a transition of '{arrow.part}' joins states that are not there")
    return logic


def _records(data: dict[str, Any], key: str, kind: type[_Record]) -> tuple[_Record, ...]:
    raw = data.get(key)
    if not isinstance(raw, list):
        raise ValueError(f"it has no list of {key}")
    return tuple(_record(entry, key, kind) for entry in raw)


def _record(raw: Any, key: str, kind: type[_Record]) -> _Record:
    if not isinstance(raw, dict):
        raise ValueError(f"an entry of {key} is no object")
    values: dict[str, Any] = {}
    for field in fields(kind):
        if field.name not in raw and field.default is not MISSING:
            continue
        value = raw.get(field.name)
        if str(field.type).startswith("tuple") and isinstance(value, (list, tuple)):
            value = tuple(value)
        if not _fits(value, str(field.type)):
            raise ValueError(f"'{field.name}' in {key} is {value!r:.60}")
        values[field.name] = value
    return kind(**values)


def _fits(value: Any, kind: str) -> bool:
    if kind.startswith("tuple"):
        return isinstance(value, tuple) and all(isinstance(item, str) for item in value)
    return isinstance(value, bool if kind == "bool" else str)
