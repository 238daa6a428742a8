"""Many designs in one call: the bits of the FMU, design by design."""

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from mechanism_fmu.batch import Batch
from mechanism_fmu.model import MechanismError
from tests.analytic.cycle import DRIVES, PERIOD
from tests.fmu.conformance.host import Fmu, Instance
from tests.fmu.test_ratchet_numbers import TABLE


@pytest.fixture(scope="module")
def ratchets(ratchet_fmu: Path) -> Batch:
    return Batch.of_fmu(ratchet_fmu)


@pytest.fixture(scope="module")
def cams(cam_drive_fmu: Path) -> Batch:
    return Batch.of_fmu(cam_drive_fmu)


def start_values(fmu: Fmu, designs: dict[str, np.ndarray], k: int):
    """A design as an FMU takes it."""
    cast = {"Real": float, "Integer": int, "Boolean": bool}
    return {name: cast[fmu.variables[name].type](column[k]) for name, column in designs.items()}


def fmu_alone(fmu: Fmu, designs, k: int, times, signals=None):
    """What the FMU itself makes of a design: its numbers, and its impacts as it told them step by step."""
    impacts = []
    with Instance(fmu) as one:
        one.begin(start_values(fmu, designs, k) | {name: column[0] for name, column in (signals or {}).items()})
        for step, (begin, end) in enumerate(pairwise(times)):
            one.set({name: float(column[step]) for name, column in (signals or {}).items()})
            one.slave.doStep(begin, end - begin)
            impacts += [one[f"impacts[{i + 1}].time"] for i in range(one["impacts_in_step"])]
        return one.get([*fmu.named("output"), *fmu.named("calculatedParameter")]), impacts


def test_guided_ratchets_are_those_of_the_fmu_to_the_bit(ratchet, ratchets):
    rng, count = np.random.default_rng(7), 12
    designs = {
        "tooth_count": rng.integers(10, 26, count).astype(float),
        "tooth_slope_angle": np.radians(rng.uniform(85, 105, count)),
        "pawl_length": rng.uniform(0.098, 0.102, count),
        "pawl_mass": rng.uniform(0.05, 0.2, count),
        "spring_stiffness": rng.uniform(5e-3, 25e-3, count),
        "restitution": rng.choice([0.0, 0.5], count),
        "friction": rng.choice([0.0, 0.1], count),
        "drive_torque": rng.uniform(0.8e-3, 1.5e-3, count),
        "load_torque": rng.uniform(-1e-3, 1e-3, count),
    }
    times = [0.0, 1.5]
    found = ratchets.run(designs, times, impacts=8)
    assert found.failures == ("",) * count
    assert min(found.impact_count) > 0
    for k in range(count):
        alone, _ = fmu_alone(ratchet, designs, k, times)
        assert {name: column[k] for name, column in found.values.items()} == alone
        kept = min(alone["impacts_in_step"], 8) if alone["impact_count"] <= 8 else 0
        for i in range(kept):
            for name, column in found.impacts.items():
                assert column[k, i] == alone[f"impacts[{i + 1}].{name}"]


def test_free_ratchets_with_a_driven_shaft_are_those_of_the_fmu_to_the_bit(ratchet, ratchets):
    """A stroke and a half, with inputs that change every 10 ms: clicks, changes of tooth, bounces."""
    designs = {
        "guided": np.zeros(3),
        "tooth_count": np.full(3, 20.0),
        "tooth_slope_angle": np.full(3, math.radians(95)),
        "drive_stiffness": np.array([2.0, 1.8, 2.2]),
        "drive_damping": np.full(3, 0.1),
        "pawl_spring_torque": np.full(3, 5e-3),
        "wheel_damping": np.full(3, 0.1),
        "restitution": np.array([0.0, 0.3, 0.5]),
        "drive_torque": np.zeros(3),
        "spring_preload": np.full(3, 3e-3),
    }
    times = (np.arange(1201) / 100).tolist()
    turn, drive = 2 * math.pi / PERIOD, DRIVES[0]
    middle = np.arange(1200) / 100 + 0.005
    signals = {
        "drive_angle": np.radians(drive.mean - drive.amplitude * np.cos(turn * middle)),
        "drive_speed": np.radians(drive.amplitude * turn * np.sin(turn * middle)),
    }
    found = ratchets.run(designs, times, signals=signals, impacts=200)
    assert found.failures == ("",) * 3
    assert min(found.values["clicks"]) >= 1
    for k in range(3):
        alone, impacts = fmu_alone(ratchet, designs, k, times, signals)
        assert {name: column[k] for name, column in found.values.items()} == alone
        count = found.impact_count[k]
        assert count == alone["impact_count"] > 5
        assert set(impacts) <= set(found.impacts["time"][k, :count].tolist())  # the FMU shows 8 of a step
        assert np.all(np.isnan(found.impacts["time"][k, count:]))
        assert k > 0 or len(impacts) == count


