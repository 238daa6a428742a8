"""As many contacts as memory holds: their modes in the records of events, and what touches and rests at once."""

from dataclasses import replace

import numpy as np
import pytest
from rotor import Stop, rotor

from mechanism_fmu import codes
from mechanism_fmu.advice import MOST_NAMED, named
from mechanism_fmu.model import GROUND, Mechanism, MechanismError, Outline, OutlineContact, Output, Revolute, rigid_body
from mechanism_fmu.simulation import Simulation
from tests.falling_blocks import GRAVITY, LANDS, LOW, MASS, blocks

OF_BLOCK = 2


@pytest.mark.parametrize(("count", "words"), [(49, 1), (50, 1), (51, 2), (100, 2), (101, 3), (200, 4)])
def test_the_modes_of_many_contacts_take_several_numbers(count, words):
    """The first and the last stop hold the arm: bit 0 of the first number, and the last bit of the last one."""
    stops = [Stop(0.3), *(Stop(0.4 + 0.001 * k) for k in range(count - 2)), Stop(0.3)]
    simulation = Simulation(rotor(stops, acceleration=1.0))
    simulation.advance(1.0)
    record = simulation.field("events")[0]
    assert len(record) == codes.EVENT_COLUMNS + 2 * (words - 1)
    new = [0] * words
    new[0] += 1
    new[-1] += 2 ** ((count - 1) % codes.MODE_BITS)
    assert record[codes.EVENT_NEW_MODE :: 2].tolist() == new
    assert not record[codes.EVENT_OLD_MODE :: 2].any()
    (event,) = simulation.events_in_step()
    assert (event.old_mode, event.new_mode) == ((), ("stop0", f"stop{count - 1}"))


@pytest.mark.parametrize("count", [30, 100])
def test_blocks_that_land_one_after_the_other(count):
    """Block k lands at LANDS (k + 1) with both points, at once, which take m v = m g t together."""
    simulation = Simulation(blocks(count))
    names = tuple(f"{side}{k}" for k in range(count) for side in ("left", "right"))
    for k in range(count):
        lands = LANDS * (k + 1)
        simulation.advance(lands + 0.5 * LANDS)
        (event,) = simulation.events_in_step()
        assert event.time == pytest.approx(lands, abs=1e-12)
        assert event.old_mode == names[: 2 * k]
        assert event.new_mode == names[: 2 * k + 2]
        assert event.impulse == pytest.approx(MASS * GRAVITY * lands)
    assert simulation.mode() == names
    forces = simulation.read()
    assert forces["force"] == pytest.approx(MASS * GRAVITY / 2)
    assert forces["last_force"] == pytest.approx(MASS * GRAVITY / 2)


def test_a_restored_state_brings_the_modes_of_all():
    simulation = Simulation(blocks(60))
    simulation.advance(45.5 * LANDS)
    saved = simulation.state.copy()
    simulation.advance(60.5 * LANDS)
    last = simulation.events_in_step()
    simulation.state[:] = saved
    assert simulation.mode() == tuple(f"{side}{k}" for k in range(45) for side in ("left", "right"))
    simulation.advance(60.5 * LANDS)
    assert simulation.events_in_step() == last


@pytest.mark.parametrize("count", [30, 100])
def test_outlines_that_all_land_in_one_instant(count):
    """Two corners of each block on one floor, where they stay; each pair of outlines has three places."""
    square = Outline.polygon(((-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)))
    floor = Outline.chain(((100.0, 0.0), (-100.0, 0.0)))
    bodies = tuple(rigid_body(f"block{k}", (0.3 * k, 0.15), mass=MASS, inertia=0.01) for k in range(count))
    contacts = tuple(
        OutlineContact(f"floor{k}", body, GROUND, outline_i=square, outline_j=floor) for k, body in enumerate(bodies)
    )
    simulation = Simulation(Mechanism(bodies, contacts=contacts, gravity=(0.0, -GRAVITY)))
    simulation.advance(0.2)
    assert len(simulation.mode()) == OF_BLOCK * count
    (event,) = simulation.events_in_step()
    assert event.time == pytest.approx(0.1, abs=1e-9)
    assert (event.old_mode, event.new_mode) == ((), simulation.mode())
    assert event.impulse == pytest.approx(count * MASS * GRAVITY * 0.1)
    y = simulation.field("y_end")[1 : 3 * count : 3]
    np.testing.assert_allclose(y, 0.1, atol=2e-9)


