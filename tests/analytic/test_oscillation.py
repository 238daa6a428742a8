"""`Oscillation`: period, amplitude, rate and power against closed forms; the motion does not feel it."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings, strategies as st
from scipy.special import ellipk

from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    CompliantShaft,
    Damper,
    Input,
    Mechanism,
    MechanismError,
    Oscillation,
    Output,
    Revolute,
    Torque,
    TorsionSpring,
    rigid_body,
)
from mechanism_fmu.simulation import Simulation, simulate

PERIOD = 1.0
READ = ("beat.period", "beat.amplitude", "beat.rate", "beat.power", "beat.passages", "beat.last_passage")


def balance(start=0.3, middle=0.0, damping=0.0, **parts):
    """A balance of 1 kg m2 on a spring that alone gives it a period of 1 s."""
    wheel = rigid_body("wheel", mass=1.0, inertia=1.0, angle=start)
    spring = TorsionSpring("spring", wheel, stiffness=(2 * math.pi / PERIOD) ** 2, free_angle=middle)
    forces = (spring, Damper("air", wheel, damping=damping), *parts.pop("forces", ()))
    beat = Oscillation("beat", wheel, middle=middle, nominal_period=PERIOD)
    joints = (Revolute("staff", wheel.at(0, 0), GROUND),)
    return Mechanism((wheel,), joints, forces, oscillations=(beat,), **parts)


def read_by_source(mechanism):
    """The mechanism with outputs that have the names of their sources."""
    return replace(mechanism, outputs=tuple(Output(source, source, "", "1") for source in READ))


def last(mechanism, time, step):
    result = simulate(mechanism, time, READ, step=step)
    return dict(zip(("period", "amplitude", "rate", "power", "passages", "last"), result.numbers[-1, 1:], strict=True))


@settings(max_examples=20, deadline=None)
@given(st.floats(0.01, 3.0), st.floats(-2.0, 2.0))
def test_a_harmonic_oscillation_has_its_period_amplitude_and_rate(reach, middle):
    found = last(balance(middle + reach, middle), 5.0, 5.0)
    assert found["period"] == pytest.approx(PERIOD, abs=1e-9)
    assert found["amplitude"] == pytest.approx(reach, abs=1e-7)
    assert found["rate"] == pytest.approx(0.0, abs=1e-4)
    assert found["power"] == 0.0
    assert (found["passages"], found["last"]) == (5.0, pytest.approx(4.75, abs=1e-8))


def test_a_slow_clock_loses():
    mechanism = balance()
    beat = replace(mechanism.oscillations[0], nominal_period=0.999)
    found = last(replace(mechanism, oscillations=(beat,)), 3.0, 3.0)
    assert found["rate"] == pytest.approx(-86.4, abs=1e-3)


def test_a_pendulum_has_the_period_of_its_amplitude():
    """T = 4 sqrt(l / g) K(sin(a / 2)): elliptic integral of the first kind."""
    amplitude, length, g = 1.5, 0.3, 9.81
    rod = rigid_body("rod", mass=1.0, inertia=1e-9, centre=(0.0, -length), angle=amplitude)
    joints = (Revolute("pivot", rod.at(0, 0), GROUND),)
    beat = Oscillation("beat", rod)
    found = last(Mechanism((rod,), joints, gravity=(0.0, -g), oscillations=(beat,)), 5.0, 0.5)
    period = 4 * math.sqrt(length / g) * ellipk(math.sin(amplitude / 2) ** 2)
    assert found["period"] == pytest.approx(period, rel=1e-7)
    assert found["amplitude"] == pytest.approx(amplitude, abs=1e-7)


def test_amplitudes_fall_by_the_logarithmic_decrement():
    """Extremes follow each other by exp(-d pi / sqrt(1 - d^2)), d the damping ratio."""
    ratio = 0.05
    mechanism = balance(1.0, damping=2 * ratio * 2 * math.pi)
    result = simulate(mechanism, 5.0, ("beat.amplitude", "beat.period"), step=0.01)
    decrement = math.exp(-ratio * math.pi / math.sqrt(1 - ratio**2))
    # the half swings that end at the first passages start at 1 and go to -decrement, decrement^2 ...
    seen = [x for x, y in zip(result["beat_amplitude"], [0.0, *result["beat_amplitude"]], strict=False) if x != y]
    expected = [0.5 * (decrement**k + decrement ** (k + 1)) for k in range(len(seen))]
    assert seen == pytest.approx(expected, abs=1e-7)
    assert result["beat_period"][-1] == pytest.approx(PERIOD / math.sqrt(1 - ratio**2), rel=1e-9)


def test_in_a_steady_state_the_power_is_what_the_damper_takes():
    shaft_stiffness, damping, amplitude = 1.0, 0.4, 0.2
    mechanism = balance(0.0, damping=damping, forces=(CompliantShaft("drive", "wheel", stiffness=shaft_stiffness),))
    mechanism = replace(mechanism, inputs=(Input("angle", "drive.angle", 0.0, "Driven end", "rad"),))
    omega = math.sqrt((2 * math.pi) ** 2 + shaft_stiffness)  # of wheel and shaft
    simulation = Simulation(read_by_source(mechanism))
    count, step = 40 * 200, 2 * math.pi / omega / 200
    for k in range(count):
        simulation.inputs[0] = amplitude * math.sin(omega * (k + 0.5) * step)
        simulation.advance((k + 1) * step)
    values = simulation.read()
    swing = amplitude * shaft_stiffness / (damping * omega)
    assert values["beat.period"] == pytest.approx(2 * math.pi / omega, rel=2e-4)
    assert values["beat.amplitude"] == pytest.approx(swing, rel=2e-3)
    assert values["beat.power"] == pytest.approx(0.5 * damping * (swing * omega) ** 2, rel=4e-3)


@pytest.mark.parametrize("step", [0.7, 0.01])
def test_readings_do_not_depend_on_communication_steps(step):
    mechanism = balance(0.4, 0.1, damping=0.3)
    whole, fine = (last(mechanism, 4.2, size) for size in (4.2, step))
    assert fine == whole


def test_inputs_that_change_all_the_time_leave_no_passage_out():
    """Each change drops what the engine has computed ahead; what was passed before counts once."""
    mechanism = balance(0.3, forces=(Torque("hand", "wheel"),))
    mechanism = replace(mechanism, inputs=(Input("hand", "hand.torque", 0.0, "Of the hand", "N.m"),))
    simulation = Simulation(read_by_source(mechanism))
    for k in range(1000):
        simulation.inputs[0] = 1e-9 * (k % 2)
        simulation.advance((k + 1) * 0.005)
    values = simulation.read()
    assert values["beat.passages"] == 5.0
    assert values["beat.period"] == pytest.approx(PERIOD, abs=1e-7)
    assert values["beat.amplitude"] == pytest.approx(0.3, abs=1e-7)


def test_the_motion_is_the_same_to_the_bit():
    with_it = balance(0.3, 0.1, damping=0.2)
    without = replace(with_it, oscillations=())
    found = [simulate(m, 3.3, ("wheel.angle", "wheel.speed"), step=0.1).numbers.tobytes() for m in (with_it, without)]
    assert found[0] == found[1]


def test_a_body_that_an_impact_turns_round_has_turned_there():
    """A stop at -0.2 rad with restitution 1 cuts the time that the swing to -0.3 rad would be beyond it."""
    mechanism = balance(0.3)
    stop = AngleStop("stop", mechanism.bodies[0], GROUND, angle=-0.2, restitution=1.0)
    found = last(replace(mechanism, contacts=(stop,)), 5.0, 0.3)
    assert found["amplitude"] == pytest.approx(0.25, abs=1e-7)
    assert found["period"] == pytest.approx(PERIOD * (1 - math.acos(0.2 / 0.3) / math.pi), abs=1e-8)


def test_a_restored_state_brings_its_readings():
    mechanism = balance(0.3, 0.1, damping=0.2)
    simulation = Simulation(read_by_source(mechanism))
    simulation.advance(1.9)
    saved = simulation.state.copy()
    simulation.advance(4.0)
    first = simulation.read()
    simulation.state[:] = saved
    simulation.advance(4.0)
    assert simulation.read() == first


def test_a_nominal_period_of_zero_is_refused():
    mechanism = balance()
    beat = replace(mechanism.oscillations[0], nominal_period=0.0)
    with pytest.raises(MechanismError, match="nominal_period = 0 s, but it must be positive"):
        simulate(replace(mechanism, oscillations=(beat,)), 1.0)
