"""Machines: what is connected to what, in which unit, when it is exchanged, and in which order."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import permutations

import pytest
from hypothesis import given, strategies as st

from harness.errors import FmuError, Status, UsageError
from harness.fmu.description import Description, Value, Variable
from harness.fmu.units import Measure, Units
from harness.machine.connection import Connection, linked, units_of_parts
from harness.machine.machine import Machine
from harness.machine.part import Extrapolation
from harness.machine.running import run_machine
from harness.machine.stepping import Jacobi
from harness.machine.structure import dependency_order
from harness.run.master import SECOND, Ending, TimeGrid, recorded_variables
from tests.harness.fake_slave import UNITS, measure
from tests.harness.machine.mass import Mass


def test_variables_of_parts_have_the_parts_name() -> None:
    one, two = Mass(), Mass()
    pair = Machine({"one": one, "two": two}, [Connection("one.pull", "two.force")])
    pair.set({"one.mass": 2.0, "two.rest": 0.5})
    assert pair.get(["two.rest", "one.mass", "two.mass"]) == [0.5, 2.0, 1.0]
    assert (one.values["mass"], two.values["rest"]) == (2.0, 0.5)
    assert pair.description.variable("one.x").unit == "m"
    recorded = [v.name for v in recorded_variables(pair.description)]
    assert "two.force" in recorded
    assert "one.mass" not in recorded


def test_inputs_are_gain_times_outputs_plus_offset_in_their_own_unit() -> None:
    one, two = Mass(), Mass()
    one.values["x"] = 0.25
    pair = Machine({"one": one, "two": two}, [Connection("one.x", "two.rest", gain=-2.0, offset=0.1)])
    pair.initialize(0.0, 1.0)
    assert two.values["rest"] == pytest.approx(-0.4, rel=1e-15)


def test_units_are_converted() -> None:
    class Thermometer(Mass):
        def __init__(self) -> None:
            super().__init__()
            variables = [
                Variable("celsius", 20, "Real", "output", unit="degC"),
                Variable("millimetres", 21, "Real", "output", unit="mm"),
                Variable("kelvin", 22, "Real", "input", unit="K"),
            ]
            self.description = Description("T", "t", "", {v.name: v for v in variables}, UNITS)
            self.values = {"celsius": 20.0, "millimetres": 250.0, "kelvin": 0.0}

        def get(self, names: Sequence[str]) -> list[Value]:
            return [self.values[name] for name in names]

    one, two, mass = Thermometer(), Thermometer(), Mass()
    connections = [
        Connection("one.celsius", "two.kelvin", gain=2.0, offset=1.0),
        Connection("one.millimetres", "mass.rest"),
    ]
    Machine({"one": one, "two": two, "mass": mass}, connections).initialize(0.0, 1.0)
    assert two.values["kelvin"] == pytest.approx(2.0 * 293.15 + 1.0, rel=1e-14)
    assert mass.values["rest"] == pytest.approx(0.25, rel=1e-14)


@pytest.mark.parametrize(
    ("connection", "message"),
    [
        (Connection("three.x", "two.rest"), "'three.x' is none of <part>.<variable>; parts: one, two"),
        (Connection("x", "two.rest"), "none of <part>.<variable>"),
        (Connection("one.z", "two.rest"), "has no variable 'one.z'"),
        (Connection("one.force", "two.rest"), "source is no output, but of causality input"),
        (Connection("one.count", "two.rest"), "connection one.count -> two.rest: Integer to Real; say convert = true"),
        (Connection("one.x", "two.mass"), "target is no input, but of causality parameter"),
        (Connection("one.x", "two.angle"), "unit 'm' does not measure the same quantity"),
        (Connection("one.x", "two.rest", gain=0.0), "gain = 0, offset = 0; give finite numbers"),
        (Connection("one.x", "two.rest", offset=math.nan), "offset = nan"),
        (
            Connection("one.x", "two.rest", rate="one.x"),
            "the rate 'one.x' is in m, which does not measure the same as m/s",
        ),
        (Connection("one.x", "two.rest", rate="one.count"), "the rate is no Real output"),
    ],
)
def test_a_connection_that_cannot_be_is_refused(connection: Connection, message: str) -> None:
    with pytest.raises(UsageError) as refusal:
        Machine({"one": Mass(), "two": Mass()}, [connection])
    assert message in str(refusal.value)


def test_an_input_has_one_source_only() -> None:
    twice = [Connection("one.x", "two.rest"), Connection("one.x", "two.rest")]
    with pytest.raises(UsageError, match=r"two\.rest has two connections"):
        Machine({"one": Mass(), "two": Mass()}, twice)
    pair = Machine({"one": Mass(), "two": Mass()}, twice[:1])
    with pytest.raises(UsageError, match=r"'two.rest' is no free input or parameter"):
        pair.set({"two.rest": 1.0})


def test_a_unit_that_means_two_things_is_converted_where_it_is_connected() -> None:
    other = Units(defined={"m": Measure(UNITS.defined["m"].exponents, 2.0)})
    pair = Machine({"one": Mass(), "two": Mass(units=other)}, [Connection("one.x", "two.rest")])
    pair.parts["one"].component.set({"x": 3.0})
    pair.exchange(0)
    assert pair.get(["two.rest"]) == [1.5]
    whole = Machine({"one": Mass(), "two": Mass(units=other)}).description
    back = linked(Connection("two.x", "one.rest", 3.0, 1.0), whole)
    assert (back.factor, back.offset) == (6.0, 1.0)
    third = Units(defined={"m": UNITS.defined["rad"]})
    with pytest.raises(UsageError, match="unit 'm', as one defines it, does not measure the same quantity as 'm'"):
        Machine({"one": Mass(), "two": Mass(units=third)}, [Connection("one.x", "two.rest")])
    Machine({"one": Mass(), "two": Mass(units=third)}, [])


@pytest.mark.parametrize(
    ("name", "foreign"),
    [
        ("m", Measure(UNITS.defined["m"].exponents, 1.0 + 5e-10)),
        ("rad/s", Measure(measure(s=-1).exponents)),  # as many tools define it
    ],
)
def test_tools_need_not_agree_to_the_last_bit(name: str, foreign: Measure) -> None:
    displayed = {"rad": {"deg": (57.2957795130823, 0.0)}}  # ours has 57.29577951308232
    whole = units_of_parts({"one": UNITS, "two": Units({**UNITS.defined, name: foreign}, displayed)})
    assert whole.disputed == frozenset()
    assert whole.displayed["rad"] == UNITS.displayed["rad"]
    assert whole.defined[name] == UNITS.defined[name]
    first = units_of_parts({"two": Units({name: foreign}), "one": UNITS})
    assert first.meaning(name) == Measure(UNITS.defined[name].exponents, foreign.factor)


def test_no_unit_is_the_unit_of_the_other_end() -> None:
    bare = {v.name: replace(v, unit="") for v in Mass().description.variables.values()}
    two = Mass()
    two.description = replace(two.description, variables=bare)
    whole = Machine({"one": Mass(), "two": two}).description
    for ends in (("one.x", "two.rest"), ("two.x", "one.rest")):
        link = linked(Connection(*ends, 2.0, 0.5, rate=ends[0].replace("x", "v")), whole)
        assert (link.factor, link.offset) == (2.0, 0.5)


def test_what_follows_an_input_at_once_is_exchanged_at_once() -> None:
    """Pull depends on rest at the same instant: one.x -> two.rest, two.pull -> three.force."""
    one, two, three = Mass(), Mass(), Mass()
    one.values["x"] = 0.5
    chain = [Connection("one.x", "two.rest"), Connection("two.pull", "three.force")]
    Machine({"three": three, "two": two, "one": one}, chain).initialize(0.0, 1.0)
    assert three.values["force"] == pytest.approx(1.5)


def test_all_parts_take_every_step_of_the_grid_and_are_ended() -> None:
    one, two = Mass(), Mass()
    pair = Machine({"one": one, "two": two}, [Connection("one.pull", "two.force")])
    outcome = run_machine(pair, Jacobi(), TimeGrid.of(0.25, 0.1), {})
    assert outcome.ending is Ending.COMPLETED
    assert one.calls == two.calls == ["initialize 0 0.25", "step 0 0.1", "step 0.1 0.1", "step 0.2 0.05", "terminate"]


def test_a_part_that_fails_ends_the_run_there() -> None:
    pair = Machine({"one": Mass(), "two": Mass(fails_at=0.2)}, [])
    outcome = run_machine(pair, Jacobi(), TimeGrid.of(1.0, 0.1), {})
    assert (outcome.ending, outcome.final_time) == (Ending.FAILED, 0.2)
    assert str(outcome.error) == "the mass has had enough"


@pytest.mark.parametrize("slopes", [False, True])
def test_slopes_go_to_parts_that_take_them_and_others_are_held_at_the_middle(slopes: bool) -> None:
    one, two = Mass(), Mass(slopes=slopes)
    one.values["v"] = 0.5
    connections = [Connection("one.x", "two.rest", gain=2.0, rate="one.v")]
    pair = Machine({"one": one, "two": two}, connections, Extrapolation.DERIVATIVES)
    pair.initialize(0.0, 1.0)
    pair.give("two", 0, SECOND // 10)
    assert two.values["rest"] == pytest.approx(0.0 if slopes else 0.05)
    two.step(0.0, 0.1)
    assert two.values["rest"] == pytest.approx(0.1 if slopes else 0.05)


@pytest.mark.parametrize(("unit", "rate"), [("km/s", 0.5e-3), ("mm/s", 500.0), ("m/ms", 0.5e-3), ("", 0.5)])
def test_a_rate_in_another_unit_is_converted(unit: str, rate: float) -> None:
    """0.5 m/s, in whatever unit the output is: the input goes on as if it were said in m/s."""
    one, two = Mass(), Mass(slopes=True)
    known = one.description.variables
    one.description = replace(one.description, variables={**known, "v": replace(known["v"], unit=unit)})
    one.values["v"] = rate
    connections = [
        Connection("one.x", "two.rest", gain=2.0, rate="one.v"),
        *([Connection("one.v", "two.plain")] if unit == "mm/s" else []),  # followed, too: read with the others
    ]
    pair = Machine({"one": one, "two": two}, connections, Extrapolation.DERIVATIVES)
    pair.initialize(0.0, 1.0)
    pair.give("two", 0, SECOND // 10)
    assert two.slopes["rest"] == pytest.approx(2.0 * 0.5)


def test_a_machine_that_reads_once_passes_on_what_outputs_were() -> None:
    """A pull follows the rest at once: read again, it reaches the third mass now; read once, a step later."""
    for reads_once, expected in ((False, 3.0), (True, 0.0)):
        one, two, three = (Mass(name) for name in ("one", "two", "three"))
        chain = [Connection("one.x", "two.rest"), Connection("two.pull", "three.force")]
        machine = Machine({"one": one, "two": two, "three": three}, chain, reads_once=reads_once)
        machine.initialize(0.0, 1.0)
        one.values["x"] = 1.0
        machine.exchange(SECOND)
        assert (two.values["rest"], three.values["force"]) == (1.0, expected)
        machine.exchange(2 * SECOND)
        assert three.values["force"] == 3.0


def test_parts_are_initialized_behind_those_that_they_follow() -> None:
    """So each finds its start with the inputs that it will have."""
    seen = {}

    class Looks(Mass):
        def exit_initialization(self) -> None:
            seen[self.name] = self.values["rest"]

    one, two, three = (Looks(name) for name in ("one", "two", "three"))
    one.values["x"], two.values["x"] = 0.5, 0.25
    chain = [Connection("one.x", "two.rest"), Connection("two.x", "three.rest")]
    Machine({"three": three, "two": two, "one": one}, chain).initialize(0.0, 1.0)
    assert seen == {"one": 0.0, "two": 0.5, "three": 0.25}


class Starts(Mass):
    """Notes what it is told when it is initialized; tells its outputs only then, if it is late."""

    def __init__(self, name: str, late: Status | None = None, start: str | None = None) -> None:
        super().__init__(name)
        variables = self.description.variables
        variables["x"] = replace(variables["x"], start=start)
        self.values["force"] = 7.0
        self.late = late
        self.seen: tuple[Value, Value] | None = None

    def get(self, names: Sequence[str]) -> list[Value]:
        if self.late is not None and self.seen is None:
            raise FmuError("not yet", status=self.late)
        return super().get(names)

    def exit_initialization(self) -> None:
        self.seen = self.values["rest"], self.values["force"]


#: The mass one leads the spring of two, which pulls at one; and three follows two.
CYCLE = (Connection("one.x", "two.rest"), Connection("two.pull", "one.force"), Connection("two.pull", "three.force"))


@pytest.mark.parametrize("names", list(permutations(("one", "two", "three"))))
def test_parts_of_a_cycle_are_initialized_together_in_any_order(names: Sequence[str]) -> None:
    parts = {name: Starts(name) for name in names}
    parts["one"].values["x"] = 0.5
    Machine(parts, CYCLE).initialize(0.0, 1.0)
    assert {name: part.seen for name, part in parts.items()} == {"one": (0, 1.5), "two": (0.5, 7), "three": (0, 1.5)}


@pytest.mark.parametrize("names", list(permutations(("one", "two", "three"))))
@pytest.mark.parametrize(("start", "rest", "force"), [(None, 0.25, 0.75), ("0.125", 0.125, 0.375)])
def test_an_output_that_is_not_told_early_counts_as_declared_or_not_at_all(
    names: Sequence[str], start: str | None, rest: float, force: float
) -> None:
    parts = {name: Starts(name, Status.DISCARD if name == "one" else None, start) for name in names}
    parts["one"].values["x"], parts["two"].values["rest"] = 0.5, 0.25
    Machine(parts, CYCLE).initialize(0.0, 1.0)
    assert parts["two"].seen == (rest, 7.0)
    assert parts["one"].seen == (0.0, force)
    assert parts["three"].values["force"] == 1.5


def test_an_end_in_the_initialization_mode_is_one() -> None:
    parts = {name: Starts(name, Status.FATAL) for name in ("one", "two", "three")}
    outcome = run_machine(Machine(parts, CYCLE), Jacobi(), TimeGrid.of(1.0, 0.1), {})
    assert outcome.ending is Ending.FAILED


def test_what_a_part_is_told_already_is_not_told_again() -> None:
    told = []

    class Counts(Mass):
        def set(self, values: Mapping[str, Value]) -> None:
            told.append(values)
            super().set(values)

    pair = Machine({"one": Mass(), "two": Counts()}, [Connection("one.x", "two.rest")])
    run_machine(pair, Jacobi(), TimeGrid.of(1.0, 0.1), {})
    assert told == [{"rest": 0.0}] * 2  # for its initialization, and behind it


NODES = "abcdefg"


@given(st.lists(st.tuples(st.sampled_from(NODES), st.sampled_from(NODES)), max_size=14))
def test_each_comes_behind_those_that_it_follows_but_in_cycles(edges: list[tuple[str, str]]) -> None:
    order, cycles = dependency_order(NODES, edges)
    assert sorted(order) == list(NODES)
    within = {node: k for k, cycle in enumerate(cycles) for node in cycle}
    for before, behind in edges:
        together = before in within and within.get(before) == within.get(behind)
        assert together or order.index(before) < order.index(behind)
    reach = {node: {node} for node in NODES}
    for _ in NODES:
        for before, behind in edges:
            for known in reach.values():
                if before in known:
                    known.add(behind)
    for node in NODES:
        others = {other for other in NODES if other != node and other in reach[node] and node in reach[other]}
        assert {
            other for other in NODES if other != node and node in within and within.get(other) == within[node]
        } == others
