"""Which displacement of which place is which unknown of the structure."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..model import AngleDriver, Mechanism, Revolute, RevoluteTranslational, Translational, TranslationalDriver
from .locks import attachments, rubbing_pins, welds
from .places import Place, find_places, named_place, place_of

IntArray = np.ndarray[Any, np.dtype[np.int64]]

#: In `Freedoms.columns`, of a rotation that no other part asks for: a pinned end of a member, where no moment acts.
RELEASED = -1
_FIXED = -2

#: The place of the ground, and so the group of what is fixed to it.
_GROUND = 0


@dataclass(frozen=True)
class Freedoms:
    """The displacements w of all places that are left when pins, welds and the ground have made some of them equal.

    Attributes:
        places: of the mechanism; the first is the ground.
        names: of the unknowns w, "<place>.x|y|angle" by the first place that has them.
        columns: shape (places, 3), the numbers in w of (u_x, u_y, theta) of each place; `len(names)` is the ground,
            which does not move; `RELEASED` stands for a rotation that is no unknown.
    """

    places: tuple[Place, ...]
    names: tuple[str, ...]
    columns: IntArray

    @property
    def ground(self) -> int:
        """The number behind the last unknown: what it would be of the ground."""
        return len(self.names)


def find_freedoms(mechanism: Mechanism, loaded: Iterable[str] = ()) -> Freedoms:
    """The unknowns of a mechanism whose driven, or else held, coordinates stand still.

    A rotation is one where members are welded, at free ends, and where something can act on it: a disk with inertia,
    a slider, a locked angle, friction, or a moment on one of the places `loaded`.

    Raises:
        LinkageError: a part is attached where no member ends, or there is no place as in `loaded`.
    """
    places = find_places(mechanism)
    pins = [attachments(mechanism, places, j) for j in mechanism.joints if isinstance(j, Revolute)]
    welded = welds(mechanism, places)
    translation, rotation = _groups(len(places), pins), _groups(len(places), welded)
    kept = _kept(mechanism, places, welded, loaded)
    names: list[str] = []
    numbers: dict[tuple[str, int], int] = {}
    columns = []
    for number, place in enumerate(places):
        row = []
        for axis, group in (("x", translation), ("y", translation), ("angle", rotation)):
            if axis == "angle" and number not in kept:
                row.append(RELEASED)
            elif group[number] == _GROUND:
                row.append(_FIXED)
            else:
                if (axis, group[number]) not in numbers:
                    numbers[axis, group[number]] = len(names)
                    names.append(f"{place.names[0]}.{axis}")
                row.append(numbers[axis, group[number]])
        columns.append(row)
    table = np.array(columns, dtype=np.int64)
    return Freedoms(places, tuple(names), np.where(table == _FIXED, len(names), table))


def _groups(count: int, pairs: Iterable[tuple[int, int]]) -> list[int]:
    """For each of `count` places the first one that it is connected with by pairs."""
    group = [*range(count)]
    for pair in pairs:
        joined = {group[number] for number in pair}
        group = [min(joined) if number in joined else number for number in group]
    return group


def _kept(
    mechanism: Mechanism, places: tuple[Place, ...], welded: Iterable[tuple[int, int]], loaded: Iterable[str]
) -> set[int]:
    """Places whose rotation is an unknown, or stands still with the ground."""
    kept = {number for pair in welded for number in pair}
    jointed: set[int] = set()
    for joint in mechanism.joints:
        if isinstance(joint, AngleDriver):
            continue  # acts at the pin of its bodies
        i, j = attachments(mechanism, places, joint)
        jointed |= {i, j}
        if isinstance(joint, (Translational, RevoluteTranslational, TranslationalDriver)):
            kept.add(i)
    for pin, _, _ in rubbing_pins(mechanism):
        kept.update(attachments(mechanism, places, pin))
    for disk in mechanism.disks:
        if any(member.body == disk.body for member in mechanism.members):
            number = place_of(places, mechanism, f"Disk {disk.name!r}", disk.body, disk.point)
            if disk.inertia > 0.0:
                kept.add(number)
    kept |= {n for n, place in enumerate(places) if len(place.names) > 1 or n not in jointed}
    return kept | {named_place(places, name) for name in loaded}
