"""Coulomb friction against closed forms: sliding, pins, sliders, impacts; and the energy it takes."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st
from touching import touching

from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    Body,
    CompliantShaft,
    Damper,
    Force,
    Mechanism,
    Output,
    PointLineContact,
    Revolute,
    Settings,
    TorsionSpring,
    Translational,
)
from mechanism_fmu.simulation import Simulation, SimulationError

GRAVITY = 9.81
MASS, INERTIA = 1.5, 0.2
ENERGIES = tuple(Output(name, f"energy.{name}", "") for name in ("kinetic", "spring", "work", "lost"))


def sliding(friction, *, height=0.0, feet=(0.0,), speed=0.0, spin=0.0, push=0.0, restitution=0.0, fall=0.0):
    """A block on feet, `height` below its centre of mass, on the ground y = 0."""
    return Mechanism(
        bodies=(Body("block", MASS, INERTIA, (0.0, height, 0.0), (speed, -fall, spin)),),
        forces=(Force("weight", "block", (push, -MASS * GRAVITY)),),
        contacts=tuple(
            PointLineContact(
                f"foot{k}",
                "block",
                (x, -height),
                GROUND,
                (0.0, 0.0),
                (0.0, 1.0),
                friction=friction,
                restitution=restitution,
            )
            for k, x in enumerate(feet)
        ),
        outputs=(
            *ENERGIES,
            *(Output(name, f"block.{name}", "") for name in ("x", "y", "angle", "x_rate", "y_rate", "speed")),
            *(Output(f"foot{k}", f"foot{k}.force", "") for k in range(len(feet))),
        ),
    )


@settings(deadline=None, max_examples=25)
@given(st.floats(0.01, 1.5), st.floats(0.1, 10.0), st.sampled_from([1, -1]))
def test_a_sliding_block_slows_down_by_mu_g(friction, speed, sign):
    simulation = Simulation(sliding(friction, speed=sign * speed))
    for share in (0.3, 0.6, 0.9):
        time = share * speed / (friction * GRAVITY)
        simulation.advance(time)
        found = simulation.read()
        assert (sign * found["x_rate"] - speed) / time == pytest.approx(-friction * GRAVITY, abs=1e-6)
        assert sign * found["x"] == pytest.approx(speed * time - friction * GRAVITY * time**2 / 2, abs=1e-9)
        assert found["lost"] == pytest.approx(friction * MASS * GRAVITY * sign * found["x"], rel=1e-9)


def test_a_block_that_has_slid_to_a_stop_stays_and_all_its_energy_is_lost():
    friction, speed = 0.4, 1.0
    simulation = Simulation(sliding(friction, speed=speed))
    stop = speed / (friction * GRAVITY)
    simulation.advance(stop + 0.1)
    found = simulation.read()
    assert abs(found["x_rate"]) < 1e-15
    assert found["x"] == pytest.approx(speed**2 / (2 * friction * GRAVITY), abs=1e-12)
    assert found["lost"] == pytest.approx(MASS * speed**2 / 2, rel=1e-8)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9, -0.9])
def test_a_block_pushed_by_less_than_friction_stands(share):
    friction = 0.3
    simulation = Simulation(sliding(friction, push=share * friction * MASS * GRAVITY))
    simulation.advance(3600.0)
    assert abs(simulation.read()["x_rate"]) < 1e-15
    assert abs(simulation.read()["x"]) < 1e-15


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("friction", [0.1, 0.5, 0.9])
def test_friction_below_the_centre_of_mass_loads_the_foot_in_front(friction, sign):
    """N_front - N_rear = mu m g h / a, with feet at +-a and h above the ground; each foot's friction follows."""
    height, half = 0.3, 0.4
    simulation = Simulation(sliding(friction, height=height, feet=(-half, half), speed=sign * 3.0))
    simulation.advance(0.1)
    found = simulation.read()
    weight, shift = MASS * GRAVITY, friction * MASS * GRAVITY * height / half
    rear, front = (found["foot0"], found["foot1"])[::sign]
    assert front == pytest.approx((weight + shift) / 2, rel=1e-9)
    assert rear == pytest.approx((weight - shift) / 2, rel=1e-9)
    assert found["x_rate"] == pytest.approx(sign * (3.0 - friction * GRAVITY * 0.1), abs=1e-8)
    assert found["angle"] == pytest.approx(0.0, abs=1e-11)


def test_a_tall_block_tips_over_its_front_foot():
    """Friction mu h > a lifts the rear foot; then J phi'' and m y'' follow from one foot alone."""
    friction, height, half = 0.8, 0.6, 0.4
    simulation = Simulation(sliding(friction, height=height, feet=(-half, half), speed=3.0))
    assert simulation.mode() == ("foot1",)
    # the foot's vertical acceleration is zero: N / m - g + a phi'' = 0, J phi'' = a N - h mu N
    lever = half - friction * height
    force = GRAVITY / (1 / MASS + half * lever / INERTIA)
    assert simulation.read()["foot1"] == pytest.approx(force, rel=1e-9)
    expected = [-friction * force / MASS, force / MASS - GRAVITY, lever * force / INERTIA]
    np.testing.assert_allclose(simulation.field("dy_end")[3:6], expected, rtol=1e-9)


