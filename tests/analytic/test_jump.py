"""The impact velocity v_I = l (omega after - omega before): one jump for each instant, whatever struck."""

import math
from itertools import groupby

import numpy as np
import pytest
from cycle import DRIVES, free_ratchet, swing
from hypothesis import assume, given, settings, strategies as st

from mechanism_fmu import codes
from mechanism_fmu.model import (
    GROUND,
    AngleLock,
    AngleStop,
    Body,
    Gears,
    LogicalFunction,
    Mechanism,
    Output,
    Revolute,
    Torque,
)
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.stress import STEEL, WedgeTooth, maximum_stress
from mechanism_fmu.tolerances import RESTS_BELOW, STICK_SPEED
from models.ratchet.model import MODEL

LENGTH = 0.03
ENERGIES = (Output("kinetic", "energy.kinetic", ""), Output("lost", "energy.lost", ""))
SPEEDS = (Output("speed", "wheel.speed", ""), Output("after", "impact.speed:wheel", ""))


def wheel(*contacts, inertia=0.2, speed=-1.0, others=(), joints=(), functions=(), forces=()):
    body = Body("wheel", 1.0, inertia, start_rate=(0.0, 0.0, speed), tooth_length=LENGTH)
    hinges = [Revolute(f"{b.name}_hinge", b.name, (0.0, 0.0), GROUND, b.start[:2]) for b in (body, *others)]
    return Simulation(
        Mechanism(
            bodies=(body, *others),
            joints=(*hinges, *joints),
            contacts=contacts,
            functions=functions,
            forces=forces,
            outputs=(*ENERGIES, *SPEEDS),
        )
    )


def one_of_each_instant(impacts):
    """The first record of each instant, after seeing that all of an instant agree."""
    first = []
    for _, group in groupby(impacts, key=lambda impact: impact.instant):
        records = list(group)
        assert len({(record.time, record.velocity, record.energy_lost) for record in records}) == 1
        first.append(records[0])
    assert [record.instant for record in first] == list(range(1, len(first) + 1))
    return first


@settings(deadline=None)
@given(speed=st.floats(1e-6, 1e3), restitution=st.just(0.0) | st.floats(0.0, 1.0))
def test_a_wheel_at_a_stop_jumps_by_its_whole_speed_and_what_comes_back(speed, restitution):
    """And its teeth have the stress of that: of its whole speed when it is stopped dead, none as that goes to 0."""
    assume(restitution == 0.0 or restitution > 2 * STICK_SPEED)  # below this part of what moves, it sticks
    simulation = wheel(AngleStop("stop", "wheel", GROUND, -0.5, restitution=restitution), speed=-speed)
    simulation.advance(0.6 / speed)
    (hit,) = simulation.impacts_in_step()
    returned = restitution
    assert hit.velocity == pytest.approx(LENGTH * speed * (1 + returned), rel=1e-9)
    assert hit.energy_lost == pytest.approx(0.1 * speed**2 * (1 - returned**2), rel=1e-9, abs=1e-12 * speed**2)
    tooth = WedgeTooth(LENGTH, 1.0)
    whole = 0.786452 * math.sqrt(STEEL.youngs_modulus * STEEL.density) * LENGTH * speed
    assert maximum_stress(tooth, STEEL, abs(hit.velocity)).stress == pytest.approx((1 + returned) * whole, rel=1e-6)


