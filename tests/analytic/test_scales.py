"""A mechanism knows no metre, kilogram or second: what is small moves as what is large does.

More scales, models and draws: python -m tests.analytic.run_scales.
"""

import math

import numpy as np
import pytest
from run_scales import MODELS, deviations, exact_scales, of_draw, of_model
from scaled import Scales

from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    Brake,
    Input,
    Mechanism,
    PointForce,
    PointLineContact,
    Revolute,
    Torque,
    bar,
    rigid_body,
)
from mechanism_fmu.simulation import simulate

#: What a column may be off, as a part of its largest value, where only readings of elastic members are solved anew.
ROUNDING = 1e-12


def of_the_same_bits(case, scales):
    """Deviations of a mechanism in scales that round nothing."""
    return [(one, off, where) for one, off, where in deviations(*case, scales) if off != 0.0]


@pytest.mark.parametrize("name", [name for name in MODELS if name != "four_bar_path_generator"])
def test_models_have_the_same_bits_in_scales_that_round_nothing(name):
    assert of_the_same_bits(of_model(name, 0.01), exact_scales((-10, 3))) == []


def test_readings_of_members_are_the_same_but_for_rounding():
    """Moments of 1e-15 N m at hinges are what the solution of the structure's equations leaves."""
    case = of_model("four_bar_path_generator", 0.01)
    for _, off, where in deviations(*case, exact_scales((-10, 3))):
        assert off <= ROUNDING or where.endswith("_moment")


@pytest.mark.parametrize("seed", range(15))
def test_random_mechanisms_have_the_same_bits(seed):
    assert of_the_same_bits(of_draw(seed), exact_scales((-10, 5))) == []


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("scales", [(1e-12, 1.0), (1e12, 1.0), (1e-9, 1e-6), (1e9, 1e4)])
def test_random_mechanisms_move_alike_in_any_scales(seed, scales):
    mass, length = scales
    given = Scales(mass, length, math.sqrt(length))
    ((_, off, where),) = deviations(*of_draw(seed), iter([given]))
    assert off <= 1e-6, where


def lift(mass, net):
    """How high a pull of its weight and `net` [N] lifts a grain in the time that takes it to 1 mm."""
    grain = rigid_body("grain", (0, 0), mass=mass, inertia=mass * 1e-8)
    pull = PointForce("pull", grain.at(0, 0), force=(0.0, mass * 9.81 + net))
    floor = PointLineContact("floor", grain.at(0, 0), GROUND.line((0, 0), (1, 0)), closed=True)
    end = math.sqrt(2e-3 * mass / net)
    mechanism = Mechanism((grain,), contacts=(floor,), forces=(pull,), gravity=(0, -9.81))
    return simulate(mechanism, until=end, step=end / 10)["grain_y"][-1]


def pushed(mass, beyond):
    """How far a push `beyond` what friction holds [N] moves a grain in the time that takes it to 1 mm."""
    grain = rigid_body("grain", (0, 0), mass=mass, inertia=mass * 1e-8)
    push = PointForce("push", grain.at(0, 0), force=(0.3 * mass * 9.81 + beyond, 0.0))
    floor = PointLineContact("floor", grain.at(0, 0), GROUND.line((0, 0), (1, 0)), closed=True, friction=0.3)
    end = math.sqrt(2e-3 * mass / beyond)
    mechanism = Mechanism((grain,), contacts=(floor,), forces=(push,), gravity=(0, -9.81))
    return simulate(mechanism, until=end, step=end / 10)["grain_x"][-1]


@pytest.mark.parametrize("motion", [lift, pushed])
@pytest.mark.parametrize(("mass", "net"), [(1e-3, 1e-3), (1e-9, 1e-8), (1e-9, 1e-9), (1e-12, 1e-12), (1e-15, 1e-17)])
def test_a_grain_moves_by_what_is_left_of_the_forces(motion, mass, net):
    assert motion(mass, net) == pytest.approx(1e-3, rel=1e-8)


@pytest.mark.parametrize("pull", [0.0, 0.5, 1.0])
def test_a_grain_that_is_pulled_by_its_weight_or_less_stays(pull):
    """What is left of two forces that cancel is their rounding."""
    grain = rigid_body("grain", (0, 0), mass=1e-12, inertia=1e-20)
    force = PointForce("pull", grain.at(0, 0), force=(0.0, pull * 1e-12 * 9.81))
    floor = PointLineContact("floor", grain.at(0, 0), GROUND.line((0, 0), (1, 0)), closed=True)
    mechanism = Mechanism((grain,), contacts=(floor,), forces=(force,), gravity=(0, -9.81))
    result = simulate(mechanism, until=1.0, step=0.1)
    assert np.abs(result["grain_y"]).max() <= 1e-15
    assert [event.guard for event in result.events] == []


