"""The linearly implicit method for stiff mechanisms: a Rosenbrock-Wanner method as data, in transformed form.

With W = 1/(h gamma) I - J, where J is the Jacobian of f at the start of the step, its increments u solve

    W u_i = f(t + c_i h, y + sum_j a_ij u_j) + h d_i df/dt + sum_j coupling_ij u_j / h,   j < i,

and y + sum_j a_sj u_j + u_s is the result, u_s its error (Hairer, Wanner: Solving ODEs II, IV.7, eq (7.25)).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .declare import Array


@dataclass(frozen=True, eq=False)
class ImplicitMethod:
    """A stiffly accurate Rosenbrock-Wanner method whose last stages are at the end of the step.

    Attributes:
        name: for people.
        gamma: the diagonal of its matrix.
        c: times of the stages as parts of the step, shape (stages,).
        a: weights of the earlier increments in each stage, shape (stages, stages), strictly lower triangular.
        coupling: weights of the earlier increments over h on the right side, of the same shape.
        time: weights d of h df/dt on the right side, shape (stages,).
        dense: weights of the increments in the dense output, shape (3, stages): with its rows k, at the fraction x of
            the step, y = (1 - x) y_0 + x (y_1 + (1 - x) (k_0 + x (k_1 + x k_2))).
    """

    name: str
    gamma: float
    c: Array
    a: Array
    coupling: Array
    time: Array
    dense: Array

    @property
    def stages(self) -> int:
        """How many increments a step has."""
        return len(self.c)

    @property
    def last(self) -> int:
        """Number of the last increment, which is the error estimate, too."""
        return self.stages - 1

    @property
    def inside(self) -> tuple[int, ...]:
        """Numbers of the stages between start and end of the step, in order of time."""
        between = [k for k in range(self.stages) if 0.0 < self.c[k] < 1.0]
        return tuple(sorted(between, key=lambda k: float(self.c[k])))


def _lower(*rows: tuple[float, ...]) -> Array:
    """A strictly lower triangular matrix, from its rows."""
    square = np.zeros((len(rows), len(rows)))
    for k, row in enumerate(rows):
        square[k, :k] = row
    return square


_A6 = (-7.502846399306121, 2.561846144803919, -11.627539656261098, -0.18268767659942256, 0.030198172008377946)

#: Coefficients: Steinebach, "Construction of Rosenbrock-Wanner method Rodas5P and numerical benchmarks within the Julia
#: Differential Equations package", BIT Numerical Mathematics 63:27 (2023). Order 5, error estimate and dense output of
#: order 4, L-stable.
RODAS5P = ImplicitMethod(
    "Rodas5P",
    gamma=0.21193756319429014,
    c=np.array([0.0, 0.6358126895828704, 0.4095798393397535, 0.9769306725060716, 0.4288403609558664, 1.0, 1.0, 1.0]),
    a=_lower(
        (),
        (3.0,),
        (2.849394379747939, 0.45842242204463923),
        (-6.954028509809101, 2.489845061869568, -10.358996098473584),
        (2.8029986275628964, 0.5072464736228206, -0.3988312541770524, -0.04721187230404641),
        _A6,
        (*_A6, 1.0),
        (*_A6, 1.0, 1.0),
    ),
    coupling=_lower(
        (),
        (-14.155112264123755,),
        (-17.97296035885952, -2.859693295451294),
        (147.12150275711716, -1.41221402718213, 71.68940251302358),
        (165.43517024871676, -0.4592823456491126, 42.90938336958603, -5.961986721573306),
        (24.854864614690072, -3.0009227002832186, 47.4931110020768, 5.5814197821558125, -0.6610691825249471),
        (
            30.91273214028599,
            -3.1208243349937974,
            77.79954646070892,
            34.28646028294783,
            -19.097331116725623,
            -28.087943162872662,
        ),
        (
            37.80277123390563,
            -3.2571969029072276,
            112.26918849496327,
            66.9347231244047,
            -40.06618937091002,
            -54.66780262877968,
            -9.48861652309627,
        ),
    ),
    time=np.array(
        [0.21193756319429014, -0.42387512638858027, -0.3384627126235924, 1.8046452872882734, 2.325825639765069, 0, 0, 0]
    ),
    dense=np.array(
        [
            [
                25.948786856663858,
                -2.5579724845846235,
                10.433815404888879,
                -2.3679251022685204,
                0.524948541321073,
                1.1241088310450404,
                0.4272876194431874,
                -0.17202221070155493,
            ],
            [
                -9.91568850695171,
                -0.9689944594115154,
                3.0438037242978453,
                -24.495224566215796,
                20.176138334709044,
                15.98066361424651,
                -6.789040303419874,
                -6.710236069923372,
            ],
            [
                11.419903575922262,
                2.8879645146136994,
                72.92137995996029,
                80.12511834622643,
                -52.072871366152654,
                -59.78993625266729,
                -0.15582684282751913,
                4.883087185713722,
            ],
        ]
    ),
)
