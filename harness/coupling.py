"""Several FMUs as one machine: connections carry outputs to inputs at common communication points.

A coupling is itself a `Slave`, whose variables are those of its parts with the part's name before them, as in
"gear_train.wheel_angle". So the master, recorders and tables of inputs that know one FMU know a machine.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from .description import Description, Value, Variable
from .errors import UsageError
from .si import Measure
from .slave import Slave
from .units import UnitMismatchError, Units


@dataclass(frozen=True)
class Connection:
    """What an input is during a step: gain times an output at the step's beginning, plus an offset.

    Attributes:
        source: "<part>.<output>".
        target: "<part>.<input>"; its unit must measure the same quantity, and the source is converted to it.
        gain: not 0.
        offset: in the unit of the target.
        rate: "<part>.<output>", the source's derivative: the input goes on at this rate during the step, if its FMU
            takes slopes of inputs. Else it is held, and lags half a step behind on the average.
    """

    source: str
    target: str
    gain: float = 1.0
    offset: float = 0.0
    rate: str | None = None


class Coupling:
    """FMUs that exchange outputs before every step, then all take it (Jacobi's scheme: their order does not matter).

    Args:
        slaves: the parts by name.
        connections: each input at most once.
        model: name of the machine.

    Raises:
        UsageError: a connection that cannot be; the message says which and why.
    """

    def __init__(self, slaves: Mapping[str, Slave], connections: Sequence[Connection], model: str = "Machine") -> None:
        self._slaves = dict(slaves)
        units = _units(self._slaves)
        variables = {v.name: v for name, slave in slaves.items() for v in _variables(name, slave.description)}
        self.description = Description(model, model, "", variables, units)
        self._links = [self._link(connection) for connection in connections]
        for link in self._links:
            if not variables[link.target].settable:
                raise UsageError(f"{link.target} has two connections; an input can have only one.")
            # Nobody else may set it, and it is worth recording.
            variables[link.target] = replace(variables[link.target], causality="output")

    def set(self, values: Mapping[str, Value]) -> None:
        """Set variables by name.

        Raises:
            UsageError: a variable that is connected.
        """
        for name in values:
            if not self.description.variable(name).settable:
                raise UsageError(f"'{name}' is no free input or parameter of the machine and cannot be set.")
        self._set(values)

    def set_slopes(self, slopes: Mapping[str, float]) -> None:
        """Let inputs of parts that take slopes change linearly in the next step."""
        for part, own in _by_part(list(slopes)).items():
            self._slaves[part].set_slopes({name: slopes[f"{part}.{name}"] for name in own})

    def get(self, names: Sequence[str]) -> list[Value]:
        """Values of variables, in the order of `names`."""
        values: dict[str, Value] = {}
        for part, own in _by_part(names).items():
            values |= zip((f"{part}.{name}" for name in own), self._slaves[part].get(own), strict=True)
        return [values[name] for name in names]

    def initialize(self, start_time: float, stop_time: float) -> None:
        """Initialize the parts one by one, and exchange what they then put out."""
        for slave in self._slaves.values():
            slave.initialize(start_time, stop_time)
        self._exchange()

    def step(self, time: float, size: float) -> None:
        """Exchange, then advance all parts from `time` by `size` [s]."""
        self._exchange()
        self._pass_slopes()
        for slave in self._slaves.values():
            slave.step(time, size)

    def terminate(self) -> None:
        """End the run of all parts."""
        for slave in self._slaves.values():
            slave.terminate()

    def _exchange(self) -> None:
        """Set connected inputs from outputs until nothing changes any more: some outputs follow an input at once.

        As often as there are parts, at most: longer chains than that are loops, which are not solved.
        """
        known: dict[str, Value] = {}
        for _ in self._slaves:
            outputs = self.get([link.source for link in self._links])
            inputs: dict[str, Value] = {
                link.target: link.factor * float(value) + link.offset
                for link, value in zip(self._links, outputs, strict=True)
            }
            if inputs == known:
                break
            self._set(inputs)
            known = inputs

    def _pass_slopes(self) -> None:
        """Let inputs with a rate go on at it during the next step."""
        links = [link for link in self._links if link.rate]
        rates = self.get([link.rate for link in links if link.rate])
        self.set_slopes({link.target: link.factor * float(rate) for link, rate in zip(links, rates, strict=True)})

    def _set(self, values: Mapping[str, Value]) -> None:
        for part, own in _by_part(list(values)).items():
            self._slaves[part].set({name: values[f"{part}.{name}"] for name in own})

    def _link(self, connection: Connection) -> _Link:
        where = f"Connection from '{connection.source}' to '{connection.target}'"
        source, target = (self._end(name, where) for name in (connection.source, connection.target))
        if source.causality != "output" or source.type != "Real":
            raise UsageError(f"{where}: the source is no Real output, but {_what(source)}; connect an output.")
        if target.causality != "input" or target.type != "Real":
            raise UsageError(f"{where}: the target is no Real input, but {_what(target)}; connect an input.")
        if not (math.isfinite(connection.gain) and math.isfinite(connection.offset)) or connection.gain == 0.0:
            numbers = f"gain = {connection.gain:g}, offset = {connection.offset:g}"
            raise UsageError(f"{where}: {numbers}; give finite numbers, and a gain that is not 0.")
        if bool(source.unit) != bool(target.unit):
            raise UsageError(f"{where}: one has the unit {source.unit or target.unit}, the other none.")
        try:
            shift, one = (self.description.units.convert(x, source.unit, target.unit) for x in (0.0, 1.0))
        except UnitMismatchError as mismatch:
            raise UsageError(f"{where}: {mismatch}.") from None
        factor, offset = connection.gain * (one - shift), connection.gain * shift + connection.offset
        return _Link(source.name, target.name, factor, offset, self._rate(connection, source, where))

    def _rate(self, connection: Connection, source: Variable, where: str) -> str | None:
        """The rate of a connection whose target's part takes slopes."""
        if connection.rate is None:
            return None
        rate = self._end(connection.rate, where)
        if rate.causality != "output" or rate.type != "Real":
            raise UsageError(f"{where}: the rate is no Real output, but {_what(rate)}.")
        try:
            same = self.description.units.convert(1.0, rate.unit, f"{source.unit}/s") == 1.0
        except UnitMismatchError:
            same = False
        if not same:
            raise UsageError(
                f"{where}: the rate '{rate.name}' is in {rate.unit or '1'}, not in {source.unit or '1'}/s."
            )
        takes = self._slaves[connection.target.partition(".")[0]].description.takes_slopes
        return rate.name if takes else None

    def _end(self, name: str, where: str) -> Variable:
        part, dot, _ = name.partition(".")
        if not dot or part not in self._slaves:
            raise UsageError(f"{where}: '{name}' is none of <part>.<variable>; parts: {', '.join(self._slaves)}.")
        return self.description.variable(name)


@dataclass(frozen=True)
class _Link:
    """A connection whose unit conversion is worked out: target = factor * source + offset.

    `rate` is None where the target is held during a step.
    """

    source: str
    target: str
    factor: float
    offset: float
    rate: str | None


def _variables(part: str, description: Description) -> Iterator[Variable]:
    for variable in description.variables.values():
        yield replace(variable, name=f"{part}.{variable.name}")


def _by_part(names: Sequence[str]) -> dict[str, list[str]]:
    """Names without their part, by part."""
    parts: dict[str, list[str]] = {}
    for name in names:
        part, _, own = name.partition(".")
        parts.setdefault(part, []).append(own)
    return parts


def _units(slaves: Mapping[str, Slave]) -> Units:
    """The units of all parts, which must mean the same by the same name."""
    defined: dict[str, Measure] = {}
    displayed: dict[str, dict[str, tuple[float, float]]] = {}
    for part, slave in slaves.items():
        units = slave.description.units
        defined |= _agreed(defined, units.defined, part)
        for name, displays in units.displayed.items():
            displayed[name] = {**displayed.get(name, {}), **_agreed(displayed.get(name, {}), displays, part)}
    return Units(defined, displayed)


_Meaning = TypeVar("_Meaning")


def _agreed(known: Mapping[str, _Meaning], more: Mapping[str, _Meaning], part: str) -> Mapping[str, _Meaning]:
    for name in known.keys() & more.keys():
        if known[name] != more[name]:
            raise UsageError(f"The unit '{name}' means one thing in {part} and another in a part before it.")
    return more


def _what(variable: Variable) -> str:
    return f"of causality {variable.causality} and type {variable.type}"
