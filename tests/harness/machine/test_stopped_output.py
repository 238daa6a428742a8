"""An output that stops: inputs that went on at its slope must come back to it."""

from collections.abc import Sequence

import pytest

from harness.fmu.description import Value
from harness.machine.connection import Connection
from harness.machine.machine import Machine
from harness.machine.part import Extrapolation
from harness.machine.stepping import Jacobi
from harness.run.master import SECOND
from tests.harness.machine.fakes import Wheel


class Stopping(Wheel):
    """Its drag grows until 0.2 s, then stays."""

    def step(self, time: float, size: float) -> None:
        super().step(time, size)
        self.values["drag"] = min(time + size, 0.2)

    def get(self, names: Sequence[str]) -> list[Value]:
        return [self.values[name] for name in names]


@pytest.mark.parametrize("extrapolation", [Extrapolation.LINEAR, Extrapolation.DERIVATIVES])
def test_an_input_does_not_stay_where_its_slope_has_brought_it(extrapolation: Extrapolation) -> None:
    driven = Wheel("driven")
    machine = Machine({"stop": Stopping(), "driven": driven}, [Connection("stop.drag", "driven.torque")], extrapolation)
    machine.initialize(0.0, 1.0)
    for k in range(6):
        Jacobi().advance(machine, k * SECOND // 10, (k + 1) * SECOND // 10)
    assert driven.values["torque"] == 0.2
