"""Force elements against closed forms: springs of one side, gravity, forces at points, bushings."""

import math
from pathlib import Path

import numpy as np
import pytest
from single_element import ENERGIES, EXACT, ORIGIN, on_a_line, read

from mechanism_fmu.model import (
    GROUND,
    Body,
    Bushing,
    Force,
    Input,
    Mechanism,
    MechanismError,
    PointForce,
    Revolute,
    SpringDamper,
    TorsionSpringDamper,
)
from mechanism_fmu.simulation import Simulation

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


def test_the_work_of_weights_is_work_done_as_the_page_says():
    """2 kg that fall by h = g t^2/2 have been given m g h, and nothing is stored."""
    page = " ".join((Path(__file__).parents[2] / "docs" / "reference" / "fmu.md").read_text(encoding="utf-8").split())
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
