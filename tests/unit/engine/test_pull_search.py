"""When within a step a closed contact would pull, for a force that is a polynomial which the test writes.

A lever on a stop, pressed by a spring of 1 N m/rad whose other end is a disc: the torque of the stop is minus the angle
of the disc. Another disc may meet a wall in the same step. The step is 1 s long.
"""

import math

import pytest
from written_step import NOTHING, T, search, write

from mechanism_fmu import codes
from mechanism_fmu.model import GROUND, AngleStop, Body, Mechanism, TorsionSpring
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tables.layout import field_of
from mechanism_fmu.tolerances import PUSHES_WITHIN

#: A contact opens when its force is less than minus this [N m], in a mechanism whose scales are 1.
OPENS_BELOW = 2 * PUSHES_WITHIN
LEVER, WALL = 0, 1
DISC_ANGLE, OTHER_ANGLE = 5, 8


def found(push, *, gap=1.0 + 0 * T, seen=(-10.0, 10.0)):
    """What the search answers when the stop's torque is `push`, the wall's gap `gap`.

    `seen`: the least and the largest torque at the step's stages, over the tolerance.
    """
    mechanism = Mechanism(
        bodies=(
            Body("lever", 1.0, 1.0),
            Body("disc", 1.0, 1.0, (0.0, 0.0, -1.0)),
            Body("other", 1.0, 1.0, (0.0, 0.0, 1.0)),
        ),
        forces=(TorsionSpring("spring", "lever", reaction="disc", stiffness=1.0),),
        contacts=(AngleStop("stop", "lever", GROUND, 0.0), AngleStop("wall", "other", GROUND, 0.0)),
    )
    simulation = Simulation(mechanism)
    assert simulation.mode() == ("stop",)
    block = simulation._block
    field_of(block, "scales")[:] = 1.0
    field_of(block, "body_scales")[:] = 1.0
    field_of(block, "tried")[:] = (0.0, 1.0)
    field_of(block, "least_push")[:] = (seen[0], 0.0)
    field_of(block, "most_push")[:] = (seen[1], 0.0)
    write(block, {DISC_ANGLE: -push, OTHER_ANGLE: gap})
    return search(block)


def assert_opens(event, fraction):
    assert event[:2] == (codes.GUARD_PUSH, LEVER)
    assert event[2] == pytest.approx(fraction, rel=0, abs=4e-12)


@pytest.mark.parametrize("root", [1e-3, 0.1, 0.125, 0.3, 0.5, 0.9, 1 - 1e-6])
@pytest.mark.parametrize("slope", [0.3, 1.0, 20.0])
def test_a_contact_opens_where_its_force_has_gone(root, slope):
    assert_opens(found(slope * (root - T)), root + OPENS_BELOW / slope)


@pytest.mark.parametrize(("begins", "ends"), [(0.1, 0.14), (0.1, 0.3), (0.49, 0.51), (0.6, 0.8), (0.9, 1.2)])
def test_a_pull_counts_that_comes_and_goes(begins, ends):
    """There is a look of the search, at a multiple of 1/8, within each."""
    assert_opens(found((T - begins) * (T - ends)), begins + OPENS_BELOW / (ends - begins))


@pytest.mark.parametrize(("begins", "ends"), [(0.002, 0.004), (0.03, 0.05), (0.3, 0.301), (0.51, 0.6), (0.97, 0.99)])
def test_a_pull_counts_between_two_looks(begins, ends):
    """Though at no stage there was one: the torque has fallen far enough along them for a dip between."""
    width = ends - begins
    opens = begins + 0.5 * (width - math.sqrt(width**2 - 4.0 * OPENS_BELOW))
    assert_opens(found((T - begins) * (T - ends), seen=(1e5, 1e6)), opens)


def test_a_pull_before_the_step_does_not_count():
    assert_opens(found((T + 0.05) * (0.1 - T)), 0.1 + OPENS_BELOW / 0.15)


@pytest.mark.parametrize("push", [1.0 + 0 * T, T, 1.0 - T, 1.0 + 1e-9 - T, 1.06 - T])
def test_a_force_that_has_not_gone_by_the_end_of_the_step_is_no_event(push):
    """Though at one of the stages, which are not quite on the dense output, there was a pull."""
    assert found(push) == NOTHING


@pytest.mark.parametrize("seen", [(1.0, 2.9), (1e6, 2.9e6)])
def test_what_has_hardly_changed_along_the_stages_is_not_looked_into(seen):
    assert found(0.5 - T, seen=seen) == NOTHING


@pytest.mark.parametrize(("opens", "strikes"), [(0.3, 0.6), (0.26, 0.27), (0.1, 0.9), (0.8, 0.81)])
def test_the_earlier_of_a_pull_and_an_impact_counts(opens, strikes):
    assert_opens(found(opens - T, gap=strikes - T), opens + OPENS_BELOW)
    event = found(strikes - T, gap=opens - T)
    assert event[:2] == (codes.GUARD_GAP, WALL)
    assert event[2] == pytest.approx(opens, rel=0, abs=1e-15)


@pytest.mark.parametrize("strikes", [0.05, 0.5, 0.7, 1.0])
def test_a_pull_after_an_impact_does_not_hide_it(strikes):
    event = found(strikes + 1e-6 - T, gap=strikes - T)
    assert event[:2] == (codes.GUARD_GAP, WALL)
