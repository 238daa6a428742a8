"""Several contacts struck at one instant: corners, flat falls, random heaps."""

import math

import numpy as np
import pytest
from hypothesis import assume, example, given, settings, strategies as st
from touching import touching

from mechanism_fmu import codes
from mechanism_fmu.engine.dynamics.scaling import LENGTH, RATE
from mechanism_fmu.model import GROUND, Body, Force, Mechanism, Output, PointLineContact
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tolerances import STICK_SPEED

MASS = 0.7
ENERGIES = tuple(Output(name, f"energy.{name}", "") for name in ("kinetic", "work", "lost"))


def wall(name, angle, restitution):
    """The ball's centre against a wall through the origin whose normal has the polar angle `angle`."""
    return PointLineContact(
        name, "ball", (0.0, 0.0), GROUND, (0.0, 0.0), (math.cos(angle), math.sin(angle)), restitution=restitution
    )


def ball_into_corner(walls, start, rate):
    body = Body("ball", MASS, 0.1, (*start, 0.0), (*rate, 0.0))
    return Simulation(Mechanism(bodies=(body,), contacts=tuple(walls), outputs=ENERGIES))


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("half", [15, 45, 60, 80])
def test_a_ball_flies_into_a_corner_along_its_middle_line_and_comes_back_with_e_times_the_speed(half, restitution):
    """Walls at +-half from the x axis: both are struck at t = 1, and their impulses are equal."""
    walls = [wall(f"wall{s}", s * math.radians(90 - half), restitution) for s in (1, -1)]
    simulation = ball_into_corner(walls, (1.0, 0.0), (-1.0, 0.0))
    simulation.advance(1.5)
    hits = simulation.impacts_in_step()
    assert [hit.contact for hit in hits] == ["wall1", "wall-1"]
    closing = math.sin(math.radians(half))
    for hit in hits:
        assert hit.time == pytest.approx(1.0, abs=1e-12)
        assert hit.closing_speed == pytest.approx(closing, rel=1e-12)
        assert hit.impulse == pytest.approx((1 + restitution) * MASS / (2 * closing), rel=1e-10)
    (event,) = simulation.events_in_step()
    assert event.old_mode == ()
    assert event.new_mode == (() if restitution else ("wall1", "wall-1"))
    assert event.impulse == pytest.approx((1 + restitution) * MASS / closing, rel=1e-10)
    np.testing.assert_allclose(simulation.field("y_end")[3:6], [restitution, 0.0, 0.0], rtol=1e-12, atol=1e-12)
    assert simulation.read()["lost"] == pytest.approx(MASS / 2 * (1 - restitution**2), rel=1e-12, abs=1e-15)


@settings(deadline=None, max_examples=40)
@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.floats(0.1, 10.0))
def test_walls_at_right_angles_do_not_know_of_each_other(e_floor, e_wall, speed):
    rests = STICK_SPEED / (LENGTH * RATE)  # of a ball that nothing but its speed moves, in parts of that
    assume(all(abs(e - rests) > 1e-11 for e in (e_wall, e_floor)))  # right there, rounding decides
    walls = [wall("floor", math.pi / 2, e_floor), wall("wall", 0.0, e_wall)]
    simulation = ball_into_corner(walls, (1.0, 1.0), (-speed, -speed))
    simulation.advance(1.5 / speed)
    assert {hit.contact: hit.impulse for hit in simulation.impacts_in_step()} == pytest.approx(
        {"floor": (1 + e_floor) * MASS * speed, "wall": (1 + e_wall) * MASS * speed}, rel=1e-5
    )
    expected = [e * speed if e >= rests else 0.0 for e in (e_wall, e_floor)]
    np.testing.assert_allclose(simulation.field("y_end")[3:5], expected, rtol=1e-12, atol=1e-10)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_a_block_that_falls_flat_on_two_feet_rises_without_turning(restitution):
    """Each foot alone would turn it."""
    height, gravity = 0.5, 10.0
    feet = [
        PointLineContact(f"foot{k}", "block", (x, 0.0), GROUND, (0.0, 0.0), (0.0, 1.0), restitution=restitution)
        for k, x in enumerate((-0.4, 0.4))
    ]
    block = Mechanism(
        bodies=(Body("block", MASS, 0.1, (0.0, height, 0.0)),),
        forces=(Force("weight", "block", (0.0, -MASS * gravity)),),
        contacts=tuple(feet),
        outputs=(*ENERGIES, Output("y", "block.y", ""), Output("angle", "block.angle", "")),
    )
    simulation = Simulation(block)
    fall = math.sqrt(2 * height / gravity)
    simulation.advance(1.01 * fall)
    speed = gravity * fall
    for hit in simulation.impacts_in_step():
        assert hit.time == pytest.approx(fall, abs=1e-12)
        assert hit.impulse == pytest.approx((1 + restitution) * MASS * speed / 2, rel=1e-10)
    assert len(simulation.impacts_in_step()) == 2
    simulation.advance(fall * max(1.01, 1 + restitution))
    found = simulation.read()
    assert found["y"] == pytest.approx(restitution**2 * height, abs=1e-10)
    assert found["angle"] == pytest.approx(0.0, abs=1e-10)
    assert found["lost"] == pytest.approx((1 - restitution**2) * MASS * gravity * height, rel=1e-9, abs=1e-12)


