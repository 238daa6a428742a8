"""The HTML around the charts."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from importlib.resources import files
from typing import Any

from ..checks import Check
from .style import CSS

#: Texts in a cell that are longer than this may fold into lines.
_LONG = 28


def page(title: str, subtitle: str, body: Iterable[str]) -> str:
    """A whole HTML page that needs no network: the chart library is inside."""
    plotly = files("plotly").joinpath("package_data", "plotly.min.js").read_text(encoding="utf-8")
    charts = files("harness.report").joinpath("charts.js").read_text(encoding="utf-8")
    return "\n".join(
        [
            "<!doctype html>",
            '<html lang="en">',
            '<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{escape(title)}</title>",
            f"<style>{CSS}</style>",
            f"<script>{plotly}</script></head>",
            f"<body><main><header><h1>{escape(title)}</h1><p>{escape(subtitle)}</p></header>",
            *body,
            f"</main><script>{charts}</script></body></html>\n",
        ]
    )


def section(heading: str, *parts: str, note: str = "", css_class: str = "") -> str:
    """A framed part of the page."""
    explanation = f"<p>{escape(note)}</p>" if note else ""
    return f'<section class="{css_class}"><h2>{escape(heading)}</h2>{explanation}{"".join(parts)}</section>'


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
    """What made the result, as of `versions.versions`."""
    return section("Versions", facts("version", versions.items()))


def chart(figure: Any, narrow: Mapping[str, Any] | None = None) -> str:
    """A figure of plotly, or a plain {data, layout}; the page brings what draws it.

    Args:
        figure: as of `interactive.interactive`, or a `plotly.graph_objects.Figure`.
        narrow: what is different in its layout on a phone's screen.
    """
    plain = figure if isinstance(figure, dict) else json.loads(figure.to_json())
    data = json.dumps(plain | {"narrow": narrow or {}}, separators=(",", ":"), ensure_ascii=False)
    # "<" could close the script element
    text = data.replace("<", "\\u003c")
    return f'<div class="chart"><div class="plot"></div><script type="application/json">{text}</script></div>'


def charts(*drawn: str) -> str:
    """Charts beside each other, as many as the screen is wide enough for."""
    return f'<div class="charts">{"".join(drawn)}</div>'


def wide(drawn: str) -> str:
    """A chart that is no use on a phone's width: there it is wider, and scrolls inside itself."""
    return f'<div class="scroll"><div class="wide">{drawn}</div></div>'
