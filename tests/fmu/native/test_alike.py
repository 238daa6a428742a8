"""Differences between the flavours that were found once, and must not come back."""

import math
import re

import pytest
from fmpy.fmi1 import FMICallException

from tests.fmu.conformance.host import Instance


@pytest.fixture(params=["ratchet", "native_ratchet"])
def one(request):
    with Instance(request.getfixturevalue(request.param)) as instance:
        yield instance


def test_a_contact_that_pulls_from_the_start_is_a_warning(one):
    one.begin({"drive_torque": -1e-3})
    (warning,) = [message for message in one.log if message.category == "logStatusWarning"]
    assert "From t = 0 s the guided contact slope pulls" in warning.text


@pytest.mark.parametrize("true", [1, -1, 2, 256])
def test_every_boolean_that_is_not_zero_is_true(one, true):
    one.slave.setBoolean([one.reference("guided")], [true])
    one.begin().step(0.1)
    assert one["guided"] == 1
    assert one["wheel_angle"] == pytest.approx(1.3089891787, abs=1e-9)


def test_switching_categories_on_chooses_among_them(one):
    one.slave.setDebugLogging(True, ["logEvents"])
    one.begin({"drive_torque": -1e-3})
    with pytest.raises(FMICallException):
        one.step(math.nan)
    assert one.log == []


def test_the_words_about_the_stop_time_are_the_same(one):
    one.begin(stop_time=1.0)
    with pytest.raises(FMICallException):
        one.step(2.0)
    assert "leads past the stop time 1 s that the host has given" in one.refusal


@pytest.mark.parametrize("stop_time", [-1.0, math.inf, math.nan])
def test_the_words_about_a_wrong_stop_time_are_the_same(one, stop_time):
    with pytest.raises(FMICallException):
        one.slave.setupExperiment(stopTime=stop_time)
    assert f"the stop time {stop_time:g} s must be finite and not before the start time 0 s" in one.refusal


@pytest.mark.parametrize("flavour", ["slider_crank", "native_slider_crank"])
def test_friction_of_joints_that_jams_names_them(flavour, request):
    """There are no contacts to be named."""
    with Instance(request.getfixturevalue(flavour)) as one:
        one.begin({"joint_friction_radius": 0.15, "slider_friction": 0.0})
        with pytest.raises(FMICallException):
            one.step(0.1)
        assert "No finite forces agree with friction from here on (Painleve's paradox" in one.refusal
        number = r"[-\d.e+]+"
        first = rf" Friction: crank_hinge \(0\.15, at {number} rad, slips, A/G = {number}\)"
        named = rf"{first}, crank_pin .*, slider_pin .*\.$"
        assert re.search(named, one.refusal.rstrip())
        assert "Contacts:" not in one.refusal
