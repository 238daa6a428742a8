"""Loops without any delay: found, told, and warned of when they do not settle."""

import pytest

from harness.fmu.description import Variable
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.running import loop_cautions, run_machine
from harness.machine.stepping import Jacobi
from harness.run.master import TimeGrid
from tests.harness.machine.fakes import Wheel


def wheels(*connections: Connection) -> Machine:
    """Their drag is the torque on them, at once; their speed is not."""
    return Machine({"one": Wheel("one"), "two": Wheel("two")}, connections)


def unsettled(machine: Machine) -> list[str]:
    outcome = run_machine(machine, Jacobi(), TimeGrid.of(0.5, 0.1), {})
    return [caution.text for caution in loop_cautions(machine, outcome.final_time)]


@pytest.mark.parametrize(("gain", "offset"), [(2.0, 1.0), (0.1, 1.0), (1.0, 0.0)])
def test_a_loop_is_told_and_warned_of_unless_it_settles(gain: float, offset: float) -> None:
    machine = wheels(
        Connection("one.drag", "two.torque", gain=gain), Connection("two.drag", "one.torque", offset=offset)
    )
    assert machine.structure.loops == [["two.torque", "one.torque"]]
    warnings = unsettled(machine)
    if offset:
        assert len(warnings) == 1
        assert "exchanges ended while a loop without any delay was still changing" in warnings[0]
        assert "(two.torque, one.torque)" in warnings[0]
    else:
        assert warnings == []


def test_a_cycle_with_a_delay_is_no_loop() -> None:
    """The chain from torque to drag to torque ends; the shaft's speed follows nobody at once."""
    two = Wheel("two")
    two.description.variables["led"] = Variable("led", 99, "Real", "input", unit="rad/s")
    parts = {"one": Wheel("one"), "two": two}
    machine = Machine(parts, [Connection("one.speed", "two.led"), Connection("two.drag", "one.torque")])
    assert machine.structure.cycles == [["one", "two"]]
    assert machine.structure.loops == []
    assert unsettled(machine) == []


def test_an_output_that_tells_no_dependencies_may_follow_any_input() -> None:
    silent = Wheel("one")
    silent.description.variables["angle"] = Variable("angle", 1, "Real", "output", unit="N.m")
    machine = Machine({"one": silent}, [Connection("one.angle", "one.torque")])
    assert machine.structure.loops == [["one.torque"]]