@settings(deadline=None, max_examples=20)
@given(st.floats(1e-3, 0.05), st.floats(1.0, 20.0), st.sampled_from([1, -1]))
def test_a_rubbing_pin_slows_a_rotor_down_by_its_load(radius, speed, sign):
    """The pin carries the weight: J omega' = -(mu r) m g."""
    mechanism = Mechanism(
        bodies=(Body("rotor", MASS, INERTIA, (0.0, 0.0, 0.0), (0.0, 0.0, sign * speed)),),
        joints=(Revolute("pin", "rotor", (0.0, 0.0), GROUND, (0.0, 0.0), radius),),
        forces=(Force("weight", "rotor", (0.0, -MASS * GRAVITY)),),
        outputs=(*ENERGIES, Output("speed", "rotor.speed", ""), Output("angle", "rotor.angle", "")),
    )
    simulation = Simulation(mechanism)
    deceleration = radius * MASS * GRAVITY / INERTIA
    time = 0.8 * speed / deceleration
    simulation.advance(time)
    found = simulation.read()
    assert sign * found["speed"] == pytest.approx(0.2 * speed, rel=1e-7)
    assert sign * found["angle"] == pytest.approx(speed * time - deceleration * time**2 / 2, rel=1e-7)
    assert found["lost"] == pytest.approx(0.96 * INERTIA * speed**2 / 2, rel=1e-7)


@pytest.mark.parametrize("on_slider", [True, False], ids=["slider first", "ground first"])
@pytest.mark.parametrize("length", [1.0, 2.5])
@pytest.mark.parametrize(("friction", "slope"), [(0.3, 0.6), (0.3, 0.0), (0.8, 0.3)])
def test_a_slider_on_an_inclined_axis(friction, slope, length, on_slider):
    """x'' = -g sin(slope) - mu g cos(slope) upwards, whatever the length of the axis and the order of the bodies."""
    c, s = math.cos(slope), math.sin(slope)
    own = ("slider", (0.0, 0.0), (length, 0.0))
    ground = (GROUND, (0.0, 0.0), (length * c, length * s))
    ends = (*own, *ground) if on_slider else (*ground, *own)
    mechanism = Mechanism(
        bodies=(Body("slider", MASS, INERTIA, (0.0, 0.0, slope), (5.0 * c, 5.0 * s, 0.0)),),
        joints=(Translational("guide", *ends, friction),),
        forces=(Force("weight", "slider", (0.0, -MASS * GRAVITY)),),
        outputs=(*ENERGIES, Output("vx", "slider.x_rate", ""), Output("vy", "slider.y_rate", "")),
    )
    simulation = Simulation(mechanism)
    time = 0.3
    simulation.advance(time)
    found = simulation.read()
    deceleration = GRAVITY * s + friction * GRAVITY * c
    assert (5.0 - math.hypot(found["vx"], found["vy"])) / time == pytest.approx(deceleration, abs=1e-6)
    way = 5.0 * time - deceleration * time**2 / 2
    assert found["lost"] == pytest.approx(friction * MASS * GRAVITY * c * way, rel=1e-8)


def rubbing_pendulum(radius, damping, friction):
    """A double pendulum under gravity, with everything that takes energy, whose lower end slides on a guided line."""
    return Mechanism(
        bodies=(
            Body("upper", 1.0, 0.1, (0.5, 0.0, 0.0)),
            Body("lower", 0.6, 0.05, (1.0, -0.4, -math.pi / 2)),
            Body("slider", 0.3, 0.05, (1.0, -0.8, 0.0)),
        ),
        joints=(
            Revolute("top", "upper", (-0.5, 0.0), GROUND, (0.0, 0.0), radius),
            Revolute("knee", "lower", (-0.4, 0.0), "upper", (0.5, 0.0), radius),
            Revolute("end", "lower", (0.4, 0.0), "slider", (0.0, 0.0), radius),
            Translational("guide", "slider", (0.0, 0.0), (0.0, 1.0), GROUND, (1.0, 0.0), (0.0, 2.0), friction),
        ),
        forces=(
            *(Force(f"weight_{name}", name, (0.0, -m * GRAVITY)) for name, m in (("upper", 1.0), ("lower", 0.6))),
            TorsionSpring("spring", "lower", "upper", stiffness=3.0, free_angle=-1.0, preload=0.2),
            Damper("oil", "upper", damping=damping),
            CompliantShaft("shaft", "upper", stiffness=20.0, damping=damping, angle=0.3, speed=0.1),
        ),
        outputs=ENERGIES,
        settings=Settings(1e-11),
    )


