"""The damage that all impacts of a run do, as a section of its report."""

from __future__ import annotations

from ..experiment import Run
from ..tooth_damage import HEADINGS, damage_note, damage_row
from .page import section, table


def fatigue_section(run: Run) -> str:
    """One line of numbers; nothing for a run without damage to tell."""
    if run.damage is None:
        return ""
    card = run.experiment.material
    rows = table(list(HEADINGS), [damage_row(run.damage, card)], numeric=range(1, len(HEADINGS)))
    sources = f"{card.text}. {'; '.join(card.sources)}."
    return section("Fatigue of the tooth", rows, note=f"{damage_note(run.damage)} {sources}")
