"""Reports as a reader has them: in a real browser, on a desk and on a phone."""

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from chromium import PROGRAM, Browser, Page, chromium, opened

from harness.app.commands.designs_run import run_optimise, run_sweep
from harness.app.commands.designs_shared import Runners
from harness.app.commands.machine_run import run_file
from harness.fmu import open_fmu
from harness.papers.study.study import ratchet_study
from harness.papers.study.study_report import paper_figures, write_study_report
from harness.report.run_report import write_report
from harness.run.experiment import Experiment, perform

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="no chromium is installed (on Debian: apt install chromium)")

PHONE, DESK = 360, 1200
SCREENS = (
    *((name, PHONE) for name in ("run", "study", "sweep", "optimum", "machine")),
    *((name, DESK) for name in ("run", "study", "machine")),
)

#: The time that the animation shows, and what its button says.
CLOCK, BUTTON = "document.querySelector('.time').textContent", "document.querySelector('.play').textContent"

#: Elements that reach beyond the screen, but for what lies in something that scrolls.
TOO_WIDE = """[...document.body.querySelectorAll("*")].filter(
    (e) => !e.closest(".scroll *") && e.getBoundingClientRect().right > document.documentElement.clientWidth + 0.5
).map((e) => e.outerHTML.slice(0, 80))"""


DESIGNS = """\
fmu.file = "{fmu}"
run = {{ stop_time = "1.2 s", step = 0.1 }}
vary.restitution = {{ from = 0.0, to = 0.6 }}
vary.tooth_slope_angle = {{ from = 86, to = 94, unit = "deg" }}
"""
SWEEP = 'sweep = { method = "sobol", count = 16 }\nrecord.first_impact = ["time", "stress_max"]\n'
MACHINE = """\
title = "Two ratchets"
run = {{ stop_time = "1.2 s", step = "10 ms", extrapolation = "constant" }}
component.upper.file = "{fmu}"
component.lower.file = "{fmu}"
connect = [{{ from = "upper.wheel_angle", to = "lower.drive_angle" }}]
"""
OPTIMUM = 'optimise = { minimise = "first_impact.stress_max", count = 20 }\n'


@dataclass(frozen=True)
class Report:
    """A file, and how many charts and pictures it has."""

    path: Path
    charts: int
    pictures: int = 1

    def traces(self) -> list[int]:
        """The number of curves and bands in each of its charts, without those that hold no point."""
        held = re.findall(
            r'<div class="plot"></div><script type="application/json">(.*?)</script>', self.path.read_text()
        )
        return [sum(_points(trace.get("x", ["parallel axes"])) for trace in json.loads(text)["data"]) for text in held]


def _points(x: list[float] | dict[str, str]) -> bool:
    """Whether there are any: in a list, or as plotly writes arrays."""
    return bool(x["bdata"] if isinstance(x, dict) else x)


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    with chromium(tmp_path_factory.mktemp("profile")) as browser:
        yield browser


@pytest.fixture(scope="module")
def reports(ratchet_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Report]:
    folder = tmp_path_factory.mktemp("reports")
    with open_fmu(ratchet_fmu) as fmu:
        run = perform(fmu, Experiment(1.2, 1e-2))
        study = ratchet_study(fmu, lambda *_: None)
    figures = paper_figures(study)
    return {
        "run": Report(write_report(run, folder / "report.html"), charts=4),
        "study": Report(write_study_report(study, figures, folder / "study.html"), charts=14),
        "sweep": Report(_designs(run_sweep, SWEEP, ratchet_fmu, folder / "sweep"), charts=2),
        "machine": Report(_machine(ratchet_fmu, folder / "machine"), charts=22, pictures=2),
        "optimum": Report(_designs(run_optimise, OPTIMUM, ratchet_fmu, folder / "optimum"), charts=3),
    }


def _designs(command: Callable[..., int], text: str, fmu: Path, folder: Path) -> Path:
    file = folder.with_suffix(".toml")
    file.write_text(text + DESIGNS.format(fmu=fmu.as_posix()))
    assert command(file, folder, Runners(fast=True)) == 0
    return folder / "report.html"


def _machine(fmu: Path, folder: Path) -> Path:
    file = folder.with_suffix(".toml")
    file.write_text(MACHINE.format(fmu=fmu.as_posix()))
    assert run_file(str(file), None, folder) == 0
    return folder / "report.html"


