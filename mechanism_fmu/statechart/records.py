"""Records of a mechanism's logic, to and from JSON data, and which transitions an event has taken."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import MISSING, asdict, dataclass, fields
from typing import Any, TypeVar

# Records of a mechanism's logic. A guard is a product of logical functions: all of its factors must be 1.

#: The event of a transition that any event can bring along.
ANY = "any"


@dataclass(frozen=True)
class Definition:
    """A logical function: a named function of the motion with the values 0 and 1.

    Attributes:
        name: "<part>.<verb>", e.g. "face.touches"; or the name of a function that the mechanism declares.
        meaning: when it is 1, e.g. "gap s <= 0".
        unit: of the quantity that it looks at.
        tolerance: how exactly the engine decides it.
        event: the event that it fires, named as in `mechanism_fmu.simulation.Event`; "" when it only guards.
    """

    name: str
    meaning: str
    unit: str
    tolerance: str
    event: str = ""


@dataclass(frozen=True)
class Region:
    """One of the state charts that run beside each other.

    Attributes:
        part: the contact, pattern or memory whose states these are; unique.
        kind: what it is, in a few words.
        states: "open" and "closed" of a contact, and one state of what only counts.
        start: the state at the start; "" when assembly decides it.
        is_contact: whether the mode of the mechanism (the names of its closed contacts) says the state.
    """

    part: str
    kind: str
    states: tuple[str, ...]
    start: str
    is_contact: bool


@dataclass(frozen=True)
class Transition:
    """One arrow of the chart.

    A contact that neither changes its state nor gave the event its name has no arrow: nothing happens to it.

    Attributes:
        part: the region.
        source, target: states.
        event: what fires it, named as in `mechanism_fmu.simulation.Event.guard`; or `ANY`.
        guard: logical functions, each perhaps with "not " before it, that must all be 1 before the reset.
        after: likewise, after the reset.
        reset: what else changes, in a few words; "" when nothing does.
        impact: whether it happens only at events with an impact.
    """

    part: str
    source: str
    target: str
    event: str
    guard: tuple[str, ...]
    after: tuple[str, ...] = ()
    reset: str = ""
    impact: bool = False

    @property
    def trigger(self) -> str:
        """The event in words."""
        if self.event == ANY:
            return "any impact" if self.impact else "any event"
        return self.event

    @property
    def condition(self) -> str:
        """The guard as a product, with what must hold after the reset."""
        before, after = " and ".join(self.guard), " and ".join(self.after)
        return "; ".join(filter(None, (before, f"then {after}" if after else "")))


@dataclass(frozen=True)
class Logic:
    """All that a mechanism's modes can do.

    Attributes:
        definitions: the logical functions.
        regions: the state charts.
        transitions: their arrows; for the same part and states the first that applies is taken.
    """

    definitions: tuple[Definition, ...]
    regions: tuple[Region, ...]
    transitions: tuple[Transition, ...]


# A mechanism's logic to and from JSON data.

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


# Which transitions an event has taken.


def taken(logic: Logic, event: str, old_mode: Collection[str], new_mode: Collection[str], impulse: float) -> list[int]:
    """Places in `logic.transitions` of the transitions that an event has taken, at most one of each region.

    Args:
        logic: of the mechanism.
        event: what fired, e.g. "face.gap" (`Event.guard`).
        old_mode: names of the closed contacts before.
        new_mode: names of the closed contacts after.
        impulse: total impulse of the event [N s]; 0 when there was no impact.

    Source: definition: an arrow is taken at its event where its states are those before and after;
        docs/explanation/theory.md, section Logical functions, modes and transitions.
    """
    found = []
    for region in logic.regions:
        source, target = (_state(region, mode) for mode in (old_mode, new_mode))
        for place, arrow in enumerate(logic.transitions):
            if arrow.part != region.part or (arrow.impact and impulse == 0):
                continue
            if region.is_contact and (arrow.source, arrow.target) != (source, target):
                continue
            if arrow.event == event or (arrow.event == ANY and source != target):
                found.append(place)
                break
    return found


def _state(region: Region, mode: Collection[str]) -> str:
    if not region.is_contact:
        return ""
    return "closed" if region.part in mode else "open"
