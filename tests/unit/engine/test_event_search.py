"""The first event of a step whose motion is a polynomial that the test writes, against its roots.

A ball between walls: the gap to a wall is the ball's distance from it, so that every gap is a polynomial too. The step
is 1 s long; what the search answers is the fraction of it.
"""

import math

import numpy as np
import pytest
from written_step import NOTHING, T, search, write

from mechanism_fmu import codes
from mechanism_fmu.model import GROUND, AngleStop, Body, Mechanism, PointLineContact
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tables.layout import field_of
from mechanism_fmu.tolerances import GAP_NOISE, MARGIN


def walls(*places, **options):
    """The block of a ball, with walls at x = place that keep it on the right."""
    contacts = tuple(
        PointLineContact(f"wall{k}", "ball", (0.0, 0.0), GROUND, (place, 0.0), (1.0, 0.0), **options)
        for k, place in enumerate(places)
    )
    body = Body("ball", 1.0, 1.0, (max(places) if options else 10.0, 0.0, 0.0))
    return of_scale_one(Mechanism(bodies=(body,), contacts=contacts))


def of_scale_one(mechanism):
    """The block of a mechanism, in which tolerances are as they stand."""
    block = Simulation(mechanism)._block
    field_of(block, "scales")[:] = 1.0
    field_of(block, "body_scales")[:] = 1.0
    return block


def found(block, x, *, touching=()):
    """What the search answers when the ball's x moves as the polynomial `x`, of degree 4 at most."""
    write(block, {0: x})
    field_of(block, "contact_touching")[:] = 0
    field_of(block, "contact_touching")[list(touching)] = 1
    return search(block)


def assert_hits(event, contact, fraction, within=1e-15):
    assert event[:2] == (codes.GUARD_GAP, contact)
    assert event[2] == pytest.approx(fraction, rel=0, abs=within)


@pytest.mark.parametrize("root", [1e-6, 0.03, 0.125, 0.3, 0.5, 0.9, 1 - 1e-9, 1.0])
@pytest.mark.parametrize("bend", [-0.2, 0.0, 0.3])
def test_a_gap_that_closes_once_does_so_at_its_root(root, bend):
    event = found(walls(0.0), (root - T) * (1 + bend * T))
    assert_hits(event, 0, root)


def test_the_step_is_closed_at_its_end_and_nothing_counts_beyond():
    assert_hits(found(walls(0.0), 1 - T), 0, 1.0)
    assert found(walls(0.0), 1 + 1e-12 - T) == NOTHING
    assert found(walls(0.0), 0.5 + T) == NOTHING
    assert found(walls(0.0), 0.5 + 0 * T) == NOTHING


@pytest.mark.parametrize("middle", [0.07, 0.19, 0.45, 0.8, 0.97])
@pytest.mark.parametrize("half", [1e-6, 1e-3, 0.02])
def test_a_short_dip_below_zero_is_found_and_one_that_does_not_reach_is_not(middle, half):
    """Both within one look of the search and across two."""
    fits = half < middle and middle + half <= 1.0
    assert fits
    assert_hits(found(walls(0.0), (T - middle) ** 2 - half**2), 0, middle - half, 1e-15 + 1e-16 / half)
    assert found(walls(0.0), (T - middle) ** 2 + half**2) == NOTHING


def test_a_dip_that_just_touches_zero_counts():
    """At 3/16, half way between two looks, where nothing is rounded."""
    assert_hits(found(walls(0.0), (T - 3 / 16) ** 2), 0, 3 / 16, 1e-8)


def test_the_first_of_two_dips_counts():
    first, second = 0.3, 0.8
    motion = ((T - first) ** 2 - 1e-4) * ((T - second) ** 2 - 1e-4)
    assert_hits(found(walls(0.0), motion), 0, first - 1e-2, 1e-13)


