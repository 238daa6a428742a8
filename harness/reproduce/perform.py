"""From ids to results: which rows are asked for, and their findings one after the other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ..errors import UsageError
from . import (
    choices,
    erdman,
    erdman_claims,
    erdman_elements,
    erdman_terms,
    errata,
    me451_cams,
    me451_gears,
    me451_joints,
    pennestri_beam,
    pennestri_cases,
    pennestri_claims,
    pennestri_impact,
    pennestri_motion,
    pennestri_ratchet,
    pennestri_stress,
)
from .bench import Bench
from .figures import FIGURES
from .row import Document, Result, Row, Verdict

#: All rows of the documents, in their order.
ROWS: tuple[Row, ...] = (
    *pennestri_motion.ROWS,
    *pennestri_impact.ROWS,
    *pennestri_stress.ROWS,
    *pennestri_ratchet.ROWS,
    *pennestri_beam.ROWS,
    *pennestri_claims.ROWS,
    *pennestri_cases.ROWS,
    *erdman_terms.ROWS,
    *erdman_elements.ROWS,
    *erdman.ROWS,
    *erdman_claims.ROWS,
    *me451_joints.ROWS,
    *me451_gears.ROWS,
    *me451_cams.ROWS,
)
ERRATA: tuple[Row, ...] = errata.ERRATA
CHOICES: tuple[Row, ...] = choices.CHOICES


@dataclass(frozen=True)
class Reproduction:
    """What came of it.

    Attributes:
        rows, errata, choices: with their findings.
        figures: SVG texts by name.
        whole: whether nothing was left out.
    """

    rows: tuple[Result, ...]
    errata: tuple[Result, ...]
    choices: tuple[Result, ...]
    figures: dict[str, str]
    whole: bool

    @property
    def everything(self) -> tuple[Result, ...]:
        """All findings."""
        return (*self.rows, *self.errata, *self.choices)

    @property
    def failed(self) -> tuple[Result, ...]:
        """Findings that are not what they should be."""
        return tuple(result for result in self.everything if result.found.verdict is Verdict.FAILED)

    def of(self, document: Document) -> tuple[Result, ...]:
        """The rows of a document."""
        return tuple(result for result in self.rows if result.row.document is document)


def chosen(asked: Sequence[str]) -> tuple[Row, ...]:
    """The rows, errata and choices whose id begins with one of `asked`, or all of them.

    Raises:
        UsageError: there is none of that name.
    """
    everything = (*ROWS, *ERRATA, *CHOICES)
    if not asked:
        return everything
    for name in asked:
        if not any(_begins(row.id, name) for row in everything):
            raise UsageError(
                f"No row's id begins with '{name}'. Give P (Pennestrì), E (Erdman), S (slides), X (errata), "
                "C (choices), or more of an id, e.g. P-eq7, E-eq13, S-3.4.1, X-gamma; without any, all rows are worked."
            )
    return tuple(row for row in everything if any(_begins(row.id, name) for name in asked))


def _begins(row: str, name: str) -> bool:
    return row.lower().startswith(name.lower())


def perform(asked: Sequence[str], bench: Bench, on_row: Callable[[Row, int, int], None]) -> Reproduction:
    """Work the rows that are asked for, and draw the figures that belong to them.

    Args:
        asked: beginnings of ids; none for all.
        bench: of shared calculations.
        on_row: called before each row with it, its number from 1 on, and how many there are.

    Raises:
        UsageError: there is no such row.
    """
    rows = chosen(asked)
    results = {}
    for number, row in enumerate(rows, start=1):
        on_row(row, number, len(rows))
        results[row.id] = Result(row, row.find(bench))

    def those(of: tuple[Row, ...]) -> tuple[Result, ...]:
        return tuple(results[row.id] for row in of if row.id in results)

    figures = {figure.name: figure.draw(bench) for figure in FIGURES if figure.row in results}
    return Reproduction(those(ROWS), those(ERRATA), those(CHOICES), figures, len(rows) == len(chosen(())))
