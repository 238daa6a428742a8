"""A simulation unit without a simulation: what a master needs of one, and a record of what it was asked."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from harness.errors import FmuError, LogMessage, Status
from harness.fmu.description import Description, Value, Variable
from harness.fmu.units import BASE_UNITS, Measure, Units

_SLOTS = 8
_FIELDS = ("time", "velocity")


def measure(**exponents: int) -> Measure:
    return Measure(tuple(exponents.get(base, 0) for base in BASE_UNITS))


UNITS = Units(
    defined={
        "rad": measure(rad=1),
        "N.m": measure(kg=1, m=2, s=-2),
        "m": measure(m=1),
        "kg.m2": measure(kg=1, m=2),
        "rad/s": measure(rad=1, s=-1),
        "K": measure(K=1),
    },
    displayed={
        "rad": {"deg": (57.29577951308232, 0.0)},
        "rad/s": {"rpm": (9.549296585513721, 0.0)},
        "K": {"degC": (1.0, -273.15)},
    },
)


def fake_description() -> Description:
    inputs = [
        Variable("drive_torque", 0, "Real", "input", unit="N.m", continuous=True, start="0.001"),
        Variable("gear", 1, "Integer", "input", start="1"),
        Variable("brake", 2, "Boolean", "input", start="false"),
    ]
    outputs = [
        Variable("wheel_angle", 10, "Real", "output", unit="rad", display_unit="deg", continuous=True),
        Variable("impact_count", 11, "Integer", "output"),
        Variable("impact", 12, "Boolean", "output"),
        Variable("impacts_in_step", 13, "Integer", "output"),
        Variable("impacts_lost", 14, "Integer", "output"),
    ]
    buffered = [
        Variable(f"impacts[{slot}].{field}", 100 + 10 * slot + k, "Real", "output", unit=("s", "m/s")[k])
        for slot in range(1, _SLOTS + 1)
        for k, field in enumerate(_FIELDS)
    ]
    parameters = [
        Variable(
            "tooth_slope_angle", 20, "Real", "parameter", unit="rad", display_unit="deg", start="1.5", maximum=3.0
        ),
        Variable("tooth_count", 21, "Integer", "parameter", start="10", minimum=3.0),
        Variable("guided", 22, "Boolean", "parameter", start="true"),
        Variable("restitution", 23, "Real", "parameter", start="0", minimum=0.0, maximum=1.0),
        Variable("crank_inertia", 24, "Real", "parameter", unit="kg.m2", start="9e-5"),
        Variable("oil_temperature", 25, "Real", "parameter", unit="K", start="293.15"),
        Variable("note", 26, "String", "parameter", start=""),
        Variable("tooth_pitch", 27, "Real", "calculatedParameter", unit="rad"),
    ]
    variables = {v.name: v for v in [*inputs, *outputs, *buffered, *parameters]}
    return Description("Fake", "Fake", "{guid}", variables, units=UNITS, stop_time=1.0, step=1e-3)


class FakeSlave:
    """A unit whose impacts are given and whose wheel turns with 1 rad/s.

    Attributes:
        calls: (time, size) of every step.
        values: of all variables.
        log: names of the other calls, in order.
        messages: none.
    """

    def __init__(self, impacts: Sequence[float] = (), fail: Callable[[float], Status | None] = lambda _: None) -> None:
        self.description = fake_description()
        self.calls: list[tuple[float, float]] = []
        self.log: list[str] = []
        self.messages: list[LogMessage] = []
        self.values: dict[str, Value] = dict.fromkeys(self.description.variables, 0)
        self._impacts = impacts
        self._count = 0
        self._lost = 0
        self._fail = fail

    def initialize(self, start_time: float, stop_time: float) -> None:
        self.log.append("initialize")

    def set(self, values: Mapping[str, Value]) -> None:
        self.values.update(values)

    def get(self, names: Sequence[str]) -> list[Value]:
        return [self.values[name] for name in names]

    def step(self, time: float, size: float) -> None:
        status = self._fail(time)
        if status is not None:
            raise FmuError(f"refused at {time:g} s", time=time, status=status)
        self.calls.append((time, size))
        hits = [t for t in self._impacts if time < t <= time + size]
        self.values["wheel_angle"] = time + size
        self._count += len(hits)
        self.values["impact_count"] = self._count
        self.values["impact"] = bool(hits)
        self.values["impacts_in_step"] = min(len(hits), _SLOTS)
        self._lost += max(len(hits) - _SLOTS, 0)
        self.values["impacts_lost"] = self._lost
        for slot, instant in enumerate(hits[:_SLOTS], start=1):
            self.values[f"impacts[{slot}].time"] = instant
            self.values[f"impacts[{slot}].velocity"] = -2.0 * instant

    def terminate(self) -> None:
        self.log.append("terminate")


class FakeFmu:
    """An FMU whose only instance is a `FakeSlave`."""

    path = Path("Fake.fmu")

    def __init__(self, slave: FakeSlave, folder: Path = Path("nowhere")) -> None:
        self.description = slave.description
        self.folder = folder
        self._slave = slave

    @contextmanager
    def instantiate(self, _name: str, _on_message: Callable[[LogMessage], None]) -> Iterator[FakeSlave]:
        yield self._slave
