"""The HTML around the charts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

from ..checks import Check
from .style import CSS


def page(title: str, subtitle: str, body: Iterable[str]) -> str:
    """A whole HTML page, with the chart library inside."""
    from plotly.offline import get_plotlyjs

    return "\n".join(
        [
            "<!doctype html>",
            '<html lang="en">',
            '<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{escape(title)}</title>",
            f"<style>{CSS}</style>",
            f"<script>{get_plotlyjs()}</script></head>",
            f"<body><main><header><h1>{escape(title)}</h1><p>{escape(subtitle)}</p></header>",
            *body,
            "</main></body></html>\n",
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


def checks_list(checks: Iterable[Check]) -> str:
    """Verdicts with their evidence."""
    lines = (
        f'<li class="{"good" if check.passed else "bad"}">{escape(check.claim)}'
        f"<small>{escape(check.evidence)}</small></li>"
        for check in checks
    )
    return f'<ul class="checks">{"".join(lines)}</ul>'


def table(
    headings: Sequence[str], rows: Iterable[Sequence[str]], *, numeric: Sequence[int] = (), changed: Sequence[int] = ()
) -> str:
    """A table of texts; `numeric` columns stand right, `changed` rows are marked."""

    def cell(tag: str, column: int, text: str) -> str:
        css_class = ' class="number"' if column in numeric else ""
        return f"<{tag}{css_class}>{escape(text)}</{tag}>"

    def line(number: int, row: Sequence[str]) -> str:
        css_class = ' class="changed"' if number in changed else ""
        return f"<tr{css_class}>{''.join(cell('td', i, text) for i, text in enumerate(row))}</tr>"

    head = "".join(cell("th", i, heading) for i, heading in enumerate(headings))
    lines = "".join(line(number, row) for number, row in enumerate(rows))
    return f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>{lines}</tbody></table></div>'


def chart(figure: Any) -> str:
    """A plotly figure; the page brings the library."""
    html: str = figure.to_html(
        full_html=False, include_plotlyjs=False, config={"displaylogo": False, "responsive": True}
    )
    return html
