import re
from html.parser import HTMLParser
from pathlib import Path

import pytest
from pendulum import MODEL

import models
from mechanism_fmu.fmu.parts.documentation import documentation, page


class Reader(HTMLParser):
    """Collects text, attributes and the balance of the tags."""

    VOID = frozenset({"meta", "img", "br", "hr"})

    def __init__(self, html: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.references: list[str] = []
        self.headings: list[str] = []
        self.text = ""
        self.feed(html)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.references += [value or "" for name, value in attrs if name in ("src", "href")]
        if re.fullmatch("h[1-6]", tag):
            self.headings.append(tag)
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if tag not in self.VOID:
            assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data


FACTS = ("It runs <em>everywhere</em>.",)


def test_every_variable_is_listed_with_unit_start_and_limits(tmp_path: Path) -> None:
    html = page(MODEL, tmp_path, FACTS)
    assert "<td><code>length</code></td><td>Real</td><td>m</td><td>1.5 (1500 mm)</td>" in html
    assert "<td>0.1 (100 mm) … 10 (10000 mm)</td><td>Length of the arm</td>" in html
    assert "<td><code>guided</code></td><td>Boolean</td><td></td><td>true</td><td></td>" in html
    assert "<td><code>impacts[1..1].time</code></td><td>Real</td><td>s</td>" in html


def test_special_letters_are_escaped(tmp_path: Path) -> None:
    assert "An arm &amp; a wall" in page(MODEL, tmp_path, FACTS)


def test_the_readme_becomes_part_of_the_page(tmp_path: Path) -> None:
    (tmp_path / "drawing.svg").write_text("<svg xmlns='http://www.w3.org/2000/svg'/>")
    (tmp_path / "README.md").write_text(
        "# Arm\n\n![drawing](drawing.svg)\n\n| a | b |\n| --- | --- |\n| 1 | 2 |\n\n"
        "[data](reference.csv) [site](https://example.org)\n\n<script>alert(1)</script>\n"
    )
    html = page(MODEL, tmp_path, FACTS)
    assert "<h2>Arm</h2>" in html
    assert "<td>1</td>" in html
    assert "<script>" not in html
    read = Reader(html)
    assert [r.partition(",")[0] for r in read.references] == ["data:image/svg+xml", "https://example.org"]
    assert "data" in read.text


@pytest.mark.parametrize("name", sorted(models.available()))
def test_the_page_of_every_model_stands_alone(name: str) -> None:
    module = models.load(name)
    read = Reader(page(module.MODEL, models.available()[name], FACTS))
    assert read.open == []
    assert all(r.startswith(("data:", "https://", "#")) for r in read.references)
    assert any(r.startswith("data:image/svg+xml") for r in read.references)
    assert read.headings.count("h1") == 1
    assert "It runs everywhere." in read.text


def test_the_licences_travel(tmp_path: Path) -> None:
    files = documentation(MODEL, tmp_path, FACTS, ("mechanism_fmu", "pythonfmu"))
    assert set(files) == {
        "documentation/index.html",
        "documentation/licenses/mechanism_fmu.txt",
        "documentation/licenses/pythonfmu.txt",
    }
    assert b"NTNU" in files["documentation/licenses/pythonfmu.txt"]
