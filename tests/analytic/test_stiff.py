"""Stiff mechanisms against what is known of their motion: explicit steps are as short there as what is long gone."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.integrate import solve_ivp

import models
from benchmarks.world.cases.n_four_bar import n_four_bar
from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    Body,
    Damper,
    Input,
    Mechanism,
    MechanismError,
    NonlinearTorsionSpring,
    Output,
    Revolute,
    Settings,
    Torque,
)
from mechanism_fmu.model.functions import maximum
from mechanism_fmu.simulation import Simulation, SimulationError

INERTIA, TORQUE = 0.02, 3.0
MOTOR = Torque("motor", "rotor", torque=TORQUE)
AUTOMATIC, EXPLICIT, IMPLICIT = codes.AUTOMATIC, codes.EXPLICIT, codes.IMPLICIT_METHOD


def rotor(*forces, tolerance=1e-9, method=AUTOMATIC, speed=0.0, **more):
    """A rotor on a pin."""
    return Mechanism(
        bodies=(Body("rotor", 1.0, INERTIA, start_rate=(0.0, 0.0, speed)),),
        joints=(Revolute("pin", "rotor", (0.0, 0.0), GROUND, (0.0, 0.0)),),
        forces=forces,
        outputs=(Output("angle", "rotor.angle", "rad"), Output("speed", "rotor.speed", "rad/s")),
        settings=Settings(tolerance, integration_method=method),
        **more,
    )


def count(simulation):
    """Steps taken, and how many of them were implicit."""
    return SimpleNamespace(
        steps=simulation.counters.item(codes.COUNT_STEPS), implicit=simulation.counters.item(codes.COUNT_IMPLICIT)
    )


def advanced(mechanism, *times):
    simulation = Simulation(mechanism)
    for time in times:
        simulation.advance(time)
    return simulation


@settings(deadline=None, max_examples=60)
@given(
    st.floats(-3, 12).map(lambda power: 10.0**power),
    st.sampled_from([1e-5, 1e-7, 1e-9, 1e-11]),
    st.sampled_from([AUTOMATIC, IMPLICIT]),
)
def test_a_damped_rotor_runs_as_it_must_however_stiff(damping, tolerance, method):
    """I w' = T - c w: from c/I = 0.05/s to 5e13/s, in a hundred steps and some more."""
    simulation = advanced(
        rotor(
            MOTOR,
            Damper("oil", "rotor", damping=damping),
            tolerance=tolerance,
            method=method,
        ),
        0.013,
        0.2,
    )
    rate, at_last = damping / INERTIA, TORQUE / damping
    gone = -math.expm1(-rate * 0.2)
    angle = at_last * (0.2 - gone / rate) if rate > 1.0 else None
    read = simulation.read()
    within = 100 * tolerance * (1e-3 + at_last)
    assert read["speed"] == pytest.approx(at_last * gone, abs=within)
    if angle is not None:
        assert read["angle"] == pytest.approx(angle, abs=within)
    assert count(simulation).steps < 600


def test_work_is_what_is_lost_and_what_is_in_the_motion():
    outputs = tuple(Output(name, f"energy.{name}", "J") for name in ("work", "lost", "kinetic"))
    mechanism = rotor(MOTOR, Damper("oil", "rotor", damping=1e7), speed=50.0)
    simulation = advanced(replace(mechanism, outputs=outputs), 0.3)
    read = simulation.read()
    begun = 0.5 * INERTIA * 50.0**2
    assert read["lost"] == pytest.approx(begun + read["work"] - read["kinetic"], rel=1e-8)
    assert count(simulation).implicit > 0


@pytest.mark.parametrize("method", [AUTOMATIC, IMPLICIT])
def test_a_stiff_law_of_the_users_own(method):
    """A cubic damper from a high speed, against scipy's Radau; the Jacobian is of the law, too."""

    def law(_angle, rate):
        return 40.0 * rate**3 + 500.0 * rate

    mechanism = rotor(
        NonlinearTorsionSpring("oil", "rotor", law=law),
        MOTOR,
        method=method,
        speed=30.0,
    )
    simulation = advanced(mechanism, 0.5)
    known = solve_ivp(
        lambda _t, y: [y[1], (TORQUE - law(y[0], y[1])) / INERTIA],
        (0, 0.5),
        [0.0, 30.0],
        "Radau",
        rtol=1e-12,
        atol=1e-14,
    ).y[:, -1]
    read = simulation.read()
    assert [read["angle"], read["speed"]] == pytest.approx(known, abs=2e-10)
    assert count(simulation).steps < 400


