"""The analyses that travel in an FMU, for tools that say what a run means: `resources/analysis.json`."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import Any

from ..model import ImpactStress, Mechanism, MechanismError, Model
from ..model.analysis import Analysis, check_analysis
from .variables import Variable, variables_of

#: Path within the FMU.
ANALYSIS = "resources/analysis.json"

#: Grows when readers of the old format would misunderstand the new one.
FORMAT = 1

#: A record of an impact begins with this, and a field of it follows.
_RECORD = "impacts[1]."

#: By how much, in parts of itself, the length of a beam may differ from that of v_I.
_SAME = 1e-9


def analysis(model: Model) -> dict[str, bytes]:
    """The file by its path within the FMU: the same bytes for the same analyses; none when the model has none.

    `{"format": 1, "analyses": [{"kind": "ImpactStress", "contact": 1, ...}, ...]}`, the other keys as in
    `mechanism_fmu.model.analysis`, without those that are "" or None; a contact is its number. The beam of an
    `ImpactStress` also has its `kind`, and beside it stand the names of its `body` and of the `striker`.

    Raises:
        MechanismError: an analysis names what the FMU does not have, or a beam is not that of the struck body.
    """
    if not model.analysis:
        return {}
    variables = variables_of(model)
    held = {v.name: v for v in variables if v.causality in ("parameter", "calculatedParameter")}
    outputs = {v.name for v in variables if v.causality == "output" and "[" not in v.name}
    records = {v.name.removeprefix(_RECORD) for v in variables if v.name.startswith(_RECORD)}
    check_analysis(model.analysis, held, outputs, records)
    mechanism = model.mechanism(model.values())
    data = {"format": FORMAT, "analyses": [_entry(one, mechanism, held) for one in model.analysis]}
    text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    return {ANALYSIS: f"{text}\n".encode()}


def _entry(one: Analysis, mechanism: Mechanism, held: Mapping[str, Variable]) -> dict[str, Any]:
    names = [contact.name for contact in mechanism.contacts]
    if one.contact not in names:
        raise MechanismError(
            f"{type(one).__name__}: there is no contact {one.contact!r}; contacts: {', '.join(names) or 'none'}."
        )
    entry = {"kind": type(one).__name__} | _plain(one) | {"contact": names.index(one.contact)}
    if isinstance(one, ImpactStress):
        body, striker = _struck(one, mechanism, held)
        entry |= {"beam": {"kind": type(one.beam).__name__} | _plain(one.beam), "body": body, "striker": striker}
    return entry


def _plain(record: Any) -> dict[str, Any]:
    """A record as JSON has it."""
    values = {field.name: getattr(record, field.name) for field in fields(record)}
    return {
        name: _plain(value) if is_dataclass(value) else value
        for name, value in values.items()
        if value is not None and value != ""
    }


def _struck(one: ImpactStress, mechanism: Mechanism, held: Mapping[str, Variable]) -> tuple[str, str]:
    """Names of the body that carries the beam, and of what strikes it.

    Raises:
        MechanismError: the contact is none of a body with teeth, or its teeth have another length than the beam.
    """
    contact = next(contact for contact in mechanism.contacts if contact.name == one.contact)
    bodies = contact.body_i, contact.body_j
    toothed = [body for body in mechanism.bodies if body.tooth_length is not None and body.name in bodies]
    if len(toothed) != 1:
        raise MechanismError(
            f"ImpactStress: contact {one.contact!r} is between {' and '.join(bodies)}, and one of them must have the "
            "beam; give Body(tooth_length=...) to that body, the length of the beam."
        )
    body = toothed[0]
    length = float(body.tooth_length or 0.0)
    given = one.beam.length
    start = float(_value(mechanism, held, given)) if isinstance(given, str) else float(given)
    if abs(start - length) > _SAME * length:
        raise MechanismError(
            f"ImpactStress: the beam is {start:g} m long, but {body.name!r} has tooth_length = {length:g} m, on which "
            "v_I rests; give both the same."
        )
    (striker,) = (name for name in bodies if name != body.name)
    return body.name, striker


def _value(mechanism: Mechanism, held: Mapping[str, Variable], name: str) -> float:
    """The value of a parameter or calculated parameter, by default."""
    calculated = {one.name: one.value for one in mechanism.calculated}
    value = calculated[name] if name in calculated else held[name].start
    return float(value or 0.0)