@pytest.mark.parametrize("restitution", [0.0, 0.3, 0.5])
def test_of_an_indexing_ratchet_nothing_happens_beside_the_records(restitution):
    """Free pawl, holding pawl, contacts that come to rest after chattering: speeds and energies are all in records."""
    simulation = Simulation(free_ratchet(restitution=restitution, holding_pawl_restitution=restitution))
    simulation.set_input("drive_torque", 0.0)
    simulation.set_input("spring_preload", 3e-3)
    instants, lost = 0, 0.0
    for k in range(1000):
        swing(simulation, DRIVES[0], (k + 0.5) * 0.01)
        simulation.begin_step()
        while simulation.time < (k + 1) * 0.01:
            simulation.go_on((k + 1) * 0.01, codes.STOP_AT_IMPACT)
            if simulation.counters[codes.COUNT_INSTANTS] > instants:
                instants += 1
                now = simulation.read()
                assert simulation.counters[codes.COUNT_INSTANTS] == instants
                assert now["wheel_speed"] == now["impact_wheel_speed"]  # just after it, to the last bit
                jump = now["impact_wheel_speed"] - now["impact_wheel_speed_before"]
                assert now["impact_velocity"] == pytest.approx(now["tooth_length"] * jump, rel=1e-12, abs=1e-18)
                lost += now["impact_energy_lost"]
    assert instants > 5
    assert lost == pytest.approx(simulation.field("ledger")[codes.LEDGER_LOST], rel=1e-12)


@pytest.mark.parametrize("ratio", [0.5, 1.0, 3.0])
def test_an_impact_elsewhere_shakes_the_teeth_through_the_joints(ratio):
    """A pinion, geared to the wheel, runs into a stop: eq (7) by hand for J + ratio^2 j and one coordinate."""
    pinion = Body("pinion", 1.0, 0.05, start=(1.0 + ratio, 0.0, 0.0), start_rate=(0.0, 0.0, ratio))
    pair = Gears("pair", "wheel", ratio, 0.0, "pinion", 1.0, math.pi)
    stop = AngleStop("stop", GROUND, "pinion", -0.5 * ratio, restitution=0.25)
    simulation = wheel(stop, others=(pinion,), joints=(pair,))
    simulation.advance(0.6)
    (hit,) = simulation.impacts_in_step()
    assert hit.contact == "stop"
    assert hit.velocity == pytest.approx(1.25 * LENGTH, rel=1e-9)
    assert hit.energy_lost == pytest.approx((1 - 0.25**2) * (0.2 + ratio**2 * 0.05) / 2, rel=1e-9)


def test_a_lock_that_closes_in_motion_is_an_impact_with_its_jump():
    """It stops the wheel dead, from whichever side it comes: the stress of the whole speed."""
    for speed in (0.7, -0.7):
        low = LogicalFunction("low", "wheel.angle", -0.35) if speed < 0 else LogicalFunction("low", "wheel.angle", 0.35)
        lock = AngleLock("lock", "wheel", GROUND, math.copysign(0.35, speed), 7.0, "low" if speed < 0 else "not low")
        simulation = wheel(lock, speed=speed, functions=(low,))
        simulation.advance(0.6)
        (hit,) = simulation.impacts_in_step()
        assert (hit.contact, hit.closing_speed) == ("lock", pytest.approx(0.7, rel=1e-9))
        assert hit.velocity == pytest.approx(-LENGTH * speed, rel=1e-9)
        assert hit.energy_lost == pytest.approx(0.1 * 0.7**2, rel=1e-9)
        assert simulation.read()["speed"] == pytest.approx(0.0, abs=1e-12)


@settings(deadline=None)
@given(
    speed=st.floats(0.2, 20.0),
    other=st.floats(-20.0, 20.0),
    e=st.tuples(*[st.floats(0.0, 1.0)] * 4),
    ratio=st.floats(0.05, 20.0),
)
def test_jumps_telescope_to_the_change_of_the_rate_that_impacts_made(speed, other, e, ratio):
    """A wheel without torque between stops, and a hammer between stops and wheel: only impacts change their rates."""
    hammer = Body("hammer", 1.0, 0.2 * ratio, start_rate=(0.0, 0.0, other))
    stops = (
        AngleStop("low", "wheel", GROUND, -0.4, restitution=e[0]),
        AngleStop("high", GROUND, "wheel", -0.4, restitution=e[1]),
        AngleStop("under", "hammer", "wheel", -0.3, restitution=e[2]),
        AngleStop("over", "wheel", "hammer", -0.3, restitution=e[3]),
    )
    simulation = wheel(*stops, speed=-speed, others=(hammer,))
    before = simulation.read()
    impacts, rested = [], False
    for time in np.linspace(0.0, 2.0 / speed, 400):
        simulation.advance(time)
        impacts += simulation.impacts_in_step()
        rested = rested or bool(simulation.mode())
    assume(not simulation.counters[codes.COUNT_LOST])  # no more impacts in a step than the buffer holds
    instants = one_of_each_instant(impacts)
    after = simulation.read()
    assert instants
    # A contact that comes to rest without an impact takes a leftover below `RESTS_BELOW` with it.
    leftover = 4 * RESTS_BELOW * speed if rested else 0.0  # of the scale of what moves
    made = sum(instant.velocity for instant in instants)
    assert made == pytest.approx(LENGTH * (after["speed"] + speed), abs=1e-12 * max(1.0, speed) + LENGTH * leftover)
    lost = math.fsum(i.energy_lost for i in instants)
    assert lost == pytest.approx(after["lost"], rel=1e-9, abs=1e-12 * before["kinetic"])


