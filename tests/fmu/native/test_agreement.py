"""Both flavours of the FMU say the same: after every step, of every event, and in the log."""

import pytest

from tests.fmu.conformance.host import Instance
from tests.fmu.native.scenes import cycle, paper, steps


@pytest.fixture(scope="module", params=[paper, cycle], ids=lambda scene: scene.__name__)
def both(request, ratchet, native_ratchet):
    """Outputs of all steps, and the log, of pythonfmu's FMU and the native one."""
    found = []
    for fmu in (ratchet, native_ratchet):
        with Instance(fmu) as one:
            found.append((steps(request.param, one), one.log))
    return found


def test_all_outputs_of_all_steps_agree(both):
    (expected, _), (found, _) = both
    assert len(found) == len(expected)
    for k, (mine, other) in enumerate(zip(found, expected, strict=True)):
        assert mine == pytest.approx(other, rel=1e-12, abs=1e-12), k


def test_every_event_was_looked_at(both):
    """The buffer of a step's events held all of them, so that what agrees are all events."""
    for outputs, _ in both:
        assert sum(step["events_in_step"] for step in outputs) == outputs[-1]["event_count"] > 0
        assert outputs[-1]["impact_count"] > 0


def test_the_log_has_the_same_lines(both):
    (_, expected), (_, found) = both
    assert found == expected
    assert any(message.category == "logEvents" for message in found)
