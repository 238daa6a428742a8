"""Verdicts (checks) of a run: what should hold, whether it does, and its numbers; and findings, which fail no run."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
import pandas as pd

from .master import Ending, Outcome

# What a source says, weighed against numbers: a finding is no check, and none of them fails a run.


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


#: Largest accepted residual of the energy balance, relative to the energy that was in play.
_ENERGY_TOLERANCE = 1e-6

#: Outputs that are named in one verdict.
_MOST_NAMED = 5

_ENERGIES = ("kinetic_energy", "spring_energy", "work_done", "energy_lost")


@dataclass(frozen=True)
class Check:
    """One verdict.

    Attributes:
        claim: what should hold.
        passed: whether it does.
        evidence: the numbers behind it.
    """

    claim: str
    passed: bool
    evidence: str


def all_passed(checks: Iterable[Check]) -> bool:
    """Whether every check holds."""
    return all(check.passed for check in checks)


def energy_residual(results: pd.DataFrame) -> pd.Series[float] | None:
    """Kinetic + spring - their initial sum - work done + energy lost [J]: zero but for rounding and tolerance.

    None when the FMU does not report all four energies.
    """
    if results.empty or not set(_ENERGIES) <= set(results.columns):
        return None
    stored = results["kinetic_energy"] + results["spring_energy"]
    residual: pd.Series[float] = stored - stored.iloc[0] - results["work_done"] + results["energy_lost"]
    return residual


def not_finite(results: pd.DataFrame, outputs: Iterable[str]) -> list[tuple[str, float, float]]:
    """Outputs that are nan or infinite somewhere: name, time of the first such value [s], and that value."""
    found = []
    for name in outputs:
        if name in results.columns and results[name].dtype.kind == "f":
            column = results[name].to_numpy()
            if not np.isfinite(column).all():
                first = int(np.argmin(np.isfinite(column)))
                found.append((name, float(results["time"].iloc[first]), float(column[first])))
    return found


def run_checks(
    outcome: Outcome,
    stop_time: float,
    results: pd.DataFrame,
    impacts: pd.DataFrame,
    lost: int,
    outputs: Iterable[str] = (),
) -> tuple[Check, ...]:
    """What every run is checked for. That outputs are numbers is mentioned only where they are not."""
    checks = [
        Check(
            "The run reaches its stop time",
            outcome.ending is Ending.COMPLETED,
            f"{outcome.final_time:.9g} of {stop_time:.9g} s in {outcome.steps} steps{_divided(outcome)}",
        )
    ]
    if wrong := not_finite(results, outputs):
        first = [f"{name} is {value} from t = {time:.9g} s" for name, time, value in wrong[:_MOST_NAMED]]
        more = [f"and {len(wrong) - _MOST_NAMED} others"] if len(wrong) > _MOST_NAMED else []
        checks.append(Check("Every output is a finite number", False, ", ".join([*first, *more])))
    if "impact_count" in results.columns and not results.empty:
        counted = int(results["impact_count"].iloc[-1])
        evidence = f"{len(impacts)} collected, {counted} counted by the FMU, {lost} lost"
        if lost:
            claim = "Every impact is counted"
            evidence += ": they did not fit into its buffer of one step, and it cannot be put back; use a shorter step"
        else:
            claim = "Every impact is collected"
        checks.append(Check(claim, counted == len(impacts) + lost, evidence))
    residual = energy_residual(results)
    if residual is not None:
        scale = float(results[list(_ENERGIES)].abs().max().max())
        worst = float(residual.abs().max())
        evidence = f"largest residual {worst:.2e} J of {scale:.3g} J in play; limit {_ENERGY_TOLERANCE:g} of it"
        checks.append(Check("The energy balance closes", worst <= _ENERGY_TOLERANCE * scale, evidence))
    return tuple(checks)


def _divided(outcome: Outcome) -> str:
    if not outcome.divided:
        return ""
    return f", {outcome.divided} of them in parts, as they had more impacts or events than the FMU's buffers hold"