@pytest.mark.parametrize("count", [16, 100])
def test_only_an_output_of_the_mode_is_refused(count):
    """An Integer of FMI has 31 bits."""
    mechanism = blocks(count)
    outputs = (Output("mode", "events[1].new_mode", "Closed contacts", type="Integer"),)
    with pytest.raises(MechanismError, match=rf"a bit for each of {2 * count} contacts, and an Integer of FMI has 31"):
        Simulation(Mechanism(mechanism.bodies, contacts=mechanism.contacts, outputs=outputs))


def test_a_failure_among_many_names_the_first():
    names = [f"c{k}" for k in range(60)]
    assert named(names, "+") == "+".join(names[:MOST_NAMED]) + f"+{60 - MOST_NAMED} more"
    assert named(names[:MOST_NAMED], ", ") == ", ".join(names[:MOST_NAMED])


def test_a_thousand_contacts_that_strike_in_one_instant():
    """Five hundred blocks land flat at 0.1 s: one event of a thousand impacts, each of which takes m v / 2."""
    count, lands = 500, 0.1
    height = 0.5 * GRAVITY * lands**2
    standing = blocks(count)
    bodies = tuple(replace(body, start=(body.start[0], LOW + height, 0.0)) for body in standing.bodies)
    simulation = Simulation(replace(standing, bodies=bodies))
    simulation.advance(1.5 * lands)
    (event,) = simulation.events_in_step()
    assert event.time == pytest.approx(lands, abs=1e-12)
    assert (event.old_mode, event.new_mode) == ((), simulation.mode())
    assert len(event.new_mode) == OF_BLOCK * count
    assert event.impulse == pytest.approx(count * MASS * GRAVITY * lands)
    outputs = simulation.read()
    assert outputs["impacts"] == OF_BLOCK * count
    assert outputs["force"] == outputs["last_force"] == pytest.approx(MASS * GRAVITY / 2)
    np.testing.assert_allclose(simulation.field("y_end")[1 : 3 * count : 3], LOW, atol=1e-12)


def test_a_chain_of_three_hundred_bodies():
    """Links of 1 m hang level from one end and are let go: the energy of all is kept, and each pin."""
    count, links, joints, last = 300, [], [], GROUND.at(0.0, 0.0)
    for k in range(count):
        link = rigid_body(f"link{k}", (k + 0.5, 0.0), mass=MASS, inertia=MASS / 12.0)
        joints.append(Revolute(f"pin{k}", last, link.at(-0.5, 0.0)))
        last = link.at(0.5, 0.0)
        links.append(link)
    simulation = Simulation(Mechanism(tuple(links), joints=tuple(joints), gravity=(0.0, -GRAVITY)))
    simulation.advance(0.05)
    y = simulation.field("y_end")
    position, rate = y[: 3 * count].reshape(-1, 3), y[3 * count : 6 * count].reshape(-1, 3)
    kinetic = 0.5 * MASS * (np.sum(rate[:, :2] ** 2) + np.sum(rate[:, 2] ** 2) / 12.0)
    assert kinetic == pytest.approx(-MASS * GRAVITY * np.sum(position[:, 1]), rel=1e-8)
    assert kinetic > 1.0
    end = position[:, :2] + 0.5 * np.column_stack([np.cos(position[:, 2]), np.sin(position[:, 2])])
    start = position[:, :2] - 0.5 * np.column_stack([np.cos(position[:, 2]), np.sin(position[:, 2])])
    np.testing.assert_allclose(start, np.vstack([[0.0, 0.0], end[:-1]]), atol=1e-10)
