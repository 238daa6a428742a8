"""Resource files of an FMU for tools: its drawing, its logic, terminals of its shafts, analyses that it declares."""

from __future__ import annotations

import itertools
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, fields, is_dataclass
from typing import Any
from xml.etree.ElementTree import Element, SubElement

from ...model import GROUND, CompliantShaft, ImpactStress, Mechanism, MechanismError, Model, Parameter, Torque
from ...model.analysis import Analysis, check_analysis
from ...model.drawing import check_drawing
from ...model.event_names import event_names
from ...model.transitions import logic_of
from ...statechart import Logic
from ...statechart.records import encode
from .model_description import to_bytes
from .variables import Variable, variables_of

# The drawing that travels in an FMU, for tools that show the motion: `resources/drawing.json`.

#: Path within the FMU.
DRAWING = "resources/drawing.json"

#: Grows when readers of the old format would misunderstand the new one.
FORMAT = 1


def drawing(model: Model) -> dict[str, bytes]:
    """The file by its path within the FMU: the same bytes for the same drawing; none when the model has no drawing.

    `{"format": 1, "shapes": [{"kind": "bar", ...}, ...]}`, the other keys as in `mechanism_fmu.model.drawing`.

    Raises:
        MechanismError: the drawing names what the FMU does not have; see `check_drawing`.
    """
    if not model.shapes:
        return {}
    # Inputs are left out: an FMU need not give back what was set. Buffered impacts are no state of the mechanism.
    known = {v.name for v in variables_of(model) if v.causality != "input" and "[" not in v.name}
    check_drawing(model.shapes, known)
    shapes = [{"kind": type(shape).__name__.lower(), **asdict(shape)} for shape in model.shapes]
    shapes = [{key: value for key, value in shape.items() if key != "copies" or value} for shape in shapes]
    text = json.dumps({"format": FORMAT, "shapes": shapes}, separators=(",", ":"), allow_nan=False)
    return {DRAWING: f"{text}\n".encode()}


# The logic that travels in an FMU, for tools that show modes, transitions and events: `resources/logic.json`.
#
# Parameters can choose between mechanisms (a guided pawl or a free one). Those that change the logic when they are
# switched between zero and not zero are its switches; the file holds every variant and says which switches choose
# which.

#: Path within the FMU.
LOGIC = "resources/logic.json"


#: More switches than this are not looked at: the variants double with each.
MOST_SWITCHES = 8


def logic(model: Model) -> dict[str, bytes]:
    """The file by its path within the FMU: the same bytes for the same model; none without contacts and friction.

    `{"format": 1, "contacts": [name, ...], "events": [{"guard": 0, "subject": 0, "name": "face.gap"}, ...],
    "impact_law": "newton", "energy_guard": true, "switches": [parameter, ...], "choices": {"10": 0, ...}, "variants":
    [...]}`: a key of the choices has a 1 for each switch that is true or not zero, its value is the place of the
    variant, whose keys are as in `mechanism_fmu.statechart.Logic`; law and guard are as of `Mechanism`.
    """
    mechanism = model.mechanism(model.values())
    if not mechanism.contacts and not mechanism.rubs_or_may:
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
        "impact_law": mechanism.impact_law,
        "energy_guard": bool(mechanism.energy_guard),
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


# terminalsAndIcons.xml: which variables of an FMU make up a shaft, so that a tool can connect all of it at once.
#
# FMI 3.0.2, section 2.4.9; FMI 2.0.4 and later refer to that section. A terminal of kind `SHAFT` has three members:
# angle [rad] and speed [rad/s], which are equal on both sides of a connection, and torque [N.m], whose sum is zero
# (variableKind "inflow"): positive is what acts on this FMU, counter-clockwise. One side gives angle and speed and
# takes the torque, the other one takes angle and speed and gives the torque.

#: Path within the FMU.
TERMINALS = "terminalsAndIcons/terminalsAndIcons.xml"

#: What kind of terminal a shaft is, in the domain of this project's names.
SHAFT = "mechanism_fmu.shaft"


