"""What no mechanism may change: energy, momentum, angular momentum."""

import math
from dataclasses import replace
from itertools import product

import numpy as np
from hypothesis import assume, given, settings, strategies as st

from mechanism_fmu.model import (
    GROUND,
    Body,
    Mechanism,
    Output,
    PointLineContact,
    Revolute,
    Settings,
    Torque,
    TorsionSpring,
)
from mechanism_fmu.simulation import Simulation

LENGTHS = st.floats(0.3, 1.2)
ENERGIES = tuple(Output(name, f"energy.{name}", "") for name in ("kinetic", "spring", "work", "lost"))


def bar(name, start, end, rate):
    """A uniform bar of 1 kg/m between two points, with the rates of its ends."""
    (x0, y0), (x1, y1) = start, end
    length = math.dist(start, end)
    middle = ((x0 + x1) / 2, (y0 + y1) / 2, math.atan2(y1 - y0, x1 - x0))
    return Body(name, length, length**3 / 12, middle, rate)


def four_bar_rates(points, speed):
    """(xd, yd, phid) of crank, coupler and rocker when the crank turns with `speed`."""
    (a, b, c, d) = map(np.array, points)

    def turned(v):
        return np.array([-v[1], v[0]])

    pin = speed * turned(b - a)
    coupler, rocker = np.linalg.solve(np.transpose([turned(c - b), -turned(c - d)]), -pin)
    tip = rocker * turned(c - d)
    return [(*(pin / 2), speed), (*((pin + tip) / 2), coupler), (*(tip / 2), rocker)]


def never_flat(*lengths):
    """All four bars cannot come to lie on one line, where the rows become dependent and the motion may branch."""
    return all(abs(np.dot(signs, lengths)) > 0.05 for signs in product((1, -1), repeat=4))


@st.composite
def four_bars(draw):
    """A closed four-bar at a random speed, with a spring on the rocker, and perhaps some joints twice."""
    crank, coupler, rocker, angle = draw(LENGTHS), draw(LENGTHS), draw(LENGTHS), draw(st.floats(-3.0, 3.0))
    a, d = np.zeros(2), np.array([1.0, 0.0])
    b = crank * np.array([math.cos(angle), math.sin(angle)])
    span = math.dist(b, d)
    assume(abs(coupler - rocker) + 0.1 < span < coupler + rocker - 0.1)
    assume(never_flat(crank, coupler, rocker, 1.0))
    along = (coupler**2 - rocker**2 + span**2) / (2 * span)
    across = math.sqrt(coupler**2 - along**2)
    e = (d - b) / span
    c = b + along * e + across * np.array([-e[1], e[0]])
    rates = four_bar_rates((a, b, c, d), draw(st.floats(-1.0, 1.0)))
    ends = ((a, b), (b, c), (d, c))
    bodies = tuple(bar(n, *end, rate) for n, end, rate in zip(("crank", "coupler", "rocker"), ends, rates, strict=True))
    joints = [
        Revolute("a", "crank", (-crank / 2, 0.0), GROUND, (0.0, 0.0)),
        Revolute("b", "crank", (crank / 2, 0.0), "coupler", (-coupler / 2, 0.0)),
        Revolute("c", "coupler", (coupler / 2, 0.0), "rocker", (rocker / 2, 0.0)),
        Revolute("d", "rocker", (-rocker / 2, 0.0), GROUND, (1.0, 0.0)),
    ]
    for joint in draw(st.lists(st.sampled_from(joints), max_size=2)):
        joints.append(replace(joint, name=f"{joint.name}{len(joints)}"))
    spring = TorsionSpring(
        "spring", "rocker", stiffness=draw(st.floats(0.0, 2.0)), free_angle=draw(st.floats(-1.0, 1.0))
    )
    return Mechanism(bodies, tuple(joints), (spring,), outputs=ENERGIES, settings=Settings(1e-10))


