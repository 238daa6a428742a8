"""Degrees of freedom of a user's mechanism at its start, and the rows of its joints that say nothing new.

`mechanism_fmu.kinematics.mobility` says more, of any instant; here the compiled engine's own rows are asked, so that a
build has nothing to compile for it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from ctypes import CDLL
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ...kinematics.mobility import Independence, free_directions, independence
from ...model import Mechanism, MechanismError, Model, compile_mechanism
from ...moving import MovingMechanism
from ...tables.layout import pack
from ..native.objects import has_libraries, library_of

_Array = np.ndarray[Any, np.dtype[np.float64]]

#: How far away configurations are looked at, relative to the size of the mechanism.
_AWAY = 0.02


@dataclass(frozen=True)
class Freedoms:
    """What joints, drivers and closed contacts leave free at the start.

    Attributes:
        coordinates: three a body.
        rows: how many there are.
        rank: how many of them are independent, here or a little away.
        redundant: the parts that have rows that depend on others.
        singular: whether the rank is smaller here than a little away.
    """

    coordinates: int
    rows: int
    rank: int
    redundant: tuple[str, ...]
    singular: bool

    def __str__(self) -> str:
        """One line."""
        free = self.coordinates - self.rank
        return (
            f"{free} degree{'' if free == 1 else 's'} of freedom ({self.coordinates} coordinates, {self.rows} rows, "
            f"{self.rows - self.rank} redundant)"
        )

    def remarks(self) -> Iterator[str]:
        """What deserves a warning."""
        if self.redundant:
            names = ", ".join(self.redundant)
            yield (
                f"rows of {names} follow from those of other joints, so that the forces are shared among them by least "
                "squares, not by stiffness; take a joint away, or let a pin slide in a guide, if that is not meant."
            )
        if self.singular:
            yield (
                "it starts in a singular position, from which it can go on in more than one way; start a little away."
            )


def report_freedoms(model: Model, path: Path, inform: Callable[[str], None], warn: Callable[[str], None]) -> None:
    """Say the degrees of freedom of a user's model that has been built, with its default values.

    Args:
        model: that can start.
        path: of its file.
        inform: is called with the line that says them.
        warn: is called with what looks like a mistake.
    """
    library = library_of() if has_libraries() else None
    found = freedoms(model.build(model.values()), library)
    inform(f"{model.name}: {found}")
    for remark in found.remarks():
        warn(f"{path}: {remark}")


def freedoms(mechanism: Mechanism, library: CDLL | None = None) -> Freedoms:
    """The degrees of freedom at the start.

    Args:
        mechanism: with plain numbers.
        library: of the compiled engine.

    Raises:
        MechanismError: it cannot be assembled.
    """
    rows, names, size = _rows(mechanism, library)
    here = best = independence(_balanced(rows, size))
    if here.dependent:
        for direction in free_directions(_balanced(rows, size)).T:
            for sign in (1.0, -1.0):
                near = _near(mechanism, sign * _AWAY * size * direction, size, library)
                if near is not None and len(near.independent) > len(best.independent):
                    best = near
    redundant = tuple(dict.fromkeys(names[k] for k in best.dependent))
    rank = len(best.independent)
    return Freedoms(rows.shape[1], rows.shape[0], rank, redundant, rank > len(here.independent))


def _rows(mechanism: Mechanism, library: CDLL | None) -> tuple[_Array, list[str], float]:
    """Phi_q of joints and closed contacts at the start, the part of each row, and the longest lever arm [m] or 1."""
    simulation = MovingMechanism.over(mechanism, pack(compile_mechanism(mechanism)), library)
    simulation.begin(0.0)
    rows, names = _read(simulation, mechanism)
    along = np.maximum(np.abs(rows[:, 0::3]), np.abs(rows[:, 1::3])).max(axis=1, initial=0.0)
    turning = np.abs(rows[:, 2::3]).max(axis=1, initial=0.0)
    size = float((turning[along > 0.0] / along[along > 0.0]).max(initial=0.0)) or 1.0
    return rows, names, size


def _read(simulation: MovingMechanism, mechanism: Mechanism) -> tuple[_Array, list[str]]:
    """Phi_q where the simulation has looked at it, and the part of each row."""
    names = [joint.name for joint in mechanism.joints for _ in range(joint.rows)] + list(simulation.mode())
    return np.array(simulation.field("jacobian")[: len(names), : 3 * len(mechanism.bodies)]), names


def _balanced(rows: _Array, size: float) -> _Array:
    """The rows with angles as lengths on a lever arm, each of length 1."""
    columns = np.tile((1.0, 1.0, 1.0 / size), rows.shape[1] // 3)
    found = rows * columns
    lengths = np.linalg.norm(found, axis=1, keepdims=True)
    balanced: _Array = found / np.where(lengths > 0.0, lengths, 1.0)
    return balanced


def _near(mechanism: Mechanism, step: _Array, size: float, library: CDLL | None) -> Independence | None:
    """The same a step away (in lengths) that joints allow, whatever drivers say; None where none is found."""
    steps = step.reshape(-1, 3) * (1.0, 1.0, 1.0 / size)
    bodies = tuple(
        replace(body, start=tuple(a + b for a, b in zip(body.start, way.tolist(), strict=True)), start_rate=(0, 0, 0))
        for body, way in zip(mechanism.bodies, steps, strict=True)
    )
    alone = replace(
        mechanism, bodies=bodies, held=(), inputs=(), outputs=(), calculated=(), members=(), lumped_masses=()
    )
    undriven = replace(alone, joints=tuple(joint for joint in mechanism.joints if joint.motion is None))
    simulation = MovingMechanism.over(undriven, pack(compile_mechanism(undriven)), library)
    try:
        simulation.begin(0.0)
    except MechanismError:
        return None
    # There, with all coordinates held, the rows of drivers are looked at as well, however far they are from closed.
    pose = simulation.field("y_end")[: 3 * len(bodies)].reshape(-1, 3).tolist()
    placed = tuple(replace(body, start=tuple(at)) for body, at in zip(bodies, pose, strict=True))
    every = tuple(f"{body.name}.{coordinate}" for body in bodies for coordinate in ("x", "y", "angle"))
    there = replace(alone, bodies=placed, held=every)
    simulation = MovingMechanism.over(there, pack(compile_mechanism(there)), library)
    with suppress(MechanismError):
        simulation.begin(0.0)
    return independence(_balanced(_read(simulation, there)[0], size))