def test_a_block_that_falls_flat_beside_its_centre_of_mass_turns_about_the_near_foot():
    """e = 0: the far foot would have to pull and takes no part, though it touches."""
    near, far, inertia = 0.2, 0.6, 0.1
    feet = [
        PointLineContact(f"foot{k}", "block", (x, 0.0), GROUND, (0.0, 0.0), (0.0, 1.0))
        for k, x in enumerate((far, near))
    ]
    body = Body("block", MASS, inertia, (0.0, 1.0, 0.0), (0.0, -1.0, 0.0))
    simulation = Simulation(Mechanism(bodies=(body,), contacts=tuple(feet)))
    simulation.advance(1.0 + 1e-6)
    impulse = 1.0 / (1 / MASS + near**2 / inertia)
    assert {hit.contact: hit.impulse for hit in simulation.impacts_in_step()} == pytest.approx(
        {"foot0": 0.0, "foot1": impulse}
    )
    spin = near * impulse / inertia
    np.testing.assert_allclose(simulation.field("y_end")[4:6], [impulse / MASS - 1.0, spin], rtol=0, atol=2e-5)


def after_the_impacts(heap):
    """Rates, and energies, right after what happens at t = 0."""
    simulation = Simulation(heap.mechanism)
    n = len(heap.masses)
    before = simulation.read()["kinetic"]
    simulation.advance(1e-12)
    return simulation, before, simulation.field("dense")[0, n : 2 * n]


@settings(deadline=None, max_examples=200)
@given(st.integers(0, 2**32), st.integers(1, 3), st.integers(1, 8), st.sampled_from([None, 0.0, 1.0]))
def test_energy_never_grows_and_nothing_goes_on_approaching(seed, bodies, contacts, restitution):
    """Whatever each contact's own restitution is."""
    heap = touching(seed, bodies=bodies, contacts=contacts, moving=True, restitution=restitution)
    simulation, before, rates = after_the_impacts(heap)
    assert np.all(heap.rows @ rates >= -2e-9)
    assert heap.masses @ rates**2 / 2 <= before * (1 + 1e-12)
    found = simulation.read()
    assert found["lost"] >= -1e-12 * before
    assert heap.masses @ rates**2 / 2 + found["lost"] == pytest.approx(before, rel=1e-10)


@pytest.mark.parametrize(("seed", "contacts"), [(22638, 7), (3168, 6)])
def test_a_body_caged_by_its_contacts_comes_to_rest(seed, contacts):
    """Leftovers of the rounds before, below the stick speed, must not leave the last rounds without a solution."""
    heap = touching(seed, bodies=1, contacts=contacts, moving=True)
    _, _, rates = after_the_impacts(heap)
    np.testing.assert_allclose(rates, 0.0, atol=1e-9)


def test_of_rows_that_contradict_each_other_the_one_that_comes_off_is_open():
    """Four contacts of a body with three coordinates cannot all return with their own e: s'+ >= e |s'-|."""
    heap = touching(4846990, bodies=1, contacts=4, moving=True)
    simulation, _, _ = after_the_impacts(heap)
    _, _, before, after, _ = np.split(
        simulation.field("impacts")[0], np.cumsum([codes.RECORD_CONTACT_IMPULSES, 4, 3, 3])
    )
    restitution = np.array([contact.restitution for contact in heap.mechanism.contacts])
    assert np.all(heap.rows @ before < 0)
    assert np.all(heap.rows @ after >= -restitution * (heap.rows @ before) - 1e-10)


