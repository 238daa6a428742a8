"""Co-simulation of components that follow each other's outputs; an algorithm decides how they take a step."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from ..errors import UsageError
from ..fmu.description import Value
from ..fmu.interface import Component
from ..run.inputs import InputSignals
from ..run.master import SECOND
from .connection import Connection, Link, own_of, part_of
from .event_iteration import Events
from .exchange import Driven, Held, initialize
from .part import Extrapolation, Part
from .structure import in_order, structure_of

_NOTHING: Mapping[str, Sequence[float]] = {}

#: So little, relatively, is rounding in a loop without delay; what is smaller than the other is nothing at all.
_SETTLED, _NOTHING_LEFT = 1e-9, 1e-9

#: Where a connected input gets its value, factor * values[place] + offset, from the values of a part's outputs as they
#: were last read. A plain tuple, because every step takes it apart.
_Wire = tuple[Sequence[float], int, float, float]


class Machine:
    """Components as one unit, whose variables are theirs with the part's name before them: "ratchet.wheel_angle".

    Every method raises `FmuError` when a component refuses or fails.

    Args:
        components: by the names of the parts.
        connections: what inputs follow.
        model: name of the machine.

    Attributes:
        structure: how the components hang together.
        description: of the machine, as if it were one FMU (`Structure.description`).
        parts: by name, each behind those that it follows.
        point: number of the run's communication point that is reached; None between two, where an algorithm may stop.
        unsettled: how often an exchange ended while a loop without delay (`Structure.loops`) still changed inputs.
        extrapolation: of inputs between communication points.
        reads_once: all outputs are read before inputs are set, as other tools' masters do: feedthrough is a step late.
    """

    def __init__(
        self,
        components: Mapping[str, Component],
        connections: Sequence[Connection] = (),
        extrapolation: Extrapolation = Extrapolation.CONSTANT,
        model: str = "Machine",
        *,
        reads_once: bool = False,
    ) -> None:
        """Connect components.

        Raises:
            UsageError: a connection that cannot be; the message says which and why.
        """
        descriptions = {name: component.description for name, component in components.items()}
        self.structure = structure_of(descriptions, connections, model)
        self.description = self.structure.description
        links = [link for link in self.structure.links if not link.held]
        self.unsettled = 0
        self.point: int | None = 0
        self.extrapolation = extrapolation
        self.reads_once = reads_once
        self._holds = extrapolation is Extrapolation.CONSTANT
        self.parts = {name: _connected(name, components[name], links) for name in self.structure.order}
        self._held = Held(self.parts, [link for link in self.structure.links if link.held and not link.ticks])
        self._events = Events(
            self.parts, [link for link in in_order(self.structure.links, self.description) if link.ticks]
        )
        self._links = len(links)
        # What a step looks at, without detours.
        self._outputs = {name: part.outputs for name, part in self.parts.items()}
        for outputs in self._outputs.values():
            outputs.remembers = not self._holds
        self._refreshers = [outputs.refresh for outputs in self._outputs.values() if outputs.names]
        self._inputs = {name: part.inputs for name, part in self.parts.items() if part.targets}
        wired = {name: self._wired(name, links) for name in self._inputs}
        self._wires = {name: [wire for _, wire in wires] for name, wires in wired.items()}
        self._bends = {name: [(source, k, factor) for source, (_, k, factor, _) in wired[name]] for name in wired}
        self._followed = {name: frozenset(source for source, _ in wires) for name, wires in wired.items()}
        self._feedthrough = {name: part.feedthrough for name, part in self.parts.items()}
        self._given: dict[str, list[float]] = {}
        self._slopes: dict[str, Sequence[float]] = {}
        self._driven: Driven | None = None

    def set(self, values: Mapping[str, Value]) -> None:
        """Set variables by name.

        Args:
            values: by "<part>.<variable>", each in its unit.

        Raises:
            UsageError: a variable that is connected or not to be set, or that there is not.
        """
        for name in values:
            if not self.description.variable(name).settable:
                raise UsageError(f"'{name}' is no free input or parameter of the machine and cannot be set.")
        for part, own in _by_part(list(values)).items():
            self.parts[part].component.set({name: values[f"{part}.{name}"] for name in own})

    def get(self, names: Sequence[str]) -> list[Value]:
        """Values of variables, in the order of `names`.

        Args:
            names: "<part>.<variable>".
        """
        values: dict[str, Value] = {}
        for part, own in _by_part(names).items():
            values |= zip((f"{part}.{name}" for name in own), self.parts[part].component.get(own), strict=True)
        return [values[name] for name in names]

    def drive(self, signals: InputSignals, start: int) -> None:
        """Let a table drive inputs, before the initialization; they must be set as it says for `start` [ns].

        They change with each exchange; in a step, Real ones go on to what it says for the end, unless inputs are held.

        Args:
            signals: the table, for variables of the machine.
            start: time of the start [ns].
        """
        self._driven = Driven(self.parts, signals, start)

    def initialize(self, start_time: float, stop_time: float) -> None:
        """Initialize the parts, each with the outputs of those that it follows, and exchange until nothing changes.

        Args:
            start_time: of the run [s].
            stop_time: of the run [s].
        """
        links = [link for link in self.structure.links if not link.ticks]
        initialize(self.parts, links, self.structure.groups, start_time, stop_time)
        self.exchange(round(start_time * SECOND))

    def terminate(self) -> None:
        """End the run of all parts."""
        for part in self.parts.values():
            part.component.terminate()

    def free_states(self) -> None:
        """Release all snapshots."""
        for part in self.parts.values():
            part.forget()

    def exchange(self, time: int) -> None:
        """Read all outputs at `time` [ns], and let inputs be what they follow.

        Outputs that follow an input at once are read again when it has changed, at most as often as there are connected
        inputs: longer chains are loops without delay, solved only if that is enough. Events that are due are handled.

        Args:
            time: communication point that is reached [ns].
        """
        self._slopes.clear()
        if self._driven is not None:
            self._driven.exchange(time)
        self._pass_on(time)
        if self._events.due():
            self._events.handle(lambda: self._changes(time))
            for name in self._events.names:
                self._outputs[name].jumped()

    def _changes(self, time: int) -> bool:
        """Pass on; whether inputs that are held have changed, or those of a part in event mode."""
        before = [self._given.get(name) for name in self._events.names]
        held = self._pass_on(time)
        return held or before != [self._given.get(name) for name in self._events.names]

    def _pass_on(self, time: int) -> bool:
        """Let inputs be what they follow; whether one that is held has changed."""
        if self.reads_once:
            return self._pass_on_once(time)
        self._flow(time)
        if not self._held:
            return False
        for number in range(len(self._held) + 1):
            self._held.read()
            if not self._held.write():
                return number > 0
            self._flow(time)
        self.unsettled += 1
        return True

    def _pass_on_once(self, time: int) -> bool:
        """Read all outputs, then set all inputs."""
        for outputs in self._outputs.values():
            outputs.read(time)
        self._held.read()
        for name in self._wires:
            self._write(name)
        return self._held.write()

    def _flow(self, time: int) -> None:
        """The exchange of what is continuous."""
        if self._holds:
            for refresh in self._refreshers:
                refresh()
        else:
            for outputs in self._outputs.values():
                outputs.read(time)
        names: Iterable[str] = self._wires
        for _ in range(self._links):
            changed = [name for name in names if self._write(name)]
            if not changed:
                return
            for name in changed:
                self._outputs[name].read(time)
            names = [name for name, sources in self._followed.items() if not sources.isdisjoint(changed)]
        self.unsettled += any(self._is_changing(name) for name in names)
        self._given.clear()

    def give_all(self, begin: int, end: int) -> None:
        """`give` every part, before any of them takes the step.

        Args:
            begin: of the step [ns], for which outputs were exchanged.
            end: of the step [ns].
        """
        if self._holds and len(self._given) == len(self._wires):
            return  # the exchange has left nothing to do
        for name in self._wires:
            self.give(name, begin, end)
        for name in () if self._driven is None else self._driven.parts:
            if name not in self._wires:
                self.give(name, begin, end)

    def give(self, name: str, begin: int, end: int, known: Mapping[str, Sequence[float]] = _NOTHING) -> None:
        """Let a part's inputs be what they follow, and go on during a step.

        A part that takes no slopes has its inputs held at what they would be in the middle of the step.

        Args:
            name: of the part.
            begin: of the step [ns], for which outputs were exchanged.
            end: of the step [ns].
            known: slopes of the outputs of parts that have already taken it [unit/s]; others are extrapolated.
        """
        if self._driven is not None and not self._holds:
            self._driven.give(name, begin, end)
        if name not in self._given:
            if name not in self._wires:
                return
            self._write(name)
        if self._holds and (not known or known.keys().isdisjoint(self._followed[name])):
            return
        part = self.parts[name]
        self.foresee([name], known)
        slopes = self._slopes
        if known:
            slopes = {**slopes, **known}
        changes = [factor * slopes[source][place] for source, place, factor in self._bends[name]]
        if self.extrapolation is Extrapolation.DERIVATIVES:
            # b t^2 / 2, with the bend b, has the mean of (b span / 3) t: so much is felt of it, to third order.
            third = (end - begin) / SECOND / 3
            for k, (source, place, factor) in enumerate(self._bends[name]):
                if source not in known:
                    changes[k] += factor * third * self._outputs[source].bends[place]
        if part.takes_slopes:
            part.slopes.values[:] = changes
            part.slopes.write_slopes()
            self._given.pop(name, None)  # at the end of the step, they are where their slopes have brought them
            return
        half = (end - begin) / SECOND / 2
        given = self._given.pop(name)
        part.inputs.values[:] = [value + change * half for value, change in zip(given, changes, strict=True)]
        part.inputs.write()

    def foresee(self, names: Sequence[str], known: Mapping[str, Sequence[float]] = _NOTHING) -> None:
        """Ask for the slopes that `give` needs for parts, while what they follow has not gone on yet.

        Args:
            names: of the parts.
            known: slopes by the name of a part [unit/s], which are not asked for.
        """
        for name in names:
            for source in self._followed.get(name, ()):
                if source not in self._slopes and source not in known:
                    self._slopes[source] = self.extrapolation.slopes(self._outputs[source])

    def restored(self, name: str) -> None:
        """A part was put back: what its inputs are is not known any more.

        Args:
            name: of the part.
        """
        self._given.pop(name, None)
        self._held.restored(name)
        if self._driven is not None:
            self._driven.restored(name)

    def _write(self, name: str) -> bool:
        """Set a part's connected inputs from outputs as they were last read.

        Whether one has changed that a connected output of the part follows at once.
        """
        now = [factor * values[place] + offset for values, place, factor, offset in self._wires[name]]
        before = self._given.get(name)
        if before == now:
            return False
        inputs = self._inputs[name]
        inputs.values[:] = now
        inputs.write()
        self._given[name] = now
        for k in self._feedthrough[name]:  # noqa: SIM110 any() takes twice as long
            if before is None or before[k] != now[k]:
                return True
        return False

    def _is_changing(self, name: str) -> bool:
        """Whether a part's connected inputs are not what they follow, beyond rounding."""
        now = [factor * values[place] + offset for values, place, factor, offset in self._wires[name]]
        given = self._given.get(name, now)
        return any(abs(a - b) > _SETTLED * max(abs(a), abs(b), _NOTHING_LEFT) for a, b in zip(now, given, strict=True))

    def _wired(self, name: str, links: Sequence[Link]) -> list[tuple[str, _Wire]]:
        """What each connected input of a part follows: which part, and which of its outputs."""
        by_target = {link.target: link for link in links}
        found: list[tuple[str, _Wire]] = []
        for target in self.parts[name].targets:
            link = by_target[f"{name}.{target}"]
            source, _, output = link.source.partition(".")
            outputs = self._outputs[source]
            found.append((source, (outputs.values, outputs.names.index(output), link.factor, link.offset)))
        return found


def _connected(name: str, component: Component, links: Sequence[Link]) -> Part:
    """A part with its connected outputs and inputs."""
    own = [link for link in links if part_of(link.source) == name]
    sources = {own_of(link.source): "" for link in own}
    sources |= {own_of(link.source): own_of(link.rate) for link in own if link.rate}
    targets = [own_of(link.target) for link in links if part_of(link.target) == name]
    scales = {own_of(link.source): link.rate_factor for link in own if link.rate}
    return Part(
        component, list(sources), list(sources.values()), targets, [scales.get(source, 1.0) for source in sources]
    )


def _by_part(names: Sequence[str]) -> dict[str, list[str]]:
    """Names without their part, by part."""
    parts: dict[str, list[str]] = {}
    for name in names:
        part, _, own = name.partition(".")
        parts.setdefault(part, []).append(own)
    return parts
