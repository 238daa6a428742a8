"""The page of a model: what stands in the file, what its scripts compute in node, and what a browser shows."""

import base64
import gzip
import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from chromium import PROGRAM, chromium, opened
from page_in_node import NODE, in_node, needs_node
from typer.testing import CliRunner

import models
from harness.app.cli import main
from harness.page.page_data import slider_range
from mechanism_fmu.fmu.native.link import has_linker

needs_linker = pytest.mark.skipif(not has_linker(), reason="ziglang is not installed")

#: When the pawl strikes in the ratchet's base case [s]: the reference of README.md.
IMPACT = 0.9399211769
ALL = [pytest.param(name, marks=() if name == "ratchet" else pytest.mark.slow) for name in models.available()]


def held(html: str, identifier: str) -> str:
    found = re.findall(rf'<script[^>]* id="{identifier}">(.*?)</script>', html, re.DOTALL)
    assert len(found) == 1
    return str(found[0])


@needs_linker
@pytest.mark.parametrize("name", ALL)
def test_a_page_is_small_and_whole(name: str, page_of: Callable[[str], Path]) -> None:
    html = page_of(name).read_text(encoding="utf-8")
    assert len(html.encode()) <= 1_000_000
    # the only address is the name of SVG's elements, which nobody loads
    assert set(re.findall(r"https?:[^\"'\s)]*", html)) == {"http://www.w3.org/2000/svg"}
    assert set(re.findall(r'\b(?:src|href)="([^"]*)"', html)) == {"data:,"}
    assert not re.search(r"@import|url\(|\bfetch\(|importScripts|XMLHttpRequest|sendBeacon", html)
    assert "default-src 'none'" in html
    assert gzip.decompress(base64.b64decode(held(html, "wasm"))).startswith(b"\0asm")
    # scripts end where they should: as many as there are, and no text of them is seen
    assert html.count("<script") == html.count("</script>") == 20
    data = json.loads(held(html, "model"))
    model = models.load(name).MODEL
    assert (data["name"], data["stop"]) == (model.name, model.stop_time)
    assert {one["name"] for one in data["given"]} == {p.name for p in model.parameters} | {
        p.name for p in model.mechanism(model.values()).inputs
    }
    assert data["shapes"]
    assert set(data["moving"]) | {one["name"] for one in data["constants"]}
    assert {one for chart in data["charts"] for one in chart["names"]} <= {
        one["name"] for kind in ("reals", "wholes") for one in data[kind]
    }
    assert {one["name"] for one in data["cases"]} >= {case.name for case in model.cases}


@needs_linker
@needs_node
@pytest.mark.parametrize("name", ALL)
def test_a_page_runs_its_model(name: str, page_of: Callable[[str], Path]) -> None:
    model = models.load(name).MODEL
    (run,) = in_node(["run", {}], of=page_of(name))
    assert (run["refused"], run["finished"], run["picture"]) == (False, True, True)
    steps = round(model.stop_time / model.step_size)
    grid = np.setdiff1d(run["time"], run["struck"])
    np.testing.assert_allclose(grid, np.linspace(0, model.stop_time, steps + 1), rtol=0, atol=1e-12 * model.stop_time)
    assert run["count"] == steps + 1 + len(run["struck"])
    lines = run["csv"].removesuffix("\r\n").split("\r\n")
    assert len(lines) == 1 + run["count"]
    assert {line.count(",") for line in lines} == {lines[0].count(",")}


@needs_linker
@needs_node
def test_the_base_case_of_the_ratchet_and_an_impossible_crank(page_of: Callable[[str], Path]) -> None:
    run, refused, stronger = in_node(
        ["run", {}],
        ["run", {"crank_length": 0.02}],
        ["run", {"drive_torque": 0.004, "guided": False, "tooth_count": 12}],
        of=page_of("ratchet"),
    )
    assert run["struck"] == [pytest.approx(IMPACT, rel=0, abs=1e-9)]
    assert run["csv"].startswith("time [s],wheel_angle [rad],")
    assert (refused["refused"], refused["count"]) == (True, 0)
    assert "crank_length = 0.02 m is 0.046394 m too short: give more than 0.066394 m" in refused["text"]
    assert not refused["text"].startswith("page")
    assert stronger["struck"]
    assert stronger["struck"][0] < IMPACT


