"""Any legal sequence of calls ends where its own history leads, bit for bit."""

import struct
from itertools import pairwise

from hypothesis import settings, strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, precondition, rule, run_state_machine_as_test

from tests.fmu.conformance.host import Instance

#: Step sizes [s]: short, usual, over an impact, over many.
STEPS = (1e-6, 1e-3, 0.013, 0.05, 0.4)


def bits(one):
    values = one.outputs().values()
    return struct.pack(f"{len(values)}d", *map(float, values))


class Session(RuleBasedStateMachine):
    """One instance goes to and fro; a second one then takes the way that is left, without detours.

    `history` holds the start values and the calls since initialization that a replay must repeat.
    """

    def __init__(self, subject, one, other):
        super().__init__()
        self.subject, self.one, self.other = subject, one, other
        self.states = []

    @initialize(rough=st.booleans())
    def begin(self, rough):
        self.one.reset()
        self.history = [dict(self.subject.rough) if rough else {}]
        self.one.begin(self.history[0])

    @rule(which=st.integers(0, 9), share=st.sampled_from([0.0, 0.3, 1.0]))
    def set_input(self, which, share):
        name, (low, high) = list(self.subject.inputs.items())[which % len(self.subject.inputs)]
        value = {name: low + share * (high - low)}
        self.one.set(value)
        self.history.append(value)

    @rule(size=st.sampled_from(STEPS), read=st.booleans())
    def step(self, size, read):
        self.one.step(size)
        self.history.append(size)
        if read:
            self.one.outputs()

    @rule(serialize=st.booleans())
    def save(self, serialize):
        state = self.one.save_bytes() if serialize else self.one.save()
        self.states.append((state, self.one.time, list(self.history)))

    @precondition(lambda self: self.states)
    @rule(which=st.integers(0, 99))
    def restore(self, which):
        state, time, history = self.states[which % len(self.states)]
        (self.one.restore_bytes if isinstance(state, bytes) else self.one.restore)(state, time)
        self.history = list(history)

    @precondition(lambda self: len(self.history) > 8)
    @rule(rough=st.booleans())
    def start_again(self, rough):
        self.begin(rough)

    def teardown(self):
        if hasattr(self, "history"):
            self.other.reset().begin(self.history[0])
            for call in self.history[1:]:
                self.other.set(call) if isinstance(call, dict) else self.other.step(call)
            assert bits(self.one) == bits(self.other)
            assert self.one.save_bytes() == self.other.save_bytes()
        for state, _, _ in self.states:
            if not isinstance(state, bytes):
                self.one.slave.freeFMUstate(state)


def test_any_sequence_of_calls_ends_where_its_history_leads(subject):
    with Instance(subject.fmu) as one, Instance(subject.fmu, "other") as other:
        run_state_machine_as_test(
            lambda: Session(subject, one, other),
            settings=settings(max_examples=80, stateful_step_count=25, deadline=None),
        )


def test_steps_of_a_step_that_was_undone_leave_no_trace(subject, instance):
    """As a master does that tries long steps first and shortens them."""
    straight, trying = instance().begin(subject.rough), instance("trying").begin(subject.rough)
    times = [0.1 * k for k in range(round(10 * subject.until) + 1)]
    for now, then in pairwise(times):
        straight.slave.doStep(now, then - now)
        state = trying.save()
        trying.slave.doStep(now, 4 * (then - now))
        trying.outputs()
        trying.slave.setFMUstate(state)
        trying.slave.freeFMUstate(state)
        trying.slave.doStep(now, then - now)
        assert bits(trying) == bits(straight)
