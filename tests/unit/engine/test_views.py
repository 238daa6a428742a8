"""Compiled views look at the same words, with the same shape and type, as Python's."""

import numpy as np
import pytest

from mechanism_fmu.engine.compiler.subset import entry
from mechanism_fmu.tables.layout import FIELDS, TABLES, allocate, field_of
from mechanism_fmu.tables.sizes import GIVEN_SIZES, SIZES, Sizes

BLOCK = allocate({name: size for size, name in enumerate(GIVEN_SIZES, 2)})
NAMED = {table.__name__: table for table in TABLES}


def compiled(lines):
    """A compiled function of (block, found) with these lines: attributes must be literal to be compiled."""
    source = "\n    ".join(["def read(block, found):", *lines])
    namespace = {**NAMED, "Sizes": Sizes}
    exec(source, namespace)
    return entry(namespace["read"])


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in ("Contacts", "Course") else pytest.mark.slow) for name in NAMED]
)
def test_compiled_entries_are_pythons(name):
    columns = {column: getattr(NAMED[name](BLOCK), column) for column in NAMED[name].fields}
    lines = [f"view = {name}(block)"]
    for k, (attribute, array) in enumerate(columns.items()):
        lines += [f"found[{k}, 0] = view.{attribute}.ctypes.data"]
        lines += [f"found[{k}, {1 + axis}] = view.{attribute}.shape[{axis}]" for axis in range(array.ndim)]
        lines += [f"found[{k}, {3 + axis}] = view.{attribute}.strides[{axis}]" for axis in range(array.ndim)]
        lines += [f"view.{attribute}[{', '.join(['0'] * array.ndim)}] = 2.5"]
    found = np.zeros((len(columns), 5), dtype=np.int64)
    compiled(lines)(BLOCK, found)
    for array, row in zip(columns.values(), found.tolist(), strict=True):
        unused = [0] * (2 - array.ndim)
        assert row == [array.ctypes.data, *array.shape, *unused, *array.strides, *unused]
        assert array.flat[0] == (2 if array.dtype == np.int64 else 2.5)  # a half survives in a float only


def test_compiled_sizes_are_pythons():
    compiled(["view = Sizes(block)", *(f"found[{k}] = view.{name}" for k, name in enumerate(SIZES))])(
        BLOCK, found := np.zeros(len(SIZES), dtype=np.int64)
    )
    assert [getattr(Sizes(BLOCK), name) for name in SIZES] == found.tolist()


def test_every_field_is_seen_by_one_view_only():
    seen = [getattr(table(BLOCK), column).ctypes.data for table in NAMED.values() for column in table.fields]
    assert sorted(seen) == sorted(field_of(BLOCK, field.name).ctypes.data for field in FIELDS)
