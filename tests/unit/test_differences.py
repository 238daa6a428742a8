"""Derivatives by extrapolated differences: known ones, at limits, and where events change."""

import math
from collections.abc import Callable, Sequence

import numpy as np
import pytest
from hypothesis import example, given, strategies as st

from mechanism_fmu.differences import Array, Sample, Slopes, slopes

#: A function, its derivative, and where.
KNOWN = [
    pytest.param(lambda x: 3.0 * x**5 - x, lambda x: 15.0 * x**4 - 1.0, 0.7, id="polynomial"),
    pytest.param(math.exp, math.exp, 1.0, id="exp"),
    pytest.param(math.sin, math.cos, 0.4, id="sin"),
    pytest.param(lambda x: 1.0 / x, lambda x: -1.0 / x**2, -2.0, id="reciprocal"),
]


def of_one(
    function: Callable[[float], float], x: float, change: Callable[[float], str] = lambda x: "", **limits: float
) -> Slopes:
    """The derivative of a function of one variable; `change` says in what its events differ at a point."""

    def sample(points: Sequence[Array]) -> list[Sample]:
        return [Sample(np.array([function(float(point[0]))]), change(float(point[0]))) for point in points]

    scale = np.array([abs(x) or 1.0])
    bounds = {name: np.array([limit]) for name, limit in limits.items()}
    return slopes(sample, np.array([function(x)]), np.array([x]), scale, **bounds)  # type: ignore[arg-type]


@pytest.mark.parametrize(("function", "derivative", "x"), KNOWN)
def test_a_known_derivative(function: Callable[[float], float], derivative: Callable[[float], float], x: float) -> None:
    found = of_one(function, x)
    assert found.matrix[0, 0] == pytest.approx(derivative(x), rel=1e-11)
    assert found.changes == ("",)


@pytest.mark.parametrize("side", ["low", "high"])
@pytest.mark.parametrize(("function", "derivative", "x"), KNOWN)
def test_a_known_derivative_at_a_limit(
    function: Callable[[float], float], derivative: Callable[[float], float], x: float, side: str
) -> None:
    """No point lies beyond the limit."""

    def inside(point: float) -> float:
        assert point >= x if side == "low" else point <= x
        return function(point)

    found = of_one(inside, x, **{side: x})
    assert found.matrix[0, 0] == pytest.approx(derivative(x), rel=1e-9)


@pytest.mark.parametrize("limits", [{}, {"low": 1.0}, {"high": 1.0}], ids=["central", "low", "high"])
@pytest.mark.parametrize("rate", [0.1, 1.0, 10.0, 50.0])
def test_the_error_is_no_larger_than_said(rate: float, limits: dict[str, float]) -> None:
    """Beside rounding, which no estimate sees: an eps of the quantity over the smallest step, times the weights."""
    found = of_one(lambda x: math.sin(rate * x), 1.0, **limits)
    true = rate * math.cos(rate)
    assert abs(found.matrix[0, 0] - true) <= found.errors[0, 0] + 1e-12 * abs(true) + 8.0 * 2.3e-16 / 1.25e-4
    assert found.errors[0, 0] < 1e-6 * abs(true)


def test_a_constant_has_the_derivative_0_exactly() -> None:
    found = of_one(lambda x: 0.1, 0.3)
    assert (found.matrix[0, 0], found.errors[0, 0]) == (0.0, 0.0)


def test_nothing_is_known_better_than_to_rounding() -> None:
    """The differences of a line may all be the same by chance."""
    found = of_one(lambda x: 0.25 + x, 0.5)
    assert found.matrix[0, 0] == pytest.approx(1.0, abs=1e-12)
    assert 1e-14 < found.errors[0, 0] < 1e-12


def test_where_far_steps_change_events_only_the_others_are_extrapolated() -> None:
    """Beyond 1e-3 there is another branch; were its values used, the derivative would be wrong by far."""

    def broken(x: float) -> float:
        return math.exp(x) + 100.0 * (abs(x - 1.0) > 1e-3)

    found = of_one(broken, 1.0, lambda x: "it strikes" if abs(x - 1.0) > 1e-3 else "")
    assert found.matrix[0, 0] == pytest.approx(math.e, rel=1e-10)
    assert found.changes == ("",)
    assert found.within[0] < 1e-3


def test_where_one_side_changes_events_the_other_is_not_used_either() -> None:
    found = of_one(lambda x: abs(x - 1.0), 1.0, lambda x: "it strikes" if x < 1.0 else "")
    assert math.isnan(found.matrix[0, 0])
    assert found.changes == ("it strikes",)


def test_where_every_step_changes_events_there_is_none_and_it_is_named() -> None:
    found = of_one(math.exp, 1.0, lambda x: "" if x == 1.0 else "it misses")
    assert math.isnan(found.matrix[0, 0])
    assert math.isinf(found.errors[0, 0])
    assert found.changes == ("it misses",)
    assert found.within[0] <= 2.1e-7


