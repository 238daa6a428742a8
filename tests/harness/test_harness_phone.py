import pytest
from fake_slave import FakeFmu, FakeSlave

from harness.report.motion import motion_chart
from harness.report.run_report import stacked
from harness.run.experiment import Experiment, perform


def test_on_a_phone_the_charts_keep_their_heights_and_the_legends_stand_above_them() -> None:
    run = perform(FakeFmu(FakeSlave(impacts=[0.5])), Experiment(1.0, 0.1))  # type: ignore[arg-type]
    run.results["drive_torque"] = range(len(run.results))  # an input that varies: a second chart
    figure = motion_chart(run)
    assert figure is not None
    wide, narrow = figure.layout, stacked(figure)
    inner = narrow["height"] - narrow["margin"]["t"] - narrow["margin"]["b"]
    wide_inner = wide.height - wide.margin.t - wide.margin.b
    ceiling = 1.0
    for number in ("", "2"):
        bottom, top = narrow[f"yaxis{number}"]["domain"]
        wide_bottom, wide_top = wide[f"yaxis{number}"].domain
        assert inner * (top - bottom) == pytest.approx(wide_inner * (wide_top - wide_bottom), abs=0.1)
        assert narrow[f"legend{number}"]["y"] == top
        assert top < ceiling
        ceiling = bottom
    assert ceiling == pytest.approx(0.0, abs=1e-12)
