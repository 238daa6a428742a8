"""Named views of an instance's block, in Python and compiled.

In Python a view is a named tuple of arrays. Compiled, it is the block's address, and each attribute is computed where
it is used: nothing is copied, nothing is allocated.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.typing.templates import AttributeTemplate
from numba.extending import infer_getattr, lower_builtin, lower_getattr, models, register_model, type_callable
from numba.np.arrayobj import make_array, populate_array

from .layout import FIELDS_BY_NAME, Array, Field, field_of, size_slot, sizes_of, slot

_View = TypeVar("_View")  # a NamedTuple class; the type system has no bound for those


def room(view: type[_View], prefix: str = "") -> Callable[[Array], _View]:
    """A function from a block to a `view`: each entry is the field of that name, with `prefix` where there is one."""
    fields = {entry: _field(prefix, entry) for entry in _entries(view)}

    last: tuple[Array | None, _View | None] = (None, None)

    def look(block: Array) -> Any:
        nonlocal last
        seen = last  # plain Python looks at the same block again and again
        if seen[0] is not block:
            last = seen = block, view(*(field_of(block, field.name) for field in fields.values()))
        return seen[1]

    return _compilable(look, view.__name__, {entry: _FieldEntry(field) for entry, field in fields.items()})


def _field(prefix: str, entry: str) -> Field:
    return FIELDS_BY_NAME.get(prefix + entry) or FIELDS_BY_NAME[entry]


def sizes_room(view: type[_View]) -> Callable[[Array], _View]:
    """A function from a block to a `view` of its sizes, named as in `layout.SIZES`."""

    def look(block: Array) -> _View:
        return view(*(sizes_of(block)[name] for name in _entries(view)))

    return _compilable(look, view.__name__, {name: _SizeEntry(name) for name in _entries(view)})


def _entries(view: Any) -> tuple[str, ...]:
    return tuple(view._fields)


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


def _compilable(look: Callable[[Array], _View], name: str, entries: dict[str, Any]) -> Callable[[Array], _View]:
    """Teach the compiler to call `look` and to read the entries of what it returns."""
    view_class = type(f"{name}View", (_ViewType,), {})
    view_type = view_class(name=f"{name}View")

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
    type_callable(look)(lambda _context: lambda block: view_type)
    lower_builtin(look, types.Array)(
        lambda context, builder, signature, args: make_array(signature.args[0])(context, builder, args[0]).data
    )
    return look
