"""A mechanism's modes and transitions, derived from the mechanism alone.

The paper draws no state chart: its Fig. 2 is a flow chart of the computation, whose branches (is s = 0? then eq (7),
and go on with other rows) are the transitions here, for any mechanism.

What is stated here is what `transition` and `impact` in `engine.contacts` and `engine.stepping.events` do:

- An open contact whose gap reaches 0 strikes, eq (7). Afterwards it is closed if it then pushes; a bounce, and an
  impact after which it would pull, leave it open. A guided contact (the paper's) need not push.
- A closed contact opens when its multiplier reaches 0. At any other event the contacts that push are chosen afresh
  among those that touch and rest, so that an impact elsewhere can open it, and one that touches can close without an
  impact.
- Beyond a boundary the contacts of a pattern open and stand at its next copy, where they may touch at once.
- A stop with memory clicks. A declared logical function switches its rows.
- What touches and has friction sticks where its slip comes to an end, or slips on the other way; it slips where
  friction has reached its bound.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ..statechart import ANY, Logic, Region, Transition, diagram, markdown
from .contacts import AngleStop, Contact
from .forces import ForceElement
from .joints import Joint
from .logic import switch
from .logical_functions import definitions, exists, is_kept, rubbing
from .mechanism import Mechanism

__all__ = ["logic_of", "transition_diagram", "transition_table"]

OPEN, CLOSED = "open", "closed"
SLIPS, STICKS = "slips", "sticks"


def logic_of(mechanism: Mechanism) -> Logic:
    """Logical functions, state charts and transitions of a mechanism whose values are plain numbers.

    Args:
        mechanism: whose values are plain numbers.
    """
    return Logic(tuple(definitions(mechanism)), tuple(_regions(mechanism)), tuple(_transitions(mechanism)))


def transition_table(mechanism: Mechanism, counts: Mapping[int, int] | None = None) -> str:
    """The transitions as Markdown; `counts` says how often each happened, by its place in the logic.

    Args:
        mechanism: whose values are plain numbers.
        counts: how often each transition happened, by its place in the logic; None leaves that out.
    """
    return markdown(logic_of(mechanism), counts)


def transition_diagram(mechanism: Mechanism, counts: Mapping[int, int] | None = None) -> str:
    """The state charts as SVG; with `counts`, by place in the logic, what happened is marked.

    Args:
        mechanism: whose values are plain numbers.
        counts: how often each transition happened, by its place in the logic; None marks nothing.
    """
    return diagram(logic_of(mechanism), counts)


def memory_of(stop: AngleStop) -> str:
    """The region in which a stop with memory counts: the name of its latched angle among the output sources."""
    return f"{stop.name}.latched"


def slip_of(part: Contact | Joint | ForceElement) -> str:
    """The region in which what rubs slips and sticks."""
    return f"{part.name}.slip"


def _regions(mechanism: Mechanism) -> Iterator[Region]:
    for contact in filter(exists, mechanism.contacts):
        states: tuple[str, ...] = (OPEN, CLOSED)
        start = OPEN
        if is_kept(contact, mechanism):
            states = (CLOSED,)
        if isinstance(contact, AngleStop) or contact.closed_while is not None:
            start = ""
        elif contact.closed > 0.5:
            start = CLOSED
        yield Region(contact.name, _kind(contact, mechanism), states, start, True)
        if isinstance(contact, AngleStop) and contact.pitch is not None:
            yield Region(memory_of(contact), "memory of the stop", ("latched",), "", False)
    for part in rubbing(mechanism):
        what = "friction, where it touches" if part in mechanism.contacts else "friction"
        yield Region(slip_of(part), what, (SLIPS, STICKS), "", False)
    for pattern in filter(exists, mechanism.patterns):
        on = ", ".join(c.name for c in mechanism.contacts if c.pattern == pattern.name)
        yield Region(pattern.name, f"repeats {on} around {pattern.body_j}", ("copy k",), "", False)
    for function in _unused(mechanism):
        yield Region(function, "logical function", ("0 or 1",), "", False)


def _kind(contact: Contact, mechanism: Mechanism) -> str:
    if contact.closed_while is not None:
        return f"row, closed while {contact.closed_while}"
    what = "stop" if isinstance(contact, AngleStop) else f"{contact.body_i} on {contact.body_j}"
    if is_kept(contact, mechanism):
        return f"{what}, guided: kept, pulls too"
    return f"{what}, {'guided: pulls too' if contact.guided > 0.5 else 'only pushes'}"


def _transitions(mechanism: Mechanism) -> Iterator[Transition]:
    for contact in filter(exists, mechanism.contacts):
        if contact.closed_while is not None:
            yield from _switched(contact)
        elif not is_kept(contact, mechanism):
            yield from _struck(contact)
            yield from _moved(contact, mechanism)
            yield from _carried_along(contact, mechanism)
        if isinstance(contact, AngleStop) and contact.pitch is not None:
            click = f"{contact.name}.click"
            yield Transition(
                memory_of(contact), "latched", "latched", click, (click,), reset="latched angle + pitch, clicks + 1"
            )
    for part in rubbing(mechanism):
        yield from _rubs(part, mechanism)
    for pattern in filter(exists, mechanism.patterns):
        for verb, reset in (("next", "k + 1"), ("previous", "k - 1")):
            event = f"{pattern.name}.{verb}"
            yield Transition(
                pattern.name, "copy k", "copy k", event, (event,), reset=f"copy {reset}; its contacts open"
            )
    for function in _unused(mechanism):
        yield Transition(function, "0 or 1", "0 or 1", function, (), reset="the other value")


def _rubs(part: Contact | Joint | ForceElement, mechanism: Mechanism) -> Iterator[Transition]:
    """What friction does."""
    region, name = slip_of(part), part.name
    on = "row on; or slips on the other way at once"
    yield Transition(region, SLIPS, STICKS, f"{name}.sticks", (f"{name}.rests",), reset=on)
    yield Transition(region, STICKS, SLIPS, f"{name}.slips", (f"{name}.gives",), reset="row off")
    if mechanism.tangential_shock:
        yield Transition(region, SLIPS, SLIPS, f"{name}.shock", (), reset="impact without approach", impact=True)


def _struck(contact: Contact) -> Iterator[Transition]:
    """What the contact's own gap and force do."""
    name, event = contact.name, f"{contact.name}.gap"
    guard = (f"{name}.touches", f"{name}.approaches")
    bounces = contact.restitution > 0
    if contact.guided > 0.5:
        after = (f"not {name}.leaves",) if bounces else ()
        yield Transition(name, OPEN, CLOSED, event, guard, after, _impact(contact), impact=True)
        if bounces:
            reset = f"{_impact(contact)}; bounces when e |s'| >= stick speed"
            yield Transition(name, OPEN, OPEN, event, guard, (f"{name}.leaves",), reset, impact=True)
        return
    pushes = f"{name}.pushes"
    yield Transition(name, OPEN, CLOSED, event, guard, (pushes,), _impact(contact), impact=True)
    reset = "bounces when e |s'| >= stick speed" if bounces else "lets go at once: it would pull"
    yield Transition(name, OPEN, OPEN, event, guard, (f"not {pushes}",), f"{_impact(contact)}; {reset}", impact=True)
    yield Transition(name, CLOSED, OPEN, f"{name}.force", (f"not {pushes}",), reset="row off")


