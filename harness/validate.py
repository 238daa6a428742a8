"""Does an FMU keep what it promises? A check of the file, then a short life of two instances."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import pairwise

import fmpy.validation

from .checks import Check
from .clock import TimeGrid, begin_and_size, seconds
from .description import Description, Value, Variable
from .errors import FmuError, HarnessError
from .reference_results import ReferenceResults, farthest, limit_for, read_reference
from .slave import Instance, Instances

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
            trajectory = self._through(slave, list(self._grid))
        return f"{len(trajectory)} steps to {seconds(self._grid.stop):g} s"

    def reset(self) -> str:
        with self._fmu.instantiate("reset") as slave:
            self._start(slave)
            first = self._through(slave, list(self._grid))
            slave.reset()
            self._start(slave)
            return self._same(first, self._through(slave, list(self._grid)))

    def rollback(self) -> str:
        with self._fmu.instantiate("rollback") as slave:
            self._start(slave)
            steps = list(self._grid)
            self._through(slave, steps[:_BRANCH])
            state = slave.save()
            first = self._through(slave, steps[_BRANCH:])
            slave.restore(state)
            slave.free_state(state)
            return self._same(first, self._through(slave, steps[_BRANCH:]))

    def transfer(self) -> str:
        steps = list(self._grid)
        with self._fmu.instantiate("source") as source, self._fmu.instantiate("target") as target:
            self._start(source)
            self._through(source, steps[:_BRANCH])
            state = source.save()
            data = source.serialize(state)
            source.free_state(state)
            self._start(target)
            state = target.deserialize(data)
            target.restore(state)
            target.free_state(state)
            first = self._through(source, steps[_BRANCH:])
            return self._same(first, self._through(target, steps[_BRANCH:])) + f", state of {len(data)} bytes"

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

    def _through(self, slave: Instance, steps: Sequence[tuple[int, int]]) -> Trajectory:
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
    if variable.type == "Binary":
        return str(start).lower() == value
    return start == value
