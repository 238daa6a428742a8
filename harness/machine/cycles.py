"""How often a run repeats what a machine is for: what damage by 1,000 cycles is told of."""

from __future__ import annotations

from dataclasses import dataclass

import pandas as pd

#: So many cycles the damage is told for.
THOUSAND = 1000


@dataclass(frozen=True)
class Cycles:
    """What is repeated in a run.

    Attributes:
        count: how often, at least 1.
        of: what, in the plural: "strokes" or "runs like this one".
        counted: how it is known, for the reader.
    """

    count: int
    of: str
    counted: str

    def damage_of_thousand(self, damage: float) -> float:
        """What a thousand of them do, if they all do as those of the run, of which all do `damage`."""
        return THOUSAND * damage / self.count


def cycles_of(component: str, counter: str, seen: pd.DataFrame) -> Cycles:
    """The cycles of a component.

    Args:
        component: that is struck.
        counter: its output that counts strokes; "" when none does.
        seen: as of `frames.Seen`.
    """
    name = f"{component}.{counter}"
    if counter and name in seen and len(seen):
        strokes = round(abs(float(seen[name].iloc[-1]) - float(seen[name].iloc[0])))
        if strokes:
            return Cycles(strokes, "strokes", f"{name} counts {strokes} in this run")
    return Cycles(1, "runs like this one", "the run as a whole is a cycle")
