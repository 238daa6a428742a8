"""Findings of figures whose drawings are lost: what is drawn instead is there, and shows what it should."""

from __future__ import annotations

import html
import re
from pathlib import Path

from .bench import Bench
from .figures import FIGURES, drawing_of
from .row import Found, Verdict, judged

_ROOT = Path(__file__).parents[2]
#: What draws in an SVG.
_STROKES = re.compile(r"<(path|line|polyline|polygon|circle|rect|use|text)\b")


def redrawn(bench: Bench, name: str, shown: tuple[str, ...], text: str, *worked: str, true: bool = True) -> Found:
    """A figure of this page: its drawing must hold all texts of `shown`, and what it is drawn from must be `true`."""
    drawing = drawing_of(next(figure for figure in FIGURES if figure.name == name), bench)
    missing = [word for word in shown if word not in html.unescape(drawing)]
    said = f"{text}{f'; missing: {missing}' if missing else ''}"
    return judged(true and not missing, said, *worked, verdict=Verdict.REDRAWN)


def redrawn_joint(*files: str) -> Found:
    """A figure that stands on a joint's page."""
    counts = [len(_STROKES.findall((_ROOT / "docs/joints" / file).read_text(encoding="utf-8"))) for file in files]
    named = " and ".join(f"docs/joints/{file}" for file in files)
    strokes = ", ".join(map(str, counts))
    return judged(min(counts) > 5, f"redrawn: {named}", f"drawn elements: {strokes}", verdict=Verdict.REDRAWN)
