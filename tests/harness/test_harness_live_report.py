"""A run's report in which the engine runs: from the run's values, in less than 1 MB, or a sentence why not."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from chromium import PROGRAM, chromium, opened
from fake_slave import FakeFmu, FakeSlave, fake_description

import build_fmu
import models
from harness.app.commands import one_run
from harness.fmu import open_fmu
from harness.page.live_section import case_of, live_section, no_live_section
from harness.report.run_report import run_report
from harness.run.experiment import Experiment, Run, perform
from harness.run.inputs import InputSignals
from mechanism_fmu.fmu.disk.user_cache import record_build, record_source
from mechanism_fmu.fmu.native.link import has_linker
from mechanism_fmu.fmu.native.web import sources_of, web_module
from mechanism_fmu.fmu.own.find import write_new
from tests.report_page import packed

needs_linker = pytest.mark.skipif(not has_linker(), reason="ziglang is not installed")
ALL = [pytest.param(name, marks=() if name == "ratchet" else pytest.mark.slow) for name in models.available()]

SETTINGS = {"tooth_count": 12}


def run_of(**more: Any) -> Run:
    return perform(FakeFmu(FakeSlave(impacts=[0.5])), Experiment(1.0, 0.1, {"tooth_count": 20}, **more))  # type: ignore[arg-type]


def live_model(html: str) -> dict[str, Any]:
    """What the page inside knows."""
    page = packed(html, "live").decode()
    found: dict[str, Any] = json.loads(
        re.findall(r'<script type="application/json" id="model">(.*?)</script>', page)[0]
    )
    return found


def test_the_case_of_a_run_has_its_values_and_times() -> None:
    case = case_of(run_of())
    assert (case["name"], case["stop"], case["step"], case["signals"]) == ("this_run", 1.0, 0.1, {})
    assert case["values"]["tooth_count"] == 20
    described = fake_description()
    assert set(case["values"]) <= {variable.name for variable in described.of("parameter", "input")}


def test_a_table_of_inputs_is_followed_and_what_cannot_be_is_said() -> None:
    torque = fake_description().variable("drive_torque")
    table = InputSignals((torque,), np.array([0.0, 2.0]), np.array([[0.0], [1.0]]), "drive.csv", "ab12")
    run = replace(run_of(), inputs=table)
    case = case_of(run)
    assert case["signals"] == {"drive_torque": {"times": [0.0, 2.0], "values": [0.0, 1.0]}}
    assert "drive_torque" not in case["values"]
    long = replace(table, times=np.arange(20_000.0), values=np.zeros((20_000, 1)))
    assert case_of(replace(run, inputs=long))["signals"] == {}


@needs_linker
@pytest.mark.parametrize("name", ALL)
def test_a_report_with_the_engine_inside_weighs_less_than_1_mb(
    name: str, request: pytest.FixtureRequest, tmp_path: Path
) -> None:
    model = models.load(name).MODEL
    with open_fmu(request.getfixturevalue(f"{name}_fmu")) as fmu:
        run = perform(fmu, Experiment(model.stop_time, model.step_size))
    html = run_report(run, live=live_section(run, web_module(models.load(name))))
    assert len(html.encode()) < 1_000_000
    held = live_model(html)
    assert held["cases"][0]["name"] == "this_run"
    assert held["stop"] == model.stop_time
    assert {one["name"] for one in held["given"]} >= set(held["cases"][0]["values"])
    assert "<h2>Live: change a value</h2>" in html


@needs_linker
@pytest.mark.skipif(PROGRAM is None, reason="no chromium is installed (on Debian: apt install chromium)")
@pytest.mark.parametrize("width", [1200, 390])
def test_the_engine_in_a_report_begins_with_the_run(width: int, ratchet_fmu: Path, tmp_path: Path) -> None:
    table = tmp_path / "torque.csv"
    table.write_text("time [s],drive_torque [N.m]\n0,0.001\n1,0.002\n2,0.001\n")
    with open_fmu(ratchet_fmu) as fmu:
        run = perform(fmu, Experiment(1.5, 1e-2, SETTINGS, table))
    file = tmp_path / "report.html"
    file.write_text(run_report(run, live=live_section(run, web_module(models.load("ratchet")))), encoding="utf-8")
    inside = "document.querySelector('.live-page iframe').contentDocument"
    first = f"{inside}?.querySelector('#impacts tbody td')?.textContent"
    with chromium(tmp_path / "profile") as browser, opened(browser, file, width) as page:
        page.wait_until("document.documentElement.classList.contains('drawn')")
        assert page.value("document.querySelector('.live-page').children.length") == 0
        page.click('nav a[href="#section-live-change-a-value"]')
        page.wait_until("!!document.querySelector('.live-page iframe')")
        page.wait_until(f"!!{first}")
        assert float(page.value(first)) == pytest.approx(run.impacts["time"][0], rel=0, abs=1e-9)
        assert page.value(f"{inside}.querySelector('#of_tooth_count').value") == "12"
        assert page.value(f"{inside}.querySelector('#of_drive_torque').placeholder") == "varies"
        before = page.value(first)
        page.value(
            f"(() => {{ const field = {inside}.querySelector('#of_drive_torque'); field.value = '3';"
            " field.dispatchEvent(new Event('change')); })()"
        )
        page.wait_until(f"{first} !== '{before}'")
        assert float(page.value(first)) < float(before)
        # folded by hand, the table of contents unfolds it again, and what was computed is still there
        page.value("document.querySelector('.live-page').closest('details').open = false")
        page.click('nav a[href="#section-live-change-a-value"]')
        page.wait_until("document.querySelector('.live-page').closest('details').open")
        assert page.value("document.documentElement.scrollWidth") <= width
        assert page.value(f"{inside}.documentElement.scrollWidth <= {inside}.documentElement.clientWidth")
        assert page.errors == []
        assert all(one.startswith(("file:", "blob:")) for one in page.requests)


@needs_linker
def test_an_fmu_that_was_built_here_has_its_model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    path = build_fmu.built("ratchet", tmp_path)
    web_module(models.load("ratchet"))  # made once
    assert build_fmu.web_of(path).model.name == "Ratchet"
    path.write_bytes(path.read_bytes() + b" ")
    with pytest.raises(LookupError, match="this file is not from here"):
        build_fmu.web_of(path)


@needs_linker
def test_a_neighbour_that_has_changed_is_noticed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "lever.py"
    text = write_new("lever", tmp_path).read_text(encoding="utf-8")
    path.write_text(text.replace("START = deg(30)", "from .numbers import START"), encoding="utf-8")
    (tmp_path / "numbers.py").write_text("START = 0.1\n")
    fmu = build_fmu.built(str(path), tmp_path / "out")
    assert build_fmu.web_of(fmu).model.name == "lever"
    (tmp_path / "numbers.py").write_text("START = 0.2\n")
    assert refusal(fmu) == f"{path} has changed since the FMU was built; build it again"


def refusal(path: Path) -> str:
    with pytest.raises(LookupError) as refused:
        build_fmu.web_of(path)
    return str(refused.value)


def test_why_a_model_cannot_be_had(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    fmu, own = tmp_path / "Own.fmu", tmp_path / "own.py"
    fmu.write_bytes(f"an FMU in {tmp_path}".encode())
    own.write_text("MODEL = None\n")
    assert "this file is not from here" in refusal(fmu)
    record_build(fmu)
    assert "this file is not from here" in refusal(fmu)  # by whom else
    record_source(fmu, f"{own}\n{'0' * 64}")
    assert "own.py" in refusal(fmu)
    record_source(fmu, f"ratchet\n{'0' * 64}")
    assert refusal(fmu) == "ratchet has changed since the FMU was built; build it again"
    record_source(fmu, f"ratchet\n{sources_of(models.load('ratchet'))}")
    monkeypatch.setattr("mechanism_fmu.fmu.native.objects.web_library_is_made", lambda: False)
    assert "`mechanism-fmu page ratchet` does it, once" in refusal(fmu)
    own.unlink()
    record_source(fmu, f"{own}\n{'0' * 64}")
    assert "own.py" in refusal(fmu)


def test_a_report_says_why_nothing_computes_in_it(monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown(_: Path) -> None:
        raise LookupError("it is too heavy.")

    monkeypatch.setattr(build_fmu, "web_of", unknown)
    html = run_report(run_of(), live=one_run._live(run_of()))
    assert "<p>Nothing here computes: it is too heavy.</p>" in html
    assert no_live_section("it is too heavy") in html
    assert "packed-live" not in html
