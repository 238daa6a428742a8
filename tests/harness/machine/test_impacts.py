"""Impacts of a machine's components: each once, whatever the algorithm; with stress and damage by component."""

from dataclasses import replace
from typing import Any

import pytest

from harness.analysis.stress import damage_of_impacts
from harness.fmu.interface import Observable
from harness.machine.machine import Machine
from harness.machine.observers.component_impacts import Impacts
from harness.machine.running import run_machine
from harness.machine.stepping import Adaptive, EventAware, GaussSeidel, Jacobi
from harness.run.master import Ending, TimeGrid
from mechanism_fmu.stress import STEEL, STEEL_CARD, maximum_stress
from tests.declared import STRUCK
from tests.harness.machine.fakes import Trouble, Wheel

ALGORITHMS: dict[str, Any] = {
    "jacobi": lambda _: Jacobi(),
    "gauss_seidel": lambda _: GaussSeidel(),
    "event_aware": EventAware,
    "adaptive": lambda machine: Adaptive(machine, 1e-3),
}
ONE, TWO = (0.11, 0.12, 0.43), (0.115, 0.3)


def wheels() -> Machine:
    return Machine({"one": Wheel("one", ONE), "two": Wheel("two", TWO), "three": Wheel("three")})


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_every_impact_is_there_once(algorithm: str) -> None:
    """Also those in a step that is taken back, or in one of the many that the machine's step has."""
    machine = wheels()
    impacts = Impacts(machine)
    outcome = run_machine(machine, ALGORITHMS[algorithm](machine), TimeGrid.of(0.5, 0.1), {}, [impacts])
    assert outcome.error is None
    table = impacts.table(impacts.by_component())
    assert list(table["time"]) == sorted(ONE + TWO)
    assert list(table["component"]) == ["one", "two", "one", "two", "one"]
    # each impact doubles the speed
    assert list(table["velocity"]) == ([-1, -1, -2, -2, -4] if algorithm == "event_aware" else list(table["velocity"]))


@pytest.mark.parametrize("algorithm", ["jacobi", "gauss_seidel", "event_aware"])
def test_impacts_of_a_step_that_another_part_did_not_complete_have_not_happened(algorithm: str) -> None:
    failing = Wheel("two", trouble=Trouble(0.3, "error"))
    machine = Machine({"one": Wheel("one", (0.25, 0.33, 0.37, 0.38)), "two": failing})
    impacts = Impacts(machine)
    outcome = run_machine(machine, ALGORITHMS[algorithm](machine), TimeGrid.of(1.0, 0.1), {}, [impacts])
    assert (outcome.ending, outcome.final_time) == (Ending.FAILED, 0.3)
    one = impacts.by_component()["one"]
    assert (list(one.impacts["time"]), one.lost) == ([0.25], 0)


def test_stress_and_damage_are_those_of_each_component_alone() -> None:
    machine = wheels()
    impacts = Impacts(machine)
    machine.parts["two"].component.set({"tooth_length": 0.02})
    run_machine(machine, EventAware(machine), TimeGrid.of(0.5, 0.1), {}, [impacts])
    found = impacts.by_component()
    assert list(found) == ["one", "two", "three"]
    one, two, three = found.values()
    assert one.beam is not None
    assert two.beam is not None
    assert (one.beam.length, two.beam.length) == (0.01, 0.02)
    largest = maximum_stress(two.beam, STEEL, 2.0).stress
    assert two.impacts["stress_max"].max() == pytest.approx(largest, rel=1e-12)
    assert one.damage == damage_of_impacts(one.impacts, STRUCK, one.beam, STEEL_CARD)
    assert (len(three.impacts), three.damage) == (0, None)
    table = impacts.table(found)
    assert list(table) == list(impacts.units)
    assert impacts.units["stress_max"] == "Pa"
    assert table["stress_max"].notna().all()


def test_impacts_that_found_no_room_are_counted() -> None:
    machine = Machine({"one": Wheel("one", (0.01, 0.02, 0.03, 0.04, 0.15))})
    impacts = Impacts(machine)
    run_machine(machine, Jacobi(), TimeGrid.of(0.2, 0.1), {}, [impacts])
    assert impacts.by_component()["one"].lost == 2
    assert len(impacts.by_component()["one"].impacts) == 3


def test_it_tells_at_which_communication_points_there_were_impacts() -> None:
    machine = wheels()
    impacts = Impacts(machine)
    struck: list[float] = []

    class Watch:
        def started(self, unit: Observable, time: float) -> None:
            assert not impacts.struck

        def stepped(self, unit: Observable, time: float) -> None:
            if impacts.struck:
                struck.append(time)

    run_machine(machine, EventAware(machine), TimeGrid.of(0.5, 0.1), {}, [impacts, Watch()])
    assert struck == sorted(ONE + TWO)


def test_a_tooth_that_cannot_be_is_told_and_leaves_the_impacts() -> None:
    machine = wheels()
    machine.parts["one"].component.set({"tooth_apex_angle": 9.0})
    impacts = Impacts(machine)
    run_machine(machine, Jacobi(), TimeGrid.of(0.5, 0.1), {}, [impacts])
    one = impacts.by_component()["one"]
    assert "describe no tooth" in one.objection
    assert (one.beam, one.damage, len(one.impacts)) == (None, None, 3)


def test_impacts_without_a_stress_model_are_told_and_kept() -> None:
    impacts = Impacts(machine := Machine({"one": Wheel("one", (0.25,), speed=3e6)}))
    run_machine(machine, Jacobi(), TimeGrid.of(0.5, 0.1), {}, [impacts])
    one = impacts.by_component()["one"]
    assert "impacts without a stress model: impact velocity = -3e+06 m/s" in one.objection
    assert (one.beam, one.damage, len(one.impacts)) == (None, None, 1)


def test_components_without_impacts_have_no_table() -> None:
    plain = Wheel("plain")
    known = {n: v for n, v in plain.description.variables.items() if "impacts" not in n}
    plain.description = replace(plain.description, variables=known)
    impacts = Impacts(Machine({"plain": plain}))
    assert impacts.by_component() == {}
    assert impacts.table({}).empty


def test_what_has_another_unit_has_a_column_of_its_own() -> None:
    """As the closing speeds of a contact and of an angle stop."""
    other = Wheel("other", (0.22,))
    name = "impacts[1].velocity"
    changed = dict(other.description.variables) | {name: replace(other.description.variables[name], unit="rad/s")}
    other.description = replace(other.description, variables=changed)
    machine = Machine({"one": Wheel("one", (0.11,)), "other": other})
    impacts = Impacts(machine)
    run_machine(machine, EventAware(machine), TimeGrid.of(0.5, 0.1), {}, [impacts])
    assert (impacts.units["velocity"], impacts.units["velocity [rad/s]"]) == ("m/s", "rad/s")
    table = impacts.table(impacts.by_component())
    assert list(table["component"]) == ["one", "other"]
    assert table["velocity"].tolist() == [-1.0, pytest.approx(float("nan"), nan_ok=True)]
    assert table["velocity [rad/s]"].tolist() == [pytest.approx(float("nan"), nan_ok=True), -1.0]
