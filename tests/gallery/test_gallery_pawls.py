"""Ratchets of the gallery: laws that they obey."""

import math

import numpy as np
import pytest
from gallery_examples import simulation


def run(name: str, until: float, step: float, **values: float) -> tuple[list, list[dict[str, float]]]:
    """Impacts of an example up to a time, and what is shown at each step."""
    running, found, shown = simulation(name, **values), [], []
    for k in range(1, round(until / step) + 1):
        running.advance(k * step)
        found += running.impacts_in_step()
        shown.append(running.read())
    return found, shown


def test_two_pawls_hold_the_wheel_every_half_pitch() -> None:
    """Twelve teeth, and rest at multiples of 15 deg from each other, on the one pawl or the other."""
    rests = {}
    for speed in (6.0, 9.0, 12.0, 14.0):
        found, shown = run("two_pawls", 2.0, 0.1, speed=speed)
        assert len(found) > 3
        assert abs(shown[-1]["wheel_rate"]) < 1e-9
        forces = shown[-1]["first_force"], shown[-1]["second_force"]
        rests[speed] = math.degrees(shown[-1]["wheel"]) / 15.0, forces[0] > forces[1]
    places = [place for place, _ in rests.values()]
    steps = np.diff(places)
    assert steps == pytest.approx(np.round(steps), abs=1e-8)
    assert list(np.round(steps)) == [2, 2, 1]
    held_by_first = [first for _, first in rests.values()]
    assert held_by_first == [True, True, True, False]


def test_a_freewheel_runs_ahead_freely_and_drives_the_other_way() -> None:
    """Ahead: the clicks alone slow it. Behind: both go together, with the angular momentum of before."""
    ahead, shown = run("freewheel", 1.0, 0.05, torque=0.0, ring_speed=20.0)
    assert len(ahead) > 20
    assert shown[-1]["ring_rate"] > 19.0
    assert abs(shown[-1]["driver_rate"]) < 2.0

    _, shown = run("freewheel", 1.0, 0.05, torque=0.0, driver_speed=10.0, ring_speed=0.0)
    last = shown[-1]
    assert last["driver_rate"] == pytest.approx(last["ring_rate"], abs=1e-9)
    of_pawl = simulation("freewheel", torque=0.0, driver_speed=10.0, ring_speed=0.0).read()
    before, behind = (5e-7 + 0.01 * (row["pawl_x"] ** 2 + row["pawl_y"] ** 2) for row in (of_pawl, last))
    assert (5e-4 + before) * 10.0 == pytest.approx((5e-4 + 2e-3 + behind) * last["ring_rate"], rel=1e-7)


def test_a_driver_that_has_caught_up_drives_the_ring() -> None:
    """With the acceleration of both: torque over the inertia of all three bodies."""
    _, shown = run("freewheel", 1.5, 0.1)
    assert shown[3]["ring_rate"] > shown[3]["driver_rate"]
    last = shown[-1]
    inertia = 5e-4 + 2e-3 + 5e-7 + 0.01 * (last["pawl_x"] ** 2 + last["pawl_y"] ** 2)
    assert (last["ring_rate"] - shown[-5]["ring_rate"]) / 0.4 == pytest.approx(0.020 / inertia, rel=1e-6)
