"""One row of the comparison: what a document says, and what became of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

from ...run.checks import Verdict
from .bench import Bench

__all__ = ["KED", "RUN", "STUDY", "Document", "Found", "Result", "Row", "Verdict", "judged", "within"]

#: Command lines that many rows are shown by.
KED = "mechanism-fmu ked four_bar_path_generator"
STUDY = "mechanism-fmu study ratchet"
RUN = "mechanism-fmu run build/Ratchet.fmu"


class Document(StrEnum):
    """The three documents, by the letter that their rows begin with; misprints and choices begin with their place."""

    PENNESTRI = "P"
    ERDMAN = "E"
    ME451 = "S"

    @property
    def short(self) -> str:
        """As the page calls it."""
        return {"P": "Pennestrì et al.", "E": "Erdman et al.", "S": "ME451"}[self.value]

    @property
    def named(self) -> str:
        """How the place of a misprint or a choice begins."""
        return self.short.split()[0]


@dataclass(frozen=True)
class Found:
    """What this project finds.

    Attributes:
        ours: number or sentence beside the printed one.
        verdict: of the row.
        worked: the numbers on the way, a line each.
        calculated: whether the verdict stands on a calculation that this run has made; if not, it is a judgement by a
            person, who read the document.
    """

    ours: str
    verdict: Verdict
    worked: tuple[str, ...] = ()
    calculated: bool = False


@dataclass(frozen=True)
class Row:
    """One equation, table, figure, example or claim of a document.

    Attributes:
        id: letter of the document, "-", short name; unique.
        place: where it stands, e.g. "eq (7)", "Table 2", "section 5.1".
        says: what it says.
        printed: the printed number, or the equation in short.
        code: files of this project where it lives.
        find: makes the finding; or the finding, where there is nothing to calculate.
        command: a command line that shows it; by default `mechanism-fmu reproduce` with this row's id.
    """

    id: str
    place: str
    says: str
    printed: str
    code: tuple[str, ...]
    find: Callable[[Bench], Found] | Found
    command: str = ""

    @property
    def document(self) -> Document:
        """Whose it is."""
        own = (document for document in Document if self.place.startswith(document.named))
        return Document(self.id[0]) if self.id[0] in set(Document) else next(own)

    @property
    def shown_by(self) -> str:
        """The command line that shows it."""
        return self.command or f"mechanism-fmu reproduce {self.id}"

    def found(self, bench: Bench) -> Found:
        """What this project finds."""
        return self.find if isinstance(self.find, Found) else self.find(bench)


@dataclass(frozen=True)
class Result:
    """A row, with what this project finds."""

    row: Row
    found: Found


def within(deviation: float, limit: float, ours: str, *worked: str, verdict: Verdict = Verdict.REPRODUCED) -> Found:
    """A finding that stands only while a deviation stays below a limit; deviations themselves are rounding."""
    right = deviation <= limit
    text = ours if right else f"{ours} (off by {deviation:.3g}, more than {limit:g})"
    return judged(right, text, *worked, verdict=verdict)


def judged(true: bool, ours: str, *worked: str, verdict: Verdict = Verdict.HOLDS) -> Found:
    """A finding whose verdict stands only while what it rests on is true."""
    return Found(ours, verdict if true else Verdict.FAILED, worked, calculated=True)
