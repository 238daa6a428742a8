"""The logic of a mechanism as plain data: logical functions, states, transitions; as a table and as a diagram.

It knows neither the model room, which derives it, nor the FMU and the harness, which carry and show it.
"""

from .follow import taken
from .records import ANY, Definition, Logic, Region, Transition
from .svg import diagram
from .table import definition_rows, definitions_table, kept_parts, markdown, rows

__all__ = [
    "ANY",
    "Definition",
    "Logic",
    "Region",
    "Transition",
    "definition_rows",
    "definitions_table",
    "diagram",
    "kept_parts",
    "markdown",
    "rows",
    "taken",
]