@pytest.mark.parametrize(("inertia", "torque"), [(1e-6, 1e-6), (1e-9, 1e-9), (1e-12, 1e-12), (1e-17, 1e-15)])
def test_a_brake_holds_its_limit_and_no_more(inertia, torque):
    wheel = rigid_body("wheel", (0, 0), mass=1, inertia=inertia)
    forces = (Torque("torque", wheel, torque=2 * torque), Brake("brake", wheel, limit=torque))
    mechanism = Mechanism((wheel,), (Revolute("pin", wheel.at(0, 0), GROUND.at(0, 0)),), forces)
    end = math.sqrt(2 * inertia / torque)
    assert simulate(mechanism, until=end, step=end / 10)["wheel_angle"][-1] == pytest.approx(1.0, rel=1e-8)


@pytest.mark.parametrize(("mass", "long", "torque"), [(0.1, 0.07, 1e-2), (1e-6, 5e-3, 1e-9), (1e-9, 2e-4, 1e-12)])
def test_a_lever_goes_from_stop_to_stop_however_small_it_is(mass, long, torque):
    """Towards the one for twice the time that it takes, and back."""
    low, travel = -math.pi / 6, math.pi / 3
    lever = bar("lever", (0, 0), length=long, angle=low, mass=mass)
    stops = (AngleStop("low", lever, GROUND, angle=low), AngleStop("high", GROUND, lever, angle=-low - travel))
    mechanism = Mechanism(
        (lever,),
        (Revolute("pin", lever.a, GROUND.at(0, 0)),),
        (Torque("motor", lever),),
        stops,
        inputs=(Input("torque", "motor.torque", 0.0, "", "N.m"),),
    )
    once = math.sqrt(2 * travel * mass * long**2 / 3 / torque)
    result = simulate(
        mechanism,
        until=4 * once,
        step=once / 50,
        inputs={"torque": lambda t: torque if t < 2 * once * (1 - 1e-9) else -torque},
    )
    assert [impact.contact for impact in result.impacts] == ["high", "low"]
    assert [impact.time for impact in result.impacts] == pytest.approx([once, 3 * once], rel=1e-9)


def test_what_nothing_presses_parts_however_slowly():
    """A ball that strikes a wall at 1 nm/s, and comes back."""
    ball = rigid_body("ball", (0, 1e-6), mass=1.0, inertia=0.1, velocity=(0.0, -1e-9))
    floor = PointLineContact("floor", ball.at(0, 0), GROUND.line((0, 0), (1, 0)), restitution=0.5)
    result = simulate(Mechanism((ball,), contacts=(floor,)), until=3e3, step=1e3)
    assert result["ball_y"][-1] == pytest.approx(1e-6, rel=1e-9)


def beside(neighbour):
    """A grain whose weight and 1e-3 of it more lift it, and a grain that falls from 1 mm and bounces, beside others."""
    lifted = rigid_body("lifted", (0, 0), mass=1e-6, inertia=1e-14)
    falls = rigid_body("falls", (1e-2, 1e-3), mass=1e-6, inertia=1e-14)
    floor = GROUND.line((0, 0), (1, 0))
    contacts = (
        PointLineContact("floor", lifted.at(0, 0), floor, closed=True),
        PointLineContact("bounces", falls.at(0, 0), floor, restitution=0.4),
    )
    forces = (PointForce("pull", lifted.at(0, 0), force=(0.0, 1.001 * 1e-6 * 9.81)),)
    bodies, joints = neighbour
    mechanism = Mechanism((lifted, falls, *bodies), joints, forces, contacts, gravity=(0, -9.81))
    result = simulate(mechanism, until=0.1, step=0.05)
    return result["lifted_y"][-1], [(hit.time, hit.closing_speed) for hit in result.impacts]


@pytest.mark.parametrize("neighbour", ["rotor", "crane"])
def test_what_is_small_moves_beside_what_is_large_or_fast_as_it_does_alone(neighbour):
    """A rotor at 1e4 rad/s, a pendulum of 10 m and 1 t: they share nothing with the grains."""
    rotor = rigid_body("rotor", (0, 1), mass=1.0, inertia=1e-3, speed=1e4)
    crane = rigid_body("crane", (0, 1), mass=1e3, inertia=1e4, centre=(10.0, 0.0))
    body = rotor if neighbour == "rotor" else crane
    high, impacts = beside(((body,), (Revolute("pin", body.at(0, 0), GROUND.at(0, 1)),)))
    alone, once = beside(((), ()))
    assert high == pytest.approx(0.5 * 9.81e-3 * 0.1**2, rel=1e-8)
    assert alone == pytest.approx(high, rel=1e-8)
    assert len(impacts) == len(once)
    np.testing.assert_allclose(impacts, once, rtol=1e-6, atol=0)
