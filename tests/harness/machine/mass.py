"""A component that keeps what it is told, and says when it was called."""

import math
from collections.abc import Mapping, MutableSequence, Sequence

from harness.errors import FmuError
from harness.fmu.description import Description, Value, Variable
from harness.fmu.units import Units
from tests.harness.fake_slave import UNITS


class Mass:
    """A mass on a line, moved exactly by a force that is held; and a spring from `x` to `rest`, which pulls."""

    def __init__(
        self, name: str = "mass", *, slopes: bool = False, units: Units = UNITS, fails_at: float = math.inf
    ) -> None:
        variables = (
            Variable("force", 0, "Real", "input", continuous=True, unit="N"),
            Variable("rest", 1, "Real", "input", continuous=True, unit="m"),
            Variable("x", 2, "Real", "output", continuous=True, unit="m"),
            Variable("v", 3, "Real", "output", continuous=True, unit="m/s"),
            Variable("pull", 4, "Real", "output", continuous=True, unit="N"),
            Variable("count", 5, "Integer", "output"),
            Variable("ratio", 6, "Real", "output", continuous=True),
            Variable("mass", 7, "Real", "parameter", unit="kg"),
            Variable("plain", 8, "Real", "input", continuous=True),
            Variable("angle", 9, "Real", "input", continuous=True, unit="rad"),
        )
        self.description = Description("Mass", "mass", "", {v.name: v for v in variables}, units, takes_slopes=slopes)
        self.name = name
        self.values: dict[str, Value] = {v.name: 0.0 for v in variables} | {"mass": 1.0, "count": 0}
        self.slopes: dict[str, float] = {}
        self.calls: list[str] = []
        self._fails_at = fails_at

    def initialize(self, start_time: float, stop_time: float) -> None:
        self.enter_initialization(start_time, stop_time)
        self.exit_initialization()

    def enter_initialization(self, start_time: float, stop_time: float) -> None:
        self.calls.append(f"initialize {start_time:g} {stop_time:g}")

    def exit_initialization(self) -> None:
        pass

    def set(self, values: Mapping[str, Value]) -> None:
        self.values |= values

    def set_slopes(self, slopes: Mapping[str, float]) -> None:
        assert self.description.takes_slopes
        self.slopes |= slopes

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

    def advance(self, time: float, size: float) -> float:
        self.step(time, size)
        return time + size

    def save(self, state: object = None) -> object:
        return dict(self.values)

    def restore(self, state: dict[str, Value]) -> None:
        self.values = dict(state)

    def free_state(self, state: object) -> None:
        pass

    def reals(self, names: Sequence[str]) -> "MassReals":
        return MassReals(self, list(names))


class MassReals:
    """Bound variables of a `Mass`."""

    def __init__(self, mass: Mass, names: list[str]) -> None:
        self._mass, self._names = mass, names
        self.values: MutableSequence[float] = [0.0] * len(names)

    def read(self) -> None:
        self.values[:] = [float(value) for value in self._mass.get(self._names)]

    def read_slopes(self) -> bool:
        return False

    def write(self) -> None:
        self._mass.set(dict(zip(self._names, self.values, strict=True)))

    def write_slopes(self) -> None:
        self._mass.set_slopes(dict(zip(self._names, self.values, strict=True)))
