"""What is told of how components fared."""

import json
from collections import Counter
from collections.abc import Sequence

import pytest

from harness.app.terminal import console, show_table
from harness.errors import Status
from harness.fmu.description import Value
from harness.fmu.values import real_time_factor
from harness.machine import part
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.observers import watched
from harness.machine.observers.bonds import BondEnergy
from harness.machine.observers.component_impacts import Impacts
from harness.machine.observers.watched import HEADINGS, REST, STATISTICS_UNITS, statistics, statistics_rows
from harness.machine.running import bond_cautions, cautions, run_machine
from harness.machine.stepping import Adaptive, EventAware, Jacobi
from harness.run.master import TimeGrid
from tests.harness.machine.fakes import Wheel


def test_steps_rollbacks_and_time_are_told_by_component() -> None:
    machine = Machine({"one": Wheel("one", (0.234,)), "two": Wheel("two")})
    run_machine(machine, EventAware(machine), TimeGrid.of(0.5, 0.1), {})
    told = statistics(machine)
    # the step with the impact is taken three times: as a whole, to the impact, and from there
    assert [(one["steps"], one["rollbacks"]) for one in told.values()] == [(7, 1), (7, 1)]
    assert told["two"]["shortest_step"] == pytest.approx(0.034)
    assert told["two"]["longest_step"] == 0.1
    assert all(one.keys() == STATISTICS_UNITS.keys() for one in told.values())
    assert json.loads(json.dumps(told)) == told


def test_the_time_is_the_component_s_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """A step takes 2 ms; to read its impacts takes 20 ms, which count for those who want to know."""
    now = 0

    class Slow(Wheel):
        def step(self, time: float, size: float) -> None:
            nonlocal now
            now += 2_000_000
            super().step(time, size)

        def get(self, names: Sequence[str]) -> list[Value]:
            nonlocal now
            now += 20_000_000
            return super().get(names)

    for module in (part, watched):
        monkeypatch.setattr(module, "perf_counter_ns", lambda: now)
    machine = Machine({"slow": Slow("slow")})
    run_machine(machine, Jacobi(), TimeGrid.of(0.5, 0.1), {}, [Impacts(machine)])
    told = statistics(machine)["slow"]
    assert told["time_per_step"] == pytest.approx(0.002)
    assert told["time_spent"] == pytest.approx(0.01)


def test_a_table_for_the_terminal_has_units_and_the_rest_of_the_time() -> None:
    machine = Machine({"one": Wheel("one"), "two": Wheel("two")})
    run_machine(machine, Jacobi(), TimeGrid.of(0.5, 0.1), {})
    rows = statistics_rows(machine, 10.0)
    assert [row[:3] for row in rows] == [["one", "5", "0"], ["two", "5", "0"], [REST, "", ""]]
    assert all(len(row) == len(HEADINGS) for row in rows)
    assert rows[0][-2:] == ["0.1", "0.1"]
    assert float(rows[2][3]) == pytest.approx(10.0, abs=0.1)
    with console.capture() as captured:
        show_table("Components", HEADINGS, rows, numeric=range(1, len(HEADINGS)))
    assert "rollbacks" in captured.get()


def test_a_narrow_terminal_cuts_no_number_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(console, "_width", 76)
    headings = ["component", *(f"number {k} [1]" for k in range(5))]
    with console.capture() as captured:
        show_table("Wide", headings, [["one", *["12345.6789"] * 5]], range(1, 6))
    assert captured.get().count("12345.6789") == 5


def test_a_machine_that_never_stepped_has_statistics_too() -> None:
    machine = Machine({"one": Wheel("one")})
    assert statistics(machine)["one"]["time_per_step"] == 0.0
    assert statistics_rows(machine, 0.0)[0][3:5] == ["0", "0"]


def test_the_real_time_factor_is_simulated_time_by_wall_time() -> None:
    assert real_time_factor(60.0, 8.0) == "7.5 x real time"
    assert real_time_factor(1.0, 0.0) == "-"


def test_who_feels_impacts_late_is_said() -> None:
    parts = {"one": Wheel("one", (0.15,), restores=False), "two": Wheel("two")}
    told = cautions(EventAware(Machine(parts)))
    assert [(message.instance, message.status) for message in told] == [("one", Status.WARNING)]
    assert "cannot be put back (canGetAndSetFMUstate)" in told[0].text
    assert cautions(EventAware(Machine({"two": Wheel("two")}))) == []
    assert cautions(Jacobi()) == []


def test_steps_that_are_too_long_for_a_tolerance_are_said() -> None:
    machine = Machine({"one": Wheel("one"), "two": Wheel("two")}, [Connection("one.drag", "two.torque")])
    algorithm = Adaptive(machine, 1e-4)
    assert cautions(algorithm) == []
    algorithm.too_small = 3
    assert "3 steps missed the tolerance 0.0001" in cautions(algorithm)[0].text


def test_a_coupling_that_makes_much_energy_is_told() -> None:
    energies = {
        "shaft": BondEnergy(-151.0, 524.0, 152.0),
        "belt": BondEnergy(1.0, 1.02, 1.1),
        "idle": BondEnergy(0, 0, 0),
    }
    (told,) = bond_cautions(energies, 2.0)
    assert "over the bond 'shaft', the coupling itself has made 675 J, where 152 J passed at most" in told.text
    (lost,) = bond_cautions({"shaft": BondEnergy(1.0, 0.9, 1.0)}, 2.0)
    assert "has lost 0.1 J" in lost.text
    assert lost.time == 2.0


def test_time_spent_in_saving_and_restoring_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    """A step takes 2 ms, a snapshot 30 ms, going back to it 500 ms."""
    now, calls = 0, Counter[str]()
    cost = {"step": 2_000_000, "save": 30_000_000, "restore": 500_000_000}

    class Slow(Wheel):
        def step(self, time: float, size: float) -> None:
            self.spend("step")
            super().step(time, size)

        def save(self, state: object = None) -> object:
            self.spend("save")
            return super().save(state)

        def restore(self, state: object) -> None:
            self.spend("restore")
            super().restore(state)

        def spend(self, call: str) -> None:
            nonlocal now
            now += cost[call]
            calls[call] += 1

    for module in (part, watched):
        monkeypatch.setattr(module, "perf_counter_ns", lambda: now)
    machine = Machine({"slow": Slow("slow", (0.234,))})
    run_machine(machine, EventAware(machine), TimeGrid.of(0.5, 0.1), {})
    told = statistics(machine)["slow"]
    assert (calls["restore"], told["rollbacks"]) == (1, 1)
    assert calls["save"] >= 5
    assert told["steps"] == calls["step"]
    assert told["time_spent"] == pytest.approx(sum(calls[call] * cost[call] for call in cost) / 1e9, rel=1e-12)
    assert told["time_per_step"] == pytest.approx(told["time_spent"] / told["steps"], rel=1e-12)
