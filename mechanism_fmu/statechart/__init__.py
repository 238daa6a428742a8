"""The logic of a mechanism as plain data: logical functions, states, transitions; as a table and as a diagram.

It knows neither the model room, which derives it, nor the FMU and the harness, which carry and show it.
"""

from .diagram import diagram
from .records import ANY, Definition, Logic, Region, Transition
from .table import definition_rows, definitions_table, kept_parts, markdown, rows
from .taken import taken

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