def test_an_overdamped_spring_follows_what_moves_it():
    """k = 1e9, c = 1e6: a rotor on a shaft whose end is moved by hand at another speed each millisecond."""
    law = NonlinearTorsionSpring("wind", "rotor", law=lambda angle, rate: 1e6 * rate + 1e9 * (angle - 1e-3))
    simulation = advanced(rotor(law), *np.linspace(0.0, 0.05, 51)[1:])
    slow = -1e9 / 1e6  # the root of I s^2 + c s + k that is left after 1e-8 s
    assert simulation.read()["angle"] == pytest.approx(1e-3 * -math.expm1(slow * 0.05), abs=1e-11)
    assert count(simulation).steps < 600


def test_impacts_are_where_they_are_within_implicit_steps():
    """Pushed through oil onto a stop, it bounces once, and creeps back: all times are known."""
    damping = 2e4
    rate, at_last = damping / INERTIA, TORQUE / damping
    mechanism = rotor(
        replace(MOTOR, torque=-TORQUE),
        Damper("oil", "rotor", damping=damping),
        contacts=(AngleStop("stop", "rotor", GROUND, -1e-5, restitution=0.5),),
    )
    simulation = Simulation(mechanism)
    simulation.advance(0.2)
    impacts = simulation.impacts_in_step()
    meets = 1e-5 / at_last + 1 / rate  # the start costs 1/rate
    assert impacts[0].time == pytest.approx(meets, abs=1e-12)
    assert impacts[0].closing_speed == pytest.approx(at_last, rel=1e-9)
    assert count(simulation).implicit > 0
    assert simulation.read()["angle"] == pytest.approx(-1e-5, abs=1e-14)


def test_any_communication_step_gives_the_same_bits():
    mechanism = rotor(MOTOR, Damper("oil", "rotor", damping=1e5), speed=3.0)
    at_once = advanced(mechanism, 0.1).read_array()
    in_parts = advanced(mechanism, *np.linspace(0.0, 0.1, 38)[1:-1], 0.1).read_array()
    np.testing.assert_array_equal(at_once, in_parts)


def test_what_is_stiff_no_longer_is_stepped_explicitly_again():
    """Oil that ends at an angle of 0.01: before it, the rotor creeps; behind it, it swings on a soft spring."""

    def law(angle, rate):
        return maximum(1e5 * (0.01 - angle), 0.0) * rate * 100.0 + 2.0 * angle

    mechanism = rotor(NonlinearTorsionSpring("oil", "rotor", law=law), MOTOR)
    simulation = Simulation(mechanism)
    while simulation.read()["angle"] < 0.02:
        simulation.advance(simulation.time + 0.05)
    before = count(simulation)
    assert before.implicit > 0
    simulation.advance(simulation.time + 20.0)
    after = count(simulation)
    assert simulation.counters.item(codes.IMPLICIT) == 0
    assert after.implicit - before.implicit < 100 < after.steps - before.steps


