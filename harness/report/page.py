"""HTML and CSS of the reports."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any

from ..run.checks import Check
from .packed import packed_figures
from .style import CSS

# The HTML around the charts.

#: Texts in a cell that are longer than this may fold into lines.
_LONG = 28
#: More sections than this have a table of contents.
_MOST_WITHOUT_CONTENTS = 4

#: Longer tables of impacts and events are folded.
_MOST_ROWS_UNFOLDED = 20

#: For the note of charts.
HOW_TO_ZOOM = "Drag over a chart to zoom, double-click to return; a click on a name hides its curve."

#: Browsers that can.
_UNPACKS = "Chrome or Edge 80, Firefox 113, Safari 16.4, or a later one"
_FIGURE = re.compile(r'<div class="chart"><script type="application/json">(.*?)</script></div>')
#: What draws charts, in the order in which they need each other.
_DRAWING = ("player.js", "axes.js", "curves.js", "parallel.js", "charts.js")
_HEADING = re.compile(r'<section id="([^"]*)"><details(?: open)?><summary><h2>(.*?)</h2>')
_NOT_IN_ANCHOR = re.compile(r"[^0-9a-z]+")


def page(title: str, subtitle: str, body: Iterable[str]) -> str:
    """A whole HTML page that needs no network: it brings what draws its charts, if there are any."""
    content = "\n".join(body)
    figures = [json.loads(text) for text in _FIGURE.findall(content)]
    content = _FIGURE.sub('<div class="chart"></div>', content)
    unpacking, drawing = _unpacked(figures) if figures else ("", "")
    return "\n".join(
        [
            "<!doctype html>",
            '<html lang="en">',
            '<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{escape(title)}</title>",
            f"<style>{CSS}</style></head>",
            f"<body><main><header><h1>{escape(title)}</h1><p>{escape(subtitle)}</p></header>",
            f"{unpacking}{_contents(content)}",
            content,
            f"</main><script>{_script('folds.js')}</script>{_unpacks(content, drawing)}{drawing}</body></html>\n",
        ]
    )


def _unpacks(*parts: str) -> str:
    """What opens what is compressed, if anything is."""
    return f"<script>{_script('packed.js')}</script>" if any('id="packed-' in part for part in parts) else ""


def _unpacked(figures: Sequence[dict[str, Any]]) -> tuple[str, str]:
    """What a page says until its charts are drawn, and the elements that draw them."""
    advice = f"They need {_UNPACKS}, with scripts allowed; all else on this page is there without them."
    notice = f"The charts are being unpacked. If this line stays, the browser cannot draw them. {advice}"
    scripts = "".join(f"<script>{_script(name)}</script>" for name in _DRAWING)
    return (
        f'<p class="unpacking" data-advice="{escape(advice)}">{escape(notice)}</p>',
        f"{packed_figures(figures)}{scripts}",
    )


def _script(name: str) -> str:
    return Path(__file__).with_name(name).read_text(encoding="utf-8")


def _contents(content: str) -> str:
    """Links to all sections; "" where there are few."""
    found = _HEADING.findall(content)
    if len(found) <= _MOST_WITHOUT_CONTENTS:
        return ""
    links = "".join(f'<li><a href="#{anchor}">{heading}</a></li>' for anchor, heading in found)
    return f"<nav><details open><summary>Contents</summary><ul>{links}</ul></details></nav>"


def section(heading: str, *parts: str, note: str = "", banner: bool = False, folded: bool = False) -> str:
    """A framed part of the page that folds, and may be `folded` at first; a banner does not fold."""
    explanation = f"<p>{escape(note)}</p>" if note else ""
    title, inside = f"<h2>{escape(heading)}</h2>", f"{explanation}{''.join(parts)}"
    if banner:
        return f'<section class="banner">{title}{inside}</section>'
    anchor = _NOT_IN_ANCHOR.sub("-", f"section {heading}".lower()).strip("-")
    opened = "" if folded else " open"
    return f'<section id="{anchor}"><details{opened}><summary>{title}</summary>{inside}</details></section>'


def folded_if_long(drawn: str, count: int, what: str) -> str:
    """A table of `count` rows; a long one unfolds at a line that says how many of `what` it has."""
    if count <= _MOST_ROWS_UNFOLDED:
        return drawn
    return f"<details><summary>{count} {escape(what)}</summary>{drawn}</details>"


def cards(figures: Iterable[tuple[str, str]]) -> str:
    """Key figures: (what, value with unit)."""
    boxes = "".join(
        f'<div class="card"><b>{escape(value)}</b><span>{escape(what)}</span></div>' for what, value in figures
    )
    return f'<div class="cards">{boxes}</div>'


def points(texts: Iterable[str]) -> str:
    """Sentences, a point each."""
    return f'<ul class="points">{"".join(f"<li>{escape(text)}</li>" for text in texts)}</ul>'


def checks_list(checks: Iterable[Check]) -> str:
    """Verdicts with their evidence."""
    lines = (
        f'<li class="{"good" if check.passed else "bad"}">{escape(check.claim)}'
        f"<small>{escape(check.evidence)}</small></li>"
        for check in checks
    )
    return f'<ul class="checks">{"".join(lines)}</ul>'


def table(
    headings: Sequence[str],
    rows: Iterable[Sequence[str]],
    *,
    numeric: Sequence[int] = (),
    changed: Sequence[int] = (),
    long: bool = False,
) -> str:
    """A table of texts that scrolls inside itself; `numeric` columns stand right, `changed` rows are marked.

    A `long` one is no higher than most of the screen, and its headings stay in sight.
    """

    def cell(tag: str, column: int, text: str) -> str:
        css_class = "number" if column in numeric else "long" if len(text) > _LONG else ""
        marked = f' class="{css_class}"' if css_class else ""
        return f"<{tag}{marked}>{escape(text)}</{tag}>"

    def line(number: int, row: Sequence[str]) -> str:
        css_class = ' class="changed"' if number in changed else ""
        return f"<tr{css_class}>{''.join(cell('td', i, text) for i, text in enumerate(row))}</tr>"

    head = "".join(cell("th", i, heading) for i, heading in enumerate(headings))
    lines = "".join(line(number, row) for number, row in enumerate(rows))
    scroll = "scroll tall" if long else "scroll"
    return f'<div class="{scroll}"><table><thead><tr>{head}</tr></thead><tbody>{lines}</tbody></table></div>'


def facts(heading: str, rows: Iterable[Sequence[str]]) -> str:
    """A table of what there is and a text about each, under `heading`, that folds on a phone."""
    return f'<div class="facts">{table(["what", heading], rows)}</div>'


def versions_section(versions: Mapping[str, str]) -> str:
    """What made the result, as of `results.versions`."""
    return section("Versions", facts("version", versions.items()))


def chart(figure: Mapping[str, Any]) -> str:
    """A figure as of `plot.interactive`; the page brings what draws it."""
    data = json.dumps(figure, separators=(",", ":"), ensure_ascii=False)
    # "<" could close the script element
    text = data.replace("<", "\\u003c")
    return f'<div class="chart"><script type="application/json">{text}</script></div>'


def charts(*drawn: str, kind: str = "") -> str:
    """Charts beside each other, as many as the screen is wide enough for.

    Args:
        drawn: they are.
        kind: "stacked" for one below the other, "small" for more in a row.
    """
    return f'<div class="{f"charts {kind}".strip()}">{"".join(drawn)}</div>'