def test_cam_drives_are_those_of_the_fmu_to_the_bit(cam_drive, cams):
    rng, count = np.random.default_rng(3), 8
    designs = {
        "unilateral": np.array([0.0] * 2 + [1.0] * 6),
        "restitution": np.where(np.arange(count) < 5, 0.0, 0.4),
        "roller_radius": rng.uniform(0.008, 0.012, count),
        "follower_inertia": rng.uniform(1e-4, 2e-4, count),
        "cam_inertia": np.full(count, 1e-2),
        "cam_speed_start": (speed := rng.uniform(40.0, 60.0, count)),
        "drive_speed": speed,
    }
    times = (np.arange(51) / 100).tolist()
    found = cams.run(designs, times, impacts=3)
    assert found.failures.count("") > 4
    assert max(found.impact_count) > 3
    for k in np.flatnonzero(np.array(found.failures) == ""):
        alone, impacts = fmu_alone(cam_drive, designs, k, times)
        assert {name: column[k] for name, column in found.values.items()} == alone
        kept = found.impacts["time"][k]
        assert kept[~np.isnan(kept)].tolist() == impacts[:3] or designs["restitution"][k] > 0


def test_the_paper_s_impacts_are_found(ratchets):
    """Two independent implementations agreed on them (half a unit of the last digit)."""
    designs = {"tooth_slope_angle": np.radians(list(TABLE))}
    found = ratchets.run(designs, [0.0, 2.0], ["wheel_speed", "impact_count"], until_impact=True)
    assert found.reached == pytest.approx([row[0] for row in TABLE.values()], abs=1e-10)
    assert found.impacts["time"][:, 0].tolist() == found.reached.tolist()
    assert found.values["wheel_speed"] == pytest.approx([row[-1] for row in TABLE.values()], abs=1e-10)
    assert found.values["impact_count"].tolist() == [1.0] * 5
    assert found.pulled["slope"].tolist()[:4] == [math.inf] * 4
    assert found.pulled["slope"][4] < found.reached[4]


BAD = {
    "limit": {"tooth_count": 2.0},
    "input": {"drive_torque": math.inf},
    "objection": {"pawl_length": 0.03},
    "start": {"guided": 0.0, "pawl_angle_start": 3.5},
}


@pytest.mark.parametrize("bad", BAD.values(), ids=BAD)
def test_one_failure_is_told_as_the_fmu_tells_it_and_leaves_the_others_alone(ratchet, ratchets, bad):
    defaults = {name: float(ratchet.start(name)) for name in bad}
    designs = {name: np.array([defaults[name], value, defaults[name]]) for name, value in bad.items()}
    found = ratchets.run(designs, [0.0, 1.0], extremes=True)
    well = ratchets.run({"drive_torque": [1e-3]}, [0.0, 1.0], extremes=True)
    for kind in ("values", "least", "greatest"):
        for name, column in getattr(found, kind).items():
            assert column[0] == column[2] == getattr(well, kind)[name][0]
            assert math.isnan(column[1])
    assert found.failures[0] == found.failures[2] == ""
    with Instance(ratchet) as one:
        with pytest.raises(FMICallException):
            one.begin(start_values(ratchet, designs, 1)).step(1.0)
        assert found.failures[1] == one.refusal.removeprefix("one: ")
        assert not found.reached[1] > one.time


def test_a_motion_that_cannot_go_on_is_told_likewise(four_bar, four_bar_fmu):
    """A parallelogram comes to lie flat."""
    lengths = {"ground_length": 0.3, "crank_length": 0.1, "coupler_length": 0.3, "rocker_length": 0.1}
    designs = {name: np.full(3, length) for name, length in lengths.items()}
    designs |= {"crank_angle_start": np.ones(3), "crank_speed_start": np.full(3, 6.0), "drive_speed": np.full(3, 6.0)}
    designs["ground_length"][:2] = 0.31, 0.32
    found = Batch.of_fmu(four_bar_fmu).run(designs, [0.0, 1.0])
    assert found.failures[:2] == ("", "")
    assert found.reached.tolist()[:2] == [1.0, 1.0]
    with Instance(four_bar) as one:
        one.begin(start_values(four_bar, designs, 2))
        with pytest.raises(FMICallException):
            one.step(1.0)
        assert "A singular configuration lies ahead" in one.refusal
        assert found.failures[2] == one.refusal.removeprefix("one: ")
    assert 0 < found.reached[2] < 1


def test_order_threads_and_company_change_no_bit(cams):
    rng, count = np.random.default_rng(5), 40
    speed = rng.uniform(40, 60, count)
    designs = {"unilateral": np.ones(count), "drive_speed": speed, "cam_speed_start": speed, "restitution": speed / 60}
    one = cams.run(designs, [0.0, 0.3], threads=1).table()
    order = rng.permutation(count)
    other = cams.run({name: column[order] for name, column in designs.items()}, [0.0, 0.3], threads=7).table()
    last = cams.run({name: column[-1:] for name, column in designs.items()}, [0.0, 0.3]).table()
    for name, column in one.items():
        np.testing.assert_array_equal(column[order], other[name])
        np.testing.assert_array_equal(column[-1:], last[name])


