"""Reference results that an FMU brings along (layered standard FMI-LS-REF), and how far a run is from them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

from .assignments import parse_value
from .csv_table import read_csv
from .description import Description, Value
from .errors import FmuError, HarnessError

_FOLDER = Path("extra", "org.fmi-standard.fmi-ls-ref")
_MANIFEST = "fmi-ls-manifest.xml"
_NUMBERS = ("Real", "Integer", "Boolean")
#: Nobody needs more, and a forged one shall not fill the memory.
_MOST_BYTES = 100_000_000

#: Largest deviation of a column, as a part of its largest value: of FMUs of this project, whose results have 12 digits,
#: and of others, which depend on the steps of a solver.
_OWN, _FOREIGN = 1e-9, 1e-3


@dataclass(frozen=True)
class ReferenceResults:
    """What an FMU shall give in its default experiment.

    Attributes:
        file: name of the CSV file.
        names: outputs.
        times: communication points [s].
        rows: values of the outputs at each of them.
        parameters: that belong to them, by name; the others have their start values.
    """

    file: str
    names: tuple[str, ...]
    times: tuple[float, ...]
    rows: tuple[tuple[float, ...], ...]
    parameters: Mapping[str, Value]


def read_reference(folder: Path, description: Description) -> ReferenceResults | None:
    """The results that an extracted FMU names; None when it names none.

    Raises:
        FmuError: it names what is not there or cannot be read.
    """
    manifest = folder / _FOLDER / _MANIFEST
    if not manifest.is_file():
        return None
    try:
        root = ElementTree.fromstring(_bytes_of(manifest))
    except (ElementTree.ParseError, LookupError, ValueError) as error:  # of odd encodings, too
        raise FmuError(f"Its {_MANIFEST} is no XML: {error}.") from error
    results, sets = _sources(root, "result", "text/csv"), _sources(root, "parameter", "application/x-ssp-parameter-set")
    if not results:
        return None
    parameters: dict[str, Value] = {}
    for name in sets:
        parameters |= _parameters(_beside(folder, name), description)
    return _table(_beside(folder, results[0]), description, parameters)


def _sources(root: ElementTree.Element, role: str, kind: str) -> list[str]:
    return [e.get("source", "") for e in root.iter("Related") if (e.get("role"), e.get("type")) == (role, kind)]


def _beside(folder: Path, name: str) -> Path:
    path = folder / _FOLDER / name
    if Path(name).name != name or not path.is_file():
        raise FmuError(f"Its {_MANIFEST} names {name!r:.80}, which is no file beside it.")
    return path


def _bytes_of(path: Path) -> bytes:
    if path.stat().st_size > _MOST_BYTES:
        raise FmuError(f"{path.name} has more than {_MOST_BYTES} bytes.")
    return path.read_bytes()


def _table(path: Path, description: Description, parameters: dict[str, Value]) -> ReferenceResults:
    try:
        table = read_csv(_bytes_of(path), Path(path.name))
        outputs = {variable.name for variable in description.of("output") if variable.type in _NUMBERS}
        head = [cell.strip() for cell in table.header]
        columns = [k for k, name in enumerate(head) if name in outputs]
        if head[0] != "time" or not columns:
            raise FmuError(f"{path.name} has no column time, or none of an output.")
        # Of several rows at one time, as at an event, the last one is what comes after it.
        rows = {float(cells[0]): tuple(_number(cells[k]) for k in columns) for _, cells in table.rows}
    except (HarnessError, ValueError) as error:
        raise FmuError(f"Its reference results cannot be read: {error}") from error
    times = tuple(rows)
    if not all(math.isfinite(t) for t in times) or any(b <= a for a, b in pairwise(times)):
        raise FmuError(f"The times of {path.name} do not increase.")
    return ReferenceResults(path.name, tuple(head[k] for k in columns), times, tuple(rows.values()), parameters)


def _number(cell: str) -> float:
    text = cell.strip().lower()
    return {"true": 1.0, "false": 0.0}[text] if text in ("true", "false") else float(text)


def _parameters(path: Path, description: Description) -> dict[str, Value]:
    """The values of an SSP parameter set, of parameters that the FMU has."""
    try:
        root = ElementTree.fromstring(_bytes_of(path))
        known = {variable.name for variable in description.of("parameter")}
        return {
            name: parse_value(element[0].get("value", ""), description.variable(name), description)
            for element in root.iter("{http://ssp-standard.org/SSP1/SystemStructureParameterValues}Parameter")
            if (name := element.get("name", "")) in known and len(element)
        }
    except (ElementTree.ParseError, LookupError, ValueError, HarnessError) as error:
        raise FmuError(f"The parameters of its reference results, {path.name}, cannot be read: {error}") from error


def limit_for(description: Description) -> float:
    """How far an FMU may be from its reference results, as a part of each column's largest value."""
    return _OWN if description.generation_tool.startswith("mechanism_fmu ") else _FOREIGN


def farthest(reference: ReferenceResults, found: Sequence[Sequence[Value]]) -> tuple[float, str, float]:
    """Where a run is farthest from the reference: the deviation (part of the largest value), output and time [s].

    Args:
        reference: what shall be.
        found: values of its outputs at its times.
    """
    worst = (0.0, reference.names[0], reference.times[0])
    for k, name in enumerate(reference.names):
        column = [row[k] for row in reference.rows]
        size = max(map(abs, column)) or 1.0
        for time, expected, row in zip(reference.times, column, found, strict=True):
            off = abs(float(row[k]) - expected) / size
            if math.isnan(off):
                return math.inf, name, time
            if off > worst[0]:
                worst = (off, name, time)
    return worst
