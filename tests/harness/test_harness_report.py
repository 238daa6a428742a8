import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from fake_slave import FakeFmu, FakeSlave

from harness.errors import FmuError, LogMessage, Status
from harness.report.motion import motion_plots
from harness.report.run_report import run_report, write_report
from harness.run.checks import Check
from harness.run.experiment import Experiment, Run, perform


def run_of(slave: FakeSlave) -> Run:
    return perform(FakeFmu(slave), Experiment(1.0, 0.1, {"tooth_count": 20}))  # type: ignore[arg-type]


def test_the_report_is_one_page_that_needs_no_network(tmp_path: Path) -> None:
    html = write_report(run_of(FakeSlave(impacts=[0.5])), tmp_path / "report.html").read_text(encoding="utf-8")
    assert html.startswith("<!doctype html>")
    assert "<script src=" not in html
    assert "<link" not in html
    for heading in ("Verdicts", "Motion", "Impacts", "Parameters", "Versions"):
        assert f"<h2>{heading}</h2>" in html
    assert "Bending stress" not in html  # the fake has no tooth


def test_what_was_set_is_marked() -> None:
    html = run_report(run_of(FakeSlave()))
    assert '<tr class="changed"><td>tooth_count</td><td class="number">20</td><td>1</td>' in html
    assert html.count('<tr class="changed">') == 1


def test_a_run_that_ended_early_says_so_first() -> None:
    html = run_report(run_of(FakeSlave(fail=lambda time: Status.FATAL if time > 0.45 else None)))
    assert html.index("This run ended early, at 0.5 s") < html.index("<h2>Verdicts</h2>")
    assert "refused at 0.5 s" in html


def test_a_run_that_never_began_still_has_a_report() -> None:
    class Broken(FakeSlave):
        def initialize(self, start_time: float, stop_time: float) -> None:
            raise FmuError("cannot be assembled")

    run = run_of(Broken())
    assert motion_plots(run) == []
    assert "cannot be assembled" in run_report(run)


def test_texts_of_the_fmu_cannot_break_the_page() -> None:
    message = LogMessage("Fake", 0.1, Status.WARNING, "", "<b>gap < 0 & closing</b>")
    html = run_report(replace(run_of(FakeSlave()), messages=[message]))
    assert "&lt;b&gt;gap &lt; 0 &amp; closing&lt;/b&gt;" in html


def test_more_verdicts_join_those_of_the_run() -> None:
    html = run_report(run_of(FakeSlave()), [Check("It is quiet", False, "70 dB")])
    assert '<li class="bad">It is quiet<small>70 dB</small></li>' in html


def test_every_impact_is_a_line_across_all_charts() -> None:
    plots = motion_plots(run_of(FakeSlave(impacts=[0.25, 0.5])))
    assert plots
    assert all(np.asarray(plot.marks).tolist() == [0.25, 0.5] for plot in plots)


def test_angles_are_shown_in_degrees_from_their_start() -> None:
    plot = motion_plots(run_of(FakeSlave()))[0]
    angle = plot.curves[0]
    assert (angle.name, angle.about) == ("wheel_angle, from 0 deg", "wheel_angle")
    assert np.asarray(angle.y)[-1] == pytest.approx(57.29577951308232)
    assert plot.title == "Angle change [deg]"


def test_curves_have_the_descriptions_of_their_variables() -> None:
    run = run_of(FakeSlave())
    known = run.description.variables
    said = {**known, "wheel_angle": replace(known["wheel_angle"], description="How far the wheel has turned")}
    plots = motion_plots(replace(run, description=replace(run.description, variables=said)))
    assert plots[0].curves[0].name == "How far the wheel has turned, from 0 deg"


def test_the_heading_says_which_model_and_the_title_too() -> None:
    run = run_of(FakeSlave())
    html = run_report(replace(run, description=replace(run.description, model="Pawl & <wheel>")))
    assert html.count("<h1>") == 1
    assert "<title>Pawl &amp; &lt;wheel&gt;</title>" in html
    assert "<header><h1>Pawl &amp; &lt;wheel&gt;</h1><p>" in html


def test_the_line_below_it_says_what_was_run() -> None:
    html = run_report(run_of(FakeSlave(impacts=[0.5])))
    subtitle = re.search(r"</h1><p>(.*?)</p>", html)
    assert subtitle is not None
    for part in ("Fake.fmu", "1 s", "0.1 s"):
        assert part in subtitle[1]