def test_an_input_changes_inside_the_step_after_which_the_method_is_another():
    """The way back to that instant is a step of the method that was taken: an explicit one is off by 1e-3 there."""
    rotor_in_oil = rotor(Damper("oil", "rotor", "swing", damping=15.0), Torque("motor", "rotor"), tolerance=1e-6)
    swing = Body("swing", 1.0, 1.0, (0.0, -1.0, 0.0), start_rate=(2.0, 0.0, 2.0))
    idle = [Body(f"disc {k}", 1.0, 1.0) for k in range(14)]  # the more bodies, the longer are implicit steps that pay
    simulation = Simulation(
        replace(
            rotor_in_oil,
            bodies=(*rotor_in_oil.bodies, swing, *idle),
            joints=(*rotor_in_oil.joints, Revolute("hinge", "swing", (0.0, 1.0), GROUND, (0.0, 0.0))),
            gravity=(0.0, -400.0),
            inputs=(Input("torque", "motor.torque", TORQUE, "", "N.m"),),
        )
    )
    counters, clock = simulation.counters, simulation.field("clock")
    counters[codes.IMPLICIT] = 1  # it finds out by itself that explicit steps are enough
    while counters.item(codes.IMPLICIT) == 1:
        simulation.advance(simulation.time + 1e-4)
    simulation.advance(simulation.time + 0.95 * (clock.item(codes.STEP_END) - simulation.time))
    assert clock.item(codes.STEP_START) < simulation.time < clock.item(codes.STEP_END)
    assert counters.item(codes.IMPLICIT_STEP) == 1
    before = simulation.read()
    simulation.inputs[0] = TORQUE + 1e-9
    simulation.advance(simulation.time + 1e-9)
    assert simulation.read() == pytest.approx(before, rel=1e-6)


def test_an_implicit_step_that_is_refused_leaves_the_size_of_the_next_one():
    """On the way to a parallelogram that lies flat each step would be the last implicit one, and one is refused."""
    simulation = Simulation(n_four_bar(1, through=False))
    counters, clock = simulation.counters, simulation.field("clock")
    simulation.begin_step()
    refused = None
    while refused is None:
        counters[codes.IMPLICIT], counters[codes.STIFF] = 1, 1000
        next_step = clock.item(codes.NEXT_STEP)
        try:
            simulation.go_on(1.0, codes.STOP_AT_STEP)
        except SimulationError as error:
            refused = str(error)
    assert "A singular configuration lies ahead" in refused
    assert counters.item(codes.COUNT_IMPLICIT) > 3
    assert clock.item(codes.NEXT_STEP) == next_step


@pytest.mark.parametrize(("speed", "goes_on"), [(0.0, True), (1.0, False)])
def test_a_step_that_is_refused_leaves_the_method_as_it_was(speed, goes_on):
    """Late on the clock no step is as short as the 2e-11 s in which oil holds the rotor: an implicit one is tried.

    From rest it passes over what is gone at once; a speed that is gone at once is more than any step may pass over.
    """
    begin = 1e6
    simulation = Simulation(rotor(MOTOR, Damper("oil", "rotor", damping=1e9), speed=speed))
    simulation.begin(begin)
    simulation.field("clock")[codes.NEXT_STEP] = 1e-3
    simulation.begin_step()
    if goes_on:
        simulation.go_on(begin + 1.0, codes.STOP_AT_STEP)
    else:
        with pytest.raises(SimulationError, match="The step size has shrunk to nothing"):
            simulation.go_on(begin + 1.0, codes.STOP_AT_STEP)
    assert simulation.field("implicit_fresh").item() == 1  # by the Jacobian of an implicit step that was tried
    assert simulation.counters.item(codes.IMPLICIT) == goes_on


def test_explicit_alone_runs_out_of_steps_where_it_is_asked_for():
    mechanism = rotor(MOTOR, Damper("oil", "rotor", damping=1e6), method=EXPLICIT)
    with pytest.raises(SimulationError, match="stiff"):
        advanced(mechanism, 0.2)


def test_a_method_that_there_is_not():
    with pytest.raises(MechanismError, match=r"integration_method = 3 is outside 0 .* 1 \(explicit\), 2"):
        Simulation(rotor(method=3))


def test_a_full_matrix_is_for_so_many_bodies():
    bodies = tuple(Body(f"disc {k}", 1.0, 1.0) for k in range(116))
    with pytest.raises(MechanismError, match=r"is for 115 bodies at most, .* has 116: take 0 or 1"):
        Simulation(Mechanism(bodies=bodies, settings=Settings(integration_method=IMPLICIT)))
    advanced(Mechanism(bodies=bodies), 0.01)


