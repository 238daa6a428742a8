"""A communication step without progress is discarded, in each flavour as far as its standard and wrapper allow."""

import re
import time

import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Discard, fmi2LastSuccessfulTime
from fmpy.fmi3 import fmi3Discard

from tests.fmu.conformance.host import Instance

#: A shaft of 1e9 N.m/rad on a crank of 1e-4 kg.m2 swings with 3 million rad/s.
STIFF = {"drive_stiffness": 1e9, "max_internal_steps": 1000}
#: A Geneva that used to take 8 s of processor time for one such step.
SLOW = {
    "driver_inertia": 0.000640946952189436,
    "wheel_mass": 6.907125425022427e-09,
    "driver_angle_start": 5.841561069329191,
    "wheel_damping": 0.0004474337431388701,
    "drive_damping": 21.827352011402528,
    "slot_friction": 0.5899216755947558,
    "backstop": True,
    "backstop_restitution": 0.6278410912080662,
}


def said(one):
    return [message for message in one.log if message.category == "logStatusDiscard"][-1]


def assert_says_what_limits(message, at):
    assert message.status == 2
    assert f"t = {at:.9g} s: No progress: " in message.text
    assert "Internal steps: 100, the last of " in message.text
    assert re.search(r"limited by the (speed|position) of crank \(", message.text)
    assert "shaft" in message.text


def discarded(call, *arguments):
    with pytest.raises(FMICallException) as caught:
        call(*arguments)
    return caught.value.status


def test_fmi2_says_how_far_it_came_and_goes_on_from_there(native_ratchet):
    with Instance(native_ratchet) as one:
        one.begin(STIFF)
        assert discarded(one.step, 0.1) == fmi2Discard
        reached = one.slave.getRealStatus(fmi2LastSuccessfulTime)
        assert 0 < reached < 1e-3
        assert_says_what_limits(said(one), reached)
        one.time = reached
        one.step(reached)
        assert one.slave.getRealStatus(fmi2LastSuccessfulTime) == 2 * reached


def test_fmi3_returns_early_where_that_is_allowed(instance3):
    one = instance3(early_return=True).begin(STIFF)
    step = one.step(0.1)
    assert step.early
    assert 0 < step.reached < 1e-3
    assert_says_what_limits(said(one), step.reached)


def test_fmi3_discards_where_early_return_is_not_allowed(instance3):
    one = instance3().begin(STIFF)
    assert discarded(one.step, 0.1) == fmi3Discard
    assert_says_what_limits(said(one), one["time"])
    one.time = one["time"]
    assert not one.step(one.time).early


def test_the_wrapper_of_pythonfmu_discards_too(ratchet):
    with Instance(ratchet) as one:
        one.begin(STIFF)
        assert discarded(one.step, 0.1) == fmi2Discard
        assert "No progress" in said(one).text
        one.reset().begin()
        one.step(0.1)


def test_the_slow_geneva_comes_to_rest_on_its_backstop(native_geneva):
    """Hops below the noise of its gap used to take 8 s of processor time, then were given up after one."""
    with Instance(native_geneva) as one:
        one.begin(SLOW)
        one.set({"drive_speed": -12.0})
        begun = time.process_time()
        one.step(0.05)
        assert time.process_time() - begun < 1
        assert one["driver_speed"] == pytest.approx(0.0, abs=1e-9)


def test_the_budget_is_adjustable(native_ratchet):
    with Instance(native_ratchet) as one:
        one.begin({**STIFF, "max_internal_steps": 10})
        assert discarded(one.step, 0.1) == fmi2Discard
        first = one.slave.getRealStatus(fmi2LastSuccessfulTime)
        one.reset().begin({**STIFF, "max_internal_steps": 20_000})
        assert discarded(one.step, 0.1) == fmi2Discard
        assert one.slave.getRealStatus(fmi2LastSuccessfulTime) > 20 * first
        assert discarded(one.set, {"max_internal_steps": 50}) == 3  # fixed from initialization on
