"""What `mechanism-fmu identify impacts` does: laws of impacts fitted to a table of measured ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from rich.markup import escape

from ...analysis.impact_fit import BOUNDS, Fitted, Identified, identify
from ...analysis.impact_laws import Array
from ...analysis.measured_impacts import read_impacts
from ...errors import UsageError
from ...run.results import write_text
from ..output import give, note
from ..terminal import console, show_note, show_progress, show_table

_NAMES = ("mu", "e", "e_t")
#: A law that is better by less than this [1] is not worth a change of the engine.
_WORTH = 0.001
_MEANING = (
    "95 %: interval by bootstrap over the rows. Errors: |v predicted - v measured| / |v measured| after the impact, in "
    "the norm of the kinetic energy; unseen: mean, of rows at numbers fitted to the other folds"
)


def identify_impacts(file: Path, folds: int, seed: int, unflagged: bool, output: Path | None) -> int:
    """Fit all laws, show and write what comes of it, and return the exit code.

    Args:
        file: table of impacts.
        folds: number of parts of the cross-validation.
        seed: of parts and intervals, a whole number.
        unflagged: whether flagged rows are left out.
        output: file for the table of the laws, or None.

    Raises:
        UsageError: the table, the folds or the place of the output cannot be; the message says what to do.
    """
    if output is not None and not output.absolute().parent.is_dir():
        raise UsageError(f"There is no folder '{output.absolute().parent}' to write {output.name} into; make it first.")
    impacts = read_impacts(file, unflagged)
    with show_progress("Fitting the laws ...") as progress:
        found = identify(impacts, folds, seed, lambda label, done: progress(f"Fitting {label}", done))
    table = table_of(found)
    laws = [row.dropna().to_dict() for _, row in table.iterrows()]  # JSON has no nan
    give({"impacts": len(impacts), "laws": laws, "line": model_line(found.chosen)})
    _show(found, len(impacts), file)
    if output is not None:
        write_text(output, lambda target: table.to_csv(target, index=False))
        note("files", str(output))
        console.print(f"Written: {escape(str(output))}", soft_wrap=True)
    return 0


def table_of(found: Identified) -> pd.DataFrame:
    """A row a law, and the two bounds below: numbers and errors as they are [1], not in per cent; nan where none."""
    rows: list[dict[str, object]] = []
    for fitted in found.laws:
        row: dict[str, object] = {"law": fitted.law.name, "impact_law": fitted.law.engine}
        for name, number, (low, high) in zip(_NAMES, fitted.numbers, fitted.intervals, strict=False):
            row |= {name: number, f"{name}_low": low, f"{name}_high": high}
        row |= _errors(fitted.errors)
        row |= {"unseen_median": float(np.median(fitted.unseen)), "unseen_mean": float(fitted.unseen.mean())}
        mean, (low, high) = fitted.behind
        rows.append({**row, "behind": mean, "behind_low": low, "behind_high": high})
    for name, errors in (("newton_of_each_impact", found.own), ("best_impulse", found.bound)):
        rows.append({"law": name, "impact_law": "", **_errors(errors)})
    return pd.DataFrame(rows)


def model_line(fitted: Fitted) -> str:
    """The line that gives a mechanism the law and its numbers (`mechanism_fmu.model.Mechanism.with_impacts`)."""
    mu, e = fitted.numbers[:2]
    return f'mechanism = mechanism.with_impacts("{fitted.law.engine}", restitution={e:.3f}, friction={mu:.3f})'


def _errors(errors: Array) -> dict[str, object]:
    return {"median": float(np.median(errors)), "mean": float(errors.mean())}


def _show(found: Identified, rows: int, file: Path) -> None:
    numbers = [[fitted.law.label, *_numbers(fitted)] for fitted in found.laws]
    headings = ["law", *(heading for name in _NAMES for heading in (name, "95 %"))]
    title = f"Laws of impacts, fitted to {rows} of {file.name}"
    show_table(title, headings, numbers, numeric=range(1, len(headings)))
    errors = [[fitted.law.label, *_shares(fitted.errors), *_unseen(fitted)] for fitted in found.laws]
    errors.append(["Newton, own numbers", *_shares(found.own), "", "", ""])
    errors.append(["best impulse, no law", *_shares(found.bound), "", "", ""])
    headings = ["law", "median [%]", "mean [%]", "unseen [%]", "behind [points]", "95 %"]
    title = f"Their errors, and two bounds; {found.folds} folds"
    show_table(title, headings, errors, numeric=range(1, len(headings)))
    console.print(f"[dim]{escape(_MEANING)}; behind: {found.chosen.law.label}'s.[/]", soft_wrap=True)
    for fitted in found.laws:
        for name, number, bounds in zip(_NAMES, fitted.numbers, BOUNDS, strict=False):
            if bool(np.any(np.isclose(number, bounds, rtol=0.0, atol=1e-9))):
                show_note(f"{name} of {fitted.law.label} is {number:g}, the end of what is looked through.")
    for sentence in conclusion(found):
        note("notes", sentence)
        console.print(escape(sentence), soft_wrap=True)
    console.print(f"[bold]{escape(model_line(found.chosen))}[/]", soft_wrap=True)


def conclusion(found: Identified) -> list[str]:
    """Which law to use and why, one sentence each."""
    chosen = found.chosen
    said = [
        f"Use {chosen.law.label}'s law: of those of the engine it has the least error on unseen rows, "
        f"{100 * float(chosen.unseen.mean()):.1f} %; no rigid impulse at the contact can come below "
        f"{100 * float(found.bound.mean()):.1f} %."
    ]
    for other in found.laws:
        mean, (low, high) = other.behind
        if other is chosen or (not other.law.engine and mean >= 0.0):
            continue
        if low <= 0.0 <= high:
            verdict = "cannot be told from it by these rows"
        elif mean > 0.0:
            verdict = f"is {100 * mean:.2f} points behind"
        else:
            why = "too little to miss it" if mean > -_WORTH else "but not in the engine"
            verdict = f"is {-100 * mean:.2f} points ahead, {why}"
        said.append(f"{other.law.label} {verdict}.")
    return said


def _numbers(fitted: Fitted) -> list[str]:
    cells = []
    for number, (low, high) in zip(fitted.numbers, fitted.intervals, strict=True):
        cells += [f"{number:.3f}", f"{low:.3f}-{high:.3f}"]
    return cells + [""] * (2 * len(_NAMES) - len(cells))


def _unseen(fitted: Fitted) -> list[str]:
    mean, (low, high) = fitted.behind
    behind = [f"{100 * mean:.2f}", f"{100 * low:.2f} to {100 * high:.2f}"] if mean else ["", ""]
    return [f"{100 * float(fitted.unseen.mean()):.1f}", *behind]


def _shares(errors: Array) -> list[str]:
    return [f"{100 * float(np.median(errors)):.1f}", f"{100 * float(errors.mean()):.1f}"]
