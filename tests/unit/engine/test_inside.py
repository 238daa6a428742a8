"""An open gap below zero is a penetration: it is refused with its contact, its depth and the time, by whatever came."""

import math

import numpy as np
import pytest
from rotor import INERTIA, rotor

from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    Body,
    CircularPattern,
    LogicalFunction,
    Mechanism,
    MechanismError,
    Output,
    PointLineContact,
    Revolute,
    rigid_body,
)
from mechanism_fmu.simulation import Simulation, SimulationError
from mechanism_fmu.tolerances import MARGIN

#: Distance of the flats of a square from its middle, about which a point turns at a radius of 1 m.
FLAT = 0.6


def around_a_square(boundary: float, speed: float, restitution: float = 0.0, **contact: object) -> Mechanism:
    """A point at cos t, sin t outside of a square whose flats are FLAT from its middle, and their boundary [rad]."""
    pattern = CircularPattern(
        "flats",
        "rotor",
        (1.0, 0.0),
        "square",
        math.pi / 2,
        (0.0, 0.0),
        (-math.sin(boundary), math.cos(boundary)),
    )
    flat = PointLineContact(
        "flat",
        "rotor",
        (1.0, 0.0),
        "square",
        (FLAT, 0.0),
        (1.0, 0.0),
        restitution=restitution,
        pattern="flats",
        **contact,
    )
    square = Body("square", 1.0, 1.0)
    return Mechanism(
        bodies=(Body("rotor", 1.0, INERTIA, (0.0, 0.0, 0.0), (0.0, 0.0, speed)), square),
        joints=(
            Revolute("hinge", "rotor", (0.0, 0.0), GROUND, (0.0, 0.0)),
            Revolute("square_hinge", "square", (0.0, 0.0), GROUND, (0.0, 0.0)),
        ),
        contacts=(flat,),
        patterns=(pattern,),
        functions=(LogicalFunction("on", of="flat.along", below=10.0),) if contact.get("closed_while") else (),
        outputs=(Output("gap", "flat.gap", "Gap"), Output("index", "flats.index", "Copy")),
    )


@pytest.mark.parametrize("restitution", [0.0, 0.5])
@pytest.mark.parametrize("speed", [1.0, -1.0])
def test_a_pattern_that_goes_on_to_a_copy_behind_whose_line_the_point_is(speed, restitution):
    """At 30 deg, before the corner at 45 deg: there the gap to the next flat is sin 30 deg - FLAT = -0.1 m."""
    boundary = math.radians(30 if speed > 0 else 60)
    simulation = Simulation(around_a_square(boundary, speed, restitution))
    for _ in range(2):  # it is the same when it is asked again, whatever was read meanwhile
        with pytest.raises(SimulationError) as caught:
            simulation.advance(2.0)
        text = str(caught.value)
        assert text.startswith(f"t = {simulation.time:.9g} s: Two bodies that may touch have gone into each other")
        assert text.endswith(" Contact 'flat': the point of 'rotor' is 0.1 m behind the line on 'square'.")
        late = MARGIN * simulation.field("scales")[0]  # by which a boundary is passed before it counts, at some 1 m/s
        assert simulation.time == pytest.approx(math.pi / 6, abs=2.0 * late)
        assert simulation.read()["gap"] == pytest.approx(-0.1, abs=2.0 * late)
        assert simulation.impacts_in_step() == []


@pytest.mark.parametrize("speed", [1.0, -1.0])
def test_a_boundary_through_the_corner_is_passed(speed):
    """A flat 0.7 m from the middle leaves 7 mm at the corner, from either side."""
    simulation = Simulation(around_a_square(math.pi / 4, speed))
    simulation.advance(0.9)
    assert simulation.read()["index"] == speed


@pytest.mark.parametrize("contact", [{"enabled": False}, {"closed_while": "not on"}])
def test_behind_what_is_no_one_sided_contact_a_point_may_be(contact):
    simulation = Simulation(around_a_square(math.radians(30), 1.0, **contact))
    simulation.advance(2.0)
    assert simulation.read()["index"] == 1


