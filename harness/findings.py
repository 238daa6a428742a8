"""What a source says, weighed against numbers: a finding is no check, and none of them fails a run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum


class Verdict(StrEnum):
    """What became of something that a source says."""

    REPRODUCED = "reproduced"
    ANSWERED = "answered"
    REDRAWN = "redrawn"
    HOLDS = "holds"
    HOLDS_IN_PART = "holds in part"
    DOES_NOT_HOLD = "does not hold"
    MISPRINT = "misprint"
    ASSUMPTION = "assumption that fails"
    TAKEN_OVER = "taken over"
    CHOICE = "choice"
    NOT_DETERMINED = "not determined"
    FAILED = "FAILED"


@dataclass(frozen=True)
class Finding:
    """One claim of a source and what became of it.

    A `Check` is what this project answers for, a finding is what the source answers for: it has no exit code.

    Attributes:
        claim: what the source says, in its words or close to them.
        verdict: whether it holds.
        evidence: the numbers behind the verdict, and where they come from.
    """

    claim: str
    verdict: Verdict
    evidence: str


def verdict_of(criteria: Sequence[bool]) -> Verdict:
    """Of a claim that says several things: it holds when all are true, and does not hold when none is."""
    return Verdict.HOLDS if all(criteria) else Verdict.HOLDS_IN_PART if any(criteria) else Verdict.DOES_NOT_HOLD
