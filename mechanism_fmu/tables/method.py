"""The Runge-Kutta method that the engine steps with: a tableau, a dense output and its orders; all else follows.

Tables take their sizes from it, and the engine reads its attributes: nothing else knows how many stages there are
(docs/decisions/035-integrator.md).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .declare import Array

#: Rows of every dense output: values and slopes at both ends of the step, a cubic.
CUBIC_ROWS = 4
#: And of a polynomial that has second derivatives there, too, as of coordinates.
QUINTIC_ROWS = 6


@dataclass(frozen=True, eq=False)
class Method:
    """An explicit Runge-Kutta method with an embedded error estimate (Hairer, Nørsett, Wanner: Solving ODEs I, II.4).

    Its last stage is taken at the end of the step: the derivative there is the first one of the next step, too ("first
    same as last"). So the last row of `a` are the weights b of the result. A method without that property gets the
    stage in addition, with error weight 0.

    Attributes:
        name: for people.
        c: times of the stages as parts of the step, shape (stages,).
        a: weights of the earlier derivatives in each stage, shape (stages, stages), strictly lower triangular.
        error: weights of the derivatives in the error estimate, shape (stages,).
        dense: weights of the derivatives in the dense output's rows beyond the cubic, shape (rows - 4, stages); see
            `engine.interpolation`.
        order: of the result; the local error is of one order more.
        error_order: of the embedded result.
        dense_order: of the dense output.
    """

    name: str
    c: Array
    a: Array
    error: Array
    dense: Array
    order: int
    error_order: int
    dense_order: int

    @property
    def stages(self) -> int:
        """How many derivatives a step has, that at its start included."""
        return len(self.c)

    @property
    def last(self) -> int:
        """Number of the stage at the end of the step."""
        return self.stages - 1

    @property
    def interior(self) -> tuple[int, ...]:
        """Numbers of the stages between start and end of the step, in order of time."""
        between = [k for k in range(self.stages) if 0.0 < self.c[k] < 1.0]
        return tuple(sorted(between, key=lambda k: float(self.c[k])))

    @property
    def dense_rows(self) -> int:
        """How many coefficients the dense output has for each unknown."""
        return max(CUBIC_ROWS + len(self.dense), QUINTIC_ROWS if self.order >= QUINTIC_ROWS - 1 else 0)

    @property
    def error_exponent(self) -> int:
        """With this power of the step size the error estimate grows."""
        return min(self.order, self.error_order) + 1


def method(
    name: str,
    c: Sequence[float],
    a: Sequence[Sequence[float]],
    error: Sequence[float],
    orders: tuple[int, int, int],
    dense: Sequence[Sequence[float]] = (),
) -> Method:
    """A method as textbooks print it.

    Args:
        name: for people.
        c: times of the stages, the first 0, the last 1.
        a: rows of weights, the first one empty, each one longer than that before it; the last are those of the result.
        error: weights of the result minus those of the embedded one, or the other way round.
        orders: of the result, of the embedded one, of the dense output.
        dense: rows of weights beyond the cubic.

    Raises:
        ValueError: the rows are no tableau of a method of at least three stages that ends with the step.

    """
    count = len(c)
    lengths = [len(row) for row in a]
    if count < 3 or lengths != list(range(count)):
        raise ValueError(f"{name}: {count} stages need rows of {list(range(count))} weights, 3 or more; got {lengths}.")
    if c[0] != 0.0 or c[-1] != 1.0:
        raise ValueError(
            f"{name}: stages from {c[0]} to {c[-1]}; the first must be at 0, the last at 1."
            " Append one at 1 whose row holds the weights of the result, with error weight 0."
        )
    for row in (error, *dense):
        if len(row) != count:
            raise ValueError(f"{name}: {len(row)} weights in {list(row)}; {count} stages need as many.")
    square = np.zeros((count, count))
    for k, row in enumerate(a):
        square[k, :k] = row
    order, error_order, dense_order = orders
    extra = np.array(dense, dtype=float).reshape(len(dense), count)
    return Method(name, np.array(c), square, np.array(error), extra, order, error_order, dense_order)


#: Coefficients: Hairer, Nørsett, Wanner, table II.5.2; dense output: their DOPRI5, function CONTD5 (II.6).
DORMAND_PRINCE = method(
    "Dormand-Prince 5(4)",
    c=(0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0),
    a=(
        (),
        (1 / 5,),
        (3 / 40, 9 / 40),
        (44 / 45, -56 / 15, 32 / 9),
        (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
        (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656),
        (35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84),
    ),
    error=(71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40),
    orders=(5, 4, 4),
    dense=(
        (
            -12715105075 / 11282082432,
            0.0,
            87487479700 / 32700410799,
            -10690763975 / 1880347072,
            701980252875 / 199316789632,
            -1453857185 / 822651844,
            69997945 / 29380423,
        ),
    ),
)

#: The method of this engine.
METHOD = DORMAND_PRINCE
