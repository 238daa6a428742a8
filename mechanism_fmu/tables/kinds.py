"""The kinds of force elements, and what stands in a row of each: read by the model, which writes it, and the engine.

A line a kind: its name, and the columns of its row of the table, in order; `point.x` is the first entry of the part's
`point`. The kind's number is its place here, so that a new one comes last.
"""

from __future__ import annotations

from collections.abc import Iterator


class Kinds:
    """Kinds of parts with a table of numbers in common.

    Attributes:
        width: of the table: the longest row.
    """

    def __init__(self, **kinds: str) -> None:
        """Take the columns of each kind, with spaces between them."""
        self._columns = {name: tuple(columns.split()) for name, columns in kinds.items()}
        self._numbers = {name: number for number, name in enumerate(kinds)}
        self.width = max(map(len, self._columns.values()))

    def __iter__(self) -> Iterator[str]:
        """The names."""
        return iter(self._columns)

    def number(self, kind: str) -> int:
        """What stands in the column `kind` of the table."""
        return self._numbers[kind]

    def columns(self, kind: str) -> tuple[str, ...]:
        """The names of a kind's columns."""
        return self._columns[kind]

    def places(self, kind: str) -> range:
        """The numbers of a kind's columns, to be named by who reads them."""
        return range(len(self._columns[kind]))


FORCES = Kinds(
    torque="torque",
    torsion_spring="stiffness free_angle preload",
    damper="damping",
    shaft="stiffness damping angle speed",
    force="x y",
    slip_clutch="stiffness damping limit speed",
    dc_motor="constant resistance inductance voltage gain integral_gain anti_windup speed",
    spring_damper="point.x point.y reaction_point.x reaction_point.y stiffness damping free_length preload",
)
