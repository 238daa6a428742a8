"""Escapements of models/: against another computation, tests/data/shapes.json, and laws they obey."""

import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import models
from benchmarks.escapements import ESCAPEMENTS, columns, exponent, steady
from benchmarks.world.cases.graham import CYCLES, TICKS, Clock, cycle
from mechanism_fmu.model import MechanismError
from mechanism_fmu.moving import Impact
from mechanism_fmu.simulation import Simulation

_CASES = json.loads((Path(__file__).parents[1] / "data" / "shapes.json").read_text(encoding="utf-8"))["cases"]
CASE, GRAHAM = (next(case for case in _CASES if case["kind"] == kind) for kind in ("pin_pallet", "graham_dead_beat"))
#: Of the verge, with 8 N.mm.
VERGE = next(case for case in _CASES if case["case"] == "verge_0.008")
BY_NAME = {one.model: one for one in ESCAPEMENTS}
SWINGS = {one.model: f"{one.body}_angle" for one in ESCAPEMENTS}

#: The data of the other computation, whose wheels turn clockwise: all is its mirror image.
PENDULUM = {"pendulum_length": 9.75 / 9.81, "pendulum_inertia": 0.988 - (9.75 / 9.81) ** 2}
DATA = {
    "pin_pallet": {"frequency": 2.5, "quality": 10.0, "balance_angle_start": math.radians(-6)},
    "graham": {**PENDULUM, "pendulum_damping": 0.1, "pendulum_angle_start": math.radians(-3)},
    "recoil_anchor": {**PENDULUM, "pendulum_angle_start": math.radians(-4)},
    "verge": {},
}
TORQUE = {"pin_pallet": 6e-4, "graham": 12e-3, "recoil_anchor": 12e-3, "verge": 1e-3}


def simulation(name: str, torque: float | None = None, **values: float) -> Simulation:
    model = models.load(name).MODEL
    found = Simulation(model.build(model.values(**{**DATA[name], **values})))
    found.set_input("drive_torque", TORQUE[name] if torque is None else torque)
    return found


def run(name: str, until: float, step: float, **values: Any) -> tuple[list[Impact], list[dict[str, float]]]:
    """Impacts up to a time, and what is shown at each step."""
    running, found, shown = simulation(name, **values), [], []
    for k in range(1, round(until / step) + 1):
        running.advance(k * step)
        found += running.impacts_in_step()
        shown.append(running.read())
    return found, shown


def period(found: list[Impact], pallet: str) -> float:
    """Of the last five swings."""
    times = [tick.time for tick in found if tick.contact.startswith(pallet)]
    return (times[-1] - times[-6]) / 5


def test_the_pin_pallet_ticks_as_another_computation_found() -> None:
    found, _ = run("pin_pallet", 0.6, 0.01)
    assert len(found) >= 6
    for tick, wanted in zip(found, CASE["results"]["first_ticks"], strict=False):
        assert tick.time == pytest.approx(float(wanted["t"]), abs=1e-8)
        assert tick.contact.partition("_")[0] == wanted["contact"].partition("/")[0]


def test_its_limit_cycle_has_the_period_and_amplitudes_of_another_computation() -> None:
    found, shown = run("pin_pallet", 24.6, 0.01)
    wanted = {name: float(value) for name, value in CASE["results"]["limit_cycle"].items()}
    entries = [tick.time for tick in found if tick.contact.startswith("entry")]
    assert entries[-1] - entries[-3] == pytest.approx(wanted["period"], abs=2e-9)
    balance = np.array([row["balance_angle"] for row in shown[-200:]])
    assert -balance.min() == pytest.approx(wanted["max_angle"], rel=2e-3)  # seen a hundred times a second
    assert -balance.max() == pytest.approx(wanted["min_angle"], rel=2e-3)
    # what the element says of it is more exact than what is seen so
    assert shown[-1]["period"] == pytest.approx(wanted["period"], abs=2e-9)
    assert shown[-1]["amplitude"] == pytest.approx(0.5 * (wanted["max_angle"] - wanted["min_angle"]), abs=1e-8)
    wheel = (shown[-1]["wheel_angle"] - shown[-405]["wheel_angle"]) / 4.04  # ten periods, in which ten teeth pass
    assert wheel == pytest.approx(np.radians(24.0) / wanted["period"], rel=2e-3)


def test_graham_ticks_as_another_computation_found() -> None:
    found, _ = run("graham", 6.0, 0.5)
    assert len(found) > 3
    for tick, wanted in zip(found, GRAHAM["results"]["first_ticks"], strict=False):
        assert tick.time == pytest.approx(float(wanted["t"]), abs=1e-8)
        assert tick.closing_speed == pytest.approx(-float(wanted["closing"]), rel=1e-7)
        assert tick.contact.partition("_")[0] == wanted["contact"].partition("/")[0]


