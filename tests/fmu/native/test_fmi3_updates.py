"""FMI 3.0: intermediate updates, and derivatives of outputs."""

import math

import pytest
from fmpy.fmi1 import FMICallException

from tests.fmu.native.scenes3 import impact_at


def test_the_host_is_told_of_each_internal_step(instance3):
    seen = []

    def look(update):
        seen.append((update, one["time"], one["wheel_angle"], one["kinetic_energy"]))

    one = instance3(on_update=look, intermediate=["wheel_angle", "kinetic_energy"]).begin()
    one.run(1.0, 2)
    times = [time for _, time, *_ in seen]

    assert len(seen) > 4
    assert times == sorted(times) == [update.time for update, *_ in seen]
    assert all(update[1:] == (False, True, True, False) for update, *_ in seen)
    assert seen[-1][1:] == (1.0, one["wheel_angle"], one["kinetic_energy"])


def test_an_impact_ends_a_step_of_a_host_that_looks_on(instance3):
    times = []
    one = instance3(event_mode=True, early_return=True, on_update=lambda u: times.append(u.time)).begin()
    step = one.step(1.0)

    assert (step.event, step.early, step.reached) == (True, True, impact_at(instance3))
    assert times[-1] == step.reached


def test_the_host_can_have_it_back_at_once_or_at_a_later_time(instance3):
    wanted = []
    one = instance3(early_return=True, on_update=lambda update: wanted[0](update)).begin()

    wanted[:] = [lambda update: update.time]
    first = one.step(0.5)
    assert first.early
    assert 0 < first.reached < 0.5
    assert not first.event
    wanted[:] = [lambda update: -math.inf]
    assert first.reached < one.step_to(0.5).reached < 0.5
    wanted[:] = [lambda update: 0.6]
    assert one.step_to(0.7) == (False, False, True, 0.6)
    wanted[:] = [lambda update: 0.7]
    assert one.step_to(0.7) == (False, False, False, 0.7)
    assert one["time"] == 0.7


def test_a_host_that_cannot_have_it_back_is_not_asked(instance3):
    asked = []
    one = instance3(on_update=lambda update: asked.append(update.can_return_early) or update.time).begin()

    assert one.step(0.5) == (False, False, False, 0.5)
    assert set(asked) == {False}


def test_at_an_intermediate_update_nothing_but_reading_is_allowed(instance3):
    said = []

    def meddle(_update):
        if said:
            return
        slave = one.slave
        for call in (
            lambda: one.set({"drive_torque": 1.0}),
            lambda: slave.doStep(one.time, 0.1),
            slave.getFMUState,
            slave.reset,
            slave.terminate,
            slave.enterEventMode,
            slave.enterStepMode,
        ):
            said.append(one.refusal(call))
        slave.fmi3FreeInstance(slave.component)
        said.append(one.log[-1].text)
        assert one["time"] > 0

    one = instance3(event_mode=True, on_update=meddle).begin()
    reference = instance3().begin()
    one.step(0.5)
    reference.step(0.5)

    assert len(said) == 8
    assert all("intermediate update" in text for text in said)
    assert one.outputs() == reference.outputs()


def test_derivatives_of_outputs(instance3):
    rates = []

    def derivatives(names):
        return one.slave.getOutputDerivatives([one.reference(name) for name in names], [1] * len(names))

    one = instance3(on_update=lambda _: rates.append(derivatives(["wheel_angle"])[0] - one["wheel_speed"])).begin()
    one.step(0.5)

    assert rates == [0.0] * len(rates)
    assert derivatives(["wheel_angle", "crank_angle"]) == [one["wheel_speed"], one["crank_speed"]]
    for name in ("time", "drive_torque"):
        assert name in one.refusal(derivatives, [name])
    with pytest.raises(FMICallException):
        derivatives(["impact_time"])
    assert one.log[-1].category == "logStatusDiscard"
    assert "impact_time has no derivative" in one.log[-1].text
    assert "order 2" in one.refusal(one.slave.getOutputDerivatives, [one.reference("wheel_angle")], [2])