@pytest.mark.parametrize("until_impact", [False, True])
def test_without_a_library_designs_go_one_by_one_with_the_same_bits(cams, monkeypatch, until_impact):
    """As they do just in time; a compiled engine spares the tests that compilation where it lies ready."""
    monkeypatch.setattr("mechanism_fmu.batch.batch.library_here", lambda _report: None)
    designs = {
        "unilateral": np.ones(6),
        "restitution": np.array([0.0, 0.2, 0.4, 0.6, 0.8, 2.0]),
        "cam_speed_start": np.full(6, 50.0),
    }
    times = (np.arange(11) / 40).tolist()
    how = {"signals": {"drive_speed": np.linspace(40.0, 60.0, 10)}, "impacts": 12, "extremes": True}
    found = Batch(cams.model).run(designs, times, threads=3, until_impact=until_impact, **how)
    one_call = cams.run(designs, times, until_impact=until_impact, **how)
    assert (found.compiled, one_call.compiled) == ("just in time", "ahead of time")
    assert np.nansum(found.impacts["closing_speed"]) > 0
    for name, column in found.table().items():
        np.testing.assert_array_equal(column, one_call.table()[name], name)


def test_communication_points_change_no_bit_but_show_more_extremes(ratchets):
    designs = {"tooth_count": [10.0, 15.0]}
    few = ratchets.run(designs, [0.0, 1.3], ["wheel_speed", "pawl_speed"], extremes=True)
    many = ratchets.run(designs, np.linspace(0.0, 1.3, 131), ["wheel_speed", "pawl_speed"], extremes=True)
    for name in few.values:
        assert few.values[name].tolist() == many.values[name].tolist()
        assert np.all(many.least[name] <= few.least[name])
        assert np.all(many.greatest[name] >= few.greatest[name])
    assert np.all(many.least["pawl_speed"] < few.least["pawl_speed"])
    assert few.greatest["wheel_speed"].tolist() == few.values["wheel_speed"].tolist()


def test_progress_is_told_and_what_it_raises_stops_the_run(ratchets):
    told = []
    ratchets.run({"drive_torque": np.full(5000, 1e-3)}, [0.0, 0.01], [], progress=lambda *now: told.append(now))
    assert told[-1] == (5000, 5000)
    assert told == sorted(told)

    class StopError(Exception):
        pass

    def stop(_done, _all):
        raise StopError

    with pytest.raises(StopError):
        ratchets.run({"drive_torque": np.full(10**5, 1e-3)}, [0.0, 100.0], [], progress=stop)


@pytest.mark.parametrize(
    ("designs", "how", "message"),
    [
        ({"tooth": [1.0]}, {}, "Ratchet has no parameter or input 'tooth'; it has: baumgarte_alpha,"),
        ({}, {}, "but there are none"),
        ({"friction": [0.0], "restitution": [0.0, 0.1]}, {}, "friction has 1, restitution has 2"),
        ({"friction": 0.1}, {}, "friction has the shape"),
        ({"friction": [0.1]}, {"times": [0.0]}, "at least two"),
        ({"friction": [0.1]}, {"times": [0.0, 0.0]}, "later"),
        ({"friction": [0.1]}, {"outputs": ["speed"]}, "Ratchet has no output 'speed'; it has: wheel_angle,"),
        ({"friction": [0.1]}, {"signals": {"torque": [0.0]}}, "Ratchet has no input 'torque'; it has: drive_torque,"),
        ({"friction": [0.1]}, {"signals": {"drive_torque": [0.0, 1.0]}}, "give 1 values, one a step"),
        ({"friction": [0.1]}, {"signals": {"drive_torque": [math.nan]}}, "drive_torque = nan is not a finite number"),
    ],
)
def test_what_cannot_be_asked_is_refused(ratchets, designs, how, message):
    with pytest.raises(MechanismError, match=message.replace("[", r"\[")):
        ratchets.run(designs, **{"times": [0.0, 1.0]} | how)


def test_warnings_are_those_of_the_fmu(ratchet, ratchets):
    designs = {
        "pawl_angle_start": [0.0, 3.0, 3.0, 0.0],
        "tooth_count": [10.0, 10.0, 25.0, 2.0],
        "tooth_slope_angle": np.radians([90, 90, 105, 90]),
    }
    found = ratchets.run(designs, [0.0, 1.0], [])
    assert found.warnings[0] == found.warnings[3] == ""
    assert found.warnings[1].startswith("pawl_angle_start is not used by the guided pawl")
    assert found.warnings[2].count("the guided contact slope pulls") == 1
    for k in range(3):
        with Instance(ratchet) as one:
            one.begin(start_values(ratchet, designs, k)).step(1.0)
            assert found.warnings[k] == "\n".join(m.text for m in one.log if m.category == "logStatusWarning")
