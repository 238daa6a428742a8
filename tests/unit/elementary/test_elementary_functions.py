"""Sine and its kin against mpmath's digits, by IEEE 754's rules at the edges, and compiled against interpreted."""

import math
import random

import mpmath
import numba
import pytest

from mechanism_fmu import elementary
from mechanism_fmu.elementary.trigonometric import FARTHEST
from mechanism_fmu.engine import elementary as compiled
from mechanism_fmu.engine.compiler.subset import entry

ONE_ARGUMENT = ("sin", "cos", "tan", "exp", "log", "tanh")
NAMES = (*ONE_ARGUMENT, "atan2", "power")
mpmath.mp.prec = 200


def either(x):
    return random.choice((-1, 1)) * x


ANGLES = (
    lambda: either(random.uniform(0, 10)),
    lambda: either(10 ** random.uniform(-12, 12.04)),
    lambda: random.randrange(1, 2**20) * math.pi / 2,
    lambda: float(random.randrange(1, 2 ** random.randrange(2, 40)) * mpmath.pi / 2),
    lambda: random.randrange(1, 10) * math.pi / 2 * (1 + random.randrange(-3, 4) * 2**-52),
)
#: By name: what draws arguments, each a number or a pair.
DRAWN = {
    "sin": ANGLES,
    "cos": ANGLES,
    "tan": ANGLES,
    "exp": (
        lambda: random.uniform(-1, 1),
        lambda: random.uniform(-708, 709.7),
        lambda: either(10 ** random.uniform(-15, 0)),
    ),
    "log": (
        lambda: random.uniform(0.5, 2),
        lambda: 10 ** random.uniform(-307, 308),
        lambda: 1 + either(10 ** random.uniform(-15, -1)),
        lambda: 5e-324 * random.randrange(1, 10**6),
    ),
    "tanh": (
        lambda: random.uniform(-1, 1),
        lambda: random.uniform(-25, 25),
        lambda: either(10 ** random.uniform(-12, 0)),
    ),
    "atan2": (
        lambda: (random.uniform(-1, 1), random.uniform(-1, 1)),
        lambda: (either(10 ** random.uniform(-5, 5)), either(10 ** random.uniform(-5, 5))),
        lambda: (either(10 ** random.uniform(-300, 300)), either(10 ** random.uniform(-300, 300))),
    ),
    "power": (
        lambda: (random.uniform(0, 3), random.uniform(-9, 9)),
        lambda: (10 ** random.uniform(-100, 100), random.uniform(-3, 3)),
        lambda: (1 + either(10 ** random.uniform(-12, -3)), either(10 ** random.uniform(0, 14))),
        lambda: (10 ** random.uniform(-8, 3), -0.2),
    ),
}
DIGITS = {name: getattr(mpmath, "power" if name == "power" else name) for name in NAMES}


def drawn(name, count):
    random.seed(name)
    for draw in DRAWN[name]:
        for _ in range(count):
            x = draw()
            yield x if isinstance(x, tuple) else (x,)


def off(name, x):
    """Error of a function, in units in the last place of its value; none where that is no normal number."""
    exact = DIGITS[name](*map(mpmath.mpf, x))
    size = abs(exact)
    if not mpmath.mpf(2) ** -1021 < size < mpmath.mpf(2) ** 1023:
        return 0.0
    return abs(float((mpmath.mpf(getattr(elementary, name)(*x)) - exact) / mpmath.mpf(math.ulp(float(size)))))


@pytest.mark.parametrize("name", NAMES)
def test_it_is_within_one_unit_in_the_last_place(name):
    worst = max((off(name, x), x) for x in drawn(name, 1500))
    assert worst[0] < 1, worst


def same(a, b):
    return (math.isnan(a) and math.isnan(b)) or (a == b and math.copysign(1, a) == math.copysign(1, b))


EDGES = [0.0, -0.0, 5e-324, 1e-310, 1e-9, 1.0, -1.0, math.pi, 1e300, -1e300, FARTHEST, math.inf, -math.inf, math.nan]


@pytest.mark.skipif(numba.config.DISABLE_JIT, reason="there is nothing compiled to compare")
@pytest.mark.parametrize("name", NAMES)
def test_compiled_it_gives_the_same_bits(name):
    function = getattr(compiled, name)
    if name in ONE_ARGUMENT:
        called = entry(lambda x: function(x))
        edges = [(x,) for x in EDGES]
    else:
        called = entry(lambda x, y: function(x, y))
        edges = [(x, y) for x in EDGES for y in EDGES]
    for x in (*edges, *drawn(name, 2000)):
        assert same(called(*x), getattr(elementary, name)(*x)), x


def test_edges_are_those_of_ieee_754():
    for y in (0.0, -0.0, 1.0, -1.0, math.inf, -math.inf, math.nan):
        for x in (0.0, -0.0, 1.0, -1.0, math.inf, -math.inf, math.nan):
            assert same(elementary.atan2(y, x), math.atan2(y, x)), (y, x)
    for x in (0.0, -0.0, 1e-300, -1e-300):
        assert same(elementary.sin(x), x)
        assert same(elementary.tan(x), x)
        assert same(elementary.tanh(x), x)
        assert elementary.cos(x) == elementary.exp(x) == 1.0
    assert elementary.exp(math.inf) == elementary.exp(710.0) == elementary.log(math.inf) == math.inf
    assert elementary.exp(-math.inf) == elementary.exp(-746.0) == elementary.log(1.0) == 0.0
    assert elementary.exp(-745.0) == 5e-324
    assert (elementary.tanh(math.inf), elementary.tanh(-30.0)) == (1.0, -1.0)
    assert elementary.power(2.0, 10.0) == 1024.0
    assert elementary.power(0.0, 0.0) == elementary.power(1.0, 1e300) == 1.0
    assert elementary.power(0.0, 0.5) == elementary.power(0.5, 1e300) == 0.0
    assert elementary.power(2.0, 1e300) == math.inf


@pytest.mark.parametrize("name", NAMES)
def test_what_has_no_value_is_not_a_number(name):
    outside = {"log": [(0.0,), (-1.0,)], "power": [(-1.0, 0.5), (0.0, -1.0), (math.inf, 1.0)]}
    outside |= {name: [(FARTHEST,), (-1e300,), (math.inf,)] for name in ("sin", "cos", "tan")}
    nan = (math.nan,) if name in ONE_ARGUMENT else (math.nan, 1.5)
    for x in (*outside.get(name, ()), nan):
        assert math.isnan(getattr(elementary, name)(*x)), x
