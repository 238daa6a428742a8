"""Reports weigh little, need no network, and hold the numbers that they were given."""

import json
import math
import re
import shutil
import struct
import subprocess
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st
from real_reports import Report

from harness.report.packed import packed_figures
from harness.report.page import chart, folded_if_long, page, section, table
from tests.report_page import figures, packed

NODE = shutil.which("node")
with_node = pytest.mark.skipif(NODE is None, reason="no node is installed (on Debian: apt install nodejs)")

#: Of each kind [MB].
MOST = {"demo": 0.65, "run": 0.15, "study": 0.15, "sweep": 0.12, "machine": 0.15, "optimum": 0.12}


class Asked(HTMLParser):
    """What a page asks a network for, or goes to."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.addresses: list[str] = []
        self.tags: set[str] = set()
        self.feed(html)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.addresses += [value or "" for name, value in attrs if name in ("src", "href", "srcset", "data", "action")]


def drawn_by_node(path: Path, *how: str) -> dict[str, Any]:
    """What stands in the charts of a page, and what the page says."""
    assert NODE is not None
    script = Path(__file__).with_name("page_in_node.js")
    ended = subprocess.run([NODE, script, path, *how], capture_output=True, text=True, check=True)
    told: dict[str, Any] = json.loads(ended.stdout)
    return told


def bits(values: list[float]) -> bytes:
    return struct.pack(f"<{len(values)}d", *values)


def opened(*drawn: dict[str, Any]) -> list[dict[str, Any]]:
    return figures(packed_figures(drawn))


@pytest.mark.parametrize("kind", MOST)
def test_how_much_a_report_weighs(reports: dict[str, Report], kind: str) -> None:
    assert reports[kind].path.stat().st_size < 1e6 * MOST[kind]


@pytest.mark.parametrize("kind", MOST)
def test_a_report_goes_nowhere_but_to_its_own_sections(reports: dict[str, Report], kind: str) -> None:
    html = reports[kind].path.read_text(encoding="utf-8")
    asked = Asked(html)
    assert asked.addresses
    assert all(re.fullmatch(r"#section-[0-9a-z-]+", address) for address in asked.addresses)
    assert all(html.count(f'id="{address[1:]}"') == 1 for address in asked.addresses)
    assert not asked.tags & {"link", "iframe", "img", "object", "embed", "base", "form"}
    assert not re.search(r"@import|url\((?!#)|\bfetch\(|XMLHttpRequest|import\(", html)


def test_a_page_without_a_chart_has_no_scripts_for_them() -> None:
    html = page("Words", "only", [section("One", "<p>two</p>")])
    assert "packed-" not in html
    assert "unpacked" not in html
    assert "CURVES" not in html


def test_equal_arrays_are_held_once() -> None:
    time, height = [0.1 * k for k in range(100)], np.linspace(0.0, 1.0, 100).tolist()
    one = {"curves": [{"x": time, "y": [0.5 * t for t in time]}, {"x": list(time), "y": [1, 2, None]}], "title": "a"}
    other = {"curves": [{"x": time, "y": height}, {"x": [0.25, 0.5], "y": list(height)}], "title": "b"}
    html = packed_figures([one, other])
    assert json.loads(packed(html, "figures"))["lengths"] == [100, 100, 100]
    assert figures(html) == [one, other]


@given(st.lists(st.floats(allow_nan=True, allow_infinity=True, width=64), min_size=16, max_size=60))
def test_numbers_come_back_to_the_bit(values: list[float]) -> None:
    [figure] = opened({"curves": [{"y": values}]})
    assert bits(figure["curves"][0]["y"]) == bits(values)


@given(
    st.lists(
        st.floats(allow_nan=False, allow_infinity=False) | st.integers(-9, 9) | st.none() | st.text("a<", max_size=2)
    )
)
def test_other_lists_come_back_as_they_are(values: list[Any]) -> None:
    given_figure = {"curves": [{"y": values, "line": True}], "range": [0.0, 1.0]}
    assert opened(given_figure) == [given_figure]


@pytest.mark.parametrize("count", [3, 30])
def test_what_is_no_number_is_a_gap_in_a_page(count: int) -> None:
    drawn = chart({"curves": [{"y": [1.0, math.nan, -math.inf] * count}]})
    [curve] = figures(page("A", "b", [drawn]))[0]["curves"]
    assert curve["y"][0] == 1.0
    assert all(value is None or not math.isfinite(value) for value in curve["y"][1:3])


@with_node
@pytest.mark.parametrize("kind", MOST)
def test_the_script_draws_what_the_page_holds(reports: dict[str, Report], kind: str) -> None:
    report = reports[kind]
    held = figures(report.path.read_text(encoding="utf-8"))
    told = drawn_by_node(report.path)
    assert [one["drawn"] for one in told["charts"]] == report.drawn()
    assert len(held) == report.charts
    for one, figure in zip(told["charts"], held, strict=True):
        assert one["label"].startswith(figure["title"])
        assert one["names"] == list(dict.fromkeys(curve["name"] for curve in figure.get("curves", ())))
        assert not any("NaN" in path or "undefined" in path for path in one["paths"])
    assert (told["notice"], told["drawn"], told["errors"]) == (None, True, [])


@with_node
@pytest.mark.parametrize(("how", "said"), [("old", "This browser cannot unpack"), ("torn", "cannot be drawn: ")])
def test_a_page_whose_charts_cannot_be_unpacked_says_so(reports: dict[str, Report], how: str, said: str) -> None:
    told = drawn_by_node(reports["run"].path, how)
    assert not told["drawn"]
    assert all(one["drawn"] == 0 for one in told["charts"])
    assert said in told["notice"]
    assert "Firefox 113" in told["notice"]


def test_the_page_says_it_where_no_script_runs(reports: dict[str, Report]) -> None:
    html = reports["run"].path.read_text(encoding="utf-8")
    notice = re.search(r'<p class="unpacking"[^>]*>(.*?)</p>', html)
    assert notice is not None
    assert "If this line stays, the browser cannot draw them. They need Chrome or Edge 80" in notice[1]


@pytest.mark.parametrize(("count", "contents"), [(4, 0), (5, 1)])
def test_many_sections_have_one_table_of_contents(count: int, contents: int) -> None:
    html = page("A", "b", [section(f"Part {k} <of> it") for k in range(count)])
    assert html.count("<nav>") == contents
    assert html.count('href="#section-part-') == count * contents
    assert html.count("<h2>Part 0 &lt;of&gt; it</h2>") == 1


def test_sections_fold_and_banners_do_not() -> None:
    folds = '<section id="section-one"><details open><summary><h2>One</h2></summary><p>why</p>two</details></section>'
    assert section("One", "two", note="why") == folds
    assert section("One", "two", banner=True) == '<section class="banner"><h2>One</h2>two</section>'


@pytest.mark.parametrize(("count", "folds"), [(20, False), (21, True)])
def test_long_tables_are_folded(count: int, folds: bool) -> None:
    drawn = table(["t"], [["1"]] * count)
    shown = folded_if_long(drawn, count, "events")
    assert shown == (f"<details><summary>{count} events</summary>{drawn}</details>" if folds else drawn)
