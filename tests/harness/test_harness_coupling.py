"""Coupling of FMUs: what is connected to what, in which unit, when it is exchanged, and what a bond reckons."""

import math
from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
import pytest

from harness.bonds import Bond, bond_energy
from harness.clock import TimeGrid
from harness.coupling import Connection, Coupling
from harness.description import Description, Value, Variable
from harness.errors import FmuError, UsageError
from harness.master import Ending, run_fixed_step
from harness.recorder import Recorder, recorded_variables
from harness.si import Measure
from harness.units import Units
from tests.harness.fake_slave import UNITS


class Mass:
    """A mass on a line, moved exactly by a force that is held; and a spring from `x` to `rest`, which pulls."""

    def __init__(self, *, slopes: bool = False, units: Units = UNITS, fails_at: float = math.inf) -> None:
        variables = (
            Variable("force", 0, "Real", "input", unit="N"),
            Variable("rest", 1, "Real", "input", unit="m"),
            Variable("x", 2, "Real", "output", unit="m"),
            Variable("v", 3, "Real", "output", unit="m/s"),
            Variable("pull", 4, "Real", "output", unit="N"),
            Variable("count", 5, "Integer", "output"),
            Variable("ratio", 6, "Real", "output"),
            Variable("mass", 7, "Real", "parameter", unit="kg"),
            Variable("plain", 8, "Real", "input"),
            Variable("angle", 9, "Real", "input", unit="rad"),
        )
        self.description = Description("Mass", "mass", "", {v.name: v for v in variables}, units, takes_slopes=slopes)
        self.values: dict[str, Value] = {v.name: 0.0 for v in variables} | {"mass": 1.0, "count": 0}
        self.slopes: dict[str, float] = {}
        self.calls: list[str] = []
        self._fails_at = fails_at

    def initialize(self, start_time: float, stop_time: float) -> None:
        self.calls.append(f"initialize {start_time:g} {stop_time:g}")

    def set(self, values: Mapping[str, Value]) -> None:
        self.values |= values

    def set_slopes(self, slopes: Mapping[str, float]) -> None:
        assert self.description.takes_slopes
        self.slopes = dict(slopes)

    def get(self, names: Sequence[str]) -> list[Value]:
        self.values["pull"] = 3.0 * (float(self.values["rest"]) - float(self.values["x"]))
        return [self.values[name] for name in names]

    def step(self, time: float, size: float) -> None:
        if time >= self._fails_at:
            raise FmuError("the mass has had enough")
        self.calls.append(f"step {time:g} {size:g}")
        a = float(self.values["force"]) / float(self.values["mass"])
        v = float(self.values["v"])
        self.values["x"] = float(self.values["x"]) + v * size + a * size * size / 2
        self.values["v"] = v + a * size
        for name, slope in self.slopes.items():
            self.values[name] = float(self.values[name]) + slope * size
        self.slopes = {}

    def terminate(self) -> None:
        self.calls.append("terminate")


def test_variables_of_parts_have_the_parts_name() -> None:
    one, two = Mass(), Mass()
    pair = Coupling({"one": one, "two": two}, [Connection("one.pull", "two.force")])
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
    pair = Coupling({"one": one, "two": two}, [Connection("one.x", "two.rest", gain=-2.0, offset=0.1)])
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
            self.values = {"celsius": 20.0, "millimetres": 250.0}

        def get(self, names: Sequence[str]) -> list[Value]:
            return [self.values[name] for name in names]

    one, two, mass = Thermometer(), Thermometer(), Mass()
    connections = [
        Connection("one.celsius", "two.kelvin", gain=2.0, offset=1.0),
        Connection("one.millimetres", "mass.rest"),
    ]
    Coupling({"one": one, "two": two, "mass": mass}, connections).initialize(0.0, 1.0)
    assert two.values["kelvin"] == pytest.approx(2.0 * 293.15 + 1.0, rel=1e-14)
    assert mass.values["rest"] == pytest.approx(0.25, rel=1e-14)


@pytest.mark.parametrize(
    ("connection", "message"),
    [
        (Connection("three.x", "two.rest"), "'three.x' is none of <part>.<variable>; parts: one, two"),
        (Connection("x", "two.rest"), "none of <part>.<variable>"),
        (Connection("one.z", "two.rest"), "has no variable 'one.z'"),
        (Connection("one.force", "two.rest"), "source is no Real output, but of causality input"),
        (Connection("one.count", "two.rest"), "source is no Real output, but of causality output and type Integer"),
        (Connection("one.x", "two.mass"), "target is no Real input, but of causality parameter"),
        (Connection("one.x", "two.angle"), "unit 'm' does not measure the same quantity"),
        (Connection("one.ratio", "two.rest"), "one has the unit m, the other none"),
        (Connection("one.x", "two.plain"), "one has the unit m, the other none"),
        (Connection("one.x", "two.rest", gain=0.0), "gain = 0, offset = 0; give finite numbers"),
        (Connection("one.x", "two.rest", offset=math.nan), "offset = nan"),
        (Connection("one.x", "two.rest", rate="one.x"), "the rate 'one.x' is in m, not in m/s"),
        (Connection("one.x", "two.rest", rate="one.count"), "the rate is no Real output"),
    ],
)
def test_a_connection_that_cannot_be_is_refused(connection: Connection, message: str) -> None:
    with pytest.raises(UsageError) as refusal:
        Coupling({"one": Mass(), "two": Mass()}, [connection])
    assert message in str(refusal.value)


