import math
from dataclasses import replace

import pytest
from hypothesis import assume, given, strategies as st
from pendulum import MODEL as DESCRIBED

from mechanism_fmu.fmu.instance.protocol import Experiment, FmiError, Phase, experiment, require, step_target
from mechanism_fmu.fmu.instance.saved_state import SavedStateError
from mechanism_fmu.fmu.instance.slave import make_slave_class
from mechanism_fmu.model import MechanismError, Parameter, Torque


def runnable(values):
    """The pendulum with a torque of its own for each input."""
    described = DESCRIBED.mechanism(values)
    bias, torque = described.inputs
    forces = (*described.forces, Torque("second", "arm"))
    return replace(described, forces=forces, inputs=(replace(bias, target="second.torque"), torque))


TOLERANCE = Parameter("relative_tolerance", 1e-8, "Of the integration", minimum=1e-13, maximum=1e-3)
MODEL = replace(DESCRIBED, mechanism=runnable, parameters=(*DESCRIBED.parameters, TOLERANCE))
Pendulum = make_slave_class(MODEL)
REFERENCES = {variable.name: variable.value_reference for variable in Pendulum.variables}


@pytest.fixture
def slave():
    return Pendulum(instance_name="one")


@pytest.fixture
def running(slave):
    slave.setup_experiment(0.0, None, None)
    slave.enter_initialization_mode()
    slave.exit_initialization_mode()
    return slave


def get(slave, name):
    return slave.get_real([REFERENCES[name]])[0]


def test_the_class_is_named_after_the_model_and_made_once():
    assert Pendulum.__name__ == "Pendulum"
    assert Pendulum.__doc__ == MODEL.description
    assert make_slave_class(MODEL) is Pendulum


def test_a_new_slave_has_the_start_values(slave):
    assert [get(slave, name) for name in ("bias", "torque", "length")] == [0.0, 0.25, 1.5]
    assert slave.get_integer([REFERENCES["teeth"]]) == [3]
    assert slave.get_boolean([REFERENCES["guided"]]) == [True]
    assert slave.get_string([]) == []


def test_calculated_parameters_follow_the_parameters(slave):
    slave.set_real([REFERENCES["length"]], [2.0])
    assert get(slave, "inertia") == pytest.approx(0.3 * 4 / 3, rel=1e-15)


def test_a_step_moves_the_arm_by_the_laws_of_a_free_arm(running):
    assert running.do_step(0.0, 0.1) is True
    acceleration = 0.25 / (0.3 * 1.5**2 / 3)
    assert get(running, "angle") == pytest.approx(acceleration * 0.1**2 / 2, rel=1e-7)


def test_outputs_before_the_step_are_not_those_after_it(running):
    before = get(running, "angle")
    running.do_step(0.0, 0.1)
    assert get(running, "angle") > before


def test_the_hosts_tolerance_needs_no_parameter_of_the_model():
    angles = []
    for tolerance in (None, 1e-12):
        slave = make_slave_class(replace(DESCRIBED, mechanism=runnable))(instance_name="one")
        slave.setup_experiment(0.0, None, tolerance)
        slave.enter_initialization_mode()
        slave.exit_initialization_mode()
        slave.do_step(0.0, 0.5)
        angles.append(get(slave, "angle"))
    assert angles[0] == pytest.approx(angles[1], rel=1e-6)


def test_a_refused_call_is_logged_as_an_error_with_the_instances_name(slave):
    with pytest.raises(FmiError):
        slave.do_step(0.0, 0.1)
    (message,) = slave.log_queue
    assert (int(message.status), message.category) == (3, "logStatusError")
    assert message.msg.startswith("one: fmi2DoStep is not allowed now: the instance is in state instantiated")