def _moved(contact: Contact, mechanism: Mechanism) -> Iterator[Transition]:
    """What the contact's pattern does with it."""
    name = contact.name
    for pattern in filter(exists, mechanism.patterns):
        if pattern.name != contact.pattern:
            continue
        for verb in ("next", "previous"):
            event = f"{pattern.name}.{verb}"
            yield Transition(name, CLOSED, OPEN, event, (event,), reset="row off: its line is the next copy's")
            yield Transition(
                name,
                CLOSED,
                CLOSED,
                event,
                (event, f"{name}.touches"),
                reset="onto the next copy's line, where it touches",
            )


def _carried_along(contact: Contact, mechanism: Mechanism) -> Iterator[Transition]:
    """What happens to the contact at events that are not its own."""
    name = contact.name
    touches, approaches, leaves = f"{name}.touches", f"{name}.approaches", f"{name}.leaves"
    guided = contact.guided > 0.5
    pushes = () if guided else (f"{name}.pushes",)
    if _others_strike(contact, mechanism):
        guard = (touches, approaches) if guided else (touches,)
        yield Transition(name, OPEN, CLOSED, ANY, guard, pushes, "struck at the same instant", impact=True)
        if not guided:
            yield Transition(
                name, CLOSED, OPEN, ANY, (), (f"not {name}.pushes",), "row off: the impact parts it", impact=True
            )
    if not guided:
        rests = (touches, f"not {approaches}", f"not {leaves}")
        yield Transition(name, OPEN, CLOSED, ANY, (*rests, *pushes), reset="row on, no impact")
        yield Transition(name, CLOSED, OPEN, ANY, (f"not {name}.pushes",), reset="row off")


def _switched(contact: Contact) -> Iterator[Transition]:
    function, value = switch(contact.closed_while)
    assert function is not None
    on, off = (function, f"not {function}") if value else (f"not {function}", function)
    what = "row on, at the nearest locked angle" if contact.angular else "row on"
    yield Transition(contact.name, OPEN, CLOSED, function, (on,), reset=f"{what}; impact, eq (7), e = 0")
    yield Transition(contact.name, CLOSED, OPEN, function, (off,), reset="row off")


def _others_strike(contact: Contact, mechanism: Mechanism) -> bool:
    """Whether there can be an impact that is not the contact's own."""
    return any(other is not contact and exists(other) and not is_kept(other, mechanism) for other in mechanism.contacts)


def _unused(mechanism: Mechanism) -> list[str]:
    """Declared functions that switch nothing."""
    used = {switch(contact.closed_while)[0] for contact in filter(exists, mechanism.contacts)}
    return [function.name for function in mechanism.functions if function.name not in used]


def _impact(contact: Contact) -> str:
    return f"impact, eq (7), e {'> 0' if contact.restitution > 0 else '= 0'}"
