"""The table of docs/explanation/friction.md: how far friction is off its oracle, kind by kind.

python tests/analytic/friction_table.py      prints it
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import test_friction_oracle as oracle
from friction_cases import SHARES, Comparison, kind_of

#: What a kind is, and what its numbers come from.
KINDS = {
    1: ("block on a slope, pushed, shaken", "closed form"),
    2: ("mass on a belt; Den Hartog's, with stops", "closed form, piecewise"),
    3: ("disc and ball: slip becomes rolling", "closed form"),
    4: ("rod that slides on its end (Painlevé)", "extrapolation in 25 digits; at an instant closed form"),
    4.5: ("the same, where it jams, extrapolated to there", "extrapolation in 25 digits"),
    5: ("rod strikes the floor, three laws", "exact fractions; Stronge: closed form"),
    6: ("rocking block of Housner", "closed form, quadrature"),
    7: ("two blocks on each other", "polynomials, piecewise"),
    8: ("pendulum with a brake, in a pin that rubs; disc on a torsion spring", "energy, quadrature, closed form"),
}
COLUMNS = (*SHARES, None)


def measured() -> dict[tuple[float, float | None], float]:
    """The largest deviation of each kind, at a relative tolerance of the integration, or (None) at an instant."""
    found: dict[tuple[float, float | None], float] = {}
    for case, part, how in _runs():
        seen = Comparison(1.0)
        part(case, how, seen)
        kind = 4.5 if part.__name__ == "jams" else float(kind_of(case))
        key = (kind, how if how in SHARES else None)
        found[key] = max(found.get(key, 0.0), *(off for _, _, off in seen.deviations()))
    return found


def _runs() -> Iterator[tuple[Any, Any, Any]]:
    """Case, part and tolerance (or law) of all tests against the oracle."""
    for test in vars(oracle).values():
        marks = {mark.args[0]: mark.args[1] for mark in getattr(test, "pytestmark", ())}
        pairs = marks.pop(("case", "part"), ())
        (hows,) = marks.values() or ((None,),)
        yield from ((*pair.values, how) for pair in pairs for how in hows)


def table() -> str:
    """In Markdown."""
    found = measured()
    lines = ["| kind | | against | at 1e-9 | at 1e-12 | impacts, instants |", "| --- | --- | --- | --- | --- | --- |"]
    for kind, (what, against) in KINDS.items():
        numbers = (f"{found[kind, column]:.1e}" if (kind, column) in found else "" for column in COLUMNS)
        lines.append(f"| {int(kind)} | {what} | {against} | {' | '.join(numbers)} |".replace("|  |", "| |"))
    return "\n".join([*lines, ""]).replace("|  |", "| |")


if __name__ == "__main__":
    print(table(), end="")