def test_above_it_the_message_says_what_is_missing():
    """A rotor in thick oil, and 115 idle discs."""
    mechanism = rotor(MOTOR, Damper("oil", "rotor", damping=1e6))
    idle = tuple(Body(f"disc {k}", 1.0, 1.0) for k in range(115))
    simulation = Simulation(replace(mechanism, bodies=(*mechanism.bodies, *idle)))
    with pytest.raises(SimulationError, match="What is stiff takes short steps here: implicit ones are for 115 bodies"):
        simulation.advance(0.2)


#: Designs at the limits of what the models' parameters allow, that took seconds or did not come to an end.
STIFF = {
    "gear_train": {"pinion_damping": 1e6},
    "gear_train, shaft": {"drive_damping": 1e9},
    "rotary_table": {"drive_damping": 1e9, "table_inertia": 1e-12},
    "four_bar": {"crank_damping": 1e6, "crank_mass": 1e-12},
    "cam_drive": {"cam_inertia": 1e-9, "drive_damping": 1e6},
    "slider_crank": {"crank_damping": 1e6},
    "geneva": {"slot_friction": 0.59, "wheel_mass": 7e-6, "wheel_damping": 1e3},
    "ratchet_free": {"drive_damping": 1e9},
}


@pytest.mark.parametrize("name", STIFF)
def test_designs_at_the_limits_need_few_steps(name):
    model = models.load(name.partition(",")[0]).MODEL
    mechanism = model.build(model.values(**STIFF[name]))
    simulation = Simulation(mechanism)
    simulation.advance(0.05)
    assert count(simulation).steps < 2000


def test_a_linkage_in_oil_moves_as_explicit_steps_say():
    """Mildly stiff, so that both can: a four-bar with 1e5/s, at three tolerances."""
    model = models.load("four_bar").MODEL
    values = {"crank_damping": 300.0}

    def angles(tolerance, method):
        mechanism = model.build(model.values(**values, relative_tolerance=tolerance, integration_method=method))
        return advanced(mechanism, 0.02).read_array()

    known = angles(1e-12, EXPLICIT)
    for tolerance in (1e-6, 1e-8, 1e-10):
        off = np.abs(angles(tolerance, IMPLICIT) - known) / (1e-3 + np.abs(known))
        assert off.max() < 1e3 * tolerance


@pytest.mark.parametrize("tolerance", [1e-7, 1e-9])
def test_what_holds_a_linkage_hard_is_not_moved_by_what_mends_it(tolerance):
    """A crank that oil turns at 2 pi rad/s: its rates were once mended by the masses, and swung with each step."""
    model = models.load("slider_crank").MODEL
    changed = {"drive_damping": 1e9, "slider_mass": 0.006, "crank_inertia": 0.0025, "crank_speed_start": -1.07}
    simulation = advanced(model.build(model.values(relative_tolerance=tolerance, **changed)), 0.05)
    read = simulation.read()
    assert read["crank_speed"] == pytest.approx(2 * math.pi, rel=tolerance)
    assert read["crank_angle"] == pytest.approx(0.1 * math.pi, abs=0.1 * tolerance)
    assert count(simulation).steps < 500


def test_a_large_force_that_a_large_damper_holds():
    """A cam in oil under an enormous preload creeps by T f'(angle) / c: what is off the cam decides on no step."""
    model = models.load("cam_drive").MODEL
    changed = {"dwell_angle": 0.5, "drive_damping": 1e6, "spring_preload": 1e6}

    def run(tolerance):
        return advanced(model.build(model.values(relative_tolerance=tolerance, **changed)), 0.05)

    once, exact = run(1e-8), run(1e-11)
    assert count(once).steps < 2500 < count(exact).steps
    read, known = once.read(), exact.read()
    assert read["cam_angle"] == pytest.approx(known["cam_angle"], abs=1e-10)
    assert read["follower_angle"] == pytest.approx(known["follower_angle"], abs=1e-8)
    passed_on = 1e6 * 0.025  # the preload times the follower's way [J]
    for energy in ("work_done", "energy_lost", "kinetic_energy", "spring_energy"):
        assert read[energy] == pytest.approx(known[energy], abs=1e-9 * passed_on)
    slope = known["follower_speed"] / known["cam_speed"]
    assert 1e6 * (2 * math.pi - known["cam_speed"]) == pytest.approx(1e6 * slope, rel=1e-6)
