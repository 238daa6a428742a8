"""Evaluation of rows: which are asked for, and their findings one after the other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ...errors import UsageError
from ...run.checks import Verdict
from . import choices, misprints
from .bench import Bench
from .erdman import element_rows, flexibility_rows, linkage_rows, term_rows
from .figures.all_figures import FIGURES, drawing_of
from .me451 import cam_rows, gear_rows, joint_rows
from .pennestri import beam_rows, case_rows, claim_rows, impact_rows, motion_rows, ratchet_rows, stress_rows
from .row import Document, Result, Row

#: All rows of the documents, in their order.
ROWS: tuple[Row, ...] = (
    *claim_rows.CONTRIBUTIONS,
    *motion_rows.ROWS,
    *impact_rows.ROWS,
    *stress_rows.ROWS,
    *ratchet_rows.ROWS,
    *beam_rows.ROWS,
    *claim_rows.ROWS,
    *case_rows.ROWS,
    *term_rows.TERMS,
    *element_rows.ROWS,
    *flexibility_rows.ROWS,
    *linkage_rows.ROWS,
    *term_rows.ROWS,
    *joint_rows.ROWS,
    *gear_rows.ROWS,
    *gear_rows.RACKS,
    *cam_rows.ROWS,
)
MISPRINTS: tuple[Row, ...] = misprints.MISPRINTS
ASSUMPTIONS: tuple[Row, ...] = misprints.ASSUMPTIONS
CHOICES: tuple[Row, ...] = choices.CHOICES


@dataclass(frozen=True)
class Reproduction:
    """What came of it.

    Attributes:
        rows, misprints, assumptions, choices: with their findings.
        figures: SVG texts by name.
        whole: whether nothing was left out.
    """

    rows: tuple[Result, ...]
    misprints: tuple[Result, ...]
    assumptions: tuple[Result, ...]
    choices: tuple[Result, ...]
    figures: dict[str, str]
    whole: bool

    @property
    def everything(self) -> tuple[Result, ...]:
        """All findings."""
        return (*self.rows, *self.misprints, *self.assumptions, *self.choices)

    @property
    def failed(self) -> tuple[Result, ...]:
        """Findings that are not what they should be."""
        return tuple(result for result in self.everything if result.found.verdict is Verdict.FAILED)

    def of(self, document: Document) -> tuple[Result, ...]:
        """The rows of a document."""
        return tuple(result for result in self.rows if result.row.document is document)

    def weighed(self, document: Document | None = None) -> tuple[Result, ...]:
        """The rows of a document, and the misprints and assumptions that are its own; without one, of all."""
        everything = (*self.rows, *self.misprints, *self.assumptions)
        return tuple(result for result in everything if document in (None, result.row.document))


def chosen(asked: Sequence[str]) -> tuple[Row, ...]:
    """The rows, misprints, assumptions and choices that are asked for by ids or what they begin with, or all of them.

    A name that is an id stands for this one only: "E-eq1" does not ask for E-eq10.

    Raises:
        UsageError: there is none of that name.
    """
    everything = (*ROWS, *MISPRINTS, *ASSUMPTIONS, *CHOICES)
    found = [row for name in asked for row in _named(name, everything)]
    return tuple(row for row in everything if row in found) if asked else everything


def _named(name: str, rows: Sequence[Row]) -> list[Row]:
    exact = [row for row in rows if row.id.lower() == name.lower()]
    found = exact or [row for row in rows if row.id.lower().startswith(name.lower())]
    if not found:
        raise UsageError(
            f"No row's id begins with '{name}'. Give P (Pennestrì), E (Erdman), S (slides), X (misprints and "
            "assumptions), C (choices), or more of an id, e.g. P-eq7, E-eq13, S-3.4.1, X-gamma; without any, all "
            "rows are worked."
        )
    return found


def perform(asked: Sequence[str], bench: Bench, on_row: Callable[[Row, int, int], None]) -> Reproduction:
    """Work the rows that are asked for, and draw the figures that belong to them.

    Args:
        asked: ids, or what they begin with; none for all.
        bench: of shared calculations.
        on_row: called before each row with it, its number from 1 on, and how many there are.

    Raises:
        UsageError: there is no such row.
    """
    rows = chosen(asked)
    results = {}
    for number, row in enumerate(rows, start=1):
        on_row(row, number, len(rows))
        results[row.id] = Result(row, row.found(bench))

    def those(of: Sequence[Row]) -> tuple[Result, ...]:
        return tuple(results[row.id] for row in of if row.id in results)

    return Reproduction(
        rows=those(ROWS),
        misprints=those(MISPRINTS),
        assumptions=those(ASSUMPTIONS),
        choices=those(CHOICES),
        figures={figure.name: drawing_of(figure, bench) for figure in FIGURES if figure.row in results},
        whole=len(rows) == len(chosen(())),
    )
