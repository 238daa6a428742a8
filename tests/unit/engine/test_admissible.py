"""What the words of a saved state may hold: declared for every one, and refused where it does not fit."""

import struct
from functools import cache

import numpy as np
import pytest
from hypothesis import given, strategies as st

import models
from mechanism_fmu import codes
from mechanism_fmu.engine import status
from mechanism_fmu.fmu.instance.saved_state import SUBJECTS, Admissible, rules
from mechanism_fmu.model import Body, Mechanism, compile_mechanism
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tables.declare import Field
from mechanism_fmu.tables.layout import FIELDS, pack, state_of
from mechanism_fmu.tables.sizes import sizes_of
from tests.fuzz.forged import forged_words

RATCHET = models.load("ratchet").MODEL


def block_of(name):
    model = models.load(name).MODEL
    return pack(compile_mechanism(model.build(model.values())))


def running(model=RATCHET, until=1.0):
    simulation = Simulation(model.build(model.values()))
    simulation.advance(until)
    return simulation


@pytest.mark.parametrize("field", [field for field in FIELDS if field.section == "state"], ids=lambda field: field.name)
def test_every_field_of_the_state_declares_what_it_holds(field):
    assert field.holds is not None
    assert len(field.holds) == len(field.columns or ("",))
    if field.integer:
        assert all(holds.whole for holds in field.holds)


def test_a_field_without_a_declaration_fails(monkeypatch):
    monkeypatch.setattr("mechanism_fmu.fmu.instance.saved_state.FIELDS", (*FIELDS, Field("state", "forgotten", (1,))))
    with pytest.raises(TypeError, match="forgotten"):
        rules(sizes_of(block_of("ratchet")))


COLUMNS = {field.name: field.columns for field in FIELDS if field.columns}


@pytest.mark.parametrize("name", COLUMNS)
def test_columns_are_declared_in_the_order_of_their_codes(name):
    assert [getattr(codes, column) for column in COLUMNS[name]] == list(range(len(COLUMNS[name])))


def test_all_counters_and_times_and_columns_of_events_are_declared():
    assert len(COLUMNS["counters"]) == codes.COUNTERS_LENGTH
    assert len(COLUMNS["clock"]) == codes.CLOCK_LENGTH
    assert len(COLUMNS["events"]) == codes.EVENT_COLUMNS
    assert len(COLUMNS["impacts"]) == codes.RECORD_CONTACT_IMPULSES + 1


@pytest.mark.parametrize("name", models.available())
def test_the_rules_cover_every_word_once(name):
    block = block_of(name)
    seen = np.zeros(len(state_of(block)), int)
    for rule in rules(sizes_of(block)):
        for row in range(rule.rows):
            start = rule.first + row * rule.stride
            seen[start : start + rule.columns] += 1

    assert (seen == 1).all()


@pytest.mark.parametrize("name", models.available())
def test_states_of_every_model_are_admitted(name):
    model = models.load(name).MODEL
    simulation = Simulation(model.build(model.values()))
    admissible = Admissible.of(sizes_of(block_of(name)))
    assert admissible.fault(simulation.state.tobytes()) is None
    for k in range(1, 60):
        simulation.advance(k * model.stop_time / 60)
        assert admissible.fault(simulation.state.tobytes()) is None


@pytest.mark.parametrize("name", models.available())
def test_kept_forged_words_are_refused(name):
    model = models.load(name).MODEL
    state = running(model, 0.05).state.tobytes()
    admissible = Admissible.of(sizes_of(block_of(name)))
    words = list(forged_words(model))
    assert len(words) > 40
    for what, place, bits in words:
        forged = state[: 8 * place] + struct.pack("<Q", bits) + state[8 * place + 8 :]
        fault = admissible.fault(forged)
        assert fault is not None, what
        assert "instead of" in fault or "cannot be about" in fault, what


