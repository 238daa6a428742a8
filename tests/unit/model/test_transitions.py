"""The logic derived from a mechanism: complete, named once, and true to what the engine does."""

import math
from collections import Counter
from dataclasses import replace
from xml.etree import ElementTree

import pytest

import models
from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    AngleLock,
    AngleStop,
    Body,
    CircularPattern,
    LogicalFunction,
    Mechanism,
    PointLineContact,
    Revolute,
)
from mechanism_fmu.model.event_names import event_names
from mechanism_fmu.model.transitions import logic_of, transition_diagram, transition_table
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.statechart import ANY, taken

MODEL = models.load("ratchet").MODEL

#: A free ratchet that indexes: four clicks in 34 s.
INDEXING = {
    "guided": 0,
    "tooth_count": 20,
    "tooth_slope_angle": math.radians(95),
    "pawl_spring_torque": 5e-3,
    "wheel_damping": 0.1,
    "drive_stiffness": 2.0,
    "drive_damping": 0.1,
}

#: A driver's pin that enters the slot of a wheel, as of a Geneva drive: switched rows and a lock.
GENEVA = Mechanism(
    bodies=(Body("crank", 1.0, 1.0), Body("wheel", 1.0, 1.0, (1.0, 0.0, 0.0))),
    joints=(
        Revolute("a", "crank", (0.0, 0.0), GROUND, (0.0, 0.0)),
        Revolute("b", "wheel", (0.0, 0.0), GROUND, (1.0, 0.0)),
    ),
    contacts=(
        PointLineContact(
            "slot", "crank", (0.5, 0.0), "wheel", (0.0, 0.0), (0.0, 1.0), pattern="slots", closed_while="pin_in_slot"
        ),
        AngleLock("arc", "wheel", GROUND, 0.0, 1.5, "not pin_in_slot"),
    ),
    patterns=(CircularPattern("slots", "crank", (0.5, 0.0), "wheel", -1.5, (0.0, 0.0), (0.0, 1.0), enabled=False),),
    functions=(LogicalFunction("pin_in_slot", "slot.along", 0.1), LogicalFunction("turned", "crank.angle", 1.0)),
)


def ratchet(**changes):
    return MODEL.build(MODEL.values(**changes))


def driven(time):
    swing = 2 * math.pi / 8
    angle = math.radians(84.3 - 10.4 * math.cos(swing * time))
    return [0.0, 3e-3, 0.0, angle, math.radians(10.4) * swing * math.sin(swing * time)]


def told(simulation, until):
    """All events up to a time: a bounce can pile up more of them than one communication step can tell."""
    before, count, begin = simulation.state.copy(), simulation.counters.item(codes.COUNT_EVENTS), simulation.time
    simulation.advance(until)
    found = simulation.events_in_step()
    if simulation.counters.item(codes.COUNT_EVENTS) - count == len(found):
        return found
    simulation.state[:] = before
    return told(simulation, (begin + until) / 2) + told(simulation, until)


def events_of(mechanism, until=34.0, step=0.01):
    simulation = Simulation(mechanism, inputs=driven(0.0))
    found = []
    for k in range(round(until / step)):
        simulation.inputs[:] = driven(k * step)
        found += told(simulation, (k + 1) * step)
    assert simulation.counters[codes.COUNT_EVENTS] == len(found)
    return found


def is_self_loop_of_nothing(event):
    """Nothing changed, and what reached zero did so without an impact: a gap that grazed, a force that returned."""
    return event.old_mode == event.new_mode and event.impulse == 0 and event.guard.endswith((".gap", ".force"))