@dataclass(frozen=True)
class Shaft:
    """A shaft: names of the variables that are its angle, speed and torque.

    Attributes:
        name: of the terminal, unique within the FMU.
        description: one line for the user.
        angle, speed, torque: names of inputs or outputs.
    """

    name: str
    description: str
    angle: str
    speed: str
    torque: str


def shafts(mechanism: Mechanism) -> tuple[Shaft, ...]:
    """The shafts of a mechanism.

    The driven end of a `CompliantShaft` is one where angle and speed are inputs and its torque is an output; so is a
    body with a `Torque` that is an input, where the body's angle and speed are outputs.
    """
    return (*_driven_ends(mechanism), *_bodies(mechanism))


def terminals(model: Model, fmi: int = 2) -> dict[str, bytes]:
    """The file by its path within the FMU, the same bytes for the same ports; none when the model has no shaft.

    Args:
        model: it.
        fmi: major version of the FMU, which FMI Library 3 wants in the file, too; all else is by the schema of FMI 3.0.
    """
    found = shafts(model.mechanism(model.values()))
    if not found:
        return {}
    root = Element("fmiTerminalsAndIcons", fmiVersion=f"{fmi}.0")
    graphics = SubElement(root, "GraphicalRepresentation")
    square = {"x1": "-100", "y1": "-100", "x2": "100", "y2": "100"}
    SubElement(graphics, "CoordinateSystem", {**square, "suggestedScalingFactorTo_mm": "0.1"})
    SubElement(graphics, "Icon", square)
    group = SubElement(root, "Terminals")
    for shaft in found:
        attributes = {"name": shaft.name, "matchingRule": "plug", "terminalKind": SHAFT}
        terminal = SubElement(group, "Terminal", attributes, description=shaft.description)
        members = (
            ("angle", shaft.angle, "signal"),
            ("speed", shaft.speed, "signal"),
            ("torque", shaft.torque, "inflow"),
        )
        for member, variable, kind in members:
            SubElement(terminal, "TerminalMemberVariable", variableName=variable, memberName=member, variableKind=kind)
    return {TERMINALS: to_bytes(root)}


def _inputs(mechanism: Mechanism) -> dict[str, str]:
    """Names of inputs by what they feed; not of those that are given otherwise, as in baked machines: no plug fits."""
    return {p.target: p.name for p in mechanism.inputs if (p.factor, p.offset) == (1.0, 0.0)}


def _driven_ends(mechanism: Mechanism) -> Iterator[Shaft]:
    by_target = _inputs(mechanism)
    by_source = {port.source: port.name for port in mechanism.outputs}
    for force in mechanism.forces:
        if not isinstance(force, CompliantShaft) or force.reaction != GROUND:
            continue
        angle, speed = by_target.get(f"{force.name}.angle"), by_target.get(f"{force.name}.speed")
        torque = by_source.get(f"{force.name}.torque")
        if angle and speed and torque:
            name = angle.removesuffix("_angle")
            yield Shaft(f"{name}_shaft", f"Driven end of the shaft to the {force.body}", angle, speed, torque)


def _bodies(mechanism: Mechanism) -> Iterator[Shaft]:
    by_target = _inputs(mechanism)
    by_source = {port.source: port.name for port in mechanism.outputs}
    taken = {shaft.name for shaft in _driven_ends(mechanism)}
    for force in mechanism.forces:
        if not isinstance(force, Torque) or force.reaction != GROUND:
            continue
        torque = by_target.get(f"{force.name}.torque")
        angle, speed = by_source.get(f"{force.body}.angle"), by_source.get(f"{force.body}.speed")
        if angle and speed and torque:
            name = next(n for n in _names(force) if n not in taken)
            taken.add(name)
            yield Shaft(name, f"Shaft of the {force.body}, which {torque} turns", angle, speed, torque)


def _names(torque: Torque) -> Iterator[str]:
    """What the shaft of a body may be called; several torques on one body are several shafts."""
    yield f"{torque.body}_shaft"
    yield f"{torque.body}_{torque.name}_shaft"
    number = 2
    while True:
        yield f"{torque.body}_{torque.name}_shaft_{number}"
        number += 1


# The analyses that travel in an FMU, for tools that say what a run means: `resources/analysis.json`.

#: Path within the FMU.
ANALYSIS = "resources/analysis.json"


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
