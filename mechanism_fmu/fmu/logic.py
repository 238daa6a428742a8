"""The logic that travels in an FMU, for tools that show modes, transitions and events: `resources/logic.json`.

Parameters can choose between mechanisms (a guided pawl or a free one). Those that change the logic when they are
switched between zero and not zero are its switches; the file holds every variant and says which switches choose which.
"""

from __future__ import annotations

import itertools
import json
from collections.abc import Iterator, Sequence
from typing import Any

from ..model import Mechanism, MechanismError, Model, Parameter
from ..model.event_names import event_names
from ..model.transitions import logic_of
from ..statechart import Logic
from ..statechart.codec import encode

#: Path within the FMU.
LOGIC = "resources/logic.json"

#: Grows when readers of the old format would misunderstand the new one.
FORMAT = 1

#: More switches than this are not looked at: the variants double with each.
MOST_SWITCHES = 8


def logic(model: Model) -> dict[str, bytes]:
    """The file by its path within the FMU: the same bytes for the same model; none when it has no contacts.

    `{"format": 1, "contacts": [name, ...], "events": [{"guard": 0, "subject": 0, "name": "face.gap"}, ...],
    "switches": [parameter, ...], "choices": {"10": 0, ...}, "variants": [...]}`: a key of the choices has a 1 for each
    switch that is true or not zero, its value is the place of the variant, whose keys are as in
    `mechanism_fmu.statechart.Logic`.
    """
    mechanism = model.mechanism(model.values())
    if not mechanism.contacts:
        return {}
    switches = switches_of(model)
    variants: list[Logic] = []
    choices: dict[str, int] = {}
    for key in itertools.product((False, True), repeat=len(switches)):
        found = _logic_for(model, switches, key)
        if found is None:
            continue
        if found not in variants:
            variants.append(found)
        choices["".join(str(int(on)) for on in key)] = variants.index(found)
    data = {
        "format": FORMAT,
        "contacts": [contact.name for contact in mechanism.contacts],
        "events": list(_events(mechanism)),
        "switches": [parameter.name for parameter in switches],
        "choices": choices,
        "variants": [encode(variant) for variant in variants],
    }
    text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    return {LOGIC: f"{text}\n".encode()}


def default_logic(model: Model) -> Logic:
    """The logic for the default values of the parameters."""
    return logic_of(model.mechanism(model.values()))


def switches_of(model: Model) -> list[Parameter]:
    """The parameters that change the logic: Boolean ones, and others that are not negative and zero by default."""
    booleans = [p for p in model.parameters if p.type == "Boolean"]
    others = [p for p in model.parameters if p.type != "Boolean" and p.start == 0 and p.minimum == 0]
    booleans = [p for p in booleans if _matters(model, p, [b for b in booleans if b is not p])]
    return [*booleans, *(p for p in others if _matters(model, p, booleans))][:MOST_SWITCHES]


def _matters(model: Model, parameter: Parameter, others: Sequence[Parameter]) -> bool:
    """Whether switching a parameter changes the logic, whatever the others are."""
    for key in itertools.product((False, True), repeat=min(len(others), MOST_SWITCHES)):
        pair = [_logic_for(model, [*others, parameter], [*key, on]) for on in (False, True)]
        if pair[0] != pair[1] and None not in pair:
            return True
    return False


def _logic_for(model: Model, switches: Sequence[Parameter], key: Sequence[bool]) -> Logic | None:
    """The logic with switches on or off and all else at its default; None when the model objects."""
    changes = {p.name: _on(p) if on else 0.0 for p, on in zip(switches, key, strict=False)}
    try:
        return logic_of(model.build(model.values(**changes)))
    except MechanismError:
        return None


def _on(parameter: Parameter) -> float:
    """A value that is not zero."""
    most = 1.0 if parameter.maximum is None else min(parameter.maximum, 1.0)
    return most if parameter.type != "Real" else most / 2


def _events(mechanism: Mechanism) -> Iterator[dict[str, Any]]:
    for guard, subject, name in event_names(mechanism):
        yield {"guard": guard, "subject": subject, "name": name}
