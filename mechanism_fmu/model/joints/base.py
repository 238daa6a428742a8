"""Base of all joints: their row of numbers, the constraint forces that can be read of them, and what they refuse."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar, NamedTuple

from ...tables.kinds import JOINTS
from ..attached import Attached
from ..body import Point
from ..curves import Curve
from ..findings import Finding, finite_positive, length, literal, refuse_unless
from ..functions import Number, where_positive

# Directions are given as vectors of any length > 0.


def unit_vector(axis: Point) -> Point:
    """The unit vector along `axis`; a vector of no length, which `findings` refuses, stays as it is."""
    long = length(axis)
    size = where_positive(long, long, 1.0)
    return axis[0] / size, axis[1] / size


class Effort(NamedTuple):
    """A force or torque that an `Output` can read of a joint, with the source "<joint>.<name of the effort>".

    Attributes:
        row: of the joint, whose multiplier lambda it is, with M qdd = F + Phi_q^T lambda ...
        factor: ... times this, or times the number of the joint that is named here.
        unit: SI unit.
    """

    row: int = 0
    factor: float | str = 1.0
    unit: str = "N"


class JointFacts(Attached):
    """What all joints have.

    Attributes:
        row: name of the kind in `tables.kinds.JOINTS`.
        rows: how many constraint rows it has.
        unit: of the motion of a driver.
        friction_static: the same while it sticks; None: as large.
        friction: the joint's entry in the table `joint_friction`; `friction_name` is what that is called.
        efforts: by name.
        axes: names of directions, which must have a length.
        sizes: names of lengths [m], which must be positive.
    """

    row: ClassVar[str]
    rows: ClassVar[int] = 1
    friction: Number = 0.0
    friction_static: Number | None = None
    unit: ClassVar[str] = "m"
    friction_name: ClassVar[str] = "friction"
    efforts: ClassVar[Mapping[str, Effort]] = {}
    axes: ClassVar[tuple[str, ...]] = ()
    sizes: ClassVar[tuple[str, ...]] = ()

    name: str

    @property
    def kind(self) -> int:
        """The joint's entry in the table `joint_kind`."""
        return JOINTS.number(self.row)

    def effort(self, quantity: str) -> tuple[int, Number] | None:
        """The row (within the joint) and the factor of an effort; None when the joint has no such output.

        Args:
            quantity: name of a force or torque, one of `efforts`.
        """
        effort = self.efforts.get(quantity)
        if effort is None:
            return None
        factor: Number = getattr(self, effort.factor) if isinstance(effort.factor, str) else effort.factor
        return effort.row, factor

    def findings(self) -> Iterator[Finding]:
        """Every problem that its numbers can have, but for its friction and for those that are not finite."""
        for name in self.axes:
            yield no_direction(f"{self.label}: {name}", getattr(self, name))
        for name in self.sizes:
            value = getattr(self, name)
            text = f"{self.label}: {name} = {{:g}} m, but it must be positive and finite."
            yield refuse_unless(finite_positive(value), text, value)

    @property
    def holding(self) -> Number:
        """The joint's entry in the table `joint_holding`: its friction while it sticks."""
        return self.friction if self.friction_static is None else self.friction_static

    @property
    def label(self) -> str:
        """Its class and name, for messages."""
        return f"{type(self).__name__} {literal(repr(self.name))}"


class UndrivenJoint(JointFacts):
    """A joint that follows no curve over time."""

    motion: ClassVar[Curve | None] = None


def no_direction(what: str, axis: Point) -> Finding:
    """The finding that a direction has no length."""
    text = f"{what} = ({{:g}}, {{:g}}) has no direction; give it a length that is finite and not zero."
    return refuse_unless(finite_positive(length(axis)), text, *axis)
