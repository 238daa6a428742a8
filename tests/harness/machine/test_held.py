"""Signals that are held: of every kind, converted where the connection says so, and never in between."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import pytest

from harness.errors import UsageError
from harness.fmu.description import Description, Value, Variable
from harness.fmu.interface import whole_step
from harness.machine.connection import Connection, linked
from harness.machine.machine import Machine
from harness.machine.part import Extrapolation
from harness.machine.running import run_machine
from harness.machine.stepping import Algorithm, EventAware, GaussSeidel, Jacobi
from harness.run.master import Ending, TimeGrid
from tests.harness.machine.fakes import WheelReals

_KINDS = {"on": "Boolean", "count": "Integer", "mode": "Integer", "note": "String", "level": "Real"}


def variables(causality: str) -> list[Variable]:
    found = []
    for k, (name, kind) in enumerate(_KINDS.items()):
        fmi_type = "Enumeration" if name == "mode" else ""
        first = 10 if causality == "input" else 0
        side = "in" if causality == "input" else "out"
        found.append(
            Variable(
                f"{name}_{side}",
                first + k,
                kind,
                causality,
                fmi_type=fmi_type,
                continuous=kind == "Real" and causality == "input",
                depends_on=frozenset(),
                start={"Boolean": "false", "String": ""}.get(kind, "0"),
            )
        )
    return found


class Switch:
    """At 0.25 s its outputs change, within a step; it keeps every value that it is given, with the time."""

    def __init__(self, name: str) -> None:
        self.name = name
        both = [*variables("output"), *variables("input")]
        self.description = Description(name, name, "", {v.name: v for v in both}, saves_state=True, takes_slopes=True)
        self.values: dict[str, Value] = {v.name: self._start(v) for v in both}
        self.time = 0.0
        self.told: list[tuple[float, dict[str, Value]]] = []
        self.slopes: list[float] = []

    @staticmethod
    def _start(variable: Variable) -> Value:
        value = variable.start_value
        assert value is not None
        return value

    def set(self, values: Mapping[str, Value]) -> None:
        for name, value in values.items():
            known = {"Real": float, "Integer": int, "Boolean": bool, "String": str}
            assert type(value) is known[self.description.variables[name].type]
        self.values |= values
        self.told.append((self.time, dict(values)))

    def set_slopes(self, slopes: Mapping[str, float]) -> None:
        self.slopes += slopes.values()

    def get(self, names: Sequence[str]) -> list[Value]:
        return [self.values[name] for name in names]

    def reals(self, names: Sequence[str]) -> WheelReals:
        return WheelReals(self, list(names))

    def initialize(self, start_time: float, stop_time: float) -> None:
        self.enter_initialization(start_time, stop_time)
        self.exit_initialization()

    def enter_initialization(self, start_time: float, stop_time: float) -> None:
        self.time = start_time

    def exit_initialization(self) -> None:
        pass

    def advance(self, time: float, size: float) -> float:
        self.time = time + size
        if self.time > 0.25:
            self.values |= {"on_out": True, "count_out": 3, "mode_out": 2, "note_out": "moved", "level_out": 1.5}
        return self.time

    def step(self, time: float, size: float) -> None:
        whole_step(self.advance, time, size)

    def terminate(self) -> None:
        pass

    def save(self, state: object = None) -> object:
        return self.time, dict(self.values)

    def restore(self, state: object) -> None:
        self.time, values = state  # type: ignore[misc]
        self.values = dict(values)

    def free_state(self, state: object) -> None:
        pass


def run(algorithm: type[Jacobi | GaussSeidel | EventAware], *connections: Connection) -> Switch:
    one, two = Switch("one"), Switch("two")
    machine = Machine({"one": one, "two": two}, connections, Extrapolation.DERIVATIVES)
    made: Algorithm = EventAware(machine) if algorithm is EventAware else algorithm()  # type: ignore[call-arg]
    outcome = run_machine(machine, made, TimeGrid.of(0.5, 0.1), {})
    assert outcome.ending is Ending.COMPLETED, outcome.error
    return two


@pytest.mark.parametrize("algorithm", [Jacobi, GaussSeidel, EventAware])
def test_each_kind_is_held_and_changes_where_it_is_seen(algorithm) -> None:
    """What happens at 0.25 s takes effect at the communication point behind it, 0.3 s, at once and as a whole."""
    two = run(algorithm, *(Connection(f"one.{name}_out", f"two.{name}_in") for name in _KINDS))
    expected = {"on_in": True, "count_in": 3, "mode_in": 2, "note_in": "moved", "level_in": 1.5}
    assert {name: two.values[name] for name in expected} == expected
    later = [(time, values) for time, values in two.told if time > 0.0]
    assert [(pytest.approx(0.3), expected)] == later
    assert two.slopes == []


@pytest.mark.parametrize(
    ("source", "target", "value"),
    [
        ("on", "count", 1),
        ("on", "mode", 1),
        ("on", "level", 1.0),
        ("count", "on", True),
        ("count", "mode", 3),
        ("count", "level", 3.0),
        ("mode", "count", 2),
        ("mode", "on", True),
        ("mode", "level", 2.0),
    ],
)
def test_kinds_are_converted(source: str, target: str, value: Value) -> None:
    plain = Connection(f"one.{source}_out", f"two.{target}_in")
    with pytest.raises(UsageError, match="say convert = true"):
        run(Jacobi, plain)
    two = run(Jacobi, Connection(plain.source, plain.target, convert=True))
    found = two.values[f"{target}_in"]
    assert found == value
    assert type(found) is type(value)


def test_gain_and_offset_of_a_switch() -> None:
    """A torque that is switched on: 0.5 as long as it is off, then 2.5."""
    switched = Connection("one.on_out", "two.level_in", gain=2.0, offset=0.5, convert=True)
    told = [values["level_in"] for _, values in run(Jacobi, switched).told]
    assert told[0] == 0.5
    assert told[-1] == 2.5


@pytest.mark.parametrize(
    ("connection", "said"),
    [
        (
            Connection("one.on_out", "two.count_in"),
            r"^connection one.on_out -> two.count_in: Boolean to Integer \(false = 0, true = 1\); say convert = true.$",
        ),
        (Connection("one.level_out", "two.count_in", convert=True), "Real to Integer cannot be converted"),
        (Connection("one.note_out", "two.count_in", convert=True), "String to Integer cannot be converted"),
        (Connection("one.count_out", "two.note_in", convert=True), "Integer to String cannot be converted"),
        (Connection("one.on_out", "two.on_in", gain=2.0), "a gain or an offset goes with Real inputs only"),
        (Connection("one.level_out", "two.level_in", rate="one.level_out"), "a signal that is held has no rate"),
    ],
)
def test_what_cannot_be(connection: Connection, said: str) -> None:
    machine = Description(
        "M",
        "M",
        "",
        {
            name: replaced
            for part, kind in (("one", "output"), ("two", "input"))
            for v in variables(kind)
            for name, replaced in [(f"{part}.{v.name}", _named(v, f"{part}.{v.name}"))]
        },
    )
    with pytest.raises(UsageError, match=said):
        linked(connection, machine)


def _named(variable: Variable, name: str) -> Variable:
    return replace(variable, name=name)


def test_a_part_that_was_put_back_is_told_again() -> None:
    """The value is part of what was put back, so it is set anew."""
    one, two = Switch("one"), Switch("two")
    machine = Machine({"one": one, "two": two}, [Connection("one.on_out", "two.on_in")])
    machine.initialize(0.0, 1.0)
    state = two.save()
    one.values["on_out"] = True
    machine.exchange(100_000_000)
    two.restore(state)
    machine.restored("two")
    machine.exchange(100_000_000)
    assert two.values["on_in"] is True


def test_a_loop_of_switches_that_does_not_settle_is_counted() -> None:
    class Inverter(Switch):
        """Its output is the opposite of its input, at once."""

        def get(self, names: Sequence[str]) -> list[Value]:
            self.values["on_out"] = not self.values["on_in"]
            return super().get(names)

    machine = Machine({"one": Inverter("one")}, [Connection("one.on_out", "one.on_in")])
    machine.initialize(0.0, 1.0)
    assert machine.unsettled == 1