@needs_linker
@needs_node
@pytest.mark.parametrize("worker", [True, False])
def test_a_reader_changes_values(worker: bool, page_of: Callable[[str], Path]) -> None:
    steps: list[dict[str, Any]] = [
        {"set": ["crank_length", "20"]},
        {"set": ["crank_length", "110"]},
        {"slide": ["drive_torque", 120]},
        {"click": ".next"},
        {"set": ["guided", False]},
        {"click": "#reset"},
        {"hash": "#drive_torque=0.002&nonsense=1"},
        {"click": "#csv"},
    ]
    (seen,) = in_node(["session", {"worker": worker}, steps], of=page_of("ratchet"))
    assert seen[-1]["errors"] == []
    start, refused, back, strong, struck, free, reset, from_hash, saved = seen
    base = f"{IMPACT:.10f}"
    assert (start["first"], start["count"], start["alert"], start["hash"]) == (base, "One impact.", "", "")
    assert (start["time"], start["shapes"] > 5, start["curves"]) == ("t = 0.000 s", True, start["values"])
    # a refusal is said, and the last good picture stays
    assert "give more than 0.066394 m" in refused["alert"]
    assert refused["hash"] == "#crank_length=0.02"
    assert [refused[key] for key in ("first", "shapes", "curves")] == [
        start[key] for key in ("first", "shapes", "curves")
    ]
    assert (back["alert"], back["first"], back["hash"]) == ("", base, "#")
    # the slider goes from 0 to 5 N.mm in 300 places
    assert strong["hash"] == "#drive_torque=0.002"
    assert float(strong["first"]) < IMPACT
    assert "impact 1 of 1 at 0.66" in struck["struck"]
    assert struck["time"] == f"t = {float(strong['first']):.3f} s"
    assert free["hash"] == "#drive_torque=0.002&guided=false"
    assert (reset["first"], reset["hash"], reset["time"]) == (base, "#", "t = 0.000 s")
    assert from_hash["first"] == strong["first"]
    assert saved["texts"][-1].startswith("time [s],wheel_angle [rad],")


@needs_linker
@needs_node
@pytest.mark.parametrize("name", [*ALL, pytest.param("woodpecker.py", marks=pytest.mark.slow)])  # which has a trace
def test_a_page_shows_its_model(name: str, page_of: Callable[[str], Path]) -> None:
    (seen,) = in_node(["session", {}, []], of=page_of(name))
    assert seen[0]["errors"] == []
    assert seen[0]["alert"] == ""
    assert seen[0]["shapes"] > 1
    assert seen[0]["curves"] == seen[0]["values"] > 1


@needs_linker
@needs_node
def test_what_is_asked_for_at_once_is_answered_once(page_of: Callable[[str], Path]) -> None:
    (answered,) = in_node(["several", 5], of=page_of("ratchet"))
    assert set(answered) == {5}


@needs_linker
@needs_node
def test_an_engine_that_does_not_start_says_why(page_of: Callable[[str], Path]) -> None:
    (run,) = in_node(["run", {}], of=page_of("ratchet"), token="another")
    assert run["refused"]
    assert "is not this FMU's" in run["text"]
    (run,) = in_node(["run", {}], of=page_of("ratchet"), old=True)
    assert run["refused"]
    assert "This browser is too old for the page; it needs Chrome or Edge 80" in run["text"]


@needs_linker
@needs_node
def test_the_address_holds_what_differs_from_the_start(page_of: Callable[[str], Path]) -> None:
    cases: dict[str, tuple[str, dict[str, Any], str]] = {
        "": ("guided", {}, "#"),
        "#drive_torque=0.002&guided=false&tooth_count=12": (
            "guided",
            {"drive_torque": 0.002, "guided": False, "tooth_count": 12},
            "#drive_torque=0.002&tooth_count=12&guided=false",
        ),
        "#drive_torque=0.001&nonsense=3&load_torque=&crank_length=long&guided=1&case=none": ("guided", {}, "#"),
        "#elastic_modulus=1e%2B21": ("guided", {"elastic_modulus": 1e21}, "#elastic_modulus=1e%2B21"),
        # of a case: what it has itself is no difference, a constant in place of a signal is
        "#case=jam&tooth_count=20&guided=true&load_torque=0": (
            "jam",
            {"guided": True, "load_torque": 0},
            "#case=jam&load_torque=0&guided=true",
        ),
        "#case=free&kept=case%3Djam%26tooth_count%3D21": ("free", {}, "#case=free&kept=case%3Djam%26tooth_count%3D21"),
        "#kept=": ("guided", {}, "#kept="),
    }
    answers = in_node(*(["hash", one] for one in cases), of=page_of("ratchet"))
    assert [tuple(one) for one in answers] == list(cases.values())


@needs_linker
@needs_node
def test_sliders_stay_in_their_range_and_hold_the_start(page_of: Callable[[str], Path]) -> None:
    (sliders,) = in_node(["sliders"], of=page_of("ratchet"))
    assert len(sliders) == 41
    for one in sliders:
        values, (low, high) = np.array(one["values"]), one["range"]
        assert one["ofStart"] == one["start"], one["name"]
        assert (values >= low).all()
        assert (values <= high).all()
        assert (np.diff(values) > 0).all(), one["name"]
        assert one["places"] == list(range(len(values))), one["name"]


