"""What the pages of docs/elements warn of is so: numbers, directions and rules that nobody could guess."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from mechanism_fmu import tolerances
from mechanism_fmu.model import (
    GROUND,
    AngleLock,
    Brake,
    CircularPattern,
    LogicalFunction,
    Mechanism,
    Output,
    PointLineContact,
    Revolute,
    SpringDamper,
    TorsionSpring,
    deg,
    rigid_body,
)
from mechanism_fmu.simulation import Simulation, SimulationError

DOCS = Path(__file__).parents[2] / "docs" / "elements"


def wheel(**start):
    """A wheel of 1 kg m2 on a hinge at the origin."""
    body = rigid_body("wheel", (0, 0), mass=1.0, inertia=1.0, **start)
    return body, Revolute("hinge", body, GROUND)


def read(mechanism, time):
    simulation = Simulation(mechanism)
    simulation.advance(time)
    return simulation.read()


@pytest.mark.parametrize(("off", "closes"), [(0.5e-6, True), (2e-6, False)])
def test_a_function_closes_what_is_within_1e_6(off, closes):
    assert tolerances.CLOSES_WITHIN == 1e-6
    body, hinge = wheel(speed=1.0)
    mechanism = Mechanism(
        bodies=(body,),
        joints=(hinge,),
        contacts=(AngleLock("pin", body, GROUND, angle=0.5 + off, pitch="360 deg", closed_while="not free"),),
        functions=(LogicalFunction("free", of=body.angle, below=0.5),),
        outputs=(Output("angle", body.angle, "Of the wheel", "rad"),),
    )
    if closes:
        assert read(mechanism, 1.0)["angle"] == pytest.approx(0.5 + off, abs=1e-9)
    else:
        with pytest.raises(SimulationError, match="A logical function closes a row where the bodies are not on it"):
            read(mechanism, 1.0)


@pytest.mark.parametrize(("direction", "time"), [((1.0, 0.0), 0.75), ((-1.0, 0.0), 0.25)])
def test_along_counts_in_the_direction_in_which_the_line_was_drawn(direction, time):
    """A bead at 2 m/s is 1 m behind (0.5, 0) at 0.75 s; drawn the other way round, it is below 0 from 0.25 s on."""
    bead = rigid_body("bead", (0, 0), mass=1.0, inertia=1.0, velocity=(2.0, 0.0))
    below = 1.0 if direction[0] > 0 else 0.0
    closed = "on" if direction[0] > 0 else "not on"
    mechanism = Mechanism(
        bodies=(bead,),
        contacts=(PointLineContact("rail", bead, GROUND.line((0.5, 0), direction), closed_while=closed),),
        functions=(LogicalFunction("on", of="rail.along", below=below),),
        outputs=(Output("closed", "rail.closed", "Whether it is on the rail"),),
    )
    simulation = Simulation(mechanism)
    simulation.advance(1.0)
    (event,) = simulation.events_in_step()
    assert event.time == pytest.approx(time, abs=1e-9)
    assert simulation.read()["closed"] == 0.0


def patterned(speed, point, below):
    """A wheel with four slots that turns under a fixed bead, and a logical function of the slot."""
    body, hinge = wheel(speed=speed)
    bead = rigid_body("bead", point, mass=1.0, inertia=1.0)
    return Mechanism(
        bodies=(body, bead),
        joints=(hinge,),
        contacts=(PointLineContact("slot", bead, body.line((0, -0.05), (1, 0)), pattern="slots", closed_while="in"),),
        patterns=(CircularPattern("slots", bead, body.line((0, 0), angle=deg(45)), pitch=deg(90)),),
        functions=(LogicalFunction("in", of="slot.along", below=below),),
        outputs=(Output("index", "slots.index", "Slot"), Output("closed", "slot.closed", "Whether it is in")),
    )


def test_a_function_follows_the_copy_of_the_pattern():
    """The bead at 0.2 m is at 0.2 cos(45 deg) m or more along the nearest copy, so never below 0.1 m.

    Along copy 0 alone it would be for more than half of each turn.
    """
    simulation = Simulation(patterned(-1.0, (0.2, 0.0), below=0.1))
    for step in range(1, 70):
        simulation.advance(0.1 * step)
        assert simulation.read()["closed"] == 0.0
    assert simulation.read()["index"] == round(6.9 / deg(90))


def test_a_pattern_is_nothing_to_friction_elsewhere():
    """Each instant, its boundary is looked at; a brake of other bodies slows these, and a pattern's none.

    Once, the brake turned the bead: what the boundary's row had written was taken for the brake's.
    """
    mechanism = patterned(-1.0, (0.2, 0.0), below=0.1)
    disc = rigid_body("disc", (1.0, 0.0), mass=1.0, inertia=0.5, speed=3.0)
    mechanism = replace(
        mechanism,
        bodies=(*mechanism.bodies, disc),
        joints=(*mechanism.joints, Revolute("pin", disc.at(0, 0), GROUND.at(1, 0))),
        forces=(Brake("brake", disc, limit=0.25),),
        outputs=(*(Output(f"{name}.angle", f"{name}.angle", "") for name in ("wheel", "bead", "disc")),),
    )
    simulation = Simulation(mechanism)
    simulation.advance(4.0)
    found = simulation.read()
    assert found["disc.angle"] == pytest.approx(3.0 * 4.0 - 0.5 * 4.0**2 / 2.0, rel=1e-9)
    assert found["wheel.angle"] == pytest.approx(-4.0, rel=1e-9)
    assert found["bead.angle"] == 0.0


def test_a_boundary_is_a_whole_line():
    """Behind the centre of the body, the boundary of copies 0 and 1 has copy 1 on the other side."""
    assert read(patterned(0.0, (-0.2, 0.05), below=-1.0), 0.1)["index"] != 0.0
    assert read(patterned(0.0, (0.2, 0.05), below=-1.0), 0.1)["index"] == 0.0


def test_a_contact_line_has_no_ends():
    ball = rigid_body("ball", (1e3, 0.0), mass=1.0, inertia=1.0)
    floor = PointLineContact("floor", ball, GROUND.line((0, 0), (1, 0)))
    mechanism = Mechanism((ball,), contacts=(floor,), gravity=(0.0, -9.81), outputs=(Output("y", ball.y, "y", "m"),))
    assert read(mechanism, 1.0)["y"] == pytest.approx(0.0, abs=1e-9)


def test_a_positive_preload_pulls_and_turns_clockwise():
    body, hinge = wheel()
    mass = rigid_body("mass", (2, 0), mass=1.0, inertia=1.0)
    mechanism = Mechanism(
        bodies=(body, mass),
        joints=(hinge,),
        forces=(TorsionSpring("coil", body, preload=1.0), SpringDamper("rope", mass, GROUND.at(0, 0), preload=1.0)),
        outputs=(Output("angle", body.angle, "Of the wheel", "rad"), Output("x", mass.x, "Of the mass", "m")),
    )
    assert read(mechanism, 1.0) == pytest.approx({"angle": -0.5, "x": 1.5}, abs=1e-9)


def test_a_free_angle_is_no_angle_from_the_start():
    body, hinge = wheel(angle=1.0)
    spring = TorsionSpring("coil", body, stiffness=1.0, free_angle=1.0)
    mechanism = Mechanism((body,), (hinge,), (spring,), outputs=(Output("speed", body.speed, "Of the wheel", "rad/s"),))
    assert read(mechanism, 1.0)["speed"] == 0.0


def test_tolerances_on_the_pages_are_those_of_the_engine():
    text = " ".join((DOCS / "point_line_contact.md").read_text(encoding="utf-8").split())
    assert re.search(r"negative \(by more than 1e-10 of the", text)
    assert tolerances.TOUCHES_WITHIN == 1e-10
    assert re.search(r"Below 1e-7 of the scale of speeds after an impact", text)
    assert tolerances.STICK_SPEED == 1e-7
    assert "passed by 1e-10" in (DOCS / "logical_function.md").read_text(encoding="utf-8")
    assert tolerances.MARGIN == 1e-10
