"""A wheel that a torque turns, exactly: with impacts at given times, and trouble on demand; it can be pickled."""

from __future__ import annotations

import copy
import math
import os
import signal
import time as clock
from collections.abc import Iterator, Mapping, MutableSequence, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from harness.errors import FmuError, LogMessage, Status
from harness.fmu.description import Description, Value, Variable
from harness.fmu.instances.message_log import MessageHandler
from tests.declared import TEETH
from tests.harness.fake_slave import UNITS

SLOTS = 2
FIELDS = {"time": "s", "velocity": "m/s"}


@dataclass(frozen=True)
class Trouble:
    """What goes wrong in the step that begins at `time` [s] or later."""

    time: float
    kind: str = "crash"


def description(restores: bool) -> Description:
    variables = [
        Variable("torque", 0, "Real", "input", continuous=True, unit="N.m"),
        Variable("angle", 1, "Real", "output", continuous=True, unit="rad", depends_on=frozenset()),
        Variable("speed", 2, "Real", "output", continuous=True, unit="rad/s", depends_on=frozenset()),
        Variable("drag", 3, "Real", "output", continuous=True, unit="N.m", depends_on=frozenset({"torque"})),
        Variable("steps", 4, "Integer", "output", depends_on=frozenset()),
        Variable("forward", 5, "Boolean", "output", depends_on=frozenset()),
        Variable("note", 6, "String", "output"),
        Variable("inertia", 7, "Real", "parameter", unit="kg.m2"),
        Variable("tooth_length", 8, "Real", "calculatedParameter", unit="m"),
        Variable("tooth_apex_angle", 9, "Real", "calculatedParameter", unit="rad"),
        Variable("impacts_in_step", 10, "Integer", "output", depends_on=frozenset()),
        Variable("impacts_lost", 11, "Integer", "output", depends_on=frozenset()),
        *(
            Variable(f"impacts[{slot}].{field}", 20 + 2 * slot + k, "Real", "output", unit=unit)
            for slot in range(1, SLOTS + 1)
            for k, (field, unit) in enumerate(FIELDS.items())
        ),
    ]
    return Description(
        "Wheel",
        "wheel",
        "",
        {v.name: v for v in variables},
        UNITS,
        saves_state=restores,
        takes_slopes=True,
        analysis=TEETH,
    )


