"""The tables of `mechanism_fmu.tables` for compiled code.

Compiled, `Joints(block)` is the block's address, and each column is computed where it is used: nothing is copied,
nothing is allocated.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.typing.templates import AttributeTemplate
from numba.extending import infer_getattr, lower_builtin, lower_getattr, models, register_model, type_callable
from numba.np.arrayobj import make_array, populate_array

from ...tables.declare import Field
from ...tables.layout import TABLES, size_slot, slot
from ...tables.sizes import SIZES, Sizes


class _ViewType(types.Type):
    """The compiler's type of a view."""


class _SizeEntry:
    """An attribute that is a size."""

    type = types.intp

    def __init__(self, name: str) -> None:
        self._index = size_slot(name)

    def lower(self, _context: Any, builder: Any, block: Any) -> Any:
        return _header_word(builder, block, self._index)


class _FieldEntry:
    """An attribute that is an array over a field; it owns nothing."""

    def __init__(self, field: Field) -> None:
        self._field = field
        self.type = types.Array(types.int64 if field.integer else types.float64, len(field.shape), "C")

    def lower(self, context: Any, builder: Any, block: Any) -> Any:
        pointer = builder.gep(block, [_header_word(builder, block, slot(self._field.name))])
        pointer = builder.bitcast(pointer, context.get_data_type(self.type.dtype).as_pointer())
        shape = [
            cgutils.intp_t(entry) if isinstance(entry, int) else _header_word(builder, block, size_slot(entry))
            for entry in self._field.shape
        ]
        word = cgutils.intp_t(8)
        strides = [word] if len(shape) == 1 else [builder.mul(word, shape[1]), word]
        array = make_array(self.type)(context, builder)
        populate_array(array, data=pointer, shape=shape, strides=strides, itemsize=word, meminfo=None)
        return array._getvalue()


def _header_word(builder: Any, block: Any, index: int) -> Any:
    """The integer in word `index` of the header, which compiled code never changes."""
    address = builder.bitcast(builder.gep(block, [cgutils.intp_t(index)]), cgutils.intp_t.as_pointer())
    word = builder.load(address)
    word.set_metadata("invariant.load", builder.module.add_metadata([]))
    return word


def _teach(view: type[Any], entries: dict[str, _SizeEntry] | dict[str, _FieldEntry]) -> None:
    """Teach the compiler to make a view of a block, and to read its entries."""
    name = f"{view.__name__}View"
    view_class = type(name, (_ViewType,), {})
    view_type = view_class(name=name)

    @register_model(view_class)
    class _Model(models.PrimitiveModel):
        def __init__(self, manager: Any, declared: Any) -> None:
            super().__init__(manager, declared, ir.DoubleType().as_pointer())

    @infer_getattr
    class _Attributes(AttributeTemplate):
        key = view_class

        def generic_resolve(self, _view: Any, attribute: str) -> Any:
            return entries[attribute].type if attribute in entries else None

    for attribute, entry in entries.items():
        lower_getattr(view_class, attribute)(
            lambda context, builder, _type, value, entry=entry: entry.lower(context, builder, value)
        )
    type_callable(view)(lambda _context: lambda block: view_type)
    lower_builtin(view, types.Array)(
        lambda context, builder, signature, args: make_array(signature.args[0])(context, builder, args[0]).data
    )


_teach(Sizes, {name: _SizeEntry(name) for name in SIZES})
for _table in TABLES:
    _teach(_table, {column: _FieldEntry(field) for column, field in _table.fields.items()})
