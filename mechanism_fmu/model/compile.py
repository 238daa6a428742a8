"""From parts to tables: the one thing that the engine reads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import codes
from .beams import beam_data, beam_members, hinge
from .body import GROUND
from .check import check
from .curves import Curve
from .forces import own_states
from .functions import Number, is_plain, sqrt
from .logic import resolve_function, switch
from .mechanism import Mechanism, curve_owners
from .sources import output_factor, reads_members, resolve_output
from .structure import Structure, member_data, structure

#: Widths of `joint_data`, of `force_data`, and of `contact_data` and `pattern_data`: the longest row of any kind.
JOINT_COLUMNS = 9
FORCE_COLUMNS = 8
CONTACT_COLUMNS = 6

#: A one- or two-dimensional table of numbers; of dtype object when the numbers are symbolic.
Table = np.ndarray[Any, np.dtype[Any]]


@dataclass(frozen=True)
class MechanismTables:
    """A mechanism as arrays, in the order of its parts; body number `bodies` (one past the last) is the ground.

    Integer tables hold structure and never depend on parameter values; the others hold numbers (SI units).
    `joint_rows` is the number of rows of all joints, `contact_rows` that of all contacts when contact coordinates
    count as coordinates, `alphas` the number of these, `own` that of states of force elements' own.
    `node_body` to `locked` are those of `structure.Structure`, and of `beam_body` to
    `beam_data` those of `beams`; empty when no output reads elastic members.
    `inverse_mass` and `inverse_root_mass` have 3 entries a body and 3 zeros for the ground.
    """

    inverse_mass: Table
    inverse_root_mass: Table
    body_start: Table
    body_start_rate: Table
    body_tooth_length: Table
    joint_kind: Table
    joint_body_i: Table
    joint_body_j: Table
    joint_row: Table
    joint_rows: int
    joint_data: Table
    joint_friction: Table
    joint_curve: Table
    force_kind: Table
    force_body: Table
    force_reaction: Table
    force_own: Table
    force_data: Table
    contact_kind: Table
    contact_body_i: Table
    contact_body_j: Table
    contact_pattern: Table
    contact_function: Table
    contact_closes_when: Table
    contact_data: Table
    contact_row_first: Table
    contact_rows: int
    own: int
    contact_alpha: Table
    alphas: int
    contact_curve_i: Table
    contact_curve_j: Table
    contact_value: Table
    pattern_body_i: Table
    pattern_body_j: Table
    pattern_data: Table
    pattern_pitch: Table
    pattern_enabled: Table
    function_kind: Table
    function_subject: Table
    function_limit: Table
    curve_piece: Table
    curve_pieces: Table
    curve_periodic: Table
    curve_range: Table
    piece_term: Table
    piece_terms: Table
    piece_start: Table
    term_data: Table
    held: Table
    input_force: Table
    input_column: Table
    input_start: Table
    input_factor: Table
    input_offset: Table
    output_kind: Table
    output_index: Table
    output_slot: Table
    output_value: Table
    settings: Table
    node_body: Table
    node_point: Table
    member_start: Table
    member_end: Table
    member_data: Table
    tie_joint: Table
    tie_node: Table
    lump_node: Table
    lump_data: Table
    couple_force: Table
    couple_node: Table
    couple_sign: Table
    locked: Table
    beam_body: Table
    beam_row: Table
    beam_data: Table


def compile_mechanism(mechanism: Mechanism) -> MechanismTables:
    """Check a mechanism whose values are plain numbers, and write it as tables.

    Raises:
        MechanismError: a part cannot be right; the message names it and the way out.
    """
    check(mechanism)
    return compile_tables(mechanism)


def compile_tables(mechanism: Mechanism) -> MechanismTables:
    """Write a mechanism as tables, unchecked: what cannot be right is refused by `check`. Numbers may be symbolic."""
    bodies = {body.name: i for i, body in enumerate(mechanism.bodies)} | {GROUND: len(mechanism.bodies)}
    forces = {force.name: i for i, force in enumerate(mechanism.forces)}
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
    first_own = np.cumsum([0, *(own_states(force) for force in mechanism.forces)])
    curves = [curve for _, curve in curve_owners(mechanism)]
    first_pieces = np.cumsum([0, *(len(curve.pieces) for curve in curves)])
    pieces = [piece for curve in curves for piece in curve.pieces]
    first_terms = np.cumsum([0, *(len(piece.terms) for piece in pieces)])
    targets = [i.target.split(".") for i in mechanism.inputs]
    outputs = [resolve_output(o.source, mechanism) for o in mechanism.outputs]
    elastic = structure(mechanism) if reads_members(mechanism) else Structure()
    hanging = beam_members(mechanism)
    constants = [(codes.CONSTANT, 0, 0)] * len(mechanism.calculated)
    return MechanismTables(
        inverse_mass=_numbers([*(1 / m for m in masses), 0.0, 0.0, 0.0]),
        inverse_root_mass=_numbers([*(1 / sqrt(m) for m in masses), 0.0, 0.0, 0.0]),
        body_start=_rows([b.start for b in mechanism.bodies], 3),
        body_start_rate=_rows([b.start_rate for b in mechanism.bodies], 3),
        body_tooth_length=_numbers([0.0 if b.tooth_length is None else b.tooth_length for b in mechanism.bodies]),
        joint_kind=_integers([j.kind for j in mechanism.joints]),
        joint_body_i=_integers([bodies[j.body_i] for j in mechanism.joints]),
        joint_body_j=_integers([bodies[j.body_j] for j in mechanism.joints]),
        joint_row=_integers(list(first_rows[:-1])),
        joint_rows=int(first_rows[-1]),
        joint_data=_rows([j.data() for j in mechanism.joints], JOINT_COLUMNS),
        joint_friction=_numbers([j.friction for j in mechanism.joints]),
        joint_curve=_integers([_number_of(joint.motion, curves) for joint in mechanism.joints]),
        force_kind=_integers([f.kind for f in mechanism.forces]),
        force_body=_integers([bodies[f.body] for f in mechanism.forces]),
        force_reaction=_integers([bodies[f.reaction] for f in mechanism.forces]),
        force_own=_integers(
            [first if own_states(f) else codes.NONE for f, first in zip(mechanism.forces, first_own, strict=False)]
        ),
        own=int(first_own[-1]),
        force_data=_rows([f.data() for f in mechanism.forces], FORCE_COLUMNS),
        contact_kind=_integers([c.kind for c in contacts]),
        contact_body_i=_integers([bodies[c.body_i] for c in contacts]),
        contact_body_j=_integers([bodies[c.body_j] for c in contacts]),
        contact_pattern=_integers([codes.NONE if c.pattern is None else patterns[c.pattern] for c in contacts]),
        contact_function=_integers([codes.NONE if f is None else functions[f] for f, _ in switches]),
        contact_closes_when=_integers([int(value) for _, value in switches]),
        contact_data=_rows([c.data() for c in contacts], CONTACT_COLUMNS),
        contact_row_first=_integers(list(first_contact_rows[:-1])),
        contact_rows=int(first_contact_rows[-1]),
        contact_alpha=_integers(
            [first if c.alphas else codes.NONE for c, first in zip(contacts, first_alphas, strict=False)]
        ),
        alphas=int(first_alphas[-1]),
        contact_curve_i=_integers([_number_of(c.profiles[0], curves) for c in contacts]),
        contact_curve_j=_integers([_number_of(c.profiles[1], curves) for c in contacts]),
        contact_value=_rows(
            [(c.restitution, c.friction, c.guided, c.enabled, c.closed) for c in contacts],
            codes.CONTACT_VALUES,
        ),
        pattern_body_i=_integers([bodies[p.body_i] for p in mechanism.patterns]),
        pattern_body_j=_integers([bodies[p.body_j] for p in mechanism.patterns]),
        pattern_data=_rows([p.data() for p in mechanism.patterns], CONTACT_COLUMNS),
        pattern_pitch=_numbers([p.pitch for p in mechanism.patterns]),
        pattern_enabled=_numbers([p.enabled for p in mechanism.patterns]),
        function_kind=_integers([kind for kind, _ in watched]),
        function_subject=_integers([index for _, index in watched]),
        function_limit=_numbers([function.below for function in mechanism.functions]),
        curve_piece=_integers(list(first_pieces[:-1])),
        curve_pieces=_integers([len(curve.pieces) for curve in curves]),
        curve_periodic=_integers([int(curve.periodic) for curve in curves]),
        curve_range=_rows([(curve.start, curve.span) for curve in curves], 2),
        piece_term=_integers(list(first_terms[:-1])),
        piece_terms=_integers([len(piece.terms) for piece in pieces]),
        piece_start=_numbers([piece.start for piece in pieces]),
        term_data=_rows([term.data() for piece in pieces for term in piece.terms], codes.TERM_COLUMNS),
        held=_integers([coordinate_index(h, mechanism) for h in mechanism.held]),
        input_force=_integers([forces[force] for force, _ in targets]),
        input_column=_integers([mechanism.forces[forces[force]].columns[entry] for force, entry in targets]),
        input_start=_numbers([i.start for i in mechanism.inputs]),
        input_factor=_numbers([i.factor for i in mechanism.inputs]),
        input_offset=_numbers([i.offset for i in mechanism.inputs]),
        output_kind=_integers([kind for kind, _, _ in outputs + constants]),
        output_index=_integers([index for _, index, _ in outputs + constants]),
        output_slot=_integers([slot for _, _, slot in outputs + constants]),
        output_value=_numbers(
            [output_factor(o.source, mechanism) for o in mechanism.outputs] + [c.value for c in mechanism.calculated]
        ),
        settings=_numbers(
            [
                mechanism.settings.relative_tolerance,
                mechanism.settings.baumgarte_alpha,
                mechanism.settings.baumgarte_beta,
                mechanism.settings.max_internal_steps,
            ]
        ),
        node_body=_integers([bodies[body] for body, _ in elastic.nodes]),
        node_point=_rows([point for _, point in elastic.nodes], 2),
        member_start=_integers([start for start, _ in elastic.ends]),
        member_end=_integers([end for _, end in elastic.ends]),
        member_data=_rows(
            [member_data(member) for member, _ in zip(mechanism.members, elastic.ends, strict=False)],
            codes.MEMBER_COLUMNS,
        ),
        tie_joint=_integers([joint for joint, _ in elastic.ties]),
        tie_node=_integers([node for _, node in elastic.ties]),
        lump_node=_integers([lump[0] for lump in elastic.lumps]),
        lump_data=_rows([lump[1:] for lump in elastic.lumps], codes.LUMP_COLUMNS),
        couple_force=_integers([force for force, _, _ in elastic.couples]),
        couple_node=_integers([node for _, node, _ in elastic.couples]),
        couple_sign=_integers([sign for _, _, sign in elastic.couples]),
        locked=_integers(elastic.locked),
        beam_body=_integers([bodies[member.body] for member in hanging]),
        beam_row=_integers([hinge(member, mechanism)[0] for member in hanging]),
        beam_data=_rows([beam_data(member, mechanism) for member in hanging], codes.BEAM_COLUMNS),
    )


def _number_of(curve: Curve | None, curves: list[Curve]) -> int:
    """The place of a curve itself (not of one with the same numbers), or `codes.NONE`."""
    return next((k for k, other in enumerate(curves) if other is curve), codes.NONE)


def coordinate_index(name: str, mechanism: Mechanism) -> int:
    """Index in q of a coordinate given as "<body>.x|y|angle"."""
    body, _, coordinate = name.rpartition(".")
    return 3 * [b.name for b in mechanism.bodies].index(body) + ("x", "y", "angle").index(coordinate)


def _integers(values: Sequence[int]) -> Table:
    return np.array(values, dtype=object if _symbolic(values) else np.int64)


def _numbers(values: Sequence[Number]) -> Table:
    return np.array(values, dtype=object if _symbolic(values) else np.float64)


def _symbolic(values: Sequence[Number]) -> bool:
    return not all(map(is_plain, values))


def _rows(rows: Sequence[Sequence[Number]], columns: int) -> Table:
    flat = [v for row in rows for v in (*row, *[0.0] * (columns - len(row)))]
    return _numbers(flat).reshape(len(rows), columns)
