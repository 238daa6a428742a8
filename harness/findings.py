"""What a source says, weighed against numbers: a finding is no check, and none of them fails a run."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum


class Verdict(StrEnum):
    """Whether a claim of a source holds."""

    HOLDS = "holds"
    HOLDS_IN_PART = "holds in part"
    DOES_NOT_HOLD = "does not hold"


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


def with_verdict(findings: Iterable[Finding], verdict: Verdict) -> tuple[Finding, ...]:
    """Those of the findings that have this verdict."""
    return tuple(finding for finding in findings if finding.verdict is verdict)