@settings(deadline=None, max_examples=40)
@given(four_bars())
def test_a_four_bar_on_a_spring_keeps_its_energy(mechanism):
    simulation = Simulation(mechanism)
    first = simulation.read()
    total = first["kinetic"] + first["spring"]
    for time in np.linspace(0.1, 2.0, 20):
        simulation.advance(time)
        found = simulation.read()
        assert abs(found["kinetic"] + found["spring"] - total) < 1e-7 * max(total, 1e-3)
        assert found["work"] == found["lost"] == 0.0


@settings(deadline=None, max_examples=30)
@given(st.lists(st.floats(-2.0, 2.0), min_size=5, max_size=5), st.floats(-1.0, 1.0), st.floats(0.0, 2.0))
def test_two_free_bodies_on_a_pin_keep_their_momenta(numbers, torque, stiffness):
    """Only internal forces: torque and spring between the bodies, and the pin."""
    vx, vy, spin_a, spin_b, fold = numbers
    at, bt = 0.5, 0.3  # from each centre of mass to the pin
    a = Body("a", 2.0, 0.3, (0.0, 0.0, 0.0), (vx, vy, spin_a))
    c, s = math.cos(fold), math.sin(fold)
    pin_rate = np.array([vx, vy + at * spin_a])
    b_rate = pin_rate + spin_b * np.array([-bt * s, bt * c])
    b = Body("b", 0.7, 0.1, (at + bt * c, bt * s, fold), (*b_rate, spin_b))
    mechanism = Mechanism(
        bodies=(a, b),
        joints=(Revolute("pin", "a", (at, 0.0), "b", (-bt, 0.0)),),
        forces=(
            Torque("motor", "a", reaction="b", torque=torque),
            TorsionSpring("spring", "a", reaction="b", stiffness=stiffness),
        ),
        settings=Settings(1e-11),
    )
    simulation = Simulation(mechanism)
    before = momenta(mechanism, simulation)
    simulation.advance(2.0)
    np.testing.assert_allclose(momenta(mechanism, simulation), before, rtol=0, atol=1e-8)


def momenta(mechanism, simulation):
    """Momentum and angular momentum about the origin, at the end of the engine's own step."""
    q, qd = np.split(simulation.field("y_end")[:-2], 2)
    total = np.zeros(3)
    for body, (x, y, _), (xd, yd, spin) in zip(mechanism.bodies, q.reshape(-1, 3), qd.reshape(-1, 3), strict=True):
        total += [body.mass * xd, body.mass * yd, body.inertia * spin + body.mass * (x * yd - y * xd)]
    return total


@settings(deadline=None, max_examples=30)
@given(st.just(0.0) | st.floats(0.01, 1.0), st.floats(0.1, 3.0), st.floats(-1.0, 1.0), st.floats(-0.4, 0.4))
def test_an_impact_between_free_bodies_keeps_their_momenta(restitution, speed, spin, offset):
    """A stone flies into a plate off its centre; the line belongs to the plate."""
    stone = Body("stone", 0.5, 0.02, (-1.0, offset, 0.0), (speed, 0.0, spin))
    plate = Body("plate", 1.5, 0.2, (0.0, 0.0, 0.0))
    face = PointLineContact("face", "stone", (0.0, 0.0), "plate", (0.0, 0.0), (-1.0, 0.0), restitution=restitution)
    mechanism = Mechanism((stone, plate), contacts=(face,), outputs=ENERGIES, settings=Settings(1e-11))
    simulation = Simulation(mechanism)
    before = momenta(mechanism, simulation)
    kinetic = simulation.read()["kinetic"]
    simulation.advance(1.5 / speed)
    (hit,) = simulation.impacts_in_step()
    found = simulation.read()
    np.testing.assert_allclose(momenta(mechanism, simulation), before, rtol=0, atol=1e-9)
    # the plate's mass as the point sees it: 1/m + 1/M + offset^2/J
    yields = 1 / 0.5 + 1 / 1.5 + offset**2 / 0.2
    assert math.isclose(hit.impulse, (1 + restitution) * speed / yields, rel_tol=1e-9)
    lost = (1 - restitution**2) * speed**2 / (2 * yields)
    assert math.isclose(found["lost"], lost, rel_tol=1e-9, abs_tol=1e-12)
    assert math.isclose(found["kinetic"] + found["lost"], kinetic, rel_tol=1e-12)
