"""From a mechanism's tables to an instance's block."""

from __future__ import annotations

from typing import Any

from .layout import FIELDS, Array, allocate, field_of


def pack(tables: Any) -> Array:
    """A block for the tables of a mechanism (any object with the table fields of `layout` as attributes).

    Returns:
        float64 of shape (words,), with inputs at their start values and no motion begun.

    """
    block = allocate(
        {
            "bodies": len(tables.body_start),
            "joints": len(tables.joint_kind),
            "forces": len(tables.force_kind),
            "contacts": len(tables.contact_body_i),
            "patterns": len(tables.pattern_pitch),
            "functions": len(tables.function_kind),
            "curves": len(tables.curve_piece),
            "pieces": len(tables.piece_term),
            "terms": len(tables.term_data),
            "alphas": tables.alphas,
            "own": tables.own,
            "held": len(tables.held),
            "inputs": len(tables.input_force),
            "outputs": len(tables.output_kind),
            "members": len(tables.member_start),
            "nodes": len(tables.node_body),
            "ties": len(tables.tie_joint),
            "lumps": len(tables.lump_node),
            "couples": len(tables.couple_force),
            "locked": len(tables.locked),
            "beams": len(tables.beam_body),
            "joint_rows": tables.joint_rows,
            "contact_rows": tables.contact_rows,
        }
    )
    write_tables(block, tables)
    field_of(block, "inputs")[:] = tables.input_start
    return block


def write_tables(block: Array, tables: Any) -> None:
    """Write tables of the same structure into a block, leaving its state as it is."""
    for field in FIELDS:
        if field.room == "tables":
            field_of(block, field.name)[...] = getattr(tables, field.name)
