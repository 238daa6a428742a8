"""Which words of a block depend on parameters, and what they are called."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from ...model import GROUND, Mechanism, MechanismError, Settings
from ...model.beams import beam_members
from ...model.mechanism import curve_owners
from ...model.sources import reads_members
from ...model.structure import Structure, structure
from ...model.symbol import Symbol
from ...model.trace import Trace
from ...tables.declare import Array
from ...tables.layout import FIELDS, field_of, slot


@dataclass(frozen=True)
class Entry:
    """A word of a block's tables that depends on a parameter.

    Attributes:
        word: its index in the block.
        label: for the user, its table and part, e.g. "inverse_mass of crank"; the name alone of a setting.
        value: what stands in the table.
    """

    word: int
    label: str
    value: Symbol


def entries(traced: Trace, block: Array) -> list[Entry]:
    """The words of a block that depend on a parameter, in the order of the block.

    Raises:
        MechanismError: the block is not one of the traced model.
    """
    found = []
    for field in FIELDS:
        if field.room != "tables":
            continue
        table = np.asarray(getattr(traced.tables, field.name))
        if table.shape != field_of(block, field.name).shape:
            raise MechanismError(
                f"The block is not one of {traced.model.name}: its table {field.name} has another size."
            )
        first = int(block.view(np.int64)[slot(field.name)])
        labels = _labels(field.name, traced.mechanism)
        for i, value in enumerate(table.flat):
            if isinstance(value, Symbol):
                found.append(Entry(first + i, labels[i * len(labels) // table.size], value))
    return found


def _labels(table: str, mechanism: Mechanism) -> list[str]:
    """One label a part: each has an equal share of the table."""
    if table == "settings":
        return [setting.name for setting in fields(Settings)]
    bodies = [body.name for body in mechanism.bodies]
    owners = curve_owners(mechanism)
    elastic = structure(mechanism) if reads_members(mechanism) else Structure()
    parts = {
        "inverse": [*bodies, GROUND],
        "body": bodies,
        "joint": [joint.name for joint in mechanism.joints],
        "force": [force.name for force in mechanism.forces],
        "contact": [contact.name for contact in mechanism.contacts],
        "pattern": [pattern.name for pattern in mechanism.patterns],
        "function": [function.name for function in mechanism.functions],
        "curve": [name for name, _ in owners],
        "piece": [name for name, curve in owners for _ in curve.pieces],
        "term": [name for name, curve in owners for piece in curve.pieces for _ in piece.terms],
        "node": [body for body, _ in elastic.nodes],
        "member": [member.name for member in mechanism.members],
        "tie": [mechanism.joints[joint].name for joint, _ in elastic.ties],
        "couple": [mechanism.forces[force].name for force, _, _ in elastic.couples],
        "lump": [elastic.nodes[lump[0]][0] for lump in elastic.lumps],
        "locked": list(mechanism.held),
        "beam": [member.name for member in beam_members(mechanism)],
        "held": list(mechanism.held),
        "input": [port.name for port in mechanism.inputs],
        "output": [*(port.name for port in mechanism.outputs), *(port.name for port in mechanism.calculated)],
    }
    return [f"{table} of {part}" for part in parts[table.partition("_")[0]]]