def test_the_first_of_two_dips_counts_when_a_look_comes_between():
    """Bottoms at 0.73 and, deeper, at 0.82; between them a summit at 0.77 and, at 0.75, a look of the search."""
    motion = ((T - 0.73) * (T - 0.77) * (T - 0.82)).integ()
    motion = motion - motion(0.73) - 1e-7
    first = np.sort(motion.roots().real)[0]
    assert_hits(found(walls(0.0), motion), 0, first, 1e-10)


@pytest.mark.parametrize(("places", "struck"), [((0.1, 0.4), 1), ((0.4, 0.1), 0), ((0.30, 0.31), 1), ((0.31, 0.3), 0)])
def test_of_several_walls_the_first_that_is_reached_is_struck(places, struck):
    """From x = 1 on at speed 1: in different looks, or in the same one."""
    assert_hits(found(walls(*places), 1 - T), struck, 1 - max(places))


def test_of_walls_at_the_same_place_the_first_is_named():
    assert_hits(found(walls(0.25, 0.25, 0.1), 1 - T), 0, 0.75)


@pytest.mark.parametrize("back", [0.01, 0.1, 0.125, 0.4, 0.95])
@pytest.mark.parametrize("start", [0.0, 4e-13, -4e-13, -1e-11])
def test_a_gap_that_opens_from_about_zero_counts_when_it_closes_again(back, start):
    """Not at the start; and then at zero itself, not within the noise that a gap at rest may have."""
    event = found(walls(0.0), start + T * (back - T), touching=[0])
    root = back / 2 + math.sqrt(back**2 / 4 + start)
    assert_hits(event, 0, root, 1e-14)


def test_a_gap_that_opens_between_two_looks_is_followed_forwards():
    """Before the step's start this polynomial is positive again, which does not count."""
    assert_hits(found(walls(0.0), T * (0.1 - T) * (0.03 + T), touching=[0]), 0, 0.1, 1e-14)


def test_a_dip_counts_that_comes_after_the_gap_has_opened_from_zero():
    """x = t ((t - 0.69)^2 - 1e-4): positive at all looks."""
    assert_hits(found(walls(0.0), T * ((T - 0.69) ** 2 - 1e-4), touching=[0]), 0, 0.68, 1e-13)


def test_a_gap_that_closes_right_after_opening_counts_though_a_look_finds_it_within_the_noise():
    """At the first look, after 1/8, it is 4e-14 below zero and falls; at the second it is open."""
    back = 1 / 8 - 4e-12
    assert_hits(found(walls(0.0), T * (T - back) * (T - 0.2), touching=[0]), 0, back, 1e-14)


@pytest.mark.parametrize(("start", "deep"), [(0.0, 6e-13), (4e-13, 9.6e-12)])
def test_a_dip_within_the_noise_right_after_opening_is_left_alone(start, deep):
    """At the first look, after 1/8, the gap is 8e-14 or 8e-13 below zero and rises."""
    bottom = 1 / 8 - 1e-7
    assert found(walls(0.0), start + T * ((T - bottom) ** 2 - deep), touching=[0]) == NOTHING


def test_a_dip_of_a_gap_at_rest_within_the_noise_is_left_alone():
    """Down by 2e-14 between the start and the first look."""
    assert found(walls(0.0), 4e-12 * T * (T - 0.14), touching=[0]) == NOTHING


def test_a_dip_counts_that_comes_after_a_rise():
    """The summit is at 0.2, the bottom at 0.69, half way between two looks."""
    motion = ((T - 0.2) * (T - 0.69)).integ()
    motion = motion - motion(0.69) - 1e-5
    root = np.sort(motion.roots().real)[1]
    assert_hits(found(walls(0.0), motion), 0, root, 1e-13)
    assert found(walls(0.0), motion + 2e-5) == NOTHING


def test_a_gap_that_opens_and_stays_open_is_no_event():
    for start in (0.0, -1e-13, -1e-11):
        assert found(walls(0.0), start + T, touching=[0]) == NOTHING


@pytest.mark.parametrize(("start", "touching"), [(0.0, [0]), (-1e-13, [0]), (5e-13, [0]), (0.0, []), (-1e-13, [])])
def test_a_gap_of_zero_or_touching_that_closes_fires_at_the_start(start, touching):
    event = found(walls(0.0), start - 1e-3 * T, touching=touching)
    assert event == (codes.GUARD_GAP, 0, 0.0)


