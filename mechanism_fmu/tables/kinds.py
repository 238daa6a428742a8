"""The kinds of joints, force elements and operations, and what stands in a row of each, for model and engine.

A line a kind: its name, and the columns of its row of the table, in order; `point.x` is the first entry of the part's
`point`. The kind's number is its place here, so that a new one comes last.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeVar

Function = TypeVar("Function", bound=Callable[..., Any])


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

    def numbered(self, functions: Mapping[str, Function]) -> dict[int, Function]:
        """Functions of kinds by their numbers."""
        return {self.number(kind): function for kind, function in functions.items()}

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
    dc_motor="constant resistance inductance voltage gain integral_gain anti_windup speed",
    spring_damper="point.x point.y reaction_point.x reaction_point.y stiffness damping free_length preload side",
    torsion_spring_damper="stiffness damping free_angle preload side",
    point_force="point.x point.y x y turns",
    bushing="point.x point.y reaction_point.x reaction_point.y stiffness_x stiffness_y damping_x damping_y "
    "torsional_stiffness torsional_damping free_angle",
    nonlinear_spring="point.x point.y reaction_point.x reaction_point.y",
    nonlinear_torsion_spring="",
    marker="point.x point.y",
    brake="limit",
    oscillation="middle nominal_period",
)

JOINTS = Kinds(
    revolute="point_i.x point_i.y point_j.x point_j.y",
    translational="point_i.x point_i.y point_j.x point_j.y axis_i.x axis_i.y axis_j.x axis_j.y",
    distance="point_i.x point_i.y point_j.x point_j.y distance",
    revolute_translational="point_i.x point_i.y point_j.x point_j.y normal_i.x normal_i.y distance",
    gears="point_i.x point_i.y point_j.x point_j.y radius_i angle_i radius_j angle_j",
    internal_gears="point_i.x point_i.y point_j.x point_j.y radius_i angle_i radius_j angle_j",
    rack_and_pinion="point_i.x point_i.y origin_i.x origin_i.y direction_i point_j.x point_j.y radius_j angle_j",
    x_driver="point_i.x point_i.y point_j.x point_j.y",
    y_driver="point_i.x point_i.y point_j.x point_j.y",
    angle_driver="",
    distance_driver="point_i.x point_i.y point_j.x point_j.y",
    translational_driver="point_i.x point_i.y point_j.x point_j.y direction_i.x direction_i.y",
)

#: The operations of a law that a user has written: each has a result, and its operands are those of earlier ones.
OPERATIONS = Kinds(
    constant="",
    length="",
    rate="",
    add="a b",
    subtract="a b",
    multiply="a b",
    divide="a b",
    negate="a",
    minimum="a b",
    maximum="a b",
    where_positive="condition positive otherwise",
    sqrt="a",
    sin="a",
    cos="a",
    tan="a",
    atan2="y x",
    exp="a",
    log="a",
    tanh="a",
    power="base exponent",
)
#: The numbers of those operations that choose between values.
CHOICES = tuple(OPERATIONS.number(kind) for kind in ("minimum", "maximum", "where_positive"))
