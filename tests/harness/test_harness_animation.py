import json
import re
from dataclasses import replace

import numpy as np
import pytest
from fake_slave import FakeFmu, FakeSlave
from hypothesis import given, strategies as st

from harness.errors import FmuError
from harness.fmu.description import Variable
from harness.report.animation import animation, animation_data, playing_speeds
from harness.report.run_report import run_report
from harness.run.drawing import Drawing, Shape
from harness.run.experiment import Experiment, Run, perform

SHAPES = (
    Shape("wheel", (0.0, 0.0), "wheel", {"angle": "wheel_angle", "count": "tooth_count"}, ((1.0, 0.0),), True),
    Shape("bar", (0.0, 0.0), "arm", {"angle": "-wheel_angle", "length": 2.0}),
    Shape("striker", "arm"),
)


def run_of(slave: FakeSlave, step: float = 0.1, shapes: tuple[Shape, ...] = SHAPES) -> Run:
    run = perform(FakeFmu(slave), Experiment(1.0, step, {"tooth_count": 20}))  # type: ignore[arg-type]
    return replace(run, drawing=Drawing(shapes))


def test_the_player_gets_shapes_and_frames() -> None:
    data = animation_data(run_of(FakeSlave(impacts=[0.25])))
    assert data is not None
    assert data["time"] == [k / 10 for k in range(11)]
    assert data["columns"] == [[k / 10 for k in range(11)]]
    assert data["impacts"] == [0.25]
    wheel, arm, striker = data["shapes"]
    assert (wheel["angle"], wheel["count"], wheel["pitch"]) == ([0, 1], 20, pytest.approx(-0.1 * np.pi))
    assert (arm["angle"], arm["length"], arm["pointed"]) == ([0, -1], 2.0, True)
    assert striker["at"] == "arm"
    assert data["contacts"] == []


def test_frames_are_few_and_hold_the_impacts() -> None:
    impacts = [0.12341, 0.5, 0.77777]
    data = animation_data(run_of(FakeSlave(impacts=impacts), step=1e-4))
    assert data is not None
    time = np.array(data["time"])
    assert len(time) <= 2000
    for instant in impacts:
        after = int(np.searchsorted(time, instant))
        assert time[after] - time[after - 1] == pytest.approx(1e-4)
    assert len(json.dumps(data)) < 300_000


def test_contacts_are_flagged_in_every_frame() -> None:
    run = run_of(FakeSlave())
    variables = {**run.description.variables, "face_active": Variable("face_active", 99, "Boolean", "output")}
    results = run.results.assign(face_active=[False] * 5 + [True] * 6)
    run = replace(run, description=replace(run.description, variables=variables), results=results)
    data = animation_data(run)
    assert data is not None
    assert [(c["name"], c["active"]) for c in data["contacts"]] == [("face", "00000111111")]
    assert '<li class="lamp" style="--lamp:var(--c1)">face</li>' in animation(run)


def test_the_section_needs_no_network_and_no_mouse() -> None:
    html = run_report(run_of(FakeSlave(impacts=[0.25])))
    assert html.index("<h2>Mechanism</h2>") < html.index("<h2>Motion</h2>")
    assert "prefers-reduced-motion" in html
    assert '<input type="range"' in html
    assert '<button type="button" class="play">Play</button>' in html
    assert "<script src=" not in html


def test_names_of_the_fmu_cannot_break_the_page() -> None:
    evil = "</script><b>"
    html = animation(run_of(FakeSlave(), shapes=(Shape("disc", (0.0, 0.0), evil, {"radius": 1.0}),)))
    assert evil not in html
    found = re.search(r'<script type="application/json">(.*?)</script>', html)
    assert found is not None
    assert json.loads(found[1])["shapes"][0]["name"] == evil


def test_without_a_drawing_there_is_no_section() -> None:
    assert animation(run_of(FakeSlave(), shapes=())) == ""


def test_a_drawing_that_cannot_be_used_is_a_note() -> None:
    run = replace(run_of(FakeSlave()), drawing=Drawing(objection="The drawing is <torn>."))
    assert "The drawing is &lt;torn&gt;." in animation(run)


def test_a_run_that_never_began_has_no_motion() -> None:
    class Broken(FakeSlave):
        def initialize(self, start_time: float, stop_time: float) -> None:
            raise FmuError("cannot be assembled")

    assert animation(run_of(Broken())) == ""


def test_frames_that_are_not_finite_are_left_out() -> None:
    run = run_of(FakeSlave())
    broken = run.results.assign(wheel_angle=[0.0, np.nan, *[0.2] * 8, np.inf])
    data = animation_data(replace(run, results=broken))
    assert data is not None
    assert len(data["time"]) == 9
    assert "nothing to draw" in animation(replace(run, results=run.results.assign(wheel_angle=np.nan)))


def test_an_impact_without_a_time_is_left_out() -> None:
    run = run_of(FakeSlave(impacts=[0.25, 0.5]))
    data = animation_data(replace(run, impacts=run.impacts.assign(time=[np.nan, 0.5])))
    assert data is not None
    assert data["impacts"] == [0.5]


@pytest.mark.parametrize("radius", [0.0, 1e308, 1e-320])
def test_what_has_no_size_is_a_note(radius: float) -> None:
    disc = Shape("disc", (0.0, 0.0), "d", {"radius": radius})
    assert "nothing to draw" in animation(run_of(FakeSlave(), shapes=(disc,)))


@pytest.mark.parametrize(("radius", "drawn"), [(1e-10, True), (1.1e-12, True), (0.4e-12, False)])
def test_how_small_a_mechanism_may_be(radius: float, drawn: bool) -> None:
    """Its picture is at least 1e-12 m wide or high."""
    html = animation(run_of(FakeSlave(), shapes=(Shape("disc", (0.0, 0.0), "d", {"radius": radius}),)))
    assert ("nothing to draw" not in html) is drawn


def test_a_parameter_that_is_not_finite_is_a_note() -> None:
    slave = FakeSlave()
    slave.values["tooth_pitch"] = float("nan")
    bar = Shape("wheel", (0.0, 0.0), "w", {"angle": "tooth_pitch", "count": 1.0}, ((1.0, 0.0),))
    assert "nothing to draw" in animation(run_of(slave, shapes=(bar,)))


@pytest.mark.parametrize(("span", "speed"), [(6.0, 1.0), (20.0, 1.0), (21.0, 2.0), (1.2, 0.5), (3600.0, 200.0)])
def test_the_default_speed_of_known_runs(span: float, speed: float) -> None:
    assert playing_speeds(span)[1] == speed


@given(span=st.floats(1e-9, 1e9))
def test_a_run_plays_within_twenty_seconds(span: float) -> None:
    speeds, speed = playing_speeds(span)
    assert speed in speeds
    assert 1.999 <= span / speed <= 20.001
    assert {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0} <= set(speeds)
    assert speeds == sorted(set(speeds))
