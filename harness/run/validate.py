"""Validation of an FMU: a check of the file, a short life of two instances, its reference results."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import fmpy.validation

from ..errors import FmuError, HarnessError
from ..fmu.description import Description, Value, Variable
from ..fmu.interface import Instance, Instances
from ..fmu.values import parse_value
from .checks import Check
from .inputs import read_csv
from .master import TimeGrid, begin_and_size, seconds

# Reference results that an FMU brings along (layered standard FMI-LS-REF), and how far a run is from them.

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


#: The run takes this many steps through the default experiment, and branches off after some of them.
_STEPS = 100
_BRANCH = 10

_REFERENCE = "It gives the reference results that it brings along"

#: Row of output values for each communication point.
Trajectory = list[list[Value]]


def validate(fmu: Instances) -> Iterator[Check]:
    """Verdicts on an FMU, each as soon as it is known."""
    try:
        problems = fmpy.validation.validate_fmu(str(fmu.path))
    except Exception as error:  # fmpy trips over some of what it is to find
        problems = [f"{type(error).__name__}: {error}"]
    yield Check("fmpy finds no problem in the file", not problems, " ".join(problems) or "schema, units, structure")
    conformance = _Conformance(fmu)
    steps: list[tuple[str, Callable[[], str]]] = [
        ("An instance starts with the values of modelDescription.xml", conformance.defaults),
        ("It runs to the stop time of its default experiment with finite outputs", conformance.run),
        ("After a reset it repeats the run exactly", conformance.reset),
    ]
    if fmu.description.saves_state:
        steps.append(("Going back to a saved state repeats the run exactly", conformance.rollback))
    if fmu.description.serializes_state:
        steps.append(("So does another instance with the serialized state", conformance.transfer))
    try:
        reference = read_reference(fmu.folder, fmu.description)
    except FmuError as error:
        yield Check(_REFERENCE, False, str(error))
    else:
        if reference is not None:
            steps.append((_REFERENCE, partial(conformance.reference, reference)))
    for claim, step in steps:
        try:
            yield Check(claim, True, step())
        except HarnessError as error:
            yield Check(claim, False, str(error))


class _Conformance:
    """Each method lets one promise come true or raises `HarnessError`, and says what it saw."""

    def __init__(self, fmu: Instances) -> None:
        self._fmu = fmu
        self._outputs = [v.name for v in fmu.description.of("output")]
        self._grid = conformance_grid(fmu.description)

    def defaults(self) -> str:
        with self._fmu.instantiate("defaults") as slave:
            variables = [v for v in self._fmu.description.of("input", "parameter") if v.start is not None]
            for variable, value in zip(variables, slave.get([v.name for v in variables]), strict=True):
                if not _same_value(variable, value):
                    raise FmuError(f"{variable.name} is {value}, but its start value is {variable.start}.")
        return f"{len(variables)} inputs and parameters"

    def run(self) -> str:
        with self._fmu.instantiate("run") as slave:
            self._start(slave)
            trajectory = self._run_of(slave, list(self._grid))
        return f"{len(trajectory)} steps to {seconds(self._grid.stop):g} s"

    def reset(self) -> str:
        with self._fmu.instantiate("reset") as slave:
            self._start(slave)
            first = self._run_of(slave, list(self._grid))
            slave.reset()
            self._start(slave)
            return self._same(first, self._run_of(slave, list(self._grid)))

    def rollback(self) -> str:
        with self._fmu.instantiate("rollback") as slave:
            self._start(slave)
            steps = list(self._grid)
            self._run_of(slave, steps[:_BRANCH])
            state = slave.save()
            first = self._run_of(slave, steps[_BRANCH:])
            slave.restore(state)
            slave.free_state(state)
            return self._same(first, self._run_of(slave, steps[_BRANCH:]))

    def transfer(self) -> str:
        steps = list(self._grid)
        with self._fmu.instantiate("source") as source, self._fmu.instantiate("target") as target:
            self._start(source)
            self._run_of(source, steps[:_BRANCH])
            state = source.save()
            data = source.serialize(state)
            source.free_state(state)
            self._start(target)
            state = target.deserialize(data)
            target.restore(state)
            target.free_state(state)
            first = self._run_of(source, steps[_BRANCH:])
            return self._same(first, self._run_of(target, steps[_BRANCH:])) + f", state of {len(data)} bytes"

    def reference(self, reference: ReferenceResults) -> str:
        first, last = reference.times[0], reference.times[-1]
        found: Trajectory = []
        with self._fmu.instantiate("reference") as slave:
            slave.set(reference.parameters)
            slave.initialize(first, last)
            for begin, end in pairwise((first, *reference.times)):
                # By the experiment's own steps: some outputs are about the last step.
                count = round((end - begin) / (self._fmu.description.step or math.inf)) or 1
                for k in range(count if end > begin else 0):
                    part = begin + (end - begin) * k / count
                    slave.step(part, begin + (end - begin) * (k + 1) / count - part)
                found.append(slave.get(reference.names))
        off, name, time = farthest(reference, found)
        limit = limit_for(self._fmu.description)
        if not off <= limit:
            raise FmuError(
                f"{name} at t = {time:.9g} s is off by {off:.2g} of its largest value in {reference.file}; "
                f"{limit:g} is the limit."
            )
        return (
            f"{len(reference.names)} outputs at {len(found)} points, off by at most {off:.1g} of their largest values"
        )

    def _start(self, slave: Instance) -> None:
        slave.initialize(seconds(self._grid.start), seconds(self._grid.stop))

    def _run_of(self, slave: Instance, steps: Sequence[tuple[int, int]]) -> Trajectory:
        trajectory = []
        for begin, end in steps:
            slave.step(*begin_and_size(begin, end))
            values = slave.get(self._outputs)
            for name, value in zip(self._outputs, values, strict=True):
                if isinstance(value, float) and not math.isfinite(value):
                    raise FmuError(f"{name} is {value} at t = {seconds(end):.9g} s.")
            trajectory.append(values)
        return trajectory

    def _same(self, first: Trajectory, second: Trajectory) -> str:
        for (_, end), before, after in zip(list(self._grid)[-len(first) :], first, second, strict=True):
            for name, one, other in zip(self._outputs, before, after, strict=True):
                if one != other:
                    raise FmuError(f"{name} was {one!r} at t = {seconds(end):.9g} s and is {other!r} now.")
        return f"{len(self._outputs)} outputs equal to the last bit at {len(first)} points"


def conformance_grid(description: Description) -> TimeGrid:
    """About a hundred steps through the default experiment, each a multiple of its step size."""
    stop = 1.0 if description.stop_time is None else description.stop_time
    smallest = stop / _STEPS if description.step is None else description.step
    return TimeGrid.of(stop, smallest * max(math.ceil(stop / smallest / _STEPS - 1e-9), 1))


#: How far the text of a start value may be rounded, by type.
_ROUNDED = {"Float32": 1e-6}


def _same_value(variable: Variable, value: Value) -> bool:
    """Whether the text of a start value means `value`; the text may be rounded in its last digit."""
    start = variable.start_value
    if isinstance(value, float) and start is not None:
        return math.isclose(float(start), value, rel_tol=_ROUNDED.get(variable.fmi_type, 1e-15))
    return str(start).lower() == value if variable.type == "Binary" else start == value
