"""Where rigid bodies with friction have no forces, or several, or motions that nothing determines: all are named."""

import json
import math
from dataclasses import replace
from pathlib import Path

import pytest

from benchmarks.world.cases.painleve_rod import FRICTION, GRAVITY, HALF, MASS, START, rod
from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    Body,
    Brake,
    Mechanism,
    Output,
    PointLineContact,
    Revolute,
    Torque,
    bar,
    rigid_body,
)
from mechanism_fmu.simulation import Simulation, SimulationError, friction_solutions
from models.slider_crank import model as slider_crank

FLOOR = GROUND.line((0, 0), (1, 0))
#: The rod of the oracle, which comes to the point where A and b vanish together.
(CASE,) = (
    case
    for case in json.loads((Path(__file__).parents[1] / "data" / "friction.json").read_text(encoding="utf-8"))["cases"]
    if any("jam" in one for one in case["results"].get("runs", ()))
)
(RUN,) = (one for one in CASE["results"]["runs"] if "jam" in one)


def started(method: int, **law: bool) -> Simulation:
    return Simulation(rod(RUN["theta0"], RUN["thetadot0"], RUN["vT0"], RUN["mu"], method=method, **law))


def test_the_rod_is_that_of_the_oracle() -> None:
    assert CASE["data"] == {"m": MASS, "l": HALF, "g": GRAVITY}


METHODS = pytest.mark.parametrize("method", [codes.EXPLICIT, codes.IMPLICIT_METHOD])


def guards(simulation: Simulation) -> list[str]:
    return [event.guard for event in simulation.events_in_step()]


@METHODS
def test_the_end_of_all_forces_is_named_with_contact_coefficient_angle_and_criterion(method: int) -> None:
    simulation = started(method)
    expected = (
        rf"Painleve.*Contacts: floor\. Friction: floor \({RUN['mu']:g}, at 0\.820761 rad, slips, A/G = -?\d\.\d+e-1\d\)"
    )
    with pytest.raises(SimulationError, match=expected):
        simulation.advance(1.0)
    assert simulation.time == pytest.approx(RUN["jam"]["t"], abs=1e-10)


@METHODS
def test_a_shock_leads_on_and_takes_energy(method: int) -> None:
    simulation = started(method, tangential_shock=True)
    before = simulation.read()
    shocks = 0
    for k in range(1, 60):
        simulation.advance(0.002 * k)
        shocks += guards(simulation).count("floor.shock")
        found = simulation.read()
        assert found["kinetic"] - found["work"] + found["lost"] == pytest.approx(before["kinetic"], rel=1e-8)
    assert shocks == 1


@pytest.mark.parametrize("tolerance", [1e-7, 1e-8, 1e-9, 1e-10, 1e-12])
def test_a_shock_leads_on_however_the_end_is_met(tolerance: float) -> None:
    """Mending drift may leave the friction of what would stick some 1e-11 of it on either side of its bound."""
    simulation = Simulation(rod(*START, FRICTION, tolerance, tangential_shock=True))
    simulation.advance(0.12)
    assert guards(simulation) == ["floor.shock"]


@pytest.mark.parametrize("mass", [1e-3, 3e-7, 1e-8])
def test_a_shock_stops_nothing_else_however_light(mass: float) -> None:
    """A bead that slides 20 m away on the same floor goes on."""
    made = rod(*START, FRICTION, 1e-7, tangential_shock=True)
    bead = rigid_body("bead", (20.0, 0.0), mass=mass, inertia=mass * 1e-2, velocity=(2.0, 0.0))
    slides = PointLineContact("bead_floor", bead.at(0.0, 0.0), FLOOR, closed=True, friction=0.1)
    outputs = (Output("v", bead.x_rate, ""),)
    both = replace(made, bodies=(*made.bodies, bead), contacts=(*made.contacts, slides), outputs=outputs)
    simulation = Simulation(both)
    simulation.advance(0.11)
    assert "floor.shock" in guards(simulation)
    assert simulation.read()["v"] == pytest.approx(2.0 - 0.1 * GRAVITY * 0.11, rel=1e-9)


@pytest.mark.parametrize("friction", [0.15, 0.3])
def test_pins_without_forces_are_named_and_stopped_by_a_shock(friction: float) -> None:
    """Pins thicker than the crank is long: friction outgrows what it is caused by, from 0.1405 m on."""
    model = slider_crank.MODEL
    mechanism = model.build(model.values(joint_friction_radius=friction))
    assert not friction_solutions(mechanism)
    moving = Simulation(model.build(model.values(joint_friction_radius=0.0))).read()["kinetic_energy"]
    with pytest.raises(
        SimulationError, match=rf"Painleve.*Friction: crank_hinge \({friction:g}, at .*crank_pin.*slider_pin"
    ):
        Simulation(mechanism).advance(0.1)
    simulation = Simulation(replace(mechanism, tangential_shock=True))
    simulation.advance(0.1)
    assert guards(simulation) == ["crank_hinge.shock"]
    assert simulation.read()["kinetic_energy"] < 1e-15
    assert simulation.read()["energy_lost"] == pytest.approx(moving, rel=1e-9)