def test_rounds_and_contacts_of_one_instant_share_one_jump():
    """A hammer strikes a wheel that is just leaving its stop: hammer on wheel, wheel on stop, hammer again."""
    hammer = Body("hammer", 1.0, 0.1, start_rate=(0.0, 0.0, -1.0))
    stop = AngleStop("stop", "wheel", GROUND, 0.0, restitution=1.0)
    blow = AngleStop("blow", "hammer", "wheel", 0.0, restitution=0.5)
    simulation = wheel(stop, blow, speed=0.1, others=(hammer,))
    simulation.advance(0.01)
    impacts = simulation.impacts_in_step()
    assert [impact.contact for impact in impacts] == ["blow", "stop", "blow"]
    assert len(one_of_each_instant(impacts)) == 1
    # Inertias 2 : 1, e = 0.5, closing 1.1 rad/s: the wheel goes to 0.1 - 1.5 * 1.1 / 3 = -0.45, the hammer to 0.1; the
    # stop turns the wheel, which closes with 0.35 and goes to 0.45 - 1.5 * 0.35 / 3 = 0.275.
    assert simulation.read()["speed"] == pytest.approx(0.275, rel=1e-12)
    assert impacts[0].velocity == pytest.approx(LENGTH * 0.175, rel=1e-12)


def test_a_wheel_that_is_held_does_not_jump_though_it_is_struck():
    """Pressed on its stop, struck towards it by a hammer that stays: an impulse, and no change of the wheel's rate."""
    hammer = Body("hammer", 1.0, 0.1, (0.0, 0.0, 0.5), start_rate=(0.0, 0.0, -1.0))
    stop = AngleStop("stop", "wheel", GROUND, 0.0)
    blow = AngleStop("blow", "hammer", "wheel", 0.0)
    simulation = wheel(stop, blow, speed=0.0, others=(hammer,), forces=(Torque("press", "wheel", torque=-1.0),))
    simulation.advance(0.6)
    (hit,) = simulation.impacts_in_step()
    assert hit.contact == "blow"
    assert hit.impulse == pytest.approx(0.1, rel=1e-9)
    assert hit.velocity == pytest.approx(0.0, abs=1e-15)


def test_the_base_case_jumps_from_its_turning_back():
    simulation = Simulation(MODEL.build(MODEL.values(relative_tolerance=1e-12)))
    simulation.advance(1.0)
    found = simulation.read()
    assert found["impact_wheel_speed_before"] == pytest.approx(-0.000779456, abs=5e-10)
    jump = found["impact_wheel_speed"] - found["impact_wheel_speed_before"]
    assert found["impact_velocity"] == pytest.approx(found["tooth_length"] * jump, rel=1e-14)
    assert found["impacts[1].velocity"] == found["impact_velocity"]
    assert found["impacts[1].wheel_speed_before"] == found["impact_wheel_speed_before"]
    assert found["impacts[1].instant"] == 1
    assert found["impact_energy_lost"] == pytest.approx(2.71981107e-4 - 8.78293469e-6, rel=1e-8)
