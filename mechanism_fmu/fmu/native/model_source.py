"""Generated model.c: a model as constants for the C surface, and its formulas."""

from __future__ import annotations

from ...model import Model
from .engine_header import advice_table, c_text
from .formulas import Formulas, c_number
from .model_data import Bits, Cell, Table, model_data


def model_source(model: Model, formulas: Formulas, guid: str, mark: bytes, clocks: bool = False) -> str:
    """The text of model.c; the arguments are those of `model_data`."""
    data = model_data(model, formulas, guid, mark, clocks)
    return "\n".join(
        [
            f"/* {model.name}: written by model_source.py. */",
            '#include "engine.h"',
            '#include "model.h"',
            "#include <math.h>",
            advice_table(),
            *(_array(value) for value in data.values() if isinstance(value, Table)),
            "const Model model = {",
            *(f"    .{name} = {_member(value)}," for name, value in data.items()),
            "};",
            formulas.source,
        ]
    )


def _array(table: Table) -> str:
    """An array constant; one without entries gets an empty one, because C has no arrays of length 0."""
    text = ",\n    ".join(map(_element, table.rows))
    return f"static const {table.kind} {table.name}[] = {{\n    {text or 0}\n}};"


def _element(row: tuple[Cell, ...]) -> str:
    return _cell(row[0]) if len(row) == 1 else f"{{{', '.join(map(_cell, row))}}}"


def _member(value: Cell | bytes | Table) -> str:
    if isinstance(value, Table):
        return "(const double *)BLOCK" if value.kind == "uint64_t" else value.name
    return f"{{{', '.join(map(str, value))}}}" if isinstance(value, bytes) else _cell(value)


def _cell(cell: Cell) -> str:
    match cell:
        case str():
            return c_text(cell)
        case Bits():
            return f"{cell:#x}"
        case int():
            return str(cell)
        case _:
            return c_number(cell)