class Wheel:
    """An impact doubles its speed; it tells up to `SLOTS` of a step."""

    def __init__(
        self,
        name: str = "wheel",
        impacts: Sequence[float] = (),
        trouble: Trouble | None = None,
        *,
        restores: bool = True,
        speed: float = 1.0,
    ) -> None:
        self.name = name
        self.description = description(restores)
        self.values: dict[str, Value] = dict.fromkeys(self.description.variables, 0.0)
        self.values |= {"speed": speed, "inertia": 1.0, "tooth_length": 0.01, "tooth_apex_angle": 0.5, "note": name}
        self.values |= {"steps": 0, "impacts_in_step": 0, "impacts_lost": 0}
        self.slopes: dict[str, float] = {}
        self.on_message: MessageHandler = lambda _: None
        self.ended: list[str] = []
        self._impacts, self._trouble = impacts, trouble

    def set(self, values: Mapping[str, Value]) -> None:
        self.values |= values

    def set_slopes(self, slopes: Mapping[str, float]) -> None:
        self.slopes |= slopes

    def get(self, names: Sequence[str]) -> list[Value]:
        self.values["drag"] = -float(self.values["torque"])
        self.values["forward"] = float(self.values["speed"]) > 0
        return [self.values[name] for name in names]

    def initialize(self, start_time: float, stop_time: float) -> None:
        self.enter_initialization(start_time, stop_time)
        self.exit_initialization()

    def enter_initialization(self, start_time: float, stop_time: float) -> None:
        pass

    def exit_initialization(self) -> None:
        pass

    def step(self, time: float, size: float) -> None:
        self._make_trouble(time)
        acceleration = float(self.values["torque"]) / float(self.values["inertia"])
        angle, speed = float(self.values["angle"]), float(self.values["speed"])
        hits = [t for t in self._impacts if time < t <= time + size]
        slope = self.slopes.pop("torque", 0.0)
        jerk = slope / float(self.values["inertia"])
        angle += speed * size + acceleration * size**2 / 2 + jerk * size**3 / 6
        speed += acceleration * size + jerk * size**2 / 2
        self.values |= {"angle": angle, "speed": speed * 2 ** len(hits)}
        self.values["steps"] = int(self.values["steps"]) + 1
        self.values["torque"] = float(self.values["torque"]) + slope * size
        self.values["impacts_in_step"] = min(len(hits), SLOTS)
        self.values["impacts_lost"] = int(self.values["impacts_lost"]) + max(len(hits) - SLOTS, 0)
        for slot, instant in enumerate(hits[:SLOTS], start=1):
            self.values |= {f"impacts[{slot}].time": instant, f"impacts[{slot}].velocity": -speed}

    def advance(self, time: float, size: float) -> float:
        self.step(time, size)
        return time + size

    def terminate(self) -> None:
        self.ended.append("terminated")

    def save(self, state: Any = None) -> Any:
        if not self.description.saves_state:
            raise FmuError(f"{self.name} cannot save its state", instance=self.name)
        return copy.deepcopy((self.values, self.slopes))

    def restore(self, state: Any) -> None:
        self.values, self.slopes = copy.deepcopy(state)

    def free_state(self, state: Any) -> None:
        self.ended.append("state freed")

    def reals(self, names: Sequence[str]) -> WheelReals:
        return WheelReals(self, list(names))

    def _make_trouble(self, time: float) -> None:
        if self._trouble is None or time < self._trouble.time - 1e-12:
            return
        if self._trouble.kind == "crash":
            os.kill(os.getpid(), signal.SIGKILL)
        elif self._trouble.kind == "exit":
            os._exit(3)
        elif self._trouble.kind == "hang":
            clock.sleep(600.0)
        elif self._trouble.kind == "nan":
            self.values["torque"] = math.nan
        elif self._trouble.kind == "bug":
            raise ZeroDivisionError("a gear of no teeth")
        elif self._trouble.kind == "warn":
            self.on_message(LogMessage(self.name, time, Status.WARNING, "", "the oil is hot"))
        else:
            status = Status[self._trouble.kind.upper()]
            text = f"{self.name} failed at t = {time:g} s (fmi2DoStep, status {self._trouble.kind}): it stalls"
            raise FmuError(text, instance=self.name, time=time, status=status)


class WheelReals:
    """Bound variables of a `Wheel`; what is no number is refused, as by FMUs (docs/how-to/machines.md)."""

    def __init__(self, component: Any, names: list[str]) -> None:
        self._component, self._names = component, names
        self.values: MutableSequence[float] = [0.0] * len(names)

    def read(self) -> None:
        self.values[:] = [float(value) for value in self._component.get(self._names)]
        for name, value in zip(self._names, self.values, strict=True):
            if not math.isfinite(value):
                raise FmuError(f"{self._component.name} failed: its output {name} is {value}")

    def read_slopes(self) -> bool:
        if self._names != ["speed"]:
            return False
        self.values[:] = [float(self._component.values["torque"])]
        return True

    def write(self) -> None:
        self._component.set(dict(zip(self._names, self.values, strict=True)))

    def write_slopes(self) -> None:
        self._component.set_slopes(dict(zip(self._names, self.values, strict=True)))


@dataclass(frozen=True)
class WheelOpener:
    """Makes a wheel in the other process (`remote.far_side.Opener`)."""

    name: str = "wheel"
    impacts: tuple[float, ...] = ()
    trouble: Trouble | None = None
    refusal: str = ""

    @property
    def description(self) -> Description:
        return description(restores=True)

    @contextmanager
    def __call__(self, on_message: MessageHandler) -> Iterator[Wheel]:
        if self.refusal:
            raise FmuError(self.refusal, instance=self.name)
        wheel = Wheel(self.name, self.impacts, self.trouble)
        wheel.on_message = on_message
        yield wheel
        on_message(LogMessage(self.name, 0.0, Status.OK, "", "ended: " + ", ".join(wheel.ended)))
