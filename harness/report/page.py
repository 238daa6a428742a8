"""HTML and CSS of the reports."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any

from ..run.checks import Check
from .packed import packed_figures, packed_library

# The look of the reports.

#: Colours that stay apart for colour-blind eyes (Okabe and Ito, "Color Universal Design", 2008).
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#444444")

#: Marks impacts in every chart.
IMPACT_COLOUR = "#B3261E"

FONT = "Inter, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif"

CSS = f"""
:root {{ color-scheme: light; --ink: #1c2733; --soft: #5b6875; --line: #dfe5ea; --ground: #f5f7f9; }}
* {{ box-sizing: border-box; }}
body {{ margin: 0; font: 15px/1.5 {FONT}; color: var(--ink); background: var(--ground); }}
main {{ max-width: 1180px; margin: 0 auto; padding: 28px 24px 60px; }}
header h1 {{ margin: 0; font-size: 28px; letter-spacing: -0.01em; }}
header p {{ margin: 4px 0 0; color: var(--soft); overflow-wrap: anywhere; }}
section {{ background: #fff; border: 1px solid var(--line); border-radius: 10px; padding: 18px 20px;
  margin-top: 18px; }}
h2 {{ margin: 0 0 4px; font-size: 18px; }}
section > p, section > details > p {{ margin: 0 0 10px; color: var(--soft); overflow-wrap: anywhere; }}
summary {{ cursor: pointer; }}
summary h2 {{ display: inline; }}
section > details > summary + * {{ margin-top: 4px; }}
nav {{ margin-top: 18px; }}
nav details {{ max-height: 40vh; overflow-y: auto; }}
nav ul {{ columns: 15em; list-style: none; margin: 6px 0 0; padding: 0; }}
nav a {{ color: inherit; overflow-wrap: anywhere; }}
.unpacking {{ margin: 18px 0 0; color: var(--soft); }}
.cards {{ display: grid; grid-template-columns: repeat(auto-fit, minmax(170px, 1fr)); gap: 14px; margin-top: 18px; }}
.card {{ background: #fff; border: 1px solid var(--line); border-radius: 10px; padding: 12px 16px; }}
.card b {{ display: block; font-size: 22px; font-weight: 650; letter-spacing: -0.01em;
  overflow-wrap: anywhere; }}
.card span {{ color: var(--soft); font-size: 13px; overflow-wrap: anywhere; }}
ul.points {{ margin: 0; padding-left: 20px; }}
ul.points li {{ overflow-wrap: anywhere; padding: 2px 0; }}
ul.checks {{ list-style: none; margin: 0; padding: 0; }}
ul.checks li {{ padding: 5px 0 5px 30px; position: relative; }}
ul.checks li::before {{ position: absolute; left: 0; width: 20px; height: 20px; border-radius: 50%; color: #fff;
  font-size: 13px; line-height: 20px; text-align: center; top: 7px; }}
ul.checks li.good::before {{ content: "✓"; background: #1b7f4b; }}
ul.checks li.bad::before {{ content: "✕"; background: {IMPACT_COLOUR}; }}
ul.checks small {{ color: var(--soft); font-size: 13px; margin-left: 6px; }}
.scroll {{ overflow-x: auto; }}
/* a shadow at the lower edge says that there is more; at the end, what moves with the rows covers it */
.tall {{ max-height: min(70vh, 620px); overflow-y: auto; background:
  linear-gradient(#fff0, #fff 60%) bottom / 100% 40px no-repeat local,
  linear-gradient(#1c273300, #1c273338) bottom / 100% 16px no-repeat scroll; }}
.tall th {{ position: sticky; top: 0; background: #fff; }}
.charts {{ display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 420px), 1fr)); gap: 10px 24px; }}
.wide {{ min-width: 640px; }}
.charts > *, .chart, .plot {{ min-width: 0; }}
table {{ border-collapse: collapse; width: 100%; font-size: 14px; font-variant-numeric: tabular-nums; }}
th, td {{ padding: 6px 12px 6px 0; border-bottom: 1px solid var(--line); text-align: left; vertical-align: top; }}
td {{ white-space: nowrap; }}
td.long {{ white-space: normal; min-width: min(24em, 72vw); }}
th {{ color: var(--soft); font-weight: 600; border-bottom-width: 2px; }}
td.number, th.number {{ text-align: right; padding-right: 14px; }}
th.number {{ vertical-align: bottom; }}
tr.changed td {{ background: #fff8e6; }}
code {{ font: 13px ui-monospace, SFMono-Regular, Menlo, Consolas, monospace; }}
.banner {{ background: #fdecea; border-color: {IMPACT_COLOUR}; }}
.animation svg {{ display: block; width: 100%; max-height: 560px; background: #fbfcfd; border-radius: 8px; }}
.animation .panels {{ display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 190px), 1fr));
  gap: 14px; }}
.animation figure {{ margin: 0; min-width: 0; }}
.animation .panels svg {{ height: 230px; }}
.animation .panels svg.hit {{ box-shadow: inset 0 0 0 2px {IMPACT_COLOUR}; }}
.animation figcaption {{ font-weight: 600; margin-top: 6px; }}
.animation .panels .legend {{ margin: 4px 0 6px; font-size: 12px; }}
.animation ul {{ list-style: none; display: flex; flex-wrap: wrap; gap: 4px 14px; margin: 0; padding: 0; }}
.animation .legend {{ display: flex; flex-wrap: wrap; justify-content: space-between; gap: 6px 28px;
  margin: 10px 0; font-size: 13px; color: var(--soft); }}
.animation .legend i {{ display: inline-block; width: 12px; height: 12px; border-radius: 3px; margin-right: 6px;
  vertical-align: -1px; }}
.animation .lamp {{ padding: 0 9px; border: 1px solid var(--line); border-radius: 9px; color: #8793a0; }}
.animation .lamp.lit {{ background: var(--lamp); border-color: var(--lamp); color: #fff; font-weight: 600; }}
.animation .timeline {{ position: relative; }}
.animation input[type=range] {{ width: 100%; margin: 14px 0 8px; }}
.animation .marks {{ position: absolute; left: 8px; right: 8px; top: 0; height: 14px; pointer-events: none; }}
.animation .marks i {{ position: absolute; width: 2px; height: 9px; margin-left: -1px; top: 4px; opacity: 0.75; }}
.animation .marks i.now {{ width: 8px; height: 14px; margin-left: -4px; top: 0; border-radius: 3px; opacity: 1; }}
.animation .controls {{ display: flex; flex-wrap: wrap; align-items: center; gap: 8px 14px; }}
.animation button, .animation select {{ font: inherit; padding: 4px 12px; border: 1px solid #b6c0ca;
  border-radius: 6px; background: #fff; color: inherit; cursor: pointer; }}
.animation .play {{ min-width: 76px; }}
.animation .time {{ font-weight: 650; font-variant-numeric: tabular-nums; min-width: 8em; }}
.animation .struck {{ color: {IMPACT_COLOUR}; font-variant-numeric: tabular-nums; }}
@media (max-width: 640px) {{
  main {{ padding: 16px 10px 40px; }}
  section {{ padding: 14px 12px; }}
  .parameters table, .parameters tbody {{ display: block; }}
  .parameters thead {{ display: none; }}
  .parameters tr {{ display: grid; grid-template: "name value unit" "meaning meaning origin" / auto 1fr auto;
    gap: 0 6px; padding: 6px 0; border-bottom: 1px solid var(--line); }}
  .parameters tr.changed {{ background: #fff8e6; }}
  .parameters td, .facts td {{ white-space: normal; overflow-wrap: anywhere; }}
  .parameters td, .parameters td.number {{ border: 0; padding: 0; }}
  .parameters td.long, .facts td.long {{ min-width: 0; }}
  .facts td:first-child {{ width: 40%; }}
  .parameters td:nth-child(3) {{ grid-area: unit; }}
  .parameters td:nth-child(4) {{ grid-area: origin; text-align: right; }}
  .parameters td:nth-child(5) {{ grid-area: meaning; }}
  .parameters td:nth-child(n + 4) {{ font-size: 13px; color: var(--soft); }}
  .animation .panels {{ grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 10px; }}
  .animation .panels svg {{ height: 170px; }}
  .cards {{ grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 10px; }}
  .card b {{ font-size: 18px; }}
  ul.checks small {{ display: block; margin-left: 0; }}
  .scroll .statechart {{ max-width: none !important; }}
}}
@media print {{ body {{ background: #fff; }} section, .card {{ break-inside: avoid; }}
  .tall {{ max-height: none; }} }}
"""


#: Margins of a figure whose charts have titles: the tool buttons stand above them.
WIDE_TOP = {"l": 70, "r": 20, "t": 64, "b": 50}

_AXIS = {
    "automargin": True,
    "gridcolor": "#ebf0f8",
    "linecolor": "#ebf0f8",
    "zerolinecolor": "#dfe5ea",
    "zerolinewidth": 2,
    "title": {"standoff": 12, "font": {"size": 13}},
}

#: What plotly takes where a figure says nothing else.
_TEMPLATE = {
    "layout": {
        "colorway": COLOURS,
        "font": {"family": FONT, "size": 13, "color": "#1c2733"},
        "hoverlabel": {"font": {"family": FONT}},
        "paper_bgcolor": "#ffffff",
        "plot_bgcolor": "#ffffff",
        "xaxis": _AXIS,
        "yaxis": _AXIS,
    }
}


def layout(**more: Any) -> dict[str, Any]:
    """Common layout of all figures."""
    return {"template": _TEMPLATE, "margin": {"l": 62, "r": 16, "t": 40, "b": 46}} | more


# The HTML around the charts.

#: Texts in a cell that are longer than this may fold into lines.
_LONG = 28
#: More sections than this have a table of contents.
_MOST_WITHOUT_CONTENTS = 4

#: Longer tables of impacts and events are folded.
_MOST_ROWS_UNFOLDED = 20

#: Browsers that can.
_UNPACKS = "Chrome or Edge 80, Firefox 113, Safari 16.4, or a later one"
_FIGURE = re.compile(r'<div class="plot"></div><script type="application/json">(.*?)</script>')
_HEADING = re.compile(r'<section id="([^"]*)"><details open><summary><h2>(.*?)</h2>')
_NOT_IN_ANCHOR = re.compile(r"[^0-9a-z]+")


def page(title: str, subtitle: str, body: Iterable[str]) -> str:
    """A whole HTML page that needs no network: the chart library is inside, if there is a chart, and compressed."""
    content = "\n".join(body)
    # what is no number is a gap in a curve
    figures = [json.loads(text, parse_constant=lambda _: None) for text in _FIGURE.findall(content)]
    content = _FIGURE.sub('<div class="plot"></div>', content)
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
            f"</main><script>{_script('folds.js')}</script>{drawing}</body></html>\n",
        ]
    )


def _unpacked(figures: Sequence[dict[str, Any]]) -> tuple[str, str]:
    """What a page says until its charts are drawn, and the elements that draw them."""
    advice = f"They need {_UNPACKS}, with scripts allowed; all else on this page is there without them."
    notice = f"The charts are being unpacked. If this line stays, the browser cannot draw them. {advice}"
    scripts = "".join(f"<script>{_script(name)}</script>" for name in ("packed.js", "charts.js"))
    return (
        f'<p class="unpacking" data-advice="{escape(advice)}">{escape(notice)}</p>',
        f"{packed_library()}{packed_figures(figures)}{scripts}",
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


def section(heading: str, *parts: str, note: str = "", banner: bool = False) -> str:
    """A framed part of the page that folds, but for a banner."""
    explanation = f"<p>{escape(note)}</p>" if note else ""
    title, inside = f"<h2>{escape(heading)}</h2>", f"{explanation}{''.join(parts)}"
    if banner:
        return f'<section class="banner">{title}{inside}</section>'
    anchor = _NOT_IN_ANCHOR.sub("-", f"section {heading}".lower()).strip("-")
    return f'<section id="{anchor}"><details open><summary>{title}</summary>{inside}</details></section>'


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


def chart(figure: Any, narrow: Mapping[str, Any] | None = None) -> str:
    """A figure of plotly, or a plain {data, layout}; the page brings what draws it.

    Args:
        figure: as of `plot.interactive`, or a `plotly.graph_objects.Figure`.
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