def test_at_a_limit_the_first_step_must_keep_the_events() -> None:
    """With a restitution of less than 1e-5, nothing bounces that the engine counts: there the motion is flat."""
    asked = []

    def bounce(x: float) -> float:
        asked.append(x)
        return x if x > 1e-5 else 0.0

    found = of_one(bounce, 0.0, lambda x: "it bounces" if x > 1e-5 else "", low=0.0)
    assert math.isnan(found.matrix[0, 0])
    assert found.changes == ("it bounces",)
    assert found.within[0] == max(asked) == 4e-3


def test_what_has_no_value_beside_it_has_no_derivative() -> None:
    found = slopes(lambda points: [Sample(None)] * len(points), np.ones(1), np.ones(1), np.ones(1))
    assert math.isnan(found.matrix[0, 0])
    assert found.changes == ("beside it there is no value",)


@pytest.mark.parametrize("room", [1e-3, 1e-5])
def test_with_less_room_than_the_first_step_the_larger_side_is_taken(room: float) -> None:
    asked = []

    def function(x: float) -> float:
        asked.append(x)
        return math.exp(x)

    found = of_one(function, 1.0, low=1.0 - room / 2.0, high=1.0 + room)
    assert found.matrix[0, 0] == pytest.approx(math.e, rel=1e-12 / room)
    assert max(asked) == 1.0 + room
    assert min(asked) == 1.0


def test_without_any_room_there_is_none_and_it_is_said() -> None:
    found = of_one(math.exp, 1.0, low=1.0, high=1.0)
    assert math.isnan(found.matrix[0, 0])
    assert found.changes == ("its limits leave no room for a step",)


def test_several_variables_and_quantities_are_asked_for_together() -> None:
    """One variable's events change at first, another one's always; the others' derivatives are not touched."""
    asked: list[int] = []

    def values(p: Array) -> Array:
        return np.array([p[0] ** 2 * p[1], math.sin(p[1]) + p[2], math.exp(p[3])])

    def sample(points: Sequence[Array]) -> list[Sample]:
        asked.append(len(points))
        far = [abs(point[1] - 3.0) > 5e-3 for point in points]
        return [
            Sample(values(p), "far" if away else "kink" if p[2] != 0.0 else "")
            for p, away in zip(points, far, strict=True)
        ]

    x = np.array([2.0, 3.0, 0.0, 1.0])
    found = slopes(sample, values(x), x, np.array([2.0, 3.0, 1.0, 1.0]), low=np.array([-9.0, -9.0, -9.0, 1.0]))
    expected = np.array([[12.0, 4.0, np.nan, 0.0], [0.0, math.cos(3.0), np.nan, 0.0], [0.0, 0.0, np.nan, math.e]])
    np.testing.assert_allclose(found.matrix, expected, rtol=1e-9, atol=1e-12)
    assert found.changes == ("", "", "kink", "")
    assert asked[0] == 7  # two sides of three variables, one of the fourth, which is at its limit
    assert asked[-1] == 2  # the variable without a derivative alone goes on to the least step
    assert sum(asked) < 7 * 6 + 2 * 14


@given(
    st.lists(st.floats(-10.0, 10.0, allow_subnormal=False), min_size=4, max_size=4),
    st.floats(-10.0, 10.0).filter(lambda x: x == 0.0 or abs(x) > 1e-3),
    st.sampled_from(["central", "low", "high"]),
)
def test_a_cubic_is_exact(coefficients: list[float], x: float, side: str) -> None:
    """Central differences have one term of error, those on one side two: the second or third row has none."""
    cubic = np.polynomial.Polynomial(coefficients)
    found = of_one(lambda at: float(cubic(at)), x, **({} if side == "central" else {side: x}))
    scale = abs(x) or 1.0
    size = sum(abs(c) * scale**k for k, c in enumerate(coefficients)) / scale
    assert abs(found.matrix[0, 0] - cubic.deriv()(x)) <= 1e-9 * size


@pytest.mark.parametrize("way", [0.0, 1e-7, -1e-5])
@pytest.mark.parametrize("slopes_", [(0.0, 0.5), (-0.5, 1.0), (2.0, 1.999)])
def test_a_kink_that_no_event_names_is_found(way: float, slopes_: tuple[float, float]) -> None:
    """Within the smallest step of it: there is no derivative, and both slopes are told."""
    below, above = slopes_
    found = of_one(lambda x: math.sin(x) + (above if x > 5.0 + way else below) * (x - 5.0 - way), 5.0)
    assert math.isnan(found.matrix[0, 0])
    assert "below" in found.changes[0]


@given(st.floats(-8.0, -1.0), st.booleans(), st.floats(-2.0, 2.0), st.floats(-2.0, 2.0))
@example(-4.0, False, 0.0, 2e-6)
def test_the_error_beside_a_kink_is_no_larger_than_said(power: float, up: bool, below: float, above: float) -> None:
    """Wherever it is: none, or the slope at the middle within its error."""
    place = 1.0 + (10.0**power if up else -(10.0**power))
    found = of_one(lambda x: math.sin(x) + (above if x > place else below) * (x - place), 1.0)
    true = math.cos(1.0) + (above if place < 1.0 else below)
    if not found.changes[0]:
        assert abs(found.matrix[0, 0] - true) <= found.errors[0, 0] + 1e-10
