"""A component with impacts, whose motion is known exactly: a ball that bounces."""

import copy
import math
from collections.abc import Mapping, MutableSequence, Sequence

from harness.fmu.description import Description, Value, Variable
from tests.harness.fake_slave import UNITS

G = 9.81


class Ball:
    """A ball that falls from `height` on a floor at 0; reports its impacts as this project's FMUs do."""

    def __init__(
        self,
        name: str = "ball",
        height: float = 1.0,
        restitution: float = 0.7,
        *,
        restores: bool = True,
        early: bool = False,
    ) -> None:
        self.name = name
        self.x, self.v, self.e = height, 0.0, restitution
        self.hits: list[float] = []
        self.early = early
        self.restored = 0
        variables = [
            Variable("x", 0, "Real", "output", continuous=True, unit="m", depends_on=frozenset()),
            Variable("v", 1, "Real", "output", continuous=True, unit="m/s", depends_on=frozenset()),
            Variable("impacts_in_step", 2, "Integer", "output"),
            Variable("impacts[1].time", 3, "Real", "output", unit="s"),
        ]
        self.description = Description(
            name, name, "", {v.name: v for v in variables}, UNITS, saves_state=restores, gives_slopes=True
        )

    def set(self, values: Mapping[str, Value]) -> None:
        assert not values

    def get(self, names: Sequence[str]) -> list[Value]:
        known = {"x": self.x, "v": self.v, "impacts_in_step": len(self.hits)}
        known["impacts[1].time"] = self.hits[0] if self.hits else 0.0
        return [known[name] for name in names]

    def initialize(self, start_time: float, stop_time: float) -> None:
        self.enter_initialization(start_time, stop_time)
        self.exit_initialization()

    def enter_initialization(self, start_time: float, stop_time: float) -> None:
        pass

    def exit_initialization(self) -> None:
        pass

    def step(self, time: float, size: float) -> None:
        assert self.advance(time, size) == time + size

    def advance(self, time: float, size: float) -> float:
        self.hits, end = [], time + size
        while True:
            fall = (self.v + math.sqrt(self.v**2 + 2 * G * self.x)) / G
            if time + fall > end or fall <= 0.0:
                break
            time += fall
            self.x, self.v = 0.0, -self.e * (self.v - G * fall)
            self.hits.append(time)
            if self.early:
                return time
        left = end - time
        self.x, self.v = self.x + self.v * left - G * left**2 / 2, self.v - G * left
        return end

    def terminate(self) -> None:
        pass

    def save(self, state: object = None) -> object:
        assert self.description.saves_state
        return copy.deepcopy((self.x, self.v, self.hits))

    def restore(self, state: tuple[float, float, list[float]]) -> None:
        self.x, self.v, self.hits = copy.deepcopy(state)
        self.restored += 1

    def free_state(self, state: object) -> None:
        pass

    def reals(self, names: Sequence[str]) -> "BallReals":
        return BallReals(self, list(names))


class BallReals:
    """Bound variables of a `Ball`."""

    def __init__(self, ball: Ball, names: list[str]) -> None:
        self._ball, self._names = ball, names
        self.values: MutableSequence[float] = [0.0] * len(names)

    def read(self) -> None:
        self.values[:] = [float(value) for value in self._ball.get(self._names)]

    def read_slopes(self) -> bool:
        self.values[:] = [{"x": self._ball.v, "v": -G}[name] for name in self._names]
        return True

    def write(self) -> None:
        assert not self._names

    write_slopes = write