def test_an_input_has_one_source_only() -> None:
    twice = [Connection("one.x", "two.rest"), Connection("one.x", "two.rest")]
    with pytest.raises(UsageError, match=r"two\.rest has two connections"):
        Coupling({"one": Mass(), "two": Mass()}, twice)
    pair = Coupling({"one": Mass(), "two": Mass()}, twice[:1])
    with pytest.raises(UsageError, match=r"'two.rest' is no free input or parameter"):
        pair.set({"two.rest": 1.0})


def test_a_unit_that_means_two_things_is_refused() -> None:
    other = Units(defined={"m": Measure(UNITS.defined["m"].exponents, 2.0)})
    with pytest.raises(UsageError, match="The unit 'm' means one thing in two and another"):
        Coupling({"one": Mass(), "two": Mass(units=other)}, [])


def test_what_follows_an_input_at_once_is_exchanged_at_once() -> None:
    """Pull depends on rest at the same instant: one.x -> two.rest, two.pull -> three.force."""
    one, two, three = Mass(), Mass(), Mass()
    one.values["x"] = 0.5
    chain = [Connection("one.x", "two.rest"), Connection("two.pull", "three.force")]
    Coupling({"three": three, "two": two, "one": one}, chain).initialize(0.0, 1.0)
    assert three.values["force"] == pytest.approx(1.5)


def test_all_parts_take_every_step_of_the_grid_and_are_ended() -> None:
    one, two = Mass(), Mass()
    pair = Coupling({"one": one, "two": two}, [Connection("one.pull", "two.force")])
    outcome = run_fixed_step(pair, TimeGrid.of(0.25, 0.1), {})
    assert outcome.ending is Ending.COMPLETED
    assert one.calls == two.calls == ["initialize 0 0.25", "step 0 0.1", "step 0.1 0.1", "step 0.2 0.05", "terminate"]


def test_a_part_that_fails_ends_the_run_there() -> None:
    pair = Coupling({"one": Mass(), "two": Mass(fails_at=0.2)}, [])
    outcome = run_fixed_step(pair, TimeGrid.of(1.0, 0.1), {})
    assert (outcome.ending, outcome.final_time) == (Ending.FAILED, 0.2)
    assert str(outcome.error) == "the mass has had enough"


def oscillation(step: float) -> float:
    """Largest error of a mass on the spring of another part: x = 1 - cos(sqrt(3) t)."""
    mass, spring = Mass(), Mass()
    connections = [
        Connection("mass.x", "spring.rest"),
        Connection("spring.pull", "mass.force", gain=-1.0, offset=3.0),
    ]
    pair = Coupling({"mass": mass, "spring": spring}, connections)
    recorder = Recorder(recorded_variables(pair.description))
    run_fixed_step(pair, TimeGrid.of(2.0, step), {}, [recorder])
    table = recorder.table()
    return float(np.abs(table["mass.x"] - 1 + np.cos(math.sqrt(3.0) * table["time"])).max())


def test_held_inputs_converge_with_the_first_order() -> None:
    errors = [oscillation(step) for step in (0.02, 0.01, 0.005)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx([1.0, 1.0], abs=0.1)


@pytest.mark.parametrize("slopes", [False, True])
def test_slopes_go_to_parts_that_take_them(slopes: bool) -> None:
    one, two = Mass(), Mass(slopes=slopes)
    one.values["v"] = 0.5
    pair = Coupling({"one": one, "two": two}, [Connection("one.x", "two.rest", gain=2.0, rate="one.v")])
    pair.initialize(0.0, 1.0)
    pair.step(0.0, 0.1)
    assert one.values["x"] == pytest.approx(0.05)
    assert two.values["rest"] == pytest.approx(0.1 if slopes else 0.0)


def test_a_bond_reckons_what_each_side_had() -> None:
    """Driver with speed 1 + t, driven part with torque 2 - t; steps of 0.5 in which each has the other's old value."""
    bond = Bond(Connection("a.speed", "b.speed"), Connection("b.torque", "a.load", gain=-1.0))
    results = pd.DataFrame(
        {
            "time": [0.0, 0.5, 1.0],
            "a.speed": [1.0, 1.5, 2.0],
            "b.speed": [1.0, 1.0, 1.5],
            "b.torque": [2.0, 1.5, 1.0],
            "a.load": [-2.0, -2.0, -1.5],
        }
    )
    energy = bond_energy(results, bond)
    assert energy.given == pytest.approx(0.5 * (2.0 * 1.25 + 1.5 * 1.75))
    assert energy.taken == pytest.approx(0.5 * (1.75 * 1.0 + 1.25 * 1.5))
    assert energy.made == pytest.approx(energy.taken - energy.given)
    assert energy.most == energy.given
