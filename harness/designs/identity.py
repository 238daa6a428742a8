"""What makes two runs of a file the same."""

from __future__ import annotations

import hashlib
import json
import re
import zipfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from mechanism_fmu import __version__, stress

from .. import tooth_damage, tooth_stress
from ..fmu import Fmu
from .of_impacts import wants_stress
from .task import Design, Task
from .variation import Axis

_DESIGNS = "designs"
#: Where stress and damage of impacts are calculated.
_STRESS_CODE = (Path(stress.__file__).parent, *map(Path, (tooth_stress.__file__, tooth_damage.__file__)))
_DESCRIPTION = "modelDescription.xml"
_DATE = re.compile(rb'generationDateAndTime="[^"]*"')


@dataclass(frozen=True)
class Identity:
    """Everything on which results depend, by topic, as JSON.

    Comments, titles and the order of tables in the file are no part of it.

    Attributes:
        topics: names of the file's tables, with what they mean once they are read.
    """

    topics: Mapping[str, Any]

    @property
    def digest(self) -> str:
        """SHA-256 of it all."""
        return _digest(self.topics)

    def changed(self, other: Mapping[str, Any]) -> list[str]:
        """The topics that differ; the designs only where nothing else explains it, as with another scipy."""
        names = dict.fromkeys([*self.topics, *other])
        found = [name for name in names if self.topics.get(name) != other.get(name)]
        return [name for name in found if name != _DESIGNS] or found


def identity(
    fmu: Mapping[str, str],
    task: Task,
    axes: Sequence[Axis],
    how: tuple[str, Mapping[str, Any]],
    designs: Sequence[Design] = (),
) -> Identity:
    """The identity of a list of designs.

    Args:
        fmu: what `contents` says of it.
        task: of every design.
        axes: what is varied.
        how: designs are found: name of the table, and what is in it.
        designs: the list, if it is known from the beginning. It is part of the identity, because another version of
            scipy might make another list of the same file.
    """
    return Identity(
        {
            "fmu": dict(fmu),
            # The stresses are no FMU's: they change with the code.
            "mechanism_fmu": {
                "version": __version__,
                "stress": code_of(_STRESS_CODE) if wants_stress(task) else None,
            },
            "run": {
                "start": task.grid.start,
                "stop": task.grid.stop,
                "step": task.grid.step,
                "material": asdict(task.material.material) | asdict(task.material.strength),
                "input": None if task.inputs is None else _signals(task),
            },
            "set": dict(sorted(task.fixed.items())),
            "vary": {
                axis.name: {
                    "unit": axis.unit,
                    "limits": None if axis.values is not None else [axis.low, axis.high],
                    "values": None if axis.values is None else list(axis.values),
                }
                for axis in axes
            },
            "record": [quantity.column for quantity in task.quantities],
            how[0]: dict(how[1]),
            _DESIGNS: _digest([list(design.values.values()) for design in designs]),
        }
    )


def contents(fmu: Fmu) -> dict[str, str]:
    """What tells an FMU from another: its model, its GUID, and SHA-256 of all that is in it but the date of its making.

    Whoever edits an FMU seldom gives it another GUID.
    """
    with zipfile.ZipFile(fmu.path) as archive:
        files = {name: archive.read(name) for name in sorted(archive.namelist())}
    files[_DESCRIPTION] = _DATE.sub(b"", files[_DESCRIPTION])
    return {"model": fmu.description.model, "guid": fmu.description.guid, "sha256": _files_digest(files.items())}


def code_of(places: Iterable[Path]) -> str:
    """SHA-256 of Python files, and of those in folders; where the places lie does not matter."""
    paths = [(place.parent, path) for place in places for path in (sorted(place.rglob("*.py")) or [place])]
    return _files_digest((path.relative_to(root).as_posix(), path.read_bytes()) for root, path in paths)


def _files_digest(files: Iterable[tuple[str, bytes]]) -> str:
    found = hashlib.sha256()
    for name, content in files:
        found.update(name.encode() + hashlib.sha256(content).digest())
    return found.hexdigest()


def _signals(task: Task) -> str:
    assert task.inputs is not None
    names = [variable.name for variable in task.inputs.variables]
    return _digest([names, task.inputs.times.tolist(), task.inputs.values.tolist()])


def _digest(data: Any) -> str:
    return hashlib.sha256(json.dumps(data, sort_keys=True).encode()).hexdigest()