def test_the_second_formulation_of_graham_ticks_as_another_computation_found() -> None:
    """That of benchmarks.world, which has its own numbers of the default clock."""
    ticks = Clock(TORQUE["graham"], **DATA["graham"]).go(6).ticks
    wanted = [(float(one["t"]), -float(one["closing"])) for one in GRAHAM["results"]["first_ticks"]]
    np.testing.assert_allclose(ticks, wanted, rtol=0, atol=1e-12)


@pytest.mark.slow
def test_the_numbers_of_graham_in_benchmarks_are_those_of_its_second_formulation() -> None:
    np.testing.assert_allclose(Clock(TORQUE["graham"]).go(6).ticks, TICKS, rtol=0, atol=1e-12)
    for factor, numbers in CYCLES.items():
        np.testing.assert_allclose(cycle(factor, -0.066 * math.sqrt(factor)), numbers, rtol=0, atol=1e-11)


def test_the_dead_beat_keeps_its_rate_where_the_recoil_does_not() -> None:
    """Same pendulum and damping, half as much torque again: Graham's rate changes by 6e-5, the recoil anchor's by 2e-3.

    With recoil it gains, since the wheel pushes the pendulum back to the middle; both have as many ticks as swings.
    """
    changes = {}
    for name in ("graham", "recoil_anchor"):
        periods = []
        for torque in (8e-3, 12e-3):
            found, shown = run(name, 100.0, 1.0, torque=torque, pendulum_damping=0.03)
            periods.append(period(found, "entry"))
            teeth = (shown[-1]["wheel_angle"] - shown[0]["wheel_angle"]) / math.radians(12.0)
            assert teeth == pytest.approx(99.0 / periods[-1], abs=1.0)
            assert shown[-1]["period"] == pytest.approx(periods[-1], rel=2e-4)
        changes[name] = periods[1] / periods[0] - 1.0
    assert abs(changes["graham"]) < 1e-4
    assert changes["recoil_anchor"] < -1.5e-3


def test_the_recoil_anchor_pushes_its_wheel_back() -> None:
    """The wheel turns back for a while after each tick; Graham's never does but by rebounds."""
    back = {}
    for name in ("recoil_anchor", "graham"):
        _, shown = run(name, 8.0, 0.02)
        angles = np.array([row["wheel_angle"] for row in shown])
        back[name] = float(-np.clip(np.diff(angles), None, 0.0).sum())
    assert back["recoil_anchor"] > 0.05
    assert back["graham"] < 1e-6


def test_the_verge_goes_twice_as_fast_with_four_times_the_torque() -> None:
    """Exactly, by the same angles: there is no other time in it than that of torque and inertia."""
    (slow, at_slow), (fast, at_fast) = (run("verge", 5.0 / k, 0.05 / k, torque=k * k * 8e-4) for k in (1, 2))
    assert len(slow) == len(fast) > 10
    assert [tick.time / 2.0 for tick in slow] == pytest.approx([tick.time for tick in fast], rel=1e-7)
    assert [2.0 * t.closing_speed for t in slow] == pytest.approx([t.closing_speed for t in fast], rel=1e-5)
    angles = [[row["foliot_angle"] for row in shown] for shown in (at_slow, at_fast)]
    assert angles[0] == pytest.approx(angles[1], abs=1e-6)


def test_the_verge_ticks_and_comes_to_the_cycle_of_another_computation() -> None:
    scale = math.sqrt(8.0)  # from 8 N.mm to 1 N.mm
    found, shown = run("verge", 20.0, 0.1)
    wanted = VERGE["results"]
    for tick, one in zip(found, wanted["first_ticks"], strict=False):
        assert tick.time == pytest.approx(scale * float(one["t"]), rel=1e-8)
        assert tick.contact.partition("_")[0] == one["contact"].partition("/")[0]
    assert period(found, "upper") == pytest.approx(scale * float(wanted["limit_cycle"]["period"]), rel=1e-8)
    assert shown[-1]["period"] == pytest.approx(scale * float(wanted["limit_cycle"]["period"]), rel=1e-8)


def test_the_period_of_the_verge_goes_with_the_torque_to_minus_a_half() -> None:
    low, high = ((factor, steady(BY_NAME["verge"], factor)) for factor in (0.5, 4.0))
    assert exponent(low, high) == pytest.approx(-0.5, abs=1e-6)
    assert low[1].amplitude == pytest.approx(high[1].amplitude, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "least", "most"),
    [
        ("recoil_anchor", -6e-3, -3.5e-3),
        ("graham", -1e-3, 0.0),
        ("pin_pallet", -8e-3, -3e-3),
        ("lever_escapement", -1e-3, 1e-3),
    ],
)
def test_what_has_a_spring_or_a_pendulum_hardly_depends_on_the_torque(name: str, least: float, most: float) -> None:
    """From half the default torque to twice as much, in the limit cycles."""
    low, high = ((factor, steady(BY_NAME[name], factor)) for factor in (0.5, 2.0))
    assert least < exponent(low, high) < most