@pytest.mark.parametrize("restitution", [(0.0, 0.0), (0.3, 0.3), (0.5, 0.0)], ids=str)
def test_every_event_of_a_real_run_is_in_the_table_and_joins_the_right_modes(restitution):
    e, e_stop = restitution
    mechanism = ratchet(**INDEXING, restitution=e, holding_pawl_restitution=e_stop)
    logic = logic_of(mechanism)
    happened = events_of(mechanism)
    counts = Counter()
    for event in happened:
        places = taken(logic, event.guard, event.old_mode, event.new_mode, event.impulse)
        arrows = [logic.transitions[place] for place in places]
        counts.update(arrow.trigger for arrow in arrows)
        assert set(event.old_mode) ^ set(event.new_mode) <= {arrow.part for arrow in arrows}, event
        # what gave the event its name took part, by an arrow of its own
        subject = event.guard.partition(".")[0]
        own = [a for a in arrows if a.event == event.guard and a.part.partition(".")[0] == subject]
        assert own or event.guard == "input" or is_self_loop_of_nothing(event) or grazes(arrows, subject), event
        for arrow in arrows:
            if arrow.part in ("slope", "face", "holding_pawl"):
                assert (arrow.source == "closed") == (arrow.part in event.old_mode)
                assert (arrow.target == "closed") == (arrow.part in event.new_mode)
    assert counts["holding_pawl.click"] == 4
    # teeth.next moves the pattern, and opens the slope with it
    assert counts["teeth.next"] == 8
    assert counts["teeth.previous"] == 0
    assert sum(event.guard == "teeth.next" for event in happened) == 4


def grazes(arrows, subject):
    """A gap that reached zero without speed closes its contact with no impact."""
    return any(a.part == subject and a.event == ANY and a.target == "closed" for a in arrows)


def test_the_guided_ratchet_does_what_the_paper_says():
    """On the slope until s = 0 at the face; eq (7); then both rows stay: a branch of its flow chart, Fig. 2."""
    logic = logic_of(ratchet())
    assert [(r.part, r.states, r.start) for r in logic.regions] == [
        ("slope", ("closed",), "closed"),
        ("face", ("open", "closed"), "open"),
    ]
    (arrow,) = logic.transitions
    assert (arrow.part, arrow.source, arrow.target, arrow.event) == ("face", "open", "closed", "face.gap")
    assert arrow.condition == "face.touches and face.approaches"
    assert "eq (7), e = 0" in arrow.reset
    assert "`slope` is closed throughout." in transition_table(ratchet())


def test_the_guided_run_takes_that_one_transition():
    simulation = Simulation(ratchet())
    simulation.advance(2.0)
    (event,) = simulation.events_in_step()
    assert taken(logic_of(ratchet()), *event[1:]) == [0]


def test_a_guided_contact_that_bounces_has_both_ways():
    logic = logic_of(ratchet(restitution=0.5))
    assert [(t.target, t.after) for t in logic.transitions] == [
        ("closed", ("not face.leaves",)),
        ("open", ("face.leaves",)),
    ]


def test_a_guided_bounce_is_told_apart_from_the_last_hit():
    mechanism = ratchet(restitution=0.5)
    simulation = Simulation(mechanism)
    counts = Counter()
    for k in range(300):
        simulation.advance((k + 1) * 0.01)
        for event in simulation.events_in_step():
            counts.update(taken(logic_of(mechanism), *event[1:]))
    assert counts[0] == 1
    assert counts[1] > 3


def test_what_is_not_enabled_is_left_out():
    logic = logic_of(ratchet(guided=0, holding_pawl=0))
    assert [r.part for r in logic.regions] == ["slope", "face", "teeth"]
    assert not any("holding_pawl" in d.name for d in logic.definitions)


def test_switched_rows_follow_their_function():
    logic = logic_of(GENEVA)
    assert [(t.part, t.source, t.event, t.guard, t.target) for t in logic.transitions] == [
        ("slot", "open", "pin_in_slot", ("pin_in_slot",), "closed"),
        ("slot", "closed", "pin_in_slot", ("not pin_in_slot",), "open"),
        ("arc", "open", "pin_in_slot", ("not pin_in_slot",), "closed"),
        ("arc", "closed", "pin_in_slot", ("pin_in_slot",), "open"),
        ("turned", "0 or 1", "turned", (), "0 or 1"),
    ]
    assert taken(logic, "pin_in_slot", ("arc",), ("slot",), 0.1) == [0, 3]
    assert [d.meaning for d in logic.definitions] == ["slot.along < 0.1", "crank.angle < 1"]


def test_a_stop_without_memory_does_not_click():
    (stop,) = [c for c in ratchet(guided=0).contacts if isinstance(c, AngleStop)]
    plain = replace(ratchet(guided=0), contacts=(replace(stop, pitch=None),), patterns=())
    logic = logic_of(plain)
    assert [r.part for r in logic.regions] == ["holding_pawl"]
    # alone, it has no impact but its own
    assert not any(t.event == ANY and t.impact for t in logic.transitions)