@pytest.mark.parametrize(
    ("radius", "damping", "friction"),
    [(0.0, 0.0, 0.0), (0.0, 0.3, 0.0), (0.01, 0.0, 0.0), (0.0, 0.0, 0.2), (0.005, 0.1, 0.1)],
    ids=["nothing", "dampers", "pins", "guide", "all"],
)
def test_energy_is_accounted_for_and_what_is_lost_only_grows(radius, damping, friction):
    simulation = Simulation(rubbing_pendulum(radius, damping, friction))
    first = simulation.read()
    total, lost = first["kinetic"] + first["spring"], 0.0
    for time in np.linspace(0.02, 1.0, 50):
        simulation.advance(time)
        found = simulation.read()
        assert found["kinetic"] + found["spring"] - found["work"] + found["lost"] == pytest.approx(total, abs=1e-9)
        assert found["lost"] >= lost - 1e-12
        lost = found["lost"]
    assert (lost > 1e-3) == bool(radius or damping or friction)


def test_energy_of_a_bouncing_sliding_block_is_accounted_for():
    simulation = Simulation(sliding(0.3, height=0.2, feet=(-0.3, 0.4), speed=2.0, fall=1.0, spin=0.0, restitution=0.4))
    first = simulation.read()["kinetic"]
    impacts = 0
    for time in np.linspace(0.02, 1.0, 50):
        simulation.advance(time)
        found = simulation.read()
        impacts += len(simulation.impacts_in_step())
        assert found["kinetic"] - found["work"] + found["lost"] == pytest.approx(first, abs=1e-9)
    assert impacts > 3


@settings(deadline=None, max_examples=100)
@given(
    st.floats(0.01, 2.0),
    st.floats(0.0, 1.0),
    st.floats(-5.0, 5.0),
    st.floats(-20.0, 20.0),
    st.floats(0.5, 5.0),
)
def test_an_oblique_impact_of_a_spinning_disc(friction, restitution, speed, spin, fall):
    """p_n = (1 + e) m v_n; p_t ends the slip of the lowest point, m_t (v + R omega), but is at most mu p_n."""
    radius = 0.25
    simulation = Simulation(
        sliding(friction, height=radius, speed=speed, spin=spin, fall=fall, restitution=restitution)
    )
    simulation.advance(1e-12)
    (hit,) = simulation.impacts_in_step()
    normal = (1 + restitution) * MASS * fall
    assert hit.impulse == pytest.approx(normal, rel=1e-5)  # e below the stick speed counts as 0
    slip = speed + radius * spin
    tangential = -slip / (1 / MASS + radius**2 / INERTIA)
    sticks = abs(tangential) <= friction * hit.impulse
    if not sticks:
        tangential = math.copysign(friction * hit.impulse, tangential)
    after = simulation.field("last_impact")[codes_after(1) : codes_after(1) + 3]
    expected = [speed + tangential / MASS, hit.impulse / MASS - fall, spin + radius * tangential / INERTIA]
    np.testing.assert_allclose(after, expected, rtol=1e-10, atol=1e-10)
    slip_after = after[0] + radius * after[2]
    assert slip_after * slip >= -1e-9  # friction never turns the slip round
    if sticks:
        assert slip_after == pytest.approx(0.0, abs=1e-10)


def codes_after(contacts):
    """Where the rates after the impact begin in a record of one body."""
    return codes.RECORD_CONTACT_IMPULSES + contacts + 3


@settings(deadline=None, max_examples=150)
@given(st.integers(0, 2**32), st.integers(1, 3), st.integers(1, 6), st.floats(0.01, 2.0))
def test_impacts_with_friction_never_add_energy(seed, bodies, contacts, friction):
    heap = touching(seed, bodies=bodies, contacts=contacts, moving=True, friction=friction)
    simulation = Simulation(heap.mechanism)
    before = simulation.read()["kinetic"]
    try:
        simulation.advance(1e-12)
    except SimulationError:  # what is wedged in afterwards may have no acceleration that agrees with friction
        assume(False)
    n = len(heap.masses)
    rates = simulation.field("dense")[0, n : 2 * n]
    after = heap.masses @ rates**2 / 2
    assert after <= before * (1 + 1e-12)
    assert after + simulation.read()["lost"] == pytest.approx(before, rel=1e-9)
    assert np.all(heap.rows @ rates >= -2e-9)


def test_friction_in_an_impact_against_rows_that_bounce_adds_no_energy():
    """Ending the slip while other contacts keep their separation speeds once added 10 % of the energy."""
    heap = touching(3385, bodies=1, contacts=5, moving=True, friction=2.0)
    simulation = Simulation(heap.mechanism)
    before = simulation.read()["kinetic"]
    simulation.advance(1e-12)
    assert simulation.read()["kinetic"] <= before
    assert simulation.read()["lost"] >= 0
