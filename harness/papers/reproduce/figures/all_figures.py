"""All figures that the page shows, as SVG texts and as plots; and findings of those whose drawings are lost."""

from __future__ import annotations

import html
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from ....report.static import svg_text
from ....run.checks import Verdict
from ....run.results import write_text
from ...study.study_report import paper_figures
from ..bench import Bench
from ..row import Found, judged
from . import erdman_figures, pennestri_figures


@dataclass(frozen=True)
class Figure:
    """A drawn figure.

    Attributes:
        name: of its file, without ending.
        place: in its document, e.g. "Fig. 4".
        caption: what it shows, and from what it is drawn.
        row: the id of its row.
        draw: makes the SVG text.
    """

    name: str
    place: str
    caption: str
    row: str
    draw: Callable[[Bench], str]


def drawing_of(figure: Figure, bench: Bench) -> str:
    """The SVG text of a figure, drawn once."""
    if figure.name not in bench.drawings:
        bench.drawings[figure.name] = figure.draw(bench)
    return bench.drawings[figure.name]


def _paper(number: int) -> Callable[[Bench], str]:
    return lambda bench: svg_text(paper_figures(bench.study)[number].plots)


_P, _E = pennestri_figures, erdman_figures

FIGURES = (
    Figure("fig01_gap", "Fig. 1", "Impact between bodies", "P-fig1", lambda _b: _P.fig01_gap()),
    Figure("fig02_procedure", "Fig. 2", "What the program does: motion", "P-fig2", lambda _b: _P.fig02_procedure()),
    Figure("fig03_stress", "Fig. 3", "What the program does: stress", "P-fig3", lambda _b: _P.fig03_stress()),
    Figure("fig04_nomenclature", "Fig. 4", "The mechanism, to scale", "P-fig4", lambda _b: _P.fig04_nomenclature()),
    Figure("fig05_tooth", "Fig. 5", "The tooth, to scale", "P-fig5", lambda _b: _P.fig05_tooth()),
    Figure("fig06_beam", "Fig. 6", "The cantilever", "P-fig6", lambda _b: _P.fig06_beam()),
    Figure("fig07_shapes", "Fig. 7", "Both shapes, to scale; grey is left out", "P-fig7", lambda _b: _P.fig07_shapes()),
    Figure("fig08_wheels", "Fig. 8", "Wheel shapes, β₀ = 95°", "P-fig8", _paper(0)),
    Figure("fig09_teeth", "Fig. 9", "Tooth shapes", "P-fig9", _paper(1)),
    Figure("fig10_stress", "Fig. 10", "Stress along the tooth", "P-fig10", _paper(2)),
    Figure("fig11_maximum", "Fig. 11", "Maximum bending stress", "P-fig11", _paper(3)),
    Figure("erdman_fig1_elements", "Erdman, Fig. 1", "Elements", "E-fig1", lambda _b: _E.fig1_elements()),
    Figure("erdman_fig2_elements", "Erdman, Fig. 2", "Torsion, spatial link", "E-fig2", lambda _b: _E.fig2_elements()),
    Figure(
        "erdman_fig3_generator",
        "Erdman, Fig. 3",
        "Path generator",
        "E-fig3",
        lambda b: _E.fig3_generator(b.crank_at(60)),
    ),
    Figure("erdman_fig4_case1", "Erdman, Fig. 4", "Case 1", "E-fig4", lambda b: _E.fig4_case1(b.crank_at(60))),
    Figure("erdman_fig7_case2", "Erdman, Fig. 7", "Case 2", "E-fig7", lambda b: _E.fig7_case2(b.crank_at(60))),
)


def write_figures(drawn: dict[str, str], folder: Path) -> list[Path]:
    """Write SVG texts by name.

    Raises:
        UsageError: the disk refuses.
    """
    return [_written(folder / f"{name}.svg", text) for name, text in drawn.items()]


def _written(path: Path, text: str) -> Path:
    return write_text(path, lambda file: file.write(text))


# Findings of figures whose drawings are lost: what is drawn instead is there, and shows what it should.

_ROOT = Path(__file__).parents[4]
#: What draws in an SVG.
_STROKES = re.compile(r"<(path|line|polyline|polygon|circle|rect|use|text)\b")


def redrawn(bench: Bench, name: str, shown: Sequence[str], text: str, *worked: str, true: bool = True) -> Found:
    """A figure of this page: its drawing must hold all texts of `shown`, and what it is drawn from must be `true`."""
    drawing = drawing_of(next(figure for figure in FIGURES if figure.name == name), bench)
    missing = [word for word in shown if word not in html.unescape(drawing)]
    text += f"; missing: {missing}" if missing else ""
    return judged(true and not missing, text, *worked, verdict=Verdict.REDRAWN)


def redrawn_joint(*files: str) -> Found:
    """A figure that stands on a joint's page."""
    counts = [len(_STROKES.findall((_ROOT / "docs/joints" / file).read_text(encoding="utf-8"))) for file in files]
    return judged(
        min(counts) > 5,
        "redrawn: " + " and ".join(f"docs/joints/{file}" for file in files),
        "drawn elements: " + ", ".join(map(str, counts)),
        verdict=Verdict.REDRAWN,
    )