def bead(gap: float, speed: float = 0.0, **contact: object) -> Mechanism:
    """A bead above a floor."""
    body = rigid_body("bead", (0.0, gap), mass=1.0, inertia=1.0, velocity=(0.0, speed))
    floor = PointLineContact("floor", body, GROUND.line((0.0, 0.0), (1.0, 0.0)), **contact)
    return Mechanism(bodies=(body,), contacts=(floor,), outputs=(Output("gap", "floor.gap", "Gap"),))


@pytest.mark.parametrize("depth", [1e-3, 1.4e-8])  # a bead with a radius of gyration of 1 m touches within 13 nm
@pytest.mark.parametrize("speed", [-1.0, 0.0, 1.0])
def test_what_is_inside_when_a_step_begins(depth, speed):
    """Whether it goes deeper, rests or comes out: nothing was there that could have brought it in."""
    simulation = Simulation(bead(0.5, speed))
    simulation.advance(0.1)
    simulation.field("y_end")[1] = -depth
    simulation.field("clock")[[2, 0]] = simulation.time
    before = simulation.field("y_end").copy()
    expected = rf"t = 0\.1 s: .* Contact 'floor': the point of 'bead' is {depth:.6g} m behind the line on 'ground'\.$"
    with pytest.raises(SimulationError, match=expected):
        simulation.advance(0.2)
    np.testing.assert_array_equal(simulation.field("y_end"), before)
    simulation.field("y_end")[1] = 0.5  # a step that is refused changes nothing
    simulation.advance(0.2)
    assert simulation.read()["gap"] == pytest.approx(0.5 + speed * 0.1)


def test_what_touches_may_be_a_nanometre_inside():
    simulation = Simulation(bead(0.5, 0.25))
    simulation.field("y_end")[1] = -0.9e-9
    simulation.advance(1.0)
    assert simulation.read()["gap"] == pytest.approx(0.25, abs=1e-8)


def test_the_start_is_refused_in_the_same_way():
    with pytest.raises(MechanismError, match=r"Contact 'floor': the point of 'bead' is 0\.25 m behind the line"):
        Simulation(bead(-0.25))


def test_the_deepest_of_several_is_named():
    body = rigid_body("bead", (0.5, 0.5), mass=1.0, inertia=1.0)
    floor = PointLineContact("floor", body, GROUND.line((0.0, 0.0), (1.0, 0.0)))
    wall = PointLineContact("wall", body, GROUND.line((0.0, 0.0), (0.0, -1.0)))
    simulation = Simulation(Mechanism(bodies=(body,), contacts=(floor, wall)))
    simulation.advance(0.1)
    simulation.field("y_end")[:2] = [-0.2, -0.1]
    simulation.field("clock")[[2, 0]] = simulation.time
    with pytest.raises(SimulationError, match=r"Contact 'wall': the point of 'bead' is 0\.2 m behind"):
        simulation.advance(1.0)


def test_a_stop_of_angles():
    stop = AngleStop("stop", "rotor", GROUND, angle=-1.0)
    mechanism = rotor(speed=0.1)
    simulation = Simulation(Mechanism(mechanism.bodies, mechanism.joints, mechanism.forces, (stop,)))
    simulation.advance(0.1)
    simulation.field("y_end")[2] = -1.25
    simulation.field("clock")[[2, 0]] = simulation.time
    with pytest.raises(SimulationError, match=r"Contact 'stop': 'rotor' is 0\.25 rad beyond its stop on 'ground'"):
        simulation.advance(1.0)


def test_far_away_and_fast_a_gap_is_a_small_difference_of_large_numbers():
    """At 1e7 m, doubles are 2e-9 m apart: what an impact leaves there is not inside; but 1 mm is."""
    far = 1e8 / 7
    body = rigid_body("ball", (0.0, -far), mass=1.0, inertia=1.0, velocity=(0.0, 1e8))
    lid = PointLineContact("lid", body, GROUND.line((0.0, far), (-1.0, 0.0)), restitution=0.5)
    simulation = Simulation(Mechanism(bodies=(body,), contacts=(lid,)))
    simulation.advance(3 * far / 1e8)
    assert len(simulation.impacts_in_step()) == 1
    y = simulation.field("y_end")
    y[1], y[4] = far + 1e-3, 0.0
    simulation.field("clock")[[2, 0]] = simulation.time
    with pytest.raises(SimulationError, match=r"the point of 'ball' is 0\.001 m behind the line"):
        simulation.advance(1.0)
