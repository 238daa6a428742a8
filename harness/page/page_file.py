"""A model's page: one HTML file with its engine, its data and the scripts, that loads nothing."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from pathlib import Path
from typing import Any

from mechanism_fmu.fmu.native.web import WebModule

from .. import report
from ..report.animation import controls, legend, playing_speeds
from ..report.motion import Contact
from ..report.style import CSS
from .page_data import beginning_with
from .payload import ENGINE_SCRIPTS, payload, script

#: What the page may do: run what stands in it, and nothing from elsewhere.
POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; style-src 'unsafe-inline'; "
    "img-src data:; worker-src blob:; base-uri 'none'; form-action 'none'"
)

#: The scripts in the order in which they need each other; those of the reports are their own.
_SCRIPTS = (
    *ENGINE_SCRIPTS,
    *(
        "player.js",
        "animation.js",
        "given.js",
        "scene.js",
        "record.js",
        "files.js",
        "controls.js",
        "axes.js",
        "curves.js",
        "run_charts.js",
    ),
    *("impacts.js", "live.js", "main.js"),
)
_OF_REPORTS = ("player.js", "animation.js", "axes.js", "curves.js")


def page(web: WebModule, first: Mapping[str, Any] | None = None) -> str:
    """The HTML file of a model.

    Args:
        web: the model for a page.
        first: the case that it begins with, as those of `web_data.WebData`; None for the model's first one.

    Raises:
        MechanismError: its drawing names what it does not have.
    """
    held = payload(web)
    data = held.model
    if first is not None:
        data |= beginning_with(first, data["cases"])
    title, about = escape(web.model.name), escape(web.model.description)
    style = CSS + Path(__file__).with_name("page.css").read_text(encoding="utf-8")
    return "\n".join(
        [
            "<!doctype html>",
            '<html lang="en">',
            '<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">',
            f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">',
            f'<link rel="icon" href="data:,"><title>{title}</title>',
            f"<style>{style}</style></head>",
            f"<body><main><header><h1>{title}</h1><p>{about}</p></header>",
            _given(data),
            f'<div class="seen">{_stage(data)}{_results()}</div></main>',
            '<noscript><p class="banner">This page computes; it needs JavaScript.</p></noscript>',
            held.elements,
            *map(_script, _SCRIPTS),
            "</body></html>\n",
        ]
    )


def _given(data: Mapping[str, Any]) -> str:
    """Where the choice of a case, sliders and fields come to stand."""
    options = "".join(
        f'<option value="{c["name"]}">{escape(c["name"].replace("_", " "))}</option>' for c in data["cases"]
    )
    alone = " hidden" if len(data["cases"]) < 2 else ""
    none = "" if any(one["group"] == "input" for one in data["given"]) else " hidden"
    return (
        f'<aside aria-label="What is given"><div class="case"{alone}><label for="case">Case</label>'
        f'<select id="case" aria-describedby="about-case">{options}</select><small id="about-case"></small></div>'
        f'<details open{none}><summary>Inputs</summary><div id="inputs"></div></details>'
        '<details open><summary>Parameters</summary><div id="parameters"></div></details>'
        '<details><summary>Integration</summary><div id="settings"></div></details></aside>'
    )


def _stage(data: Mapping[str, Any]) -> str:
    """The picture with what plays it, and what is wrong."""
    speeds, speed = playing_speeds(data["stop"])
    plays = controls({"speeds": speeds, "speed": speed, "impacts": [0.0]})
    lamps = [Contact(c["name"], c["variable"], c["colour"]) for c in data["contacts"]]
    named = legend([shape for shape in data["shapes"] if shape.get("name")], lamps)
    return (
        '<section class="stage" aria-label="Mechanism"><p id="no-picture" hidden>There is no drawing of this run.</p>'
        '<div class="animation"><svg role="img" aria-label="The mechanism at the time shown below"></svg>'
        f'{plays}{named}</div><div class="buttons"><button type="button" id="live" aria-pressed="false">Live</button>'
        '<button type="button" id="restart" hidden>Restart</button>'
        '<button type="button" id="keep" aria-pressed="false">Keep to compare</button>'
        '<button type="button" id="reset">Reset</button><button type="button" id="csv">Results (CSV)</button>'
        '<button type="button" id="toml">Values (TOML)</button>'
        '<button type="button" id="inputs-csv" hidden>Inputs (CSV)</button><span id="state" role="status"></span></div>'
        # nothing that is pressed moves when a run says something: refusals lie over the page, warnings above curves
        '<div id="refusal" role="alert" hidden></div></section>'
    )


def _results() -> str:
    return (
        '<section aria-label="Curves"><div id="note" role="status" hidden></div><div id="charts"></div></section>'
        '<section aria-label="Impacts"><h2>Impacts</h2><p id="impact-count"></p><div class="scroll" tabindex="0" '
        'role="region" aria-label="Table of impacts"><table id="impacts"><thead></thead><tbody></tbody></table></div>'
        "</section>"
    )


def _script(name: str) -> str:
    return script(name, Path(report.__file__).parent if name in _OF_REPORTS else Path(__file__).parent)