def with_counters(simulation, **changes):
    """The state with other counters."""
    kept = simulation.state.copy()
    for name, value in changes.items():
        simulation.counters[getattr(codes, name)] = value
    changed = simulation.state.tobytes()
    simulation.state[:] = kept
    return changed


@pytest.mark.parametrize("guard", SUBJECTS)
def test_a_pending_event_is_about_something_that_is_there(guard):
    simulation = running()
    sizes = sizes_of(block_of("ratchet"))
    admissible = Admissible.of(sizes)
    count = sizes[SUBJECTS[guard]]
    for subject in (-1, 0, count - 1, count, count + 1):
        fault = admissible.fault(with_counters(simulation, PENDING_GUARD=guard, PENDING_SUBJECT=subject))
        assert (fault is None) == (0 <= subject < count)


def test_a_failed_event_has_a_status_that_events_can_have():
    """Messages of others look up contacts, which would be those of a status's number."""
    simulation = running()
    admissible = Admissible.of(sizes_of(block_of("ratchet")))
    for outcome in (*status.ADVICE, -1, 0, 99):
        fault = admissible.fault(with_counters(simulation, PENDING_GUARD=codes.GUARD_FAILED, PENDING_SUBJECT=outcome))
        assert (fault is None) == (outcome in status.EVENT_FAILURES)


def test_records_that_are_counted_are_about_something():
    simulation = running(until=0.5)
    admissible = Admissible.of(sizes_of(block_of("ratchet")))
    assert simulation.counters[codes.COUNT_IN_STEP] == 0
    assert "without a contact" in admissible.fault(with_counters(simulation, COUNT_IN_STEP=1))
    simulation = running(until=1.0)
    events = int(simulation.counters[codes.EVENTS_IN_STEP])
    assert events > 0
    for guard in (codes.GUARD_NONE, codes.GUARD_BEGIN, codes.GUARD_FAILED):
        simulation.field("events")[0, codes.EVENT_GUARD] = guard
        assert "cannot be about" in admissible.fault(simulation.state.tobytes())


def test_an_internal_step_has_a_length_while_the_time_lies_in_it():
    simulation = running(until=0.5)
    clock = simulation.field("clock")
    assert clock[codes.TIME] < clock[codes.STEP_END]
    clock[codes.STEP_SIZE] = 0.0

    assert "no length" in Admissible.of(sizes_of(block_of("ratchet"))).fault(simulation.state.tobytes())


@cache
def ratchet_state():
    """What a ratchet's state may hold, and one."""
    return Admissible.of(sizes_of(block_of("ratchet"))), running(until=0.5).state.tobytes()


@given(st.integers(-(2**63), 2**63 - 1) | st.integers(-3, 3))
def test_counts_and_flags_are_what_their_limits_say(value):
    admissible, state = ratchet_state()
    for name, expected in (("counters[COUNT_IMPACTS]", 0 <= value <= 2**53), ("counters[RAMPING]", value in (0, 1))):
        place = 8 * admissible.names.index(name)
        fault = admissible.fault(state[:place] + struct.pack("<q", value) + state[place + 8 :])
        assert (fault is None) == expected or abs(value - 2**53) <= 1


@pytest.mark.parametrize(("bodies", "most"), [(115, 1), (116, 0)])
def test_steps_are_implicit_only_where_there_is_room_for_their_matrix(bodies, most):
    mechanism = Mechanism(bodies=tuple(Body(f"disc {k}", 1.0, 1.0) for k in range(bodies)))
    admissible = Admissible.of(sizes_of(pack(compile_mechanism(mechanism))))
    for name in ("IMPLICIT", "IMPLICIT_STEP"):
        for value in (-1, 0, 1, 2):
            fault = admissible.fault(with_counters(Simulation(mechanism), **{name: value}))
            assert (fault is None) == (0 <= value <= most)


def test_bytes_of_another_length_are_refused():
    admissible, state = ratchet_state()
    assert "bytes" in admissible.fault(state[:-8])
    assert "bytes" in admissible.fault(b"")