@pytest.mark.parametrize(
    ("start", "minimum", "maximum", "expected"),
    [
        (0.1, 1e-6, 1000.0, (0.05, 0.2)),
        (-4.0, None, None, (-8.0, -2.0)),
        (0.8, 0.0, 1.0, (0.4, 1.0)),
        (3.0, 2.5, None, (2.5, 6.0)),
        (0.0, -1e6, 1e6, (-1.0, 1.0)),
        (0.0, 0.0, 1e6, (0.0, 1.0)),
        (0.0, None, 0.3, (-1.0, 0.3)),
    ],
)
def test_a_slider_goes_from_half_to_twice_its_start(
    start: float, minimum: float | None, maximum: float | None, expected: tuple[float, float]
) -> None:
    assert slider_range(start, minimum, maximum) == expected
    assert slider_range(0.0, -1e3, 1.0, "rad") == (-math.pi, 1.0)


def test_models_say_what_is_usual_of_what_starts_at_zero() -> None:
    for name in models.available():
        model = models.load(name).MODEL
        for port in (*model.mechanism(model.values()).inputs, *model.parameters):
            guessed = port.start == 0 and getattr(port, "type", "Real") != "Boolean" and port.usual is None
            assert not guessed or port.unit in ("rad", "rad/s", "m/s2", "1"), f"{name}: {port.name}"


@needs_linker
def test_the_command_writes_the_page_of_a_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert CliRunner().invoke(main, ["new", "lever"]).exit_code == 0
    text = Path("lever.py").read_text(encoding="utf-8")
    found = re.search(r'description="([^"]*)"', text) or re.search(r'Model\(\s*"\w+",\s*"([^"]*)"', text)
    assert found is not None
    Path("lever.py").write_text(text.replace(found[1], "A </script><b>lever & co"), encoding="utf-8")
    done = CliRunner().invoke(main, ["page", "lever.py"])
    assert done.exit_code == 0, done.output
    assert "lever.html" in done.output
    html = Path("lever.html").read_text(encoding="utf-8")
    assert "A &lt;/script&gt;&lt;b&gt;lever &amp; co" in html
    assert html.count("<script") == html.count("</script>") == 20
    if NODE is not None:
        run, seen = in_node(["run", {}], ["session", {}, []], of=tmp_path / "lever.html")
        assert run["finished"]
        assert run["struck"]
        assert (seen[0]["errors"], seen[0]["shapes"] > 1) == ([], True)


@pytest.mark.parametrize("name", ["gearbox", "nowhere.py"])
def test_what_is_no_model_is_wrong_use(name: str, tmp_path: Path) -> None:
    done = CliRunner().invoke(main, ["page", name, "-o", str(tmp_path / "page.html")])
    assert done.exit_code == 2
    assert not list(tmp_path.iterdir())


@needs_linker
@pytest.mark.skipif(PROGRAM is None, reason="no chromium is installed (on Debian: apt install chromium)")
@pytest.mark.parametrize("width", [1200, 390])
def test_in_a_browser(width: int, page_of: Callable[[str], Path], tmp_path: Path) -> None:
    with chromium(tmp_path / "profile") as browser, opened(browser, page_of("ratchet"), width) as shown:
        first = "document.querySelector('#impacts tbody td')?.textContent"
        shown.wait_until(f"{first} === '{IMPACT}'")
        assert shown.value("document.documentElement.scrollWidth") <= width
        shown.value(
            "(() => { const field = document.querySelector('#of_drive_torque'); field.value = '2';"
            " field.dispatchEvent(new Event('change')); })()"
        )
        shown.wait_until(f"{first} !== '{IMPACT}'")
        assert shown.value("location.hash") == "#drive_torque=0.002"
        shown.click("#reset")
        shown.wait_until(f"{first} === '{IMPACT}'")
        shown.click(".next")
        assert "impact 1 of 1" in shown.value("document.querySelector('.struck').textContent")
        # it lives, and an input that is dragged does not begin anew
        shown.click("#live")
        shown.wait_until("document.querySelector('#state').textContent === ''")
        legends = "[...document.querySelectorAll('#charts .curves b')].map((one) => one.textContent)"
        shown.wait_until(f"!({legends}).some((one) => ['', '–'].includes(one))")
        shown.click(".play")
        for _ in range(10):  # at each look there are numbers, though curves are drawn now and then only
            assert not {"", "–"} & set(shown.value(legends))
        shown.wait_until("document.querySelector('.time').textContent > 't = 0.2'")
        shown.value(
            "(() => { const slider = document.querySelector('#inputs input[type=range]'); slider.value = 240;"
            " slider.dispatchEvent(new Event('input')); })()"
        )
        shown.click(".next")
        shown.wait_until("document.querySelector('.struck').textContent.includes('impact 1 of 1')")
        assert 0.2 < float(shown.value(first)) < IMPACT
        assert shown.value("document.documentElement.scrollWidth") <= width
        shown.click("#live")
        shown.wait_until(f"{first} && document.querySelector('#state').textContent === ''")
        assert shown.errors == []
        assert all(one.startswith(("file:", "blob:", "data:")) for one in shown.requests)