CASES = {
    "guided": ratchet(),
    "guided, e": ratchet(restitution=0.5),
    "free": ratchet(guided=0),
    "free, e": ratchet(guided=0, restitution=0.5, holding_pawl_restitution=0.1),
    "geneva": GENEVA,
    "free, friction": ratchet(guided=0, friction=0.1, joint_friction_radius=1e-3),
    "brake": models.load("rotary_table").MODEL.build(models.load("rotary_table").MODEL.values()),
}


@pytest.mark.parametrize("mechanism", CASES.values(), ids=CASES)
def test_names_are_one_vocabulary(mechanism):
    logic = logic_of(mechanism)
    names = [d.name for d in logic.definitions]
    assert len(set(names)) == len(names)
    assert len({r.part for r in logic.regions}) == len(logic.regions)
    told = [name for _, _, name in event_names(mechanism)]
    assert len(set(told)) == len(told)
    for arrow in logic.transitions:
        assert arrow.event in (*told, ANY)
        assert {factor.removeprefix("not ") for factor in (*arrow.guard, *arrow.after)} <= set(names)
        states = next(r.states for r in logic.regions if r.part == arrow.part)
        assert {arrow.source, arrow.target} <= set(states)
    assert {d.event for d in logic.definitions} <= {*told, ""}


@pytest.mark.parametrize("mechanism", CASES.values(), ids=CASES)
@pytest.mark.parametrize("counts", [None, {}, {0: 12}], ids=str)
def test_the_diagram_is_well_formed_and_shows_every_guard(mechanism, counts):
    text = transition_diagram(mechanism, counts)
    assert text == transition_diagram(replace(mechanism), counts)
    words = " ".join("".join(element.itertext()) for element in ElementTree.fromstring(text).iter())
    logic = logic_of(mechanism)
    assert logic.transitions
    assert logic.regions
    for arrow in logic.transitions:
        assert arrow.trigger in words
        assert all(factor.removeprefix("not ") in words for factor in (*arrow.guard, *arrow.after))
    assert all(region.part in words for region in logic.regions)
    assert ("×12" in words) == (counts == {0: 12})
    assert "http" not in text.replace("http://www.w3.org/2000/svg", "")


def test_the_table_has_a_row_for_each_transition():
    mechanism = CASES["free"]
    lines = transition_table(mechanism, {0: 7}).splitlines()
    rows = [line for line in lines if line.startswith("| ")]
    assert len(rows) == 2 + len(logic_of(mechanism).transitions)
    assert rows[2].endswith("| 7 |")
    assert {line.replace("\\|", "").count("|") for line in rows} == {8}


def test_what_rubs_slips_and_sticks_and_nothing_else_does():
    assert not [r.part for r in logic_of(ratchet(guided=0)).regions if r.part.endswith(".slip")]
    logic = logic_of(ratchet(guided=0, friction=0.1))
    assert [r.part for r in logic.regions if r.part.endswith(".slip")] == ["slope.slip", "face.slip"]
    (place,) = taken(logic, "slope.sticks", ["slope"], ["slope"], 0.0)
    assert (logic.transitions[place].source, logic.transitions[place].target) == ("slips", "sticks")
    (place,) = taken(logic, "face.slips", ["slope", "face"], ["slope", "face"], 0.0)
    assert (logic.transitions[place].source, logic.transitions[place].target) == ("sticks", "slips")


def test_a_table_that_stops_and_goes_on_takes_both_arrows():
    """Its brake catches it, and the shaft's end, which goes on, tears it off: named events, each an arrow."""
    model = models.load("rotary_table").MODEL
    mechanism = model.build(model.values())
    simulation, logic = Simulation(mechanism), logic_of(mechanism)
    simulation.advance(1.0)
    names = [event.guard for event in simulation.events_in_step()]
    simulation.set_slope("load_torque", 0.5)
    simulation.advance(2.0)
    names += [event.guard for event in simulation.events_in_step()]
    assert names == ["brake.sticks", "brake.slips"]
    assert [place for name in names for place in taken(logic, name, [], [], 0.0)] == [0, 1]
