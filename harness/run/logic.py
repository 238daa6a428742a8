"""Modes and transitions of an FMU's mechanism, `resources/logic.json`, and every event of a run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

import pandas as pd

from mechanism_fmu.statechart import Logic, taken
from mechanism_fmu.statechart.records import decode

from ..analysis.impacts import Buffer, Collector
from ..errors import UsageError
from ..fmu.description import Description, Value
from ..fmu.resources import FlawError, resource
from ..fmu.values import parse_value


@dataclass(frozen=True)
class LogicFile:
    """What an FMU declares about its logic.

    Attributes:
        contacts: names, in the order of the bits of a mode; () when the FMU declares nothing, or has only friction.
        events: names of events by (guard, subject).
        switches: parameters that choose the variant by being zero (false) or not.
        choices: place of the variant by a text of 0 and 1, one for each switch.
        variants: the logic of each.
        objection: why it cannot be used, for the user; "" when nothing is wrong.
        impact_law: of impacts with friction, "newton", "poisson" or "stronge"; "" when the FMU does not say.
        energy_guard: whether an impact that would add energy is repeated by Poisson's law.
    """

    contacts: tuple[str, ...] = ()
    events: Mapping[tuple[int, int], str] = field(default_factory=dict)
    switches: tuple[str, ...] = ()
    choices: Mapping[str, int] = field(default_factory=dict)
    variants: tuple[Logic, ...] = ()
    objection: str = ""
    impact_law: str = ""
    energy_guard: bool = False

    def chosen(self, parameters: Mapping[str, Value]) -> Logic | None:
        """The logic for parameter values; None when the FMU declares nothing about these."""
        key = "".join("1" if parameters.get(name) else "0" for name in self.switches)
        return self.variants[self.choices[key]] if key in self.choices else None

    def event(self, guard: int, subject: int) -> str:
        """An event in words."""
        return self.events.get((guard, subject), f"guard {guard} of {subject}")

    def mode(self, number: int) -> str:
        """Names of the closed contacts, joined by "+"; the number itself when the FMU declares nothing."""
        if not self.variants:
            return str(number)
        return "+".join(name for bit, name in enumerate(self.contacts) if number >> bit & 1)


@lru_cache(maxsize=8)
def read_logic(folder: Path) -> LogicFile:
    """The logic in the extracted FMU `folder`; one that cannot be used is an objection and never an error.

    It is read once for all runs with the FMU: nothing changes in an extracted one.
    """
    try:
        data = resource(folder, "logic.json", "variants")
        return LogicFile() if data is None else _checked(data)
    except ValueError as error:
        return LogicFile(
            objection=f"The FMU's modes (resources/logic.json) cannot be shown: {error}. Build the FMU again."
        )


def default_parameters(description: Description, settings: Mapping[str, Value]) -> dict[str, Value]:
    """All parameters at their default values, but for the settings."""
    values: dict[str, Value] = {}
    for variable in description.of("parameter"):
        try:
            values[variable.name] = parse_value(variable.start or "", variable, description)
        except UsageError:
            continue  # an odd start value decides nothing here
    return values | dict(settings)


def _checked(data: dict[str, Any]) -> LogicFile:
    variants = tuple(decode(variant) for variant in data["variants"])
    choices = data.get("choices")
    if not isinstance(choices, dict) or not all(_is_place(place, len(variants)) for place in choices.values()):
        raise FlawError("its choices name variants that are not there")
    law = data.get("impact_law", "")
    if not isinstance(law, str):
        raise FlawError("its law of impacts is no text")
    return LogicFile(
        _names(data, "contacts"),
        _events(data),
        _names(data, "switches"),
        choices,
        variants,
        impact_law=law,
        energy_guard=data.get("energy_guard") is True,
    )


def _is_place(place: Any, count: int) -> bool:
    return isinstance(place, int) and not isinstance(place, bool) and 0 <= place < count


def _names(data: dict[str, Any], key: str) -> tuple[str, ...]:
    names = data.get(key)
    if not isinstance(names, list) or not all(isinstance(name, str) and name for name in names):
        raise FlawError(f"it has no list of {key}")
    return tuple(names)


def _events(data: dict[str, Any]) -> dict[tuple[int, int], str]:
    raw = data.get("events")
    if not isinstance(raw, list):
        raise FlawError("it has no list of events")
    events: dict[tuple[int, int], str] = {}
    for entry in raw:
        guard, subject, name = (entry.get(k) if isinstance(entry, dict) else None for k in ("guard", "subject", "name"))
        if not (isinstance(guard, int) and isinstance(subject, int) and isinstance(name, str)):
            raise FlawError("an event has no guard, subject and name")
        events[guard, subject] = name
    return events


# Every event of a run, from the FMU's buffer of the events of the last communication step.

_FIELDS = ("time", "guard", "subject", "old_mode", "new_mode", "impulse")

#: Columns of the table of events, with their units.
UNITS = {"time": "s", "guard": "1", "old_mode": "1", "new_mode": "1", "impulse": "N.s"}


class EventCollector(Collector):
    """An observer that keeps the events in `events[1].time`, `events[1].guard`, ... after every step.

    Attributes:
        reports: whether the FMU has these variables; one without them has no events to report.
        lost: events that did not fit into the buffer, when the FMU counts all in `event_count`.
    """

    def __init__(self, description: Description) -> None:
        super().__init__(description, Buffer(description, "events", _FIELDS), "event_count")
        self.reports = bool(self._buffer.fields)

    def _lost_of(self, counted: int) -> int:
        return counted - len(self._rows)

    def table(self, logic: LogicFile) -> pd.DataFrame:
        """One row for each event, in the order of time, in words: the columns of `UNITS`."""
        rows = [
            (time, logic.event(int(guard), int(subject)), logic.mode(int(old)), logic.mode(int(new)), impulse)
            for time, guard, subject, old, new, impulse in self._rows
        ]
        return pd.DataFrame(rows, columns=list(UNITS))


def counts_of(logic: Logic, events: pd.DataFrame) -> Mapping[int, int]:
    """How often each transition of `logic` happened, by its place."""
    counts = dict.fromkeys(range(len(logic.transitions)), 0)
    for _, guard, old, new, impulse in events.itertuples(index=False):
        for place in taken(logic, str(guard), str(old).split("+"), str(new).split("+"), float(impulse)):
            counts[place] += 1
    return counts
