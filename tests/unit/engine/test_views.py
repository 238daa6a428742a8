"""Compiled views look at the same words, with the same shape and type, as Python's."""

import numpy as np
import pytest

from mechanism_fmu.engine.block import elastic, motion, parts
from mechanism_fmu.engine.block.layout import FIELDS, GIVEN_SIZES, SIZES, allocate, field_of
from mechanism_fmu.engine.compiler.subset import entry

BLOCK = allocate({name: size for size, name in enumerate(GIVEN_SIZES, 2)})
NAMES = (
    "bodies",
    "joints",
    "forces",
    "contacts",
    "patterns",
    "functions",
    "curves",
    "strikes",
    "watch",
    "ports",
    "course",
    "pose",
    "rows",
    "linear_system",
    "loads",
    "stages",
    "options",
    "members",
    "nodes",
    "ties",
    "couples",
    "lumps",
    "beams",
    "structure",
)


def look(name):
    return next(getattr(module, name) for module in (parts, motion, elastic) if hasattr(module, name))


def compiled(lines):
    """A compiled function of (block, found) with these lines: attributes must be literal to be compiled."""
    source = "\n    ".join(["def read(block, found):", *lines])
    namespace = {**vars(parts), **vars(motion), **vars(elastic)}
    exec(source, namespace)
    return entry(namespace["read"])


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in ("contacts", "course") else pytest.mark.slow) for name in NAMES]
)
def test_compiled_entries_are_pythons(name):
    view = look(name)(BLOCK)
    lines = [f"view = {name}(block)"]
    for k, (attribute, array) in enumerate(view._asdict().items()):
        lines += [f"found[{k}, 0] = view.{attribute}.ctypes.data"]
        lines += [f"found[{k}, {1 + axis}] = view.{attribute}.shape[{axis}]" for axis in range(array.ndim)]
        lines += [f"found[{k}, {3 + axis}] = view.{attribute}.strides[{axis}]" for axis in range(array.ndim)]
        lines += [f"view.{attribute}[{', '.join(['0'] * array.ndim)}] = 2.5"]
    found = np.zeros((len(view), 5), dtype=np.int64)
    compiled(lines)(BLOCK, found)
    for array, row in zip(view, found.tolist(), strict=True):
        unused = [0] * (2 - array.ndim)
        assert row == [array.ctypes.data, *array.shape, *unused, *array.strides, *unused]
        assert array.flat[0] == (2 if array.dtype == np.int64 else 2.5)  # a half survives in a float only


def test_compiled_sizes_are_pythons():
    compiled(["view = sizes(block)", *(f"found[{k}] = view.{name}" for k, name in enumerate(SIZES))])(
        BLOCK, found := np.zeros(len(SIZES), dtype=np.int64)
    )
    assert parts.sizes(BLOCK) == tuple(found)
    assert parts.sizes(BLOCK)._fields == SIZES


def test_every_field_is_seen_by_one_view_only():
    seen = [array.ctypes.data for name in NAMES for array in look(name)(BLOCK)]
    assert sorted(seen) == sorted(field_of(BLOCK, field.name).ctypes.data for field in FIELDS)
