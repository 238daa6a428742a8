"""A model as one block of bytes, which the WebAssembly module of all pages loads (loaded.c): no compiler is needed.

It is laid out as a C compiler for wasm32 lays out the structures of model.h: pointers and `size_t` have four bytes,
numbers begin at a multiple of their size. Pointers are counted from the first byte; a list of them is inside.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable

from ...model.functions import Number
from ...model.symbol import Symbol
from .formulas import Formulas
from .model_data import Bits, Cell, ModelData, Table

#: The operations in the order of the enumeration in loaded.c.
STEPS = (
    *("add", "subtract", "multiply", "divide", "negate"),
    *("sin", "cos", "tan", "sqrt", "atan2", "where_positive"),
)

_HEAD = struct.Struct("<4I")


class _Pointer(int):
    """The place of something in the image."""


class _Image:
    """Bytes, and where among them there are pointers."""

    def __init__(self) -> None:
        self.contents = bytearray(_HEAD.size)
        self.pointers: list[int] = []

    def put(self, rows: Iterable[Iterable[Cell | bytes | Table]]) -> _Pointer:
        """Add an array, behind all that it points to; each row is an element. Returns its place."""
        ready = [[self._pointed(part) for part in row] for row in rows]
        self._align(8)
        place = _Pointer(len(self.contents))
        for row in ready:
            wide = False
            for part in row:
                wide |= self._add(part)
            if wide:
                self._align(8)
        return place

    def _pointed(self, part: Cell | bytes | Table) -> Cell | bytes:
        """The part as it stands in a structure."""
        if isinstance(part, Table):
            return self.put(part.rows)
        if isinstance(part, str):
            place = _Pointer(len(self.contents))
            self.contents += part.encode() + b"\0"
            return place
        return part

    def _add(self, part: Cell | bytes) -> bool:
        """Add a part of a structure; whether it has eight bytes."""
        match part:
            case bytes():
                self.contents += part
            case float():
                self._align(8)
                self.contents += struct.pack("<d", part)
                return True
            case Bits():
                self.contents += struct.pack("<Q", part)
                return True
            case _Pointer():
                self.pointers.append(len(self.contents))
                self.contents += struct.pack("<I", part)
            case int():
                self.contents += struct.pack("<i", part)
            case _:
                raise TypeError(f"{part!r} has no form in the image of a model")
        return False

    def _align(self, size: int) -> None:
        self.contents += bytes(-len(self.contents) % size)


def model_image(data: ModelData, formulas: Formulas) -> bytes:
    """The bytes of a model.

    Args:
        data: what the C surface gets to know of it.
        formulas: its parameters-to-tables function, traced.
    """
    image = _Image()
    of_formulas = image.put([_formulas(image, formulas)])
    of_model = image.put([data.values()])
    pointers = image.put([image.pointers])
    _HEAD.pack_into(image.contents, 0, of_model, of_formulas, pointers, len(image.pointers))
    return bytes(image.contents)


def _formulas(image: _Image, formulas: Formulas) -> list[Cell]:
    """The structure `Formulas` of loaded.c; in x, constants stand behind parameters, results behind them."""
    traced = formulas.traced
    parameters = len(traced.model.parameters)
    wanted = (*formulas.values, *formulas.numbers)
    needed = {number: traced.operations[number] for number in traced.needed(wanted)}
    given = [x.value for x in needed.values() if x.name == "constant"]
    given += [float(x) for x in wanted if not isinstance(x, Symbol)]
    constants = {x.hex(): x for x in given}  # as text, 0 and -0 are two
    of_constant = {text: parameters + place for place, text in enumerate(constants)}
    first = parameters + len(constants)
    places: dict[int, int] = {}
    steps: list[list[int]] = []
    for number, operation in needed.items():
        match operation.name:
            case "parameter":
                places[number] = int(operation.value)
            case "constant":
                places[number] = of_constant[operation.value.hex()]
            case name:
                operands = [places[operand] for operand in operation.operands]
                places[number] = first + len(steps)
                steps.append([STEPS.index(name), *operands, *(0,) * (3 - len(operands))])

    def place(x: Number) -> list[int]:
        return [places[x.number] if isinstance(x, Symbol) else of_constant[float(x).hex()]]

    x = [0.0] * parameters + list(constants.values()) + [0.0] * len(steps)
    return [
        image.put([number] for number in x),
        first,
        image.put(steps),
        len(steps),
        image.put(map(place, formulas.values)),
        image.put(map(place, formulas.numbers)),
        len(formulas.numbers),
    ]
