"""Components whose motion is known exactly: linear systems, solved by matrix exponentials."""

import copy
from collections.abc import Mapping, MutableSequence, Sequence

import numpy as np
from scipy.linalg import expm

from harness.errors import FmuError
from harness.fmu.description import Description, Value, Variable
from tests.harness.fake_slave import UNITS


class Linear:
    """x' = A x + B u, y = C x + D u, with inputs that are held or go on at a slope: exact for both.

    Attributes:
        description: inputs, outputs and the parameters `<output>_start`, which nobody needs.
        calls: sizes of steps.
    """

    def __init__(
        self,
        name: str,
        matrices: tuple[Sequence[Sequence[float]], ...],
        inputs: Mapping[str, str],
        outputs: Mapping[str, str],
        start: Sequence[float],
        *,
        slopes: bool = True,
        told: bool = True,
        restores: bool = True,
    ) -> None:
        self.name = name
        self._a, self._b, self._c, self._d = (np.array(matrix, float) for matrix in matrices)
        self.x = np.array(start, float)
        self._inputs, self._outputs = list(inputs), list(outputs)
        follows = {
            y: frozenset(u for u, d in zip(inputs, row, strict=True) if d)
            for y, row in zip(outputs, self._d, strict=True)
        }
        variables = [
            *(Variable(u, k, "Real", "input", unit=unit) for k, (u, unit) in enumerate(inputs.items())),
            *(
                Variable(y, 100 + k, "Real", "output", continuous=True, unit=unit, depends_on=follows[y])
                for k, (y, unit) in enumerate(outputs.items())
            ),
        ]
        self.description = Description(
            name,
            name,
            "",
            {v.name: v for v in variables},
            UNITS,
            saves_state=restores,
            takes_slopes=slopes,
            gives_slopes=told,
        )
        self.u = np.zeros(len(inputs))
        self._slope = np.zeros(len(inputs))
        self.calls: list[float] = []
        self.stop_time = 0.0

    def set(self, values: Mapping[str, Value]) -> None:
        for name, value in values.items():
            self.u[self._inputs.index(name)] = float(value)

    def set_slopes(self, slopes: Mapping[str, float]) -> None:
        assert self.description.takes_slopes
        for name, slope in slopes.items():
            self._slope[self._inputs.index(name)] = slope

    def get(self, names: Sequence[str]) -> list[Value]:
        y = self._c @ self.x + self._d @ self.u
        return [
            float(y[self._outputs.index(n)] if n in self._outputs else self.u[self._inputs.index(n)]) for n in names
        ]

    def slopes_of(self, names: Sequence[str]) -> list[float]:
        y = self._c @ (self._a @ self.x + self._b @ self.u) + self._d @ self._slope
        return [float(y[self._outputs.index(name)]) for name in names]

    def initialize(self, start_time: float, stop_time: float) -> None:
        self.enter_initialization(start_time, stop_time)
        self.exit_initialization()

    def enter_initialization(self, start_time: float, stop_time: float) -> None:
        self.stop_time = stop_time

    def exit_initialization(self) -> None:
        pass

    def step(self, time: float, size: float) -> None:
        n, m = self._b.shape
        whole = np.zeros((n + 2 * m, n + 2 * m))
        whole[:n, :n], whole[:n, n : n + m], whole[n : n + m, n + m :] = self._a, self._b, np.eye(m)
        z = expm(whole * size) @ np.concatenate([self.x, self.u, self._slope])
        self.x, self.u = z[:n], z[n : n + m]
        self._slope = np.zeros(m)
        self.calls.append(size)

    def advance(self, time: float, size: float) -> float:
        self.step(time, size)
        return time + size

    def terminate(self) -> None:
        pass

    def save(self, state: object = None) -> object:
        if not self.description.saves_state:
            raise FmuError(f"{self.name} cannot save its state")
        return copy.deepcopy({k: v for k, v in vars(self).items() if k in ("x", "u", "_slope")})

    def restore(self, state: object) -> None:
        vars(self).update(copy.deepcopy(state))  # type: ignore[call-overload]

    def free_state(self, state: object) -> None:
        pass

    def reals(self, names: Sequence[str]) -> "LinearReals":
        return LinearReals(self, list(names))


class LinearReals:
    """Bound variables of a `Linear`."""

    def __init__(self, component: Linear, names: list[str]) -> None:
        self._component, self._names = component, names
        self.values: MutableSequence[float] = [0.0] * len(names)

    def read(self) -> None:
        self.values[:] = [float(value) for value in self._component.get(self._names)]

    def read_slopes(self) -> bool:
        assert self._component.description.gives_slopes
        self.values[:] = self._component.slopes_of(self._names)
        return True

    def write(self) -> None:
        self._component.set(dict(zip(self._names, self.values, strict=True)))

    def write_slopes(self) -> None:
        self._component.set_slopes(dict(zip(self._names, self.values, strict=True)))


def mass(name: str, m: float = 1.0, k: float = 1.0, start: Sequence[float] = (1.0, 0.0), **how: bool) -> Linear:
    """A mass on a spring to the ground, driven by a force; tells where it is."""
    matrices = ([[0, 1], [-k / m, 0]], [[0], [1 / m]], [[1, 0], [0, 1]], [[0], [0]])
    return Linear(name, matrices, {"force": "N"}, {"x": "m", "v": "m/s"}, start, **how)


def mass_and_spring(
    name: str, m: float = 1.0, k: float = 1.0, kc: float = 0.5, start: Sequence[float] = (0.0, 0.0), **how: bool
) -> Linear:
    """A mass on a spring to the ground, and a coupling spring to a point that is led; tells its force on that point."""
    matrices = ([[0, 1], [-(k + kc) / m, 0]], [[0], [kc / m]], [[1, 0], [0, 1], [kc, 0]], [[0], [0], [-kc]])
    return Linear(name, matrices, {"led": "m"}, {"x": "m", "v": "m/s", "force": "N"}, start, **how)
