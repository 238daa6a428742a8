"""The logic of a mechanism as plain data: logical functions, states, transitions; as a table and as a diagram.

It knows neither the package `model`, which derives it, nor the FMU and the harness, which carry and show it.
"""

from .pictures import (
    definition_rows as definition_rows,
    definitions_table as definitions_table,
    diagram as diagram,
    kept_parts as kept_parts,
    markdown as markdown,
    rows as rows,
)
from .records import (
    ANY as ANY,
    Definition as Definition,
    Logic as Logic,
    Region as Region,
    Transition as Transition,
    taken as taken,
)