@pytest.fixture(scope="module", params=SCREENS, ids=str)
def shown(
    request: pytest.FixtureRequest, browser: Browser, reports: dict[str, Report]
) -> Iterator[tuple[Page, Report]]:
    name, width = request.param
    with opened(browser, reports[name].path, width) as page:
        yield page, reports[name]


def test_a_report_has_no_error_and_asks_the_network_for_nothing(shown: tuple[Page, Report]) -> None:
    page, report = shown
    assert page.errors == []
    assert page.requests == [report.path.resolve().as_uri()]


def test_all_charts_are_there(shown: tuple[Page, Report]) -> None:
    page, report = shown
    drawn = page.value(
        '[...document.querySelectorAll(".plot")].map((p) => p.querySelectorAll(".trace, g.parcoords").length)'
    )
    assert drawn == report.traces()
    assert len(drawn) == report.charts


def test_the_mechanism_is_drawn_and_plays(shown: tuple[Page, Report]) -> None:
    page, report = shown
    assert page.value('document.querySelectorAll(".animation svg polygon").length') == report.pictures  # the wheels
    _play(page)


def test_nothing_is_wider_than_the_screen(shown: tuple[Page, Report]) -> None:
    page, _ = shown
    assert page.value("document.documentElement.scrollWidth <= document.documentElement.clientWidth")
    assert page.value("innerWidth") == page.width  # a phone would zoom out
    assert page.value(TOO_WIDE) == []
    assert page.value('[...document.querySelectorAll(".card")].every((e) => e.scrollWidth <= e.clientWidth)')


def test_wide_tables_scroll_inside_themselves(shown: tuple[Page, Report]) -> None:
    page, _ = shown
    wide = page.value('[...document.querySelectorAll(".scroll")].filter((e) => e.scrollWidth > e.clientWidth).length')
    assert (wide >= 1) == (page.width == PHONE)


def test_the_mechanism_plays_pauses_and_goes_to_the_impact(browser: Browser, reports: dict[str, Report]) -> None:
    with opened(browser, reports["run"].path, PHONE) as page:
        _play(page)
        stopped = page.value(CLOCK)
        frames = "let n = 20; const go = () => n-- ? requestAnimationFrame(go) : done(); go();"
        page.value(f"new Promise((done) => {{ {frames} }})")
        assert page.value(CLOCK) == stopped
        assert page.value(BUTTON) == "Play"
        page.click(".animation .next")
        page.wait_until("document.querySelector('.struck').textContent === 'impact 1 of 1 at 0.9399212 s'")
        assert page.value("document.querySelector('.flash').getAttribute('visibility')") == "visible"


def test_components_of_a_machine_move_together_and_flash_at_their_impacts(
    browser: Browser, reports: dict[str, Report]
) -> None:
    moved = (
        "[...document.querySelectorAll('.animation svg')].map((s) => s.querySelector('path').getAttribute('transform'))"
    )
    with opened(browser, reports["machine"].path, PHONE) as page:
        start = page.value(moved)
        assert len(start) == 2
        page.click(".animation .next")
        page.wait_until(
            "document.querySelector('.struck').textContent === 'impact 2 of 2 at 0.9399212 s, lower, upper'"
        )
        assert all(now != before for now, before in zip(page.value(moved), start, strict=True))
        assert page.value("document.querySelectorAll('.animation svg.hit').length") == 2


def _play(page: Page) -> None:
    """Begin at the beginning, see the pawl move, and pause."""
    bar = "document.querySelector('.animation svg path').getAttribute('transform')"
    start, place = page.value(CLOCK), page.value(bar)
    assert start == "t = 0.000 s"
    page.click(".animation .play")
    page.wait_until(f"{CLOCK} !== {start!r} && {bar} !== {place!r}")
    assert page.value(BUTTON) == "Pause"
    page.click(".animation .play")


def test_the_eyes_of_these_tests_are_open(browser: Browser, tmp_path: Path) -> None:
    page_with_faults = tmp_path / "faults.html"
    page_with_faults.write_text(
        '<!doctype html><meta name="viewport" content="width=device-width, initial-scale=1">'
        '<div style="width: 500px">wide</div><img src="nowhere.png"><script>console.error("bad"); missing();</script>'
    )
    with opened(browser, page_with_faults, PHONE) as page:
        assert len(page.errors) >= 2
        assert any(address.endswith("nowhere.png") for address in page.requests)
        assert page.value(TOO_WIDE)