def test_pins_with_one_solution_go_on() -> None:
    """A fixed point of friction and pin forces diverges here, although there is one motion."""
    model = slider_crank.MODEL
    mechanism = model.build(model.values(joint_friction_radius=0.13))
    assert len(friction_solutions(mechanism)) == 1
    Simulation(mechanism).advance(0.01)


def test_several_solutions_are_an_event() -> None:
    line = next(line for line in CASE["results"]["table"] if line["kind"] == "two")
    mechanism = rod(line["theta"], line["thetadot"], line["sigma"], line["mu"])
    assert len(friction_solutions(mechanism)) == 2
    assert guards(Simulation(mechanism)) == ["floor.several"]


def test_two_motions_of_a_chain_of_bars_are_an_event() -> None:
    """Where a pin between three bars comes to rest, it may stick, or slip on: by all modes, both agree."""
    bodies: list[Body] = []
    joints = []
    start = (0.0, 0.0)
    for k, (angle, radius) in enumerate([(-0.5 * math.pi, 0.4), (0.0, 0.4), (0.5 * math.pi, 0.5)]):
        end = (start[0] + math.cos(angle), start[1] + math.sin(angle))
        bodies.append(bar(f"bar{k}", start, end, mass=1.0))
        before = bodies[k - 1].b if k > 0 else GROUND.at(0.0, 0.0)
        joints.append(Revolute(f"pin{k}", bodies[k].a, before, friction_radius=radius))
        start = end
    chain = Mechanism(tuple(bodies), tuple(joints), gravity=(0.0, -GRAVITY))
    simulation = Simulation(chain)
    simulation.advance(0.3)
    (time,) = (event.time for event in simulation.events_in_step() if event.guard.endswith(".several"))

    there = Simulation(chain)
    there.begin_step()
    while there.time < time:
        there.go_on(0.3, codes.STOP_AT_EVENT)
    y = there.field("y_end")[:18].reshape(6, 3)
    bodies = [replace(body, start=tuple(y[k]), start_rate=tuple(y[3 + k])) for k, body in enumerate(bodies)]
    one, other = friction_solutions(replace(chain, bodies=tuple(bodies)))
    assert {one.modes["pin2"], other.modes["pin2"]} == {"sticks", "slips forwards"}
    assert abs(one.accelerations["bar2"][2] - other.accelerations["bar2"][2]) > 0.5


@pytest.mark.parametrize(
    ("frictions", "named"),
    [((0.1, 0.4, 0.2), ["foot0.undetermined"]), ((0.2, 0.2, 0.2), []), ((0.1, 0.2, 0.3), [])],
    ids=["unequal", "equal", "linear along the plank"],
)
def test_a_plank_on_three_feet(frictions: tuple[float, ...], named: list[str]) -> None:
    """Normal forces are determined up to (1, -2, 1): that changes the friction unless mu is linear along the plank."""
    plank = rigid_body("plank", (0.0, 0.0), mass=2.0, inertia=0.3, velocity=(1.0, 0.0))
    feet = tuple(
        PointLineContact(f"foot{k}", plank.at(0.4 * (k - 1), 0.0), FLOOR, closed=True, friction=mu)
        for k, mu in enumerate(frictions)
    )
    outputs = (Output("v", "plank.x_rate", "", "m/s"),)
    simulation = Simulation(Mechanism((plank,), contacts=feet, gravity=(0.0, -9.81), outputs=outputs))
    assert guards(simulation) == named
    simulation.advance(0.2)
    if not named:
        assert simulation.read()["v"] == pytest.approx(1.0 - frictions[1] * 9.81 * 0.2, abs=1e-12)


def test_an_overconstrained_pin_that_slips_is_undetermined() -> None:
    """Two pins on one axis share the load at will: with unequal friction their torque does, too."""
    rotor = rigid_body("rotor", (0.0, 0.0), mass=1.0, inertia=0.1, speed=5.0)
    for radii, named in (((0.01, 0.02), ["left.undetermined"]), ((0.01, 0.0), ["left.undetermined"])):
        pins = tuple(
            Revolute(name, rotor, GROUND, friction_radius=radius)
            for name, radius in zip(("left", "right"), radii, strict=True)
        )
        assert guards(Simulation(Mechanism((rotor,), pins, gravity=(0.0, -9.81)))) == named


def test_two_brakes_on_one_shaft_both_stick() -> None:
    """Friction of one is at its bound without moving anything, as the other holds: nothing slides."""
    disc = rigid_body("disc", (0.0, 0.0), mass=1.0, inertia=0.1)
    simulation = Simulation(
        Mechanism(
            (disc,),
            (Revolute("shaft", disc, GROUND),),
            (Brake("small", disc, limit=1.0), Brake("large", disc, limit=10.0), Torque("load", disc, torque=8.0)),
            outputs=(Output("small", "small.sticks", "", "1"), Output("large", "large.sticks", "", "1")),
        )
    )
    simulation.advance(10.0)
    assert simulation.read() == {"small": 1.0, "large": 1.0}
    assert simulation.counters[codes.COUNT_EVENTS] == 0
