"""Force elements: closed forms, and for random mechanisms of random elements momenta and a ledger that adds up."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st
from scipy.interpolate import PchipInterpolator

from mechanism_fmu.model import (
    GROUND,
    Body,
    Bushing,
    Force,
    Input,
    Marker,
    Mechanism,
    MechanismError,
    NonlinearSpring,
    NonlinearTorsionSpring,
    Output,
    PointForce,
    Revolute,
    Settings,
    SpringDamper,
    TorsionSpringDamper,
    characteristic,
)
from mechanism_fmu.model.functions import exp, maximum, smoothstep, tanh, where
from mechanism_fmu.simulation import Simulation

EXACT = Settings(relative_tolerance=1e-12)
ENERGIES = tuple(Output(name, f"energy.{name}", "") for name in ("kinetic", "spring", "work", "lost"))
ORIGIN = (0.0, 0.0)


def read(name, *quantities):
    return tuple(Output(f"{name}.{quantity}", f"{name}.{quantity}", "") for quantity in quantities)


def on_a_line(element, start=2.1, rate=0.0, outputs=(), mass=0.7):
    """A mass on the x axis with an element to the origin."""
    body = Body("mass", mass, 1.0, (start, 0.0, 0.0), (rate, 0.0, 0.0))
    outputs = (*read("mass", "x", "x_rate"), *outputs, *ENERGIES)
    return Simulation(Mechanism((body,), forces=(element,), outputs=outputs, settings=EXACT))


# One side only.


def test_a_rope_pulls_only_where_it_is_longer_than_it_is():
    """Thrown out along its rope, a mass comes back as fast as it went, after half a swing."""
    mass, stiffness, length, speed = 0.7, 300.0, 2.0, 1.5
    rope = SpringDamper("rope", "mass", ORIGIN, GROUND, ORIGIN, stiffness, length, one_sided="stretched")
    simulation = on_a_line(rope, start=1.5, rate=speed, outputs=read("rope", "force", "power"))
    taut = (length - 1.5) / speed
    half = math.pi / math.sqrt(stiffness / mass)
    simulation.advance(taut / 2)
    assert simulation.read()["rope.force"] == 0.0
    simulation.advance(taut + half / 2)
    found = simulation.read()
    stretch = speed / math.sqrt(stiffness / mass)
    assert found["mass.x"] == pytest.approx(length + stretch, abs=1e-9)
    assert found["rope.force"] == pytest.approx(stiffness * stretch, rel=1e-8)
    simulation.advance(taut + half + 0.2)
    found = simulation.read()
    assert found["mass.x_rate"] == pytest.approx(-speed, abs=1e-9)
    assert found["mass.x"] == pytest.approx(length - 0.2 * speed, abs=1e-9)
    assert (found["rope.force"], found["spring"], found["lost"]) == (0.0, 0.0, 0.0)


def test_a_bumper_with_a_damper_never_holds_back_and_loses_what_it_does_not_give_back():
    bumper = SpringDamper("bumper", "mass", ORIGIN, GROUND, ORIGIN, 400.0, 2.0, damping=12.0, one_sided="compressed")
    simulation = on_a_line(bumper, start=2.5, rate=-1.5, outputs=read("bumper", "force"))
    energy = 0.5 * 0.7 * 1.5**2
    forces = []
    for time in np.linspace(0.01, 2.0, 200):
        simulation.advance(time)
        found = simulation.read()
        forces.append(found["bumper.force"])
        assert found["kinetic"] + found["spring"] + found["lost"] == pytest.approx(energy, abs=1e-10)
    assert max(forces) == 0.0
    assert min(forces) < -10.0
    assert 0.0 < found["mass.x_rate"] < 1.5
    assert found["spring"] == 0.0


def test_an_elastic_end_stop_turns_a_body_back():
    body = Body("arm", 1.0, 0.3, (0.0, 0.0, 0.0), (0.0, 0.0, 2.0))
    stop = TorsionSpringDamper("stop", "arm", stiffness=500.0, free_angle=0.4, one_sided="stretched")
    simulation = Simulation(
        Mechanism(
            (body,),
            joints=(Revolute("hinge", "arm", ORIGIN, GROUND, ORIGIN),),
            forces=(stop,),
            outputs=(*read("arm", "angle", "speed"), *read("stop", "angle", "torque", "power")),
            settings=EXACT,
        )
    )
    root = math.sqrt(500.0 / 0.3)
    simulation.advance(0.2 + 0.25 * math.pi / root)
    found = simulation.read()
    deep = 2.0 / root * math.sin(math.pi / 4)
    assert found["arm.angle"] == found["stop.angle"] == pytest.approx(0.4 + deep, abs=1e-9)
    assert found["stop.torque"] == pytest.approx(-500.0 * deep, rel=1e-7)
    assert found["stop.power"] == pytest.approx(found["stop.torque"] * found["arm.speed"], rel=1e-12)
    simulation.advance(0.2 + math.pi / root + 0.1)
    assert simulation.read()["arm.angle"] == pytest.approx(0.2, abs=1e-9)


@pytest.mark.parametrize("element", [SpringDamper("s", "mass", ORIGIN, GROUND, ORIGIN, one_sided="pull")])
def test_a_side_that_is_none_is_refused(element):
    with pytest.raises(MechanismError, match="one_sided = 'pull' is none of no, stretched, compressed"):
        on_a_line(element)


# Gravity, forces at points, bushings.


def test_gravity_is_the_weight_of_every_body():
    bodies = (Body("one", 2.0, 0.1), Body("two", 3.0, 0.1, (1.0, 0.0, 0.0), (0.0, 2.0, 0.0)))
    outputs = (*read("one", "y"), *read("two", "x", "y"), *ENERGIES)
    simulation = Simulation(Mechanism(bodies, gravity=(0.5, -9.80665), outputs=outputs, settings=EXACT))
    simulation.advance(0.8)
    found = simulation.read()
    assert found["one.y"] == pytest.approx(-0.5 * 9.80665 * 0.64, abs=1e-12)
    assert found["two.y"] == pytest.approx(1.6 - 0.5 * 9.80665 * 0.64, abs=1e-12)
    assert found["two.x"] == pytest.approx(1.0 + 0.25 * 0.64, abs=1e-12)
    assert found["work"] == pytest.approx(found["kinetic"] - 6.0, abs=1e-11)


def test_gravity_equals_forces_at_the_centres():
    rod = Body("rod", 1.3, 0.02, (0.3, 0.0, 0.0))
    pin = Revolute("pin", "rod", (-0.3, 0.0), GROUND, ORIGIN)
    outputs = (*read("rod", "angle"), *read("pin", "force_x", "force_y"), *ENERGIES)
    by_hand = Mechanism((rod,), (pin,), forces=(Force("w", "rod", (0.0, -1.3 * 9.81)),), outputs=outputs)
    by_gravity = Mechanism((rod,), (pin,), gravity=(0.0, -9.81), outputs=outputs)
    found = []
    for mechanism in (by_hand, by_gravity):
        simulation = Simulation(mechanism)
        simulation.advance(0.7)
        found.append(simulation.read())
    assert found[0] == found[1]


def test_a_force_in_the_frame_of_the_body_turns_with_it():
    """A rocket on a hinge: a constant torque about it, so a constant angular acceleration."""
    arm = Body("arm", 1.0, 0.2, (0.5, 0.0, 0.0))
    thrust = PointForce("thrust", "arm", (0.3, 0.1), (0.0, 4.0), frame="body")
    simulation = Simulation(
        Mechanism(
            (arm,),
            (Revolute("hinge", "arm", (-0.5, 0.0), GROUND, ORIGIN),),
            forces=(thrust,),
            outputs=(*read("arm", "angle", "speed"), *read("thrust", "power"), *ENERGIES),
            inputs=(Input("push", "thrust.y", 4.0, ""),),
            settings=EXACT,
        )
    )
    simulation.advance(1.5)
    found = simulation.read()
    acceleration = 4.0 * 0.8 / (0.2 + 0.25)
    assert found["arm.angle"] == pytest.approx(0.5 * acceleration * 1.5**2, rel=1e-9)
    assert found["thrust.power"] == pytest.approx(3.2 * found["arm.speed"], rel=1e-9)
    assert found["work"] == pytest.approx(3.2 * found["arm.angle"], rel=1e-9)


def test_a_force_in_global_directions_acts_at_its_point():
    plate = Body("plate", 2.0, 0.4, (0.0, 0.0, 0.7))
    pull = PointForce("pull", "plate", (0.2, -0.1), (3.0, -1.0))
    simulation = Simulation(Mechanism((plate,), forces=(pull,), outputs=read("plate", "x", "angle"), settings=EXACT))
    simulation.advance(1e-3)
    x = math.cos(0.7) * 0.2 + math.sin(0.7) * 0.1
    y = math.sin(0.7) * 0.2 - math.cos(0.7) * 0.1
    found = simulation.read()
    assert found["plate.x"] == pytest.approx(0.5e-6 * 3.0 / 2.0, rel=1e-9)
    assert found["plate.angle"] - 0.7 == pytest.approx(0.5e-6 * (x * -1.0 - y * 3.0) / 0.4, rel=1e-6)


def test_a_frame_that_is_none_is_refused():
    with pytest.raises(MechanismError, match="frame = 'wheel' is neither global nor body"):
        on_a_line(PointForce("push", "mass", ORIGIN, (1.0, 0.0), frame="wheel"))


def test_a_bushing_swings_along_each_of_its_directions():
    mass, inertia = 0.7, 0.05
    body = Body("block", mass, inertia, (0.02, -0.01, 0.1))
    bushing = Bushing("bushing", "block", ORIGIN, GROUND, ORIGIN, 100.0, 400.0, torsional_stiffness=3.0)
    outputs = read("bushing", "x", "y", "angle", "force_x", "force_y", "torque")
    simulation = Simulation(Mechanism((body,), forces=(bushing,), outputs=outputs, settings=EXACT))
    simulation.advance(0.4)
    found = simulation.read()
    for name, start, stiffness, heavy, force in (
        ("x", 0.02, 100.0, mass, "force_x"),
        ("y", -0.01, 400.0, mass, "force_y"),
        ("angle", 0.1, 3.0, inertia, "torque"),
    ):
        value = start * math.cos(math.sqrt(stiffness / heavy) * 0.4)
        assert found[f"bushing.{name}"] == pytest.approx(value, abs=1e-10)
        assert found[f"bushing.{force}"] == pytest.approx(-stiffness * value, abs=1e-8)


# Laws.


def test_a_table_is_a_monotone_cubic_whose_slope_and_energy_go_with_it():
    points = ((1.5, 0.0), (2.0, 10.0), (2.2, 10.0), (2.6, 40.0), (3.0, 35.0))
    reference = PchipInterpolator(*np.array(points).T)
    spring = NonlinearSpring("spring", "mass", ORIGIN, GROUND, ORIGIN, law=characteristic(points))
    simulation = on_a_line(spring, 2.9, rate=0.3, outputs=read("spring", "length", "force"))
    begin = simulation.read()
    lengths = []
    for time in np.linspace(0.02, 1.0, 50):
        simulation.advance(time)
        found = simulation.read()
        length = found["spring.length"]
        lengths.append(length)
        if 1.5 <= length <= 3.0:
            force, energy = float(reference(length)), float(reference.integrate(1.5, length))
        else:
            end = 1.5 if length < 1.5 else 3.0
            slope, at_end, beyond = float(reference.derivative()(end)), float(reference(end)), length - end
            force = at_end + slope * beyond
            energy = float(reference.integrate(1.5, end)) + at_end * beyond + 0.5 * slope * beyond * beyond
        assert found["spring.force"] == pytest.approx(force, abs=1e-10)
        assert found["spring"] == pytest.approx(energy, abs=1e-10)
        assert found["kinetic"] + found["spring"] == pytest.approx(begin["kinetic"] + begin["spring"], rel=1e-9)
        assert found["work"] == found["lost"] == 0.0
    assert min(lengths) < 1.5, "the straight part before the first point is not reached"


def law(x, v):
    pull = 30.0 * (x - 2.0) + 5.0 * maximum(x - 2.05, 0.0) ** 2 - where(v > 0.1, 1.0, -0.5) * exp(-x)
    return pull + 0.3 * tanh(v / 0.05) + smoothstep(x, 2.0, 2.2) / (1.0 + abs(v))


def test_a_law_of_the_users_own_is_carried_out_as_python_does():
    spring = NonlinearSpring("spring", "mass", ORIGIN, GROUND, ORIGIN, law=law)
    simulation = on_a_line(spring, 2.3, rate=0.3, outputs=read("spring", "length", "speed", "force", "power"))
    begin = simulation.read()
    for time in np.linspace(0.02, 2.0, 40):
        simulation.advance(time)
        found = simulation.read()
        assert found["spring.force"] == law(found["spring.length"], found["spring.speed"])
        assert found["spring.power"] == -found["spring.force"] * found["spring.speed"]
        assert found["kinetic"] == pytest.approx(begin["kinetic"] + found["work"], abs=1e-9)


def test_a_linear_law_is_a_spring():
    linear = NonlinearTorsionSpring("spring", "arm", law=lambda angle, speed: 4.0 * angle + 0.2 * speed)
    damped = TorsionSpringDamper("spring", "arm", stiffness=4.0, damping=0.2)
    found = []
    for element in (linear, damped):
        body = Body("arm", 1.0, 0.3, (0.0, 0.0, 0.5))
        outputs = (*read("arm", "angle"), *read("spring", "torque"))
        simulation = Simulation(Mechanism((body,), forces=(element,), outputs=outputs, settings=EXACT))
        simulation.advance(1.3)
        found.append(list(simulation.read().values()))
    np.testing.assert_allclose(*found, rtol=1e-10)


def branching(x, v):
    if x > 0.0:
        return v
    return 0.0


@pytest.mark.parametrize(
    ("law", "said"),
    [
        (branching, r"line \d+ \(if x > 0\.0:\): A law must not branch on its arguments"),
        (lambda x, v: math.sin(x) + v, "A law must not make plain numbers or text of its arguments"),
        (lambda x, v: max(x, v), "A law must not branch"),
        (lambda x, v: (x > v) * 2.0, "A law must not branch"),
        (lambda x, v: None, "it returns None, but must return a number"),
        (lambda x: x, r"called with two arguments.* write law\(x, v\), not <lambda>\(x\)"),
        (5.0, r"5\.0 is neither a function law\(x, v\) nor a curve"),
        ([(0.0, 1.0), (1.0, 2.0)], "is neither a function"),
        (
            lambda x, v: x * np.array([1.0, 2.0]),
            r"it calculates with array\(\[1\., 2\.\]\), but a law takes real numbers",
        ),
        (lambda x, v: 1j * x, "it calculates with 1j, but a law takes real numbers"),
        (lambda x, v: 1j, "it returns 1j, but must return a number"),
        (lambda x, v: np.ones(2), "must return a number"),
        (lambda x, v: x + None, "it calculates with None"),
        (lambda x, v: sum(x**k for k in range(1, 12) for _ in range(60)) * v, "more than 500 operations"),
    ],
)
def test_a_law_that_cannot_be_recorded_is_refused_with_the_line(law, said):
    with pytest.raises(MechanismError, match=f"(?s)The law of NonlinearSpring 'spring' cannot be used, .*{said}"):
        on_a_line(NonlinearSpring("spring", "mass", ORIGIN, GROUND, ORIGIN, law=law))


def test_a_number_of_another_law_is_refused_wherever_it_comes_back():
    kept = []

    def keeping(x, v):
        kept.append(x * v)
        return x

    on_a_line(NonlinearSpring("spring", "mass", ORIGIN, GROUND, ORIGIN, law=keeping))
    for other in (lambda x, v: kept[0], lambda x, v: kept[0] + x):
        with pytest.raises(MechanismError, match="A number of one law was used in another"):
            on_a_line(NonlinearSpring("spring", "mass", ORIGIN, GROUND, ORIGIN, law=other))


@pytest.mark.parametrize(
    ("exponent", "same"),
    [
        (2.0, lambda x: x * x),
        (np.int64(3), lambda x: x * x * x),
        (np.float64(3.0), lambda x: x * x * x),
        (0, lambda x: 1.0),
        (0.0, lambda x: 1.0),
        (-1, lambda x: 1.0 / x),
        (-3.0, lambda x: 1.0 / (x * x * x)),
        (13, lambda x: (x * x * x * x * x * x) * (x * x * x * x * x * x) * x),
        (50, None),
    ],
)
@pytest.mark.parametrize("angle", [-0.5, 0.7])
def test_whole_powers_are_there_for_negative_numbers_too(exponent, same, angle):
    spring = NonlinearTorsionSpring("spring", "arm", law=lambda x, v: x**exponent)
    arm = Body("arm", 1.0, 0.3, (0.0, 0.0, angle))
    torque = Simulation(Mechanism((arm,), forces=(spring,), outputs=read("spring", "torque"))).read()["spring.torque"]
    assert torque == pytest.approx(-(angle ** float(exponent)), rel=1e-14)
    if same is not None:
        assert torque == -same(angle)


@pytest.mark.parametrize("points", [[(0, 1, 2), (1, 2, 3)], [0.0, 1.0], [(0.0, 1.0), (1.0,)], ["ab", "cd"]])
def test_points_of_a_table_are_pairs(points):
    with pytest.raises(MechanismError, match=r"Point \d of a characteristic is .* must be a pair"):
        characteristic(points)


# Random mechanisms of random elements.

POINT = st.tuples(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3))
SIDE = st.sampled_from(["no", "stretched", "compressed"])
SMALL = st.floats(0.0, 2.0)


@st.composite
def elements(draw, name, body, reaction):
    """A force element between two bodies that keeps momenta."""
    a, b = draw(POINT), draw(POINT)
    stiffness, damping, preload = draw(st.floats(0.0, 20.0)), draw(SMALL), draw(st.floats(-1.0, 1.0))
    kind = draw(st.sampled_from(["line", "torsion", "bushing", "table", "law", "torsion law"]))
    if kind == "line":
        return SpringDamper(name, body, a, reaction, b, stiffness, 1.0, damping, preload, draw(SIDE))
    if kind == "torsion":
        return TorsionSpringDamper(name, body, reaction, stiffness, 0.2, damping, preload, draw(SIDE))
    if kind == "bushing":
        return Bushing(name, body, a, reaction, b, stiffness, 5.0, damping, 0.3, 1.0, damping, 0.1)
    if kind == "table":
        values = draw(st.lists(st.floats(-5.0, 5.0), min_size=4, max_size=4))
        return NonlinearSpring(
            name, body, a, reaction, b, law=characteristic(list(zip((0.2, 0.9, 1.1, 2.0), values, strict=True)))
        )
    if kind == "law":
        return NonlinearSpring(
            name, body, a, reaction, b, law=lambda x, v: stiffness * (x - 1.0) ** 3 + damping * tanh(v) + preload
        )
    return NonlinearTorsionSpring(name, body, reaction, law=lambda x, v: smoothstep(x, -1.0, 1.0) + damping * v)


@settings(deadline=None, max_examples=40, suppress_health_check=[HealthCheck.too_slow])
@given(data=st.data(), rates=st.lists(st.floats(-1.0, 1.0), min_size=9, max_size=9))
def test_free_bodies_with_random_elements_keep_their_momenta_and_the_ledger_adds_up(data, rates):
    names = ("one", "two", "three")
    places = ((0.0, 0.0, 0.3), (1.5, 0.4, -1.0), (0.2, 1.6, 2.0))
    masses = ((1.0, 0.2), (2.0, 0.5), (0.7, 0.3))
    bodies = tuple(
        Body(name, *mass, place, tuple(rates[3 * k : 3 * k + 3]))
        for k, (name, mass, place) in enumerate(zip(names, masses, places, strict=True))
    )
    forces = tuple(
        data.draw(elements(f"e{k}", *pair)) for k, pair in enumerate([names[:2], names[1:], (names[2], names[0])])
    )
    outputs = tuple(o for name in names for o in read(name, "x", "y", "x_rate", "y_rate", "speed"))
    powers = tuple(o for force in forces for o in read(force.name, "power"))
    simulation = Simulation(Mechanism(bodies, forces=forces, outputs=(*outputs, *powers, *ENERGIES), settings=EXACT))

    def kept():
        found = simulation.read()
        total = np.zeros(4)
        for name, (mass, inertia) in zip(names, masses, strict=True):
            x, y, u, v, w = (found[f"{name}.{what}"] for what in ("x", "y", "x_rate", "y_rate", "speed"))
            total[:3] += mass * u, mass * v, inertia * w + mass * (x * v - y * u)
        total[3] = found["kinetic"] + found["spring"] + found["lost"] - found["work"]
        return total

    first = kept()
    for time in (0.1, 0.4, 0.8):
        simulation.advance(time)
        np.testing.assert_allclose(kept(), first, atol=1e-10 * max(1.0, *np.abs(first)))
    found, rates_now = simulation.read(), simulation.read_rates()
    power = sum(found[f"{force.name}.power"] for force in forces)
    assert power == pytest.approx(rates_now["kinetic"], rel=1e-9, abs=1e-9)  # the bodies get what the elements give


# Markers.


@given(
    pose=st.tuples(*[st.floats(-3.0, 3.0)] * 3), rate=st.tuples(*[st.floats(-5.0, 5.0)] * 3), point=POINT, pull=POINT
)
@settings(max_examples=30, deadline=None)
def test_a_marker_reads_place_velocity_and_acceleration_of_its_point(pose, rate, point, pull):
    """By complex numbers: r = z + s e^(i phi); and it does nothing to the motion."""
    body = Body("body", 2.0, 0.3, pose, rate)
    push = PointForce("push", "body", (0.1, 0.2), pull)
    pen = (Marker("pen", "body", point),)
    outputs = read("pen", "x", "y", "x_rate", "y_rate")
    simulation = Simulation(Mechanism((body,), forces=(push,), markers=pen, outputs=outputs))
    found, rates = simulation.read(), simulation.read_rates()
    turn = np.exp(1j * pose[2])
    arm = complex(*point) * turn
    place = complex(*pose[:2]) + arm
    velocity = complex(*rate[:2]) + 1j * rate[2] * arm
    lever = (0.1 + 0.2j) * turn
    torque = (lever.conjugate() * complex(*pull)).imag
    acceleration = complex(*pull) / 2.0 + (1j * torque / 0.3 - rate[2] ** 2) * arm
    expected = (place.real, place.imag, velocity.real, velocity.imag)
    assert [*found.values()] == pytest.approx(expected, abs=1e-13)
    expected = (velocity.real, velocity.imag, acceleration.real, acceleration.imag)
    assert [*rates.values()] == pytest.approx(expected, rel=1e-12, abs=1e-11)
    motion = read("body", "x", "angle", "speed")
    both = [Simulation(Mechanism((body,), forces=(push,), markers=marks, outputs=motion)) for marks in ((), pen)]
    for one in both:
        one.advance(0.3)
    assert both[0].read() == both[1].read()


def test_the_work_of_weights_is_work_done_as_the_page_says():
    """2 kg that fall by h = g t^2/2 have been given m g h, and nothing is stored."""
    page = " ".join((Path(__file__).parents[2] / "docs" / "fmu.md").read_text(encoding="utf-8").split())
    assert (
        "`gravity` has no potential energy in this ledger, and a body of mass m that falls by h has `work_done` m g h."
        in page
    )
    simulation = Simulation(
        Mechanism((Body("mass", 2.0, 1.0),), gravity=(0.0, -9.81), outputs=ENERGIES, settings=EXACT)
    )
    simulation.advance(0.5)
    found = simulation.read()
    assert found["work"] == pytest.approx(2.0 * 9.81 * (9.81 * 0.5**2 / 2), rel=1e-12)
    assert found["kinetic"] == pytest.approx(found["work"], rel=1e-12)
    assert found["spring"] == found["lost"] == 0.0
