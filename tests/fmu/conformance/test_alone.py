"""Calls that could crash the host: a crash of the other process is a failed test of this one."""

from pathlib import Path

import pytest

from tests.fmu.conformance import alone

SESSIONS = [
    pytest.param(session, id=session.__name__, marks=pytest.mark.slow if session is alone.random_calls else ())
    for session in (alone.odd_calls, alone.odd_names, alone.random_calls, alone.threads)
]


@pytest.mark.parametrize("session", SESSIONS)
def test_the_host_survives(subject, session):
    alone.run_alone(session, subject.fmu.folder)


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="needs /proc to see the memory of a process")
def test_saving_refusing_and_resetting_cost_no_memory(subject):
    # A leaked state would cost 3 kB and an instance 25 kB each time; the allocator's own unrest stays below 0.5 MB.
    most = 0.5e6 / 500
    printed = alone.run_alone(alone.memory, subject.fmu.folder, str(most))
    growth = {name: float(size) for name, size in (line.split() for line in printed.splitlines())}
    state = growth.pop("size")
    # The wrapper never gives back the bytes of a state that was refused, nor the text of a logged message.
    growth["refuse_state"] -= state
    assert max(growth.values()) < most, growth
