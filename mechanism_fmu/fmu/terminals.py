"""terminalsAndIcons.xml: which variables of an FMU make up a shaft, so that a tool can connect all of it at once.

FMI 3.0.2, section 2.4.9; FMI 2.0.4 and later refer to that section. A terminal of kind `SHAFT` has three members: angle
[rad] and speed [rad/s], which are equal on both sides of a connection, and torque [N.m], whose sum is zero
(variableKind "inflow"): positive is what acts on this FMU, counter-clockwise. One side gives angle and speed and takes
the torque, the other one takes angle and speed and gives the torque.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from xml.etree.ElementTree import Element, SubElement

from ..model import GROUND, CompliantShaft, Mechanism, Model, Torque
from .model_description import to_bytes

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
