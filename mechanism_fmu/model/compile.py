"""Compilation of a mechanism to the tables of numbers that the engine reads."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from itertools import chain, count
from typing import Any

import numpy as np

from .. import codes, tables
from ..tables.declare import Field, Table
from ..tables.kinds import CHOICES
from .beams import beam_data, beam_members, hinge
from .body import GROUND
from .checks.check import check
from .curves import Curve
from .elimination import elimination_order
from .functions import is_plain, sqrt
from .logic import resolve_function, switch
from .mechanism import Mechanism, curve_owners
from .outline_contacts import numbered_outlines
from .outlines.features import around
from .sources import kept, output_factor, reads_members, resolve_output
from .structure import Structure, member_data, structure

# Names of the engine's unknowns for messages: which part limits the steps.


_IMPACT_LAWS = {"newton": codes.NEWTON, "poisson": codes.POISSON, "stronge": codes.STRONGE}


def unknown_names(mechanism: Mechanism) -> tuple[str, ...]:
    """What the user knows each unknown as, in the order of the engine: positions, rates, work, loss ...

    A body is named with the force elements and contacts that act on it.
    """
    names = [
        f"the {what} of {body.name}{_acting_on(mechanism, body.name)}"
        for what in ("position", "speed")
        for body in mechanism.bodies
        for _ in range(3)
    ]
    names += ["the work done", "the energy lost"]
    names += [f"the contact point of {contact.name}" for contact in mechanism.contacts for _ in range(contact.alphas)]
    names += [f"the state of {force.name}" for force in mechanism.elements for _ in range(force.own)]
    names += [f"the sliding work of {contact.name}" for contact in mechanism.contacts if contact.wears]
    return tuple(names)


def _acting_on(mechanism: Mechanism, body: str) -> str:
    acting = [force for force in mechanism.elements if force.acts != "nowhere"]
    forces = [force.name for force in acting if body in (force.body, force.reaction)]
    contacts = [c.name for c in mechanism.contacts if body in (c.body_i, c.body_j)]
    return f" ({', '.join((*forces, *contacts))} act on it)" if forces or contacts else ""


#: A one- or two-dimensional table of numbers; of dtype object when the numbers are symbolic.
Array = np.ndarray[Any, np.dtype[Any]]


@dataclass(frozen=True)
class MechanismTables:
    """A mechanism as arrays, in the order of its parts; body number `bodies` (one past the last) is the ground.

    Each column of the tables in `mechanism_fmu.tables` is an attribute, by the name of its field, e.g. `joint_kind`.
    Integer columns hold structure and never depend on parameter values; the others hold numbers (SI units). Those of
    `members` are empty when no output reads elastic members.

    Attributes:
        columns: arrays by name of the field, whose shape is in `mechanism_fmu.tables`.
        numbers: `joint_rows`, the number of rows of all joints; `contact_rows`, that of all contacts when contact
            coordinates count as coordinates; `alphas`, the number of these; `own`, of states of force elements' own;
            `wears`, of contacts that wear; `buffer` and `event_buffer`, of impacts and events of a communication step
            that are kept.
    """

    columns: Mapping[str, Array]
    numbers: Mapping[str, int]

    def __getattr__(self, name: str) -> Any:
        """A column or number.

        Raises:
            AttributeError: there is none of that name.
        """
        for found in (self.__dict__.get("columns", {}), self.__dict__.get("numbers", {})):
            if name in found:
                return found[name]
        raise AttributeError(f"there is no table {name!r}")


def compile_mechanism(mechanism: Mechanism) -> MechanismTables:
    """Check a mechanism whose values are plain numbers, and write it as tables.

    Args:
        mechanism: whose values are plain numbers.

    Raises:
        MechanismError: a part cannot be right; the message names it and the way out.
    """
    check(mechanism)
    return compile_tables(mechanism)


def compile_tables(mechanism: Mechanism) -> MechanismTables:
    """Write a mechanism as tables, unchecked: what cannot be right is refused by `check`. Numbers may be symbolic."""
    bodies = {body.name: i for i, body in enumerate(mechanism.bodies)} | {GROUND: len(mechanism.bodies)}
    forces = {force.name: i for i, force in enumerate(mechanism.elements)}
    contacts = mechanism.contacts
    patterns = {pattern.name: i for i, pattern in enumerate(mechanism.patterns)}
    functions = {function.name: i for i, function in enumerate(mechanism.functions)}
    contact_numbers = {contact.name: i for i, contact in enumerate(contacts)}
    watched = [resolve_function(function, contact_numbers, bodies) for function in mechanism.functions]
    switches = [switch(contact.closed_while) for contact in contacts]
    masses = [m for body in mechanism.bodies for m in (body.mass, body.mass, body.inertia)]
    first_rows = np.cumsum([0, *(joint.rows for joint in mechanism.joints)])
    first_contact_rows = np.cumsum([0, *(contact.rows for contact in contacts)])
    first_alphas = np.cumsum([0, *(contact.alphas for contact in contacts)])
    wear = count()
    first_own = np.cumsum([0, *(force.own for force in mechanism.elements)])
    curves = [curve for _, curve in curve_owners(mechanism)]
    laws = [force.operations() for force in mechanism.elements]
    law_ends = np.cumsum([0, *map(len, laws)])
    thresholds = [force.thresholds() for force in mechanism.elements]
    first_thresholds = np.cumsum([0, *map(len, thresholds)]).tolist()
    by_table = [isinstance(force.law, Curve) for force in mechanism.elements]
    energies = count(len(curves) - sum(by_table))  # they are the last curves
    energy_of = [next(energies) if has_table else codes.NONE for has_table in by_table]
    first_pieces = np.cumsum([0, *(len(curve.pieces) for curve in curves)])
    pieces = [piece for curve in curves for piece in curve.pieces]
    first_terms = np.cumsum([0, *(len(piece.terms) for piece in pieces)])
    targets = [i.target.split(".") for i in mechanism.inputs]
    constants = [(codes.CONSTANT, 0, 0)] * len(mechanism.calculated)
    outputs = [*(resolve_output(o.source, mechanism) for o in mechanism.outputs), *constants]
    factors = [output_factor(o.source, mechanism) for o in mechanism.outputs] + [c.value for c in mechanism.calculated]
    elastic = structure(mechanism) if reads_members(mechanism) else Structure()
    hanging = beam_members(mechanism)
    outlines = numbered_outlines(contacts)

    def columns(table: type[Table], parts: Sequence[Any] = (), **given: Sequence[Any]) -> Iterator[tuple[str, Array]]:
        """The columns of a table: those given, and else what the parts have by that name."""
        for column, field in table.fields.items():
            if field.section == "tables":
                values = given[column] if column in given else [_entry(part, column, bodies) for part in parts]
                yield field.name, _array(values, field)

    return MechanismTables(
        dict(
            chain(
                columns(
                    tables.Bodies,
                    mechanism.bodies,
                    inverse_mass=[*(1 / m for m in masses), 0.0, 0.0, 0.0],
                    inverse_root_mass=[*(1 / sqrt(m) for m in masses), 0.0, 0.0, 0.0],
                    rank=elimination_order(
                        [bodies[body.name] for body in mechanism.bodies],
                        [(bodies[p.body_i], bodies[p.body_j]) for p in (*mechanism.joints, *contacts)],
                    ),
                    tooth_length=[0.0 if b.tooth_length is None else b.tooth_length for b in mechanism.bodies],
                ),
                columns(
                    tables.Joints,
                    mechanism.joints,
                    row=first_rows[:-1].tolist(),
                    curve=[_number_of(joint.motion, curves) for joint in mechanism.joints],
                ),
                columns(
                    tables.Forces,
                    mechanism.elements,
                    own=[n if f.own else codes.NONE for f, n in _pairs(mechanism.elements, first_own)],
                    law=law_ends[:-1].tolist(),
                    law_end=law_ends[1:].tolist(),
                    curve=energy_of,
                    threshold=[n if own else codes.NONE for own, n in _pairs(thresholds, first_thresholds)],
                ),
                columns(
                    tables.Operations,
                    kind=[operation.code for law in laws for operation in law],
                    operands=[
                        [first + operand for operand in operation.operands]
                        for law, first in _pairs(laws, law_ends.tolist())
                        for operation in law
                    ],
                    value=[operation.value for law in laws for operation in law],
                    threshold=[
                        first + own.index((codes.THRESHOLD_CONDITION, k)) if operation.code in CHOICES else codes.NONE
                        for law, own, first in zip(laws, thresholds, first_thresholds[:-1], strict=True)
                        for k, operation in enumerate(law)
                    ],
                ),
                columns(
                    tables.Thresholds,
                    kind=[kind for own in thresholds for kind, _ in own],
                    force=[k for k, own in enumerate(thresholds) for _ in own],
                    subject=[
                        number + (int(first_pieces[curve]) if curve != codes.NONE else first)
                        for own, first, curve in zip(thresholds, law_ends.tolist()[:-1], energy_of, strict=True)
                        for _, number in own
                    ],
                ),
                columns(
                    tables.Contacts,
                    contacts,
                    pattern=[codes.NONE if c.pattern is None else patterns[c.pattern] for c in contacts],
                    function=[codes.NONE if f is None else functions[f] for f, _ in switches],
                    closes_when=[int(value) for _, value in switches],
                    row_first=first_contact_rows[:-1].tolist(),
                    alpha=[first if c.alphas else codes.NONE for c, first in _pairs(contacts, first_alphas)],
                    curve_i=[_number_of(c.profiles[0], curves) for c in contacts],
                    curve_j=[_number_of(c.profiles[1], curves) for c in contacts],
                    outline_i=[first for first, _ in outlines.numbers],
                    outline_j=[second for _, second in outlines.numbers],
                    group=[k - getattr(c, "place", 0) for k, c in enumerate(contacts)],
                    wear=[next(wear) if c.wears else codes.NONE for c in contacts],
                    value=[(c.restitution, c.friction, c.guided, c.enabled, c.closed, c.holding) for c in contacts],
                ),
                columns(
                    tables.Features,
                    kind=[kind for chain_ in outlines.features for kind, _ in chain_],
                    data=[data for chain_ in outlines.features for _, data in chain_],
                ),
                columns(
                    tables.Outlines,
                    first=np.cumsum([0, *map(len, outlines.features)])[:-1].tolist(),
                    count=[len(chain_) for chain_ in outlines.features],
                    closed=[outline.closed + outline.hole for outline, _ in outlines.all],
                    copies=[0 if copies is None else copies.count for _, copies in outlines.all],
                    data=[(*around(o), *((0.0, 0.0, 0.0) if c is None else c.data())) for o, c in outlines.all],
                ),
                columns(tables.Patterns, mechanism.patterns),
                columns(
                    tables.Functions,
                    kind=[kind for kind, _ in watched],
                    subject=[index for _, index in watched],
                    limit=[function.below for function in mechanism.functions],
                ),
                columns(
                    tables.Curves,
                    piece=first_pieces[:-1].tolist(),
                    pieces=[len(curve.pieces) for curve in curves],
                    periodic=[int(curve.periodic) for curve in curves],
                    range=[(curve.start, curve.span) for curve in curves],
                    piece_term=first_terms[:-1].tolist(),
                    piece_terms=[len(piece.terms) for piece in pieces],
                    piece_start=[piece.start for piece in pieces],
                    term_data=[term.data() for piece in pieces for term in piece.terms],
                ),
                columns(
                    tables.Ports,
                    input_force=[forces[force] for force, _ in targets],
                    input_column=[mechanism.elements[forces[force]].columns[entry] for force, entry in targets],
                    input_start=[i.start for i in mechanism.inputs],
                    input_factor=[i.factor for i in mechanism.inputs],
                    input_offset=[i.offset for i in mechanism.inputs],
                    output_kind=[kind for kind, _, _ in outputs],
                    output_index=[index for _, index, _ in outputs],
                    output_slot=[slot for _, _, slot in outputs],
                    output_value=factors,
                ),
                columns(
                    tables.Options,
                    settings=[
                        *(getattr(mechanism.settings, setting.name) for setting in fields(mechanism.settings)),
                        _IMPACT_LAWS[mechanism.impact_law],
                        mechanism.energy_guard,
                        mechanism.tangential_shock,
                        mechanism.through_singularities,
                    ],
                    held=[coordinate_index(h, mechanism) for h in mechanism.held],
                ),
                columns(
                    tables.Members,
                    start=[start for start, _ in elastic.ends],
                    end=[end for _, end in elastic.ends],
                    data=[member_data(member) for member, _ in _pairs(mechanism.members, elastic.ends)],
                ),
                columns(
                    tables.Nodes,
                    body=[bodies[body] for body, _ in elastic.nodes],
                    point=[point for _, point in elastic.nodes],
                ),
                columns(tables.Ties, joint=[joint for joint, _ in elastic.ties], node=[n for _, n in elastic.ties]),
                columns(
                    tables.Lumps, node=[lump[0] for lump in elastic.lumps], data=[lump[1:] for lump in elastic.lumps]
                ),
                columns(
                    tables.Couples,
                    force=[force for force, _, _ in elastic.couples],
                    node=[node for _, node, _ in elastic.couples],
                    sign=[sign for _, _, sign in elastic.couples],
                ),
                columns(
                    tables.Beams,
                    body=[bodies[member.body] for member in hanging],
                    row=[hinge(member, mechanism)[0] for member in hanging],
                    data=[beam_data(member, mechanism) for member in hanging],
                ),
                columns(tables.Structure, locked=elastic.locked),
            )
        ),
        {
            "rubs": len(mechanism.rubbing),
            "joint_rows": int(first_rows[-1]),
            "contact_rows": int(first_contact_rows[-1]),
            "alphas": int(first_alphas[-1]),
            "own": int(first_own[-1]),
            "oscillations": len(mechanism.oscillations),
            "wears": sum(c.wears for c in contacts),
            "buffer": kept("impacts", mechanism, codes.IMPACT_BUFFER_LENGTH),
            "event_buffer": kept("events", mechanism, codes.EVENT_BUFFER_LENGTH),
        },
    )


def _pairs(left: Sequence[Any], right: Any) -> Iterator[tuple[Any, Any]]:
    """As far as the shorter one goes."""
    return zip(left, right, strict=False)


def _entry(part: Any, column: str, bodies: Mapping[str, int]) -> Any:
    """What a part has by a column's name: a body is its number, a row of numbers may be a method."""
    value = getattr(part, column)
    return bodies[value] if isinstance(value, str) else value() if callable(value) else value


def _number_of(curve: Curve | None, curves: list[Curve]) -> int:
    """The place of a curve itself (not of one with the same numbers), or `codes.NONE`."""
    return next((k for k, other in enumerate(curves) if other is curve), codes.NONE)


def coordinate_index(name: str, mechanism: Mechanism) -> int:
    """Index in q of a coordinate given as "<body>.x|y|angle"."""
    body, _, coordinate = name.rpartition(".")
    return 3 * [b.name for b in mechanism.bodies].index(body) + ("x", "y", "angle").index(coordinate)


def _array(values: Sequence[Any], field: Field) -> Array:
    """A column; shorter rows than its own are filled up with zeros. Symbolic numbers make it one of objects."""
    widths = [int(width) for width in field.shape[1:]]
    flat = [n for row in values for n in (*row, *[0.0] * (widths[0] - len(row)))] if widths else list(values)
    kind = np.int64 if field.integer else np.float64
    return np.array(flat, dtype=kind if all(map(is_plain, flat)) else object).reshape(len(values), *widths)