def test_a_small_gap_that_has_not_touched_is_followed_to_its_root():
    assert_hits(found(walls(0.0), 5e-13 - 1e-3 * T), 0, 5e-10, 1e-15)


@pytest.mark.parametrize("start", [0.0, -5e-13, 5e-13])
def test_a_touching_gap_at_rest_may_sink_by_the_noise(start):
    """x = start - t^2 / 100 reaches -1e-12."""
    event = found(walls(0.0), start - 0.01 * T**2, touching=[0])
    assert_hits(event, 0, 10 * math.sqrt(start + GAP_NOISE), 1e-12)
    assert found(walls(0.0), start + 0 * T, touching=[0]) == NOTHING
    assert found(walls(0.0), 0.9 * start - 1e-13 * T**2, touching=[0]) == NOTHING


def test_a_touching_gap_at_rest_that_is_deeper_than_the_noise_fires_at_the_start():
    assert found(walls(0.0), -2e-12 + 0 * T, touching=[0]) == (codes.GUARD_GAP, 0, 0.0)


def test_a_gap_at_rest_that_has_risen_above_the_noise_closes_at_zero():
    """x = t^2 (1/2 - t): its rate is zero at the start."""
    assert_hits(found(walls(0.0), T**2 * (0.5 - T), touching=[0]), 0, 0.5, 1e-15)


def test_a_gap_that_rises_within_the_noise_keeps_it():
    """x = 4e-13 (t - 4 t^2), at rest to within 1e-9 m/s, sinks below -1e-12 where 4 t^2 - t = 2.5."""
    root = (1 + math.sqrt(1 + 16 * 2.5)) / 8
    assert_hits(found(walls(0.0), 4e-13 * (T - 4 * T**2), touching=[0]), 0, root, 1e-3)


def test_a_gap_that_opens_but_never_gets_above_zero_ends_where_it_began():
    """x = -1e-9 + 2e-9 t - 4e-9 t^2; else hops that follow each other would sink ever deeper."""
    event = found(walls(0.0), -1e-9 + 2e-9 * T - 4e-9 * T**2, touching=[0])
    assert_hits(event, 0, 0.5, 1e-9)


def test_a_wall_behind_does_not_hide_the_one_that_was_left():
    assert_hits(found(walls(0.0, -0.2), T * (0.5 - T), touching=[0]), 0, 0.5, 1e-15)


@pytest.mark.parametrize("options", [{"enabled": 0.0}, {"closed": True, "guided": True}])
def test_walls_that_are_not_there_or_closed_for_good_are_not_watched(options):
    assert found(walls(0.0, **options), 0.5 - T) == NOTHING


@pytest.mark.parametrize("angle", [0.6 + 1.1 * MARGIN, 0.7, 0.9, 1.5, 2.0])
@pytest.mark.parametrize("speed", [-0.01, 0.0, 1.0])
def test_a_guard_that_is_no_gap_and_is_passed_at_the_start_fires_there(angle, speed):
    """The stop clicks at 0.1 + 0.5."""
    block = wheel()
    write(block, {2: angle + speed * T})
    assert search(block) == (codes.GUARD_CLICK, 0, 0.0)


@pytest.mark.parametrize("angle", [0.2, 0.5, 0.6, 0.6 + 0.9 * MARGIN])
def test_a_guard_that_is_no_gap_and_is_not_passed_waits(angle):
    block = wheel()
    write(block, {2: angle + 0 * T})
    assert search(block) == NOTHING


def wheel():
    """The block of a wheel on a stop that has clicked at 0.1 and does so next at 0.6."""
    body = Body("wheel", 1.0, 1.0, (0.0, 0.0, 0.2))
    return of_scale_one(Mechanism(bodies=(body,), contacts=(AngleStop("pawl", "wheel", GROUND, 0.1, 0.5),)))
