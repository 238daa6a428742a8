"""What the native flavour has beyond the other one: slopes of inputs, derivatives of outputs, memory from the host."""

import math

import pytest
from fmpy import calloc, free
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2CallbackAllocateMemoryTYPE, fmi2CallbackFreeMemoryTYPE

import models
from mechanism_fmu.simulation import Simulation
from tests.fmu.conformance.host import Instance

TORQUE = "drive_torque"


@pytest.fixture
def one(native_ratchet):
    with Instance(native_ratchet) as instance:
        yield instance


def torque(time):
    """Drive torque [N m] and its slope at the beginning of a step: a piecewise linear signal."""
    return 1e-3 + 5e-4 * math.sin(3 * time)


def step(one, size):
    begin, end = torque(one.time), torque(one.time + size)
    one.set({TORQUE: begin})
    one.slave.setRealInputDerivatives([one.reference(TORQUE)], [1], [(end - begin) / size])
    one.step(size)


def test_an_input_follows_its_slope_bit_for_bit_as_in_the_engine(one):
    model = models.load("ratchet").MODEL
    engine = Simulation(model.build(model.values()))
    one.begin()
    for k in range(40):
        begin, end = torque(one.time), torque(one.time + 0.05)
        step(one, 0.05)
        engine.set_input(TORQUE, begin)
        engine.set_slope(TORQUE, (end - begin) / 0.05)
        engine.advance(one.time)
        assert one["wheel_angle"] == engine.read()["wheel_angle"], k
    assert one["impact_count"] == 1
    assert one[TORQUE] == pytest.approx(torque(one.time), abs=1e-12)


def test_a_slope_set_in_initialization_mode_acts_in_the_first_step(native_ratchet):
    angles = []
    for early in (True, False):
        with Instance(native_ratchet) as one:
            one.slave.setupExperiment()
            one.slave.enterInitializationMode()
            slope = [one.reference(TORQUE)], [1], [1e-2]
            if early:
                one.slave.setRealInputDerivatives(*slope)
                one["wheel_angle"]  # assembles the mechanism on the way
            one.slave.exitInitializationMode()
            if not early:
                one.slave.setRealInputDerivatives(*slope)
            one.step(0.3)
            assert one[TORQUE] == pytest.approx(1e-3 + 3e-3, rel=1e-12)
            angles.append(one["wheel_angle"])
    assert angles[0] == angles[1]


def test_slopes_make_long_steps_as_good_as_many_short_ones(one, native_ratchet):
    one.begin()
    with Instance(native_ratchet) as fine:
        fine.begin()
        for _ in range(40):
            step(one, 0.02)
            for _ in range(200):
                fine.set({TORQUE: torque(fine.time + 5e-5)})
                fine.step(1e-4)
        assert one["crank_angle"] == pytest.approx(fine["crank_angle"], abs=2e-5)


@pytest.mark.parametrize(
    ("reference", "order", "slope"), [(0, 2, 1.0), (0, 0, 1.0), (10**6, 1, 1.0), (0, 1, math.nan), (0, 1, math.inf)]
)
def test_what_is_no_slope_of_an_input_is_refused(one, reference, order, slope):
    one.begin()
    with pytest.raises(FMICallException):
        one.slave.setRealInputDerivatives([reference], [order], [slope])
    one.step(0.1)


def test_a_slope_that_leads_beyond_the_limits_of_its_input_is_refused(one):
    one.begin()
    one.slave.setRealInputDerivatives([one.reference(TORQUE)], [1], [1e9])
    with pytest.raises(FMICallException):
        one.step(0.1)
    assert "The derivative of drive_torque leads to 1e+08 N.m" in one.refusal
    one.slave.setRealInputDerivatives([one.reference(TORQUE)], [1], [0.0])
    one.step(0.1)


def test_derivatives_of_outputs_are_those_of_the_motion(one):
    one.begin().run(0.5, 0.1)
    names = ["wheel_angle", "wheel_speed", "crank_speed", "work_done", "kinetic_energy"]
    references = [one.reference(name) for name in names]
    rates = dict(zip(names, one.slave.getRealOutputDerivatives(references, [1] * len(names)), strict=True))
    before = one.get(names)
    assert rates["wheel_angle"] == before["wheel_speed"]
    one.step(1e-4)
    for name, after in one.get(names).items():
        assert rates[name] == pytest.approx((after - before[name]) / 1e-4, rel=1e-3, abs=1e-9), name


def test_what_jumps_has_no_derivative(one):
    one.begin().step(0.1)
    for name in ("impact_time", "contact_force"):
        with pytest.raises(FMICallException):
            one.slave.getRealOutputDerivatives([one.reference(name)], [1])
        assert one.log[-1].category == "logStatusDiscard"
        assert f"{name} has no derivative" in one.log[-1].text


def test_all_memory_comes_from_the_host_and_goes_back_to_it(native_ratchet):
    held = set()

    def allocate(count, size):
        address = calloc(count, size)
        held.add(address)
        return address

    def release(address):
        held.discard(address)
        free(address)

    with Instance(native_ratchet) as pattern:
        callbacks = pattern._callbacks()
    callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(allocate)
    callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(release)
    with Instance(native_ratchet, callbacks=callbacks) as one:
        one.begin().step(0.1)
        state = one.save()
        other = one.slave.deSerializeFMUstate(one.slave.serializeFMUstate(state))
        assert len(held) == 3
        one.slave.freeFMUstate(state)
        one.slave.freeFMUstate(other)
        assert len(held) == 1
    assert not held
