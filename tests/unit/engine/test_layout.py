"""The block: every field has words of its own, and the state is one piece."""

import numpy as np
from rotor import Stop, rotor

from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.tables.layout import FIELDS, allocate, field_of, pack, state_of, write_tables
from mechanism_fmu.tables.sizes import SIZES, sizes_of

GIVEN = {
    "bodies": 2,
    "joints": 3,
    "forces": 4,
    "contacts": 5,
    "patterns": 2,
    "features": 5,
    "outlines": 2,
    "functions": 3,
    "curves": 4,
    "pieces": 6,
    "terms": 9,
    "alphas": 3,
    "own": 2,
    "oscillations": 2,
    "wears": 3,
    "operations": 3,
    "thresholds": 4,
    "held": 1,
    "inputs": 6,
    "outputs": 7,
    "members": 2,
    "nodes": 4,
    "ties": 5,
    "lumps": 3,
    "couples": 2,
    "locked": 1,
    "beams": 2,
    "rubs": 6,
    "joint_rows": 8,
    "contact_rows": 7,
    "buffer": 3,
    "event_buffer": 4,
}
HEADER = len(SIZES) + len(FIELDS)


def filled():
    """A block in which every word of every field has a number of its own: its place in the block."""
    block = allocate(GIVEN)
    for field in FIELDS:
        view = field_of(block, field.name)
        first = (view.__array_interface__["data"][0] - block.__array_interface__["data"][0]) // 8
        view[...] = np.arange(first, first + view.size).reshape(view.shape)
    return block


def test_sizes_that_follow_from_others():
    sizes = sizes_of(allocate(GIVEN))
    assert list(sizes) == list(SIZES)
    assert sizes.items() >= GIVEN.items()
    assert (sizes["coordinates"], sizes["columns"], sizes["frames"]) == (6, 9, 3)
    assert sizes["wide"] == 9 + 3  # a column for each contact coordinate
    assert sizes["rows"] == 8 + 7 + 6 + 1  # of joints, of contacts, of what sticks, a spare one
    assert sizes["unknowns"] == 2 * 6 + 2 + 3 + 2 + 3  # positions, rates, work and loss, contact coordinates, own, wear
    assert [sizes[name] for name in ("y_work", "y_loss", "y_alpha", "y_own")] == [12, 13, 14, 17]
    assert sizes["displacements"] == 3 * 4  # x, y and rotation of a node
    assert (
        sizes["guards"] == 2 * 5 + 2 * 2 + 3 + 6
    )  # gap and click of a contact, both ends of a pattern, functions, slip
    assert sizes["record"] == 8 + 5 + 12  # eight columns, an impulse a contact, all rates before and after


def test_fields_fill_the_block_behind_the_header_and_none_overlaps_another():
    block = filled()
    for field in FIELDS:
        view = field_of(block, field.name)
        assert view.dtype == (np.int64 if field.integer else np.float64)
        assert np.shares_memory(view, block)
        assert view.ravel()[0] == view.ravel()[-1] - view.size + 1  # nobody wrote here afterwards
    words = sum(field_of(block, field.name).size for field in FIELDS)
    assert block.size == HEADER + words


def test_the_header_survives_writing_all_fields():
    np.testing.assert_array_equal(filled()[:HEADER].view(np.int64), allocate(GIVEN)[:HEADER].view(np.int64))


def test_a_new_block_is_zero():
    assert not allocate(GIVEN)[HEADER:].any()


def test_the_state_is_the_state_fields_and_nothing_else():
    block = filled()
    in_state = [field_of(block, field.name).ravel() for field in FIELDS if field.section == "state"]
    np.testing.assert_array_equal(state_of(block).view(np.int64), np.concatenate([f.view(np.int64) for f in in_state]))


def test_pack_writes_every_table_where_field_of_finds_it():
    tables = compile_mechanism(rotor([Stop(1.0)], acceleration=2.0))
    block = pack(tables)
    for field in FIELDS:
        if field.section == "tables":
            np.testing.assert_array_equal(field_of(block, field.name), getattr(tables, field.name), field.name)
    np.testing.assert_array_equal(field_of(block, "inputs"), tables.input_start)


def test_new_tables_leave_the_state_as_it_is():
    block = pack(compile_mechanism(rotor([Stop(1.0)], acceleration=2.0)))
    state_of(block)[:] = 7.0
    write_tables(block, compile_mechanism(rotor([Stop(0.5)], acceleration=3.0)))
    assert (state_of(block) == 7.0).all()
    assert field_of(block, "input_start")[0] == rotor(acceleration=3.0).inputs[0].start