def islands(heap):
    """Contacts that share bodies, or are joined by others that do, by number."""
    left = dict(enumerate(heap.rows != 0.0))
    while left:
        first = next(iter(left))
        moved, found = left.pop(first), [first]
        while more := [c for c, entries in left.items() if np.any(entries & moved)]:
            moved = np.any([moved, *(left.pop(c) for c in more)], axis=0)
            found += more
        yield sorted(found), np.repeat(moved.reshape(-1, 3).any(axis=1), 3)


@settings(deadline=None, max_examples=200)
@given(st.integers(0, 2**32), st.integers(1, 3), st.integers(2, 8))
@example(seed=1_347_455_789, bodies=3, contacts=7)  # of two islands, one approaches so slowly that it strikes by itself
@example(seed=1_347_455_789, bodies=3, contacts=5)
def test_the_first_round_obeys_newtons_law_with_impulses_that_only_push(seed, bodies, contacts):
    """Of the contacts of each island that approach: p >= 0, s'+ >= e |s'-|, p (s'+ - e |s'-|) = 0."""
    heap = touching(seed, bodies=bodies, contacts=contacts, moving=True)
    simulation, _, _ = after_the_impacts(heap)
    hits = simulation.field("impacts")[: simulation.counters[codes.COUNT_IN_STEP]]
    assume(simulation.counters[codes.COUNT_LOST] == 0)
    for island, moved in islands(heap):
        obeys_newtons_law(heap, island, moved, hits[np.isin(hits[:, codes.RECORD_CONTACT], island)])


def obeys_newtons_law(heap, island, moved, hits):
    """As the test says, of the contacts of one island, the coordinates that they move, and their impacts."""
    closing = -heap.rows @ heap.rates
    struck = np.array([c for c in island if closing[c] > 1e-9], dtype=int)
    if len(struck) == 0:
        assert len(hits) == 0
        return
    assert list(hits[: len(struck), codes.RECORD_CONTACT]) == list(struck)
    n = len(heap.masses)
    parts = np.cumsum([codes.RECORD_CONTACT_IMPULSES, len(heap.rows), n, n])
    _, impulses, before, after, _ = np.split(hits[0], parts)
    np.testing.assert_allclose(before[moved], heap.rates[moved], rtol=0, atol=1e-15)
    if len(hits) > len(struck):  # later rounds have their impulses, too, and the rates after are those after the last
        return
    np.testing.assert_allclose(hits[: len(struck), codes.RECORD_CLOSING_SPEED], closing[struck], rtol=1e-9)
    own = np.zeros(len(heap.rows))
    own[island] = impulses[island]
    size = np.abs(own).max()
    change = heap.rows.T @ own / heap.masses
    np.testing.assert_allclose((after - heap.rates - change)[moved], 0.0, rtol=0, atol=1e-10 * max(1.0, size))
    returned = np.array([contact.restitution for contact in heap.mechanism.contacts]) * closing
    stays = returned[struck] < 1e-5  # so slowly it may stay closed
    opens = (heap.rows @ after)[struck]
    excess = np.where(stays, opens, opens - returned[struck])
    assert own.min() >= -1e-10 * size
    assert not np.any(np.delete(own, struck))
    assert excess.min() >= -1e-9
    left = np.minimum(np.abs(opens - returned[struck]), np.where(stays, np.abs(opens), np.inf))
    np.testing.assert_allclose(own[struck] * left, 0.0, atol=1e-8 * max(1.0, size))


@settings(deadline=None, max_examples=100)
@given(st.integers(0, 2**32), st.integers(1, 3))
def test_one_contact_alone_gives_equation_7(seed, bodies):
    """P = (1 + e) |s'| / (s_q M^-1 s_q^T), and M dqd = s_q^T P."""
    heap = touching(seed, bodies=bodies, contacts=1, moving=True)
    simulation, _, rates = after_the_impacts(heap)
    (row,), (contact,) = heap.rows, heap.mechanism.contacts
    closing = -row @ heap.rates
    impulse = (1 + contact.restitution) * closing / (row / heap.masses @ row) if closing > 0 else 0.0
    assert [hit.impulse for hit in simulation.impacts_in_step()] == pytest.approx([impulse] if closing > 0 else [])
    np.testing.assert_allclose(rates, heap.rates + row / heap.masses * impulse, rtol=0, atol=1e-10)
