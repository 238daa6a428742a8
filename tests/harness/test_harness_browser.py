"""Reports as a reader has them: in a real browser, on a desk and on a phone."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from chromium import PROGRAM, Browser, Page, chromium, opened
from real_reports import Report

from tests.report_page import figures

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="no chromium is installed (on Debian: apt install chromium)")

PHONE, DESK = 360, 1200
SCREENS = (
    *((name, PHONE) for name in ("run", "study", "sweep", "optimum", "machine")),
    *((name, DESK) for name in ("run", "study", "machine")),
)

#: The time that the animation shows, and what its button says.
CLOCK, BUTTON = "document.querySelector('.time').textContent", "document.querySelector('.play').textContent"

#: The charts come after the page.
DRAWN = "document.documentElement.classList.contains('drawn')"

#: Elements that reach beyond the screen, but for what lies in something that scrolls.
TOO_WIDE = """[...document.body.querySelectorAll("*")].filter(
    (e) => !e.closest(".scroll *") && e.getBoundingClientRect().right > document.documentElement.clientWidth + 0.5
).map((e) => e.outerHTML.slice(0, 80))"""


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    with chromium(tmp_path_factory.mktemp("profile")) as browser:
        yield browser


@pytest.fixture(scope="module", params=SCREENS, ids=str)
def shown(
    request: pytest.FixtureRequest, browser: Browser, reports: dict[str, Report]
) -> Iterator[tuple[Page, Report]]:
    name, width = request.param
    with opened(browser, reports[name].path, width) as page:
        page.wait_until(DRAWN)
        yield page, reports[name]


def test_a_report_has_no_error_and_asks_the_network_for_nothing(shown: tuple[Page, Report]) -> None:
    page, report = shown
    assert page.errors == []
    assert page.requests == [report.path.resolve().as_uri()]


def test_all_charts_are_there(shown: tuple[Page, Report]) -> None:
    page, report = shown
    drawn = page.value(
        '[...document.querySelectorAll(".chart")].map((c) =>'
        ' c.querySelectorAll("path.curve, path.dots, path.area, rect.bar, path.axis").length)'
    )
    assert drawn == report.drawn()
    assert len(drawn) == report.charts
    # as wide as there is room for
    assert page.value(
        '[...document.querySelectorAll(".plot > svg")].every((s) => s.viewBox.baseVal.width === s.clientWidth)'
    )


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
        page.wait_until(DRAWN)
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
        page.wait_until(DRAWN)
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


#: Of the first two charts: the texts under their time axes, and where their cursor is.
TICKS = """[...document.querySelectorAll(".chart")].slice(0, 2).map(
    (c) => [...c.querySelectorAll("svg > g > text[text-anchor=middle]")].map((t) => t.textContent).join())"""
CURSORS = '[...document.querySelectorAll(".chart .cursor")].slice(0, 2).map((c) => c.getAttribute("d"))'
#: The middle of the first chart's picture, and its width.
PLACE = """(() => { const s = document.querySelector(".chart svg"); s.scrollIntoView({block: "center"});
    const b = s.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2, b.width]; })()"""


def test_charts_of_a_section_point_and_zoom_together(browser: Browser, reports: dict[str, Report]) -> None:
    with opened(browser, reports["run"].path, DESK) as page:
        page.wait_until(DRAWN)
        whole = page.value(TICKS)
        assert whole[0] == whole[1]
        x, y, wide = page.value(PLACE)
        mouse = {"y": y, "button": "left", "clickCount": 1}
        page.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
        assert page.value('document.querySelector(".chart .at").textContent').startswith("time 0.57")
        cursors = page.value(CURSORS)
        assert cursors[0].split()[0] == cursors[1].split()[0] != ""
        values = page.value('[...document.querySelectorAll(".chart")][0].querySelectorAll("b").length')
        assert values > 1
        page.call("Input.dispatchMouseEvent", type="mousePressed", x=x, **mouse)
        for part in (0.1, 0.2):
            page.call("Input.dispatchMouseEvent", type="mouseMoved", x=x + part * wide, y=y, buttons=1, button="left")
        page.call("Input.dispatchMouseEvent", type="mouseReleased", x=x + 0.2 * wide, **mouse)
        zoomed = page.value(TICKS)
        assert zoomed[0] == zoomed[1] != whole[0]
        assert all(0.57 <= float(text) <= 0.85 for text in zoomed[0].split(","))
        page.click(".chart figcaption button:not([hidden])")
        assert page.value(TICKS) == whole
        # the same by keys
        page.value('document.querySelector(".chart svg").focus()')
        for key in ("ArrowRight", "+"):
            page.call("Input.dispatchKeyEvent", type="keyDown", key=key)
        assert page.value(TICKS)[1] != whole[1]
        page.call("Input.dispatchKeyEvent", type="keyDown", key="0")
        assert page.value(TICKS) == whole
        assert page.errors == []


def test_a_name_hides_its_curve_and_a_chart_gives_its_numbers(browser: Browser, reports: dict[str, Report]) -> None:
    with opened(browser, reports["run"].path, DESK) as page:
        page.wait_until(DRAWN)
        count = 'document.querySelector(".chart").querySelectorAll("path.curve").length'
        before = page.value(count)
        page.click(".chart .curves button")
        assert page.value(count) == before - 1
        assert page.value('document.querySelector(".chart .curves button").getAttribute("aria-pressed")') == "false"
        page.value("URL.createObjectURL = (blob) => { window.saved = blob; return 'blob:'; }")
        page.value("HTMLAnchorElement.prototype.click = function () { window.file = this.download; }")
        page.value("document.querySelector('.chart button[title^=\"Save\"]').click()")
        lines = page.value("window.saved.text()").splitlines()
        assert page.value("window.file") == "angle_change_deg.csv"
        assert lines[0].startswith('time [s],"Absolute angle of the wheel (psi), unwrapped, from 75 deg (wheel_angle)"')
        assert len(lines) == 1 + len(figures(reports["run"].path.read_text(encoding="utf-8"))[0]["curves"][0]["x"])


def test_designs_are_chosen_along_an_axis(browser: Browser, reports: dict[str, Report]) -> None:
    with opened(browser, reports["sweep"].path, DESK) as page:
        page.wait_until(DRAWN)
        x, y, high = page.value(
            '(() => { const g = document.querySelector(".parallel .grip"); g.scrollIntoView({block: "center"});'
            " const b = g.getBoundingClientRect(); return [b.x + b.width / 2, b.y, b.height]; })()"
        )
        mouse = {"x": x, "button": "left", "clickCount": 1}
        page.call("Input.dispatchMouseEvent", type="mousePressed", y=y + 8, **mouse)
        page.call("Input.dispatchMouseEvent", type="mouseMoved", y=y + high / 2, buttons=1, **mouse)
        page.call("Input.dispatchMouseEvent", type="mouseReleased", y=y + high / 2, **mouse)
        told = page.value('document.querySelector(".parallel .at").textContent')
        assert 1 <= int(told.split()[0]) < 16
        assert " of 16 designs: " in told
        page.click(".parallel figcaption button")
        assert page.value('document.querySelector(".parallel .at").textContent') == ""
        assert page.errors == []
