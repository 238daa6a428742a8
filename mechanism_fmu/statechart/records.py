"""Records of a mechanism's logic. A guard is a product of logical functions: all of its factors must be 1."""

from __future__ import annotations

from dataclasses import dataclass

#: The event of a transition that any event can bring along.
ANY = "any"


@dataclass(frozen=True)
class Definition:
    """A logical function: a named function of the motion with the values 0 and 1.

    Attributes:
        name: "<part>.<verb>", e.g. "face.touches"; or the name of a function that the mechanism declares.
        meaning: when it is 1, e.g. "gap s <= 0".
        unit: of the quantity that it looks at.
        tolerance: how exactly the engine decides it.
        event: the event that it fires, named as in `mechanism_fmu.simulation.Event`; "" when it only guards.
    """

    name: str
    meaning: str
    unit: str
    tolerance: str
    event: str = ""


@dataclass(frozen=True)
class Region:
    """One of the state charts that run beside each other.

    Attributes:
        part: the contact, pattern or memory whose states these are; unique.
        kind: what it is, in a few words.
        states: "open" and "closed" of a contact, and one state of what only counts.
        start: the state at the start; "" when assembly decides it.
        is_contact: whether the mode of the mechanism (the names of its closed contacts) tells the state.
    """

    part: str
    kind: str
    states: tuple[str, ...]
    start: str
    is_contact: bool


@dataclass(frozen=True)
class Transition:
    """One arrow of the chart.

    A contact that neither changes its state nor gave the event its name has no arrow: nothing happens to it.

    Attributes:
        part: the region.
        source, target: states.
        event: what fires it, named as in `mechanism_fmu.simulation.Event.guard`; or `ANY`.
        guard: logical functions, each perhaps with "not " before it, that must all be 1 before the reset.
        after: likewise, after the reset.
        reset: what else changes, in a few words; "" when nothing does.
        impact: whether it happens only at events with an impact.
    """

    part: str
    source: str
    target: str
    event: str
    guard: tuple[str, ...]
    after: tuple[str, ...] = ()
    reset: str = ""
    impact: bool = False

    @property
    def trigger(self) -> str:
        """The event in words."""
        if self.event == ANY:
            return "any impact" if self.impact else "any event"
        return self.event

    @property
    def condition(self) -> str:
        """The guard as a product, with what must hold after the reset."""
        before, after = " and ".join(self.guard), " and ".join(self.after)
        return "; ".join(filter(None, (before, f"then {after}" if after else "")))


@dataclass(frozen=True)
class Logic:
    """All that a mechanism's modes can do.

    Attributes:
        definitions: the logical functions.
        regions: the state charts.
        transitions: their arrows; for the same part and states the first that applies is taken.
    """

    definitions: tuple[Definition, ...]
    regions: tuple[Region, ...]
    transitions: tuple[Transition, ...]