@pytest.mark.parametrize("name", ["pin_pallet", "lever_escapement"])
def test_a_stronger_spring_swings_more(name: str) -> None:
    """And what it gives goes into the air: in the limit cycle the power is that of the teeth that pass."""
    model = models.load(name).MODEL
    found = []
    for factor in (1.0, 1.5):
        running = Simulation(model.build(model.values(quality=10.0 if name == "pin_pallet" else 30.0)))
        torque = factor * model.inputs[0].start
        running.set_input("drive_torque", torque)
        running.advance(24.0)
        shown = running.read()
        assert shown["power"] == pytest.approx(torque * math.radians(24.0) / shown["period"], rel=1e-4)
        found.append(shown["amplitude"])
    assert found[0] < found[1]


def test_the_balance_of_the_lever_escapement_is_detached() -> None:
    """It swings far beyond the lever, which rests on its banking pins; one tooth for each swing to and fro."""
    model = models.load("lever_escapement").MODEL
    running = Simulation(model.build(model.values()))
    start, lever = running.read()["wheel_angle"], []
    for k in range(1, 2001):
        running.advance(k * 0.01)
        lever.append(running.read()["lever_angle"])
    shown = running.read()
    assert shown["amplitude"] > 1.9
    assert shown["wheel_angle"] - start == pytest.approx(shown["swings"] * math.radians(24.0), abs=math.radians(24.0))
    rests = np.isclose(np.abs(lever), math.radians(5.0), atol=1e-6)
    assert rests.mean() > 0.8


@pytest.mark.slow
def test_the_lever_escapement_runs_for_good() -> None:
    """An hour would be as this: a quarter of one, and as many teeth as swings."""
    model = models.load("lever_escapement").MODEL
    running = Simulation(model.build(model.values()))
    start = running.read()["wheel_angle"]
    for minute in range(15):
        running.advance(60.0 * (minute + 1))
    shown = running.read()
    assert shown["swings"] == pytest.approx(2250.0, abs=1.0)
    assert shown["wheel_angle"] - start == pytest.approx(shown["swings"] * math.radians(24.0), abs=math.radians(24.0))


@pytest.mark.parametrize("name", SWINGS)
def test_the_default_run_is_the_reference_curve(name: str) -> None:
    curve = pd.read_csv(models.available()[name] / "reference.csv")
    assert tuple(curve) == ("time", *columns(BY_NAME[name]))
    model = models.load(name).MODEL
    running = Simulation(model.build(model.values()))
    rows = []
    for time in curve["time"]:
        running.advance(time)
        rows.append(running.read())
    for column, scale in {
        "wheel_angle": 1.0,
        SWINGS[name]: 1.0,
        "period": 1.0,
        "amplitude": 1.0,
        "swings": 1.0,
    }.items():
        np.testing.assert_allclose([row[column] for row in rows], curve[column], rtol=0, atol=2e-7 * scale)


# What is refused at the start.


@pytest.mark.parametrize(
    ("name", "values", "says"),
    [
        (
            "graham",
            {"tip_radius": 3.5e-4},
            "The anchor jams: with pallet_thickness = 0.0026 m and tip_radius = 0.00035 m",
        ),
        ("recoil_anchor", {"pallet_thickness": 2.9e-3}, "The anchor jams: with pallet_thickness = 0.0029 m and"),
        ("lever_escapement", {"pallet_thickness": 6e-3}, "The anchor jams: with pallet_thickness = 0.006 m and"),
        ("pin_pallet", {"pin_radius": 8e-4}, "The anchor jams: with thickness of the teeth = 0.00478"),
        ("verge", {"tip_radius": 9e-4}, "The verge jams: with tip_radius = 0.0009 m"),
        ("graham", {"lock_angle": math.radians(0.3)}, "The anchor does not hold: lock_angle = 0.3 deg"),
        ("lever_escapement", {"lock_angle": math.radians(0.5)}, "The anchor does not hold: lock_angle = 0.5 deg"),
    ],
)
def test_an_anchor_that_jams_or_does_not_hold_is_named_at_the_start(name, values, says) -> None:
    model = models.load(name).MODEL
    with pytest.raises(MechanismError, match=re.escape(says)):
        model.build(model.values(**values))


@pytest.mark.parametrize(
    ("name", "tip"),
    [
        ("graham", "tip_radius"),
        ("recoil_anchor", "tip_radius"),
        ("lever_escapement", "tip_radius"),
        ("pin_pallet", "pin_radius"),
        ("verge", "tip_radius"),
    ],
)
def test_the_limit_that_is_named_is_the_limit(name: str, tip: str) -> None:
    """Just below it is not refused, for this; nor for a lock that is too small for such a tip."""
    model = models.load(name).MODEL
    locked = {"lock_angle": 0.1} if name in ("graham", "lever_escapement") else {}
    (said,) = model.refused(model.values(**locked, **{tip: 2e-3}))
    assert re.search(r"drop (?:is|of the wheel is) -", said)
    most = float(re.search(r"(?:below|less than) ([\d.e-]+) m", said)[1])
    assert not model.refused(model.values(**locked, **{tip: 0.9999 * most}))
    assert model.refused(model.values(**locked, **{tip: 1.0001 * most}))
