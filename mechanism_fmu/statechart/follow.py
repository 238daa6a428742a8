"""Which transitions an event has taken."""

from __future__ import annotations

from collections.abc import Collection

from .records import ANY, Logic, Region


def taken(logic: Logic, event: str, old_mode: Collection[str], new_mode: Collection[str], impulse: float) -> list[int]:
    """Places in `logic.transitions` of the transitions that an event has taken, at most one of each region.

    Args:
        logic: of the mechanism.
        event: what fired, e.g. "face.gap" (`Event.guard`).
        old_mode: names of the closed contacts before.
        new_mode: names of the closed contacts after.
        impulse: total impulse of the event [N s]; 0 when there was no impact.
    """
    found = []
    for region in logic.regions:
        source, target = (_state(region, mode) for mode in (old_mode, new_mode))
        for place, arrow in enumerate(logic.transitions):
            if arrow.part != region.part or (arrow.impact and impulse == 0):
                continue
            if region.is_contact and (arrow.source, arrow.target) != (source, target):
                continue
            if arrow.event == event or (arrow.event == ANY and source != target):
                found.append(place)
                break
    return found


def _state(region: Region, mode: Collection[str]) -> str:
    if not region.is_contact:
        return ""
    return "closed" if region.part in mode else "open"
