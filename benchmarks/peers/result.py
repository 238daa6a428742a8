"""All that is run of some cases."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from .case import Case, Point, Program, Verdict, measure, overtaken, verdicts
from .programs import is_here

#: One run: of a case, by a program, at one of its settings.
Task = tuple[Case, Program, float]


@dataclass(frozen=True)
class Result:
    """A case, and all that was run of it."""

    case: Case
    points: tuple[Point, ...]

    @property
    def verdicts(self) -> list[Verdict]:
        """Each way of a peer at its best, those that are ahead first."""
        return verdicts(self.points, self.case.floor)

    @property
    def overtaken(self) -> list[Verdict]:
        """Peers that are ahead at some other setting."""
        return overtaken(self.points, self.case.floor)


def run_all(cases: Sequence[Case], tracked: Callable[[Sequence[Task]], Iterable[Task]]) -> list[Result]:
    """Run cases by all programs that are installed.

    Args:
        cases: which.
        tracked: gives the runs one after the other, and shows how far they are.
    """
    tasks = [
        (case, program, setting)
        for case in cases
        for program in case.programs
        if is_here(program.code)
        for setting in program.settings
    ]
    exact = {case.name: case.reference() for case in cases}
    points: dict[str, list[Point]] = {case.name: [] for case in cases}
    for case, program, setting in tracked(tasks):
        points[case.name].append(measure(program, setting, exact[case.name]))
    return [Result(case, tuple(points[case.name])) for case in cases]
