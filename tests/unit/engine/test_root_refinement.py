"""The true step to the zero of a gap, for a ball that flies straight: the root of a linear function."""

import pytest

from mechanism_fmu.engine.compiler.subset import entry
from mechanism_fmu.engine.stepping.events import refine
from mechanism_fmu.model import GROUND, Body, Mechanism, PointLineContact
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tables.layout import field_of

STARTS = 7.0


@entry
def to_the_root(block, step):
    return refine(block, 0, step)


def refined(x, speed, step):
    """The step that ends where x = 0, found from `step` on, and where the step last tried ends."""
    body = Body("ball", 1.0, 1.0, (1.0, 0.0, 0.0))
    wall = PointLineContact("wall", "ball", (0.0, 0.0), GROUND, (0.0, 0.0), (1.0, 0.0))
    block = Simulation(Mechanism(bodies=(body,), contacts=(wall,)))._block
    y, rates = field_of(block, "y_start"), field_of(block, "derivatives")[0]
    y[:], rates[:] = 0.0, 0.0
    y[0], y[3], rates[0] = x, speed, speed
    field_of(block, "tried")[0] = STARTS
    size = to_the_root(block, step)
    assert field_of(block, "tried")[0] == STARTS
    return size, field_of(block, "y_new")[0]


@pytest.mark.parametrize(("x", "speed"), [(1.0, -1.0), (0.2, -3.0), (1e-3, -2e-4), (50.0, -10.0)])
@pytest.mark.parametrize("share", [0.51, 0.9, 1.0, 1.3, 10.0])
def test_the_step_ends_at_zero_gap(x, speed, share):
    root = -x / speed
    size, ends = refined(x, speed, share * root)
    assert size == pytest.approx(root, rel=1e-14, abs=0)
    assert ends == pytest.approx(0.0, abs=1e-13 * x)


@pytest.mark.parametrize("step", [0.1, 0.4, 0.49])
def test_a_root_farther_off_than_twice_the_step_is_not_gone_to(step):
    """x = 1 - t"""
    assert refined(1.0, -1.0, step) == pytest.approx((step, 1.0 - step), rel=1e-14, abs=0)


@pytest.mark.parametrize("step", [0.1, 0.5, 2.0])
def test_a_root_before_the_start_is_not_gone_to(step):
    """x = -0.2 - t"""
    assert refined(-0.2, -1.0, step) == pytest.approx((step, -0.2 - step), rel=1e-14, abs=0)


@pytest.mark.parametrize("speed", [0.5, 3.0])
def test_a_gap_that_opens_has_no_root_to_go_to(speed):
    """Where a dip of the dense output only just reached zero."""
    assert refined(-0.1, speed, 0.3) == pytest.approx((0.3, 0.3 * speed - 0.1), rel=1e-14, abs=0)
