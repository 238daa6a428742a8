"""The sources of outputs that tell events."""

from dataclasses import replace

import pytest

import models
from mechanism_fmu import codes
from mechanism_fmu.model import AngleStop, MechanismError
from mechanism_fmu.model.sources import resolve_output

MODEL = models.load("ratchet").MODEL
RATCHET = MODEL.build(MODEL.values())


def test_events_have_sources():
    assert resolve_output("event.count", RATCHET) == (codes.COUNTER, codes.COUNT_EVENTS, 0)
    assert resolve_output("event.in_step", RATCHET) == (codes.COUNTER, codes.EVENTS_IN_STEP, 0)
    assert resolve_output("events[1].time", RATCHET) == (codes.BUFFERED_EVENT, codes.EVENT_TIME, 0)
    assert resolve_output("events[16].new_mode", RATCHET) == (codes.BUFFERED_EVENT, codes.EVENT_NEW_MODE, 15)


@pytest.mark.parametrize(
    "source", ["event.time", "events[0].time", "events[1001].time", "events[1].tooth", "events.time"]
)
def test_there_are_no_others(source):
    with pytest.raises(MechanismError, match=r"event\.count\|in_step"):
        resolve_output(source, RATCHET)


def test_a_mode_must_fit_an_integer_of_fmi():
    stops = tuple(AngleStop(f"stop{k}", "wheel", "ground", 0.0) for k in range(32))
    with pytest.raises(MechanismError, match="a bit for each of 32 contacts"):
        resolve_output("events[1].old_mode", replace(RATCHET, contacts=stops))