def test_a_mistake_of_ours_is_logged_with_its_type_and_place(running, monkeypatch):
    monkeypatch.setattr(running._simulation, "advance", lambda target: 1 // 0)
    with pytest.raises(ZeroDivisionError):
        running.do_step(0.0, 0.1)
    text = running.log_queue[-1].msg
    assert "internal error ZeroDivisionError" in text
    assert f"{__file__}:" in text
    assert "please report it" in text


def test_percent_signs_are_doubled_in_the_log():
    slave = Pendulum(instance_name="50 %s")
    with pytest.raises(FmiError):
        slave.terminate()
    assert slave.log_queue[0].msg.startswith("50 %%s: ")


def test_a_list_with_one_bad_value_sets_nothing(slave):
    with pytest.raises(MechanismError, match=r"torque = 2 N.m is above its limit; give at most 1 N.m"):
        slave.set_real([REFERENCES["bias"], REFERENCES["torque"]], [0.5, 2.0])
    assert get(slave, "bias") == 0.0
    slave.set_real([REFERENCES["torque"]], [0.0])
    assert get(slave, "bias") == 0.0


@pytest.mark.parametrize("name", ["angle", "inertia"])
def test_what_is_calculated_cannot_be_set(slave, name):
    with pytest.raises(FmiError, match=f"{name} is of causality .* and cannot be set"):
        slave.set_real([REFERENCES[name]], [1.0])


def test_a_state_returns_to_another_slave(running):
    running.set_real([REFERENCES["torque"]], [0.75])
    running.do_step(0.0, 0.1)
    state = running._fmu_state_to_bytes(running._get_fmu_state())
    running.do_step(0.1, 0.1)
    other = Pendulum(instance_name="two")
    other._set_fmu_state(other._fmu_state_from_bytes(state))
    other.do_step(0.1, 0.1)
    assert get(other, "angle") == get(running, "angle")
    assert get(other, "torque") == 0.75


def test_a_refused_state_leaves_the_slave_as_it_was(running):
    running.do_step(0.0, 0.1)
    before = running._get_fmu_state()
    with pytest.raises(SavedStateError):
        running._set_fmu_state(before[:-1])
    assert running._get_fmu_state() == before


@pytest.mark.parametrize("phase", Phase)
def test_a_call_is_allowed_in_its_phases_only(phase):
    allowed = (Phase.INITIALIZATION, Phase.STEPPING)
    if phase in allowed:
        require(phase, allowed, "fmi2X")
    else:
        with pytest.raises(FmiError, match=f"fmi2X .* state {phase.name.lower()}, not initialization or stepping"):
            require(phase, allowed, "fmi2X")


def test_initialization_needs_an_experiment(slave):
    with pytest.raises(FmiError, match="before fmi2SetupExperiment"):
        slave.enter_initialization_mode()


@pytest.mark.parametrize(
    "arguments",
    [
        *[(bad, None, None) for bad in (math.nan, math.inf, -math.inf, 1e300)],
        *[(1.0, bad, None) for bad in (math.nan, math.inf, 0.5)],
        *[(0.0, None, bad) for bad in (math.nan, math.inf, 0.0, -1e-6)],
    ],
)
def test_an_impossible_experiment_is_refused(arguments):
    with pytest.raises(FmiError, match=r"fmi2SetupExperiment: the .* must be"):
        experiment(*arguments)


def test_what_the_host_leaves_open_has_no_limit():
    assert experiment(2.0, None, None) == Experiment(2.0, math.inf, math.inf)
    assert experiment(2.0, 3.0, 1e-6) == Experiment(2.0, 3.0, 1e-6)


@given(st.floats(-1e6, 1e6), st.floats(1e-6, 1e6))
def test_a_step_leads_from_where_the_last_one_ended(reached, size):
    assert step_target(reached, reached, size, math.inf) == reached + size > reached


@given(st.floats(-1e6, 1e6), st.floats(1e-3, 1e3), st.sampled_from([-1, 1]))
def test_a_gap_or_an_overlap_is_refused(reached, gap, way):
    with pytest.raises(FmiError, match="is not the time reached"):
        step_target(reached, reached + way * gap, 1.0, math.inf)


@given(st.floats(-1e6, 1e6), st.floats(1e-9, 1.0), st.floats(1e-6, 1e3))
def test_a_step_past_the_stop_time_is_refused(reached, size, beyond):
    stop_time = reached + size
    assume(beyond > 2e-9 * max(1.0, abs(stop_time)))
    with pytest.raises(FmiError, match="leads past the stop time"):
        step_target(reached, reached, size + beyond, stop_time)


@pytest.mark.parametrize("size", [0.0, -0.0, -1.0, -1e-300, -5e-324])
def test_a_step_that_does_not_lead_forward_is_refused(size):
    with pytest.raises(FmiError, match="must be positive"):
        step_target(1.0, 1.0, size, math.inf)


@pytest.mark.parametrize("numbers", [(math.nan, 1.0), (math.inf, 1.0), (1.0, math.nan), (1.0, math.inf)])
def test_time_and_size_must_be_finite(numbers):
    with pytest.raises(FmiError, match="is not a finite number"):
        step_target(1.0, *numbers, math.inf)


def test_a_step_lost_in_rounding_is_refused():
    with pytest.raises(FmiError, match="lost in rounding"):
        step_target(1e9, 1e9, 1e-9, math.inf)


def test_rounding_of_the_hosts_clock_is_forgiven():
    """A host may multiply where the slave has added, up to and including the stop time."""
    reached = 0.0
    for k in range(1000):
        reached = step_target(reached, 0.1 * k, 0.1, 100.0)
    assert reached == pytest.approx(100.0, rel=1e-12)
