"""Escapements and ratchets of the gallery: against another computation, tests/data/shapes.json, and laws they obey."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from gallery_examples import simulation

_CASES = json.loads((Path(__file__).parents[1] / "data" / "shapes.json").read_text(encoding="utf-8"))["cases"]
CASE, GRAHAM = (next(case for case in _CASES if case["kind"] == kind) for kind in ("pin_pallet", "graham_dead_beat"))
#: Of the verge, with 8 N.mm.
VERGE = next(case for case in _CASES if case["case"] == "verge_0.008")


def ticks(until: float, **values: float) -> tuple[list, list[dict[str, float]]]:
    """Impacts up to a time, and what is shown a hundred times a second."""
    running, found, shown = simulation("pin_pallet", **values), [], []
    for k in range(1, round(until * 100) + 1):
        running.advance(k / 100)
        found += running.impacts_in_step()
        shown.append(running.read())
    return found, shown


def test_it_ticks_as_another_computation_found() -> None:
    found, _ = ticks(0.6)
    for tick, wanted in zip(found, CASE["results"]["first_ticks"], strict=False):
        assert tick.time == pytest.approx(float(wanted["t"]), abs=1e-8)
        assert tick.contact.partition("_")[0] == wanted["contact"].partition("/")[0]


def test_its_limit_cycle_has_the_period_and_amplitudes_of_another_computation() -> None:
    found, shown = ticks(24.6)
    wanted = {name: float(value) for name, value in CASE["results"]["limit_cycle"].items()}
    entries = [tick.time for tick in found if tick.contact.startswith("entry")]
    assert entries[-1] - entries[-3] == pytest.approx(wanted["period"], abs=2e-9)
    lever = np.array([row["lever"] for row in shown[-200:]])
    assert lever.max() == pytest.approx(wanted["max_angle"], rel=2e-3)  # seen a hundred times a second
    assert lever.min() == pytest.approx(wanted["min_angle"], rel=2e-3)
    wheel = (shown[-1]["wheel"] - shown[-405]["wheel"]) / 4.04  # ten periods, in which ten teeth pass
    assert wheel == pytest.approx(-np.radians(24.0) / wanted["period"], rel=2e-3)


def test_a_weaker_spring_swings_less() -> None:
    spans = []
    for torque in (0.5e-3, 0.8e-3):
        _, shown = ticks(8.0, torque=torque)
        spans.append(np.ptp([row["lever"] for row in shown[-200:]]))
    assert spans[0] < spans[1]


def run(name: str, until: float, step: float, **values: float) -> tuple[list, list[dict[str, float]]]:
    """Impacts of an example up to a time, and what is shown at each step."""
    running, found, shown = simulation(name, **values), [], []
    for k in range(1, round(until / step) + 1):
        running.advance(k * step)
        found += running.impacts_in_step()
        shown.append(running.read())
    return found, shown


def period(found: list, pallet: str) -> float:
    """Of the last five swings."""
    times = [tick.time for tick in found if tick.contact.startswith(pallet)]
    return (times[-1] - times[-6]) / 5


def test_graham_ticks_as_another_computation_found() -> None:
    found, _ = run("graham", 6.0, 0.5)
    for tick, wanted in zip(found, GRAHAM["results"]["first_ticks"], strict=False):
        assert tick.time == pytest.approx(float(wanted["t"]), abs=1e-8)
        assert tick.closing_speed == pytest.approx(-float(wanted["closing"]), rel=1e-7)
        assert tick.contact.partition("_")[0] == wanted["contact"].partition("/")[0]


def test_the_dead_beat_keeps_its_rate_where_the_recoil_does_not() -> None:
    """Same pendulum and damping, half as much torque again: Graham's rate changes by 6e-5, the recoil anchor's by 2e-3.

    With recoil it gains, since the wheel pushes the pendulum back to the middle; both have as many ticks as swings.
    """
    changes = {}
    for name in ("graham", "anchor"):
        periods = []
        for torque in (8e-3, 12e-3):
            found, shown = run(name, 100.0, 1.0, torque=torque, damping=0.03)
            periods.append(period(found, "entry"))
            teeth = (shown[0]["wheel"] - shown[-1]["wheel"]) / math.radians(12.0)
            assert teeth == pytest.approx(99.0 / periods[-1], abs=1.0)
        changes[name] = periods[1] / periods[0] - 1.0
    assert abs(changes["graham"]) < 1e-4
    assert changes["anchor"] < -1.5e-3


def test_the_recoil_anchor_pushes_its_wheel_back() -> None:
    """The wheel turns clockwise, but for a while after each tick; Graham's never goes back but by rebounds."""
    back = {}
    for name in ("anchor", "graham"):
        _, shown = run(name, 8.0, 0.02)
        angles = np.array([row["wheel"] for row in shown])
        back[name] = float(np.clip(np.diff(angles), 0.0, None).sum())
    assert back["anchor"] > 0.05
    assert back["graham"] < 1e-6


def test_the_verge_goes_twice_as_fast_with_four_times_the_torque() -> None:
    """Exactly, by the same angles: there is no other time in it than that of torque and inertia."""
    (slow, at_slow), (fast, at_fast) = (run("verge", 5.0 / k, 0.05 / k, torque=k * k * 8e-4) for k in (1, 2))
    assert len(slow) == len(fast) > 10
    assert [tick.time / 2.0 for tick in slow] == pytest.approx([tick.time for tick in fast], rel=1e-7)
    assert [2.0 * t.closing_speed for t in slow] == pytest.approx([t.closing_speed for t in fast], rel=1e-5)
    assert [row["verge"] for row in at_slow] == pytest.approx([row["verge"] for row in at_fast], abs=1e-6)


def test_the_verge_ticks_and_comes_to_the_cycle_of_another_computation() -> None:
    scale = math.sqrt(8.0)  # from 8 N.mm to 1 N.mm
    found, _ = run("verge", 20.0, 0.1)
    wanted = VERGE["results"]
    for tick, one in zip(found, wanted["first_ticks"], strict=False):
        assert tick.time == pytest.approx(scale * float(one["t"]), rel=1e-8)
        assert tick.contact.partition("_")[0] == one["contact"].partition("/")[0]
    assert period(found, "upper") == pytest.approx(scale * float(wanted["limit_cycle"]["period"]), rel=1e-8)


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
