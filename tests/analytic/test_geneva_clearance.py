"""The Geneva drive with play: its first blow and a passage in closed form, bounds of its play, the drive without."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from benchmarks import geneva
from benchmarks.geneva_clearance import Drive, passage
from mechanism_fmu.simulation import Simulation
from models.geneva_clearance.model import MODEL

W = 2 * math.pi
#: A driver so heavy against the wheel that its speed changes by less than 1e-11 of itself.
STEADY = {"driver_inertia": 1e6, "wheel_inertia": 1e-6, "drive_damping": 0.0, "relative_tolerance": 1e-12}
#: Distance from the driver's hinge to the pin, and from the wheel's to the mouths [m].
ARM = RIM = 0.1 * math.sqrt(0.5)


def simulation_of(**values):
    return Simulation(MODEL.build(MODEL.values(**values)))


def calculated(**values):
    return {one.name: float(one.value) for one in MODEL.build(MODEL.values(**values)).calculated}


def test_a_passage_is_the_reference_curve() -> None:
    """Rest, blow, push, free, blow, held back: each in closed form."""
    curve = pd.read_csv(Path(__file__).parents[2] / "models" / "geneva_clearance" / "reference.csv")
    simulation = simulation_of(**STEADY)
    for row in curve.itertuples(index=False):
        simulation.advance(row.time)
        found = simulation.read()
        assert found["driver_angle"] == pytest.approx(row.driver_angle, abs=1e-10)
        assert found["wheel_angle"] == pytest.approx(row.wheel_angle, abs=1e-9)
        assert found["wheel_speed"] == pytest.approx(row.wheel_speed, abs=2e-8)


@pytest.mark.parametrize("clearance", [2e-5, 1e-4, 1e-3])
def test_events_of_a_passage_are_where_they_should_be(clearance: float) -> None:
    simulation = simulation_of(slot_clearance=clearance, mouth_radius=0.5e-3, **STEADY)
    simulation.advance(0.61)
    found = passage(Drive(clearance=clearance, mouth=0.5e-3))
    events = [(event.guard, event.time) for event in simulation.events_in_step()][:3]
    wanted = zip(("slot.gap", "slot.force", "slot.gap"), (found.strikes, found.leaves, found.meets), strict=True)
    for (guard, time), (name, theta) in zip(events, wanted, strict=True):
        assert guard == name
        assert time == pytest.approx(theta / W, abs=1e-8)


@pytest.mark.parametrize("restitution", [0.0, 0.4, 1.0])
@pytest.mark.parametrize("clearance", [1e-5, 1e-4, 1e-3])
def test_the_pin_strikes_as_rigid_bodies_do(clearance: float, restitution: float) -> None:
    """At a light driver: p = (1 + e) v / (s^2/I_d + x^2/I_w), v = w s, with the levers s = a sin(tau), x = R - s."""
    inertia = {"driver_inertia": 2e-3, "wheel_inertia": 1e-3, "drive_damping": 0.0}
    simulation = simulation_of(slot_clearance=clearance, mouth_radius=1e-4, restitution=restitution, **inertia)
    tau = math.acos(1 - clearance / 2 / ARM)
    lever = ARM * math.sin(tau)
    known = calculated(slot_clearance=clearance)
    assert (known["entry_angle"], known["entry_speed_ratio"]) == pytest.approx((tau, lever), rel=1e-9)
    simulation.advance((0.75 * math.pi + tau) / W + 1e-9)
    (hit,) = simulation.impacts_in_step()
    found = simulation.read()
    impulse = (1 + restitution) * W * lever / (lever**2 / 2e-3 + (RIM - lever) ** 2 / 1e-3)
    assert hit.time == pytest.approx((0.75 * math.pi + tau) / W, abs=1e-11)
    assert hit.closing_speed == pytest.approx(W * lever, rel=1e-8)
    assert hit.impulse == pytest.approx(impulse, rel=1e-8)
    assert found["impact_wheel_speed"] == pytest.approx(-impulse * (RIM - lever) / 1e-3, rel=1e-8)
    assert found["impact_driver_speed"] == pytest.approx(W - impulse * lever / 2e-3, rel=1e-8)


@pytest.mark.parametrize("values", [{}, {"restitution": 0.5}, {"slot_friction": 0.2, "locking_friction": 0.2}])
def test_one_station_a_turn_within_the_play_of_the_arc(values: dict[str, float]) -> None:
    """Whenever the pin is on the far side, the wheel stands at a multiple of 90 deg, but for its play."""
    simulation = simulation_of(driver_inertia=10.0, **values)
    play = calculated(**values)["rest_play"]
    for turn in range(5):
        simulation.advance(max(turn * 1.0, 1e-3))
        found = simulation.read()
        turns = found["driver_angle"] / W
        assert turns == pytest.approx(turn, abs=0.01)
        assert abs(found["wheel_angle"] - math.pi / 4 + turn * math.pi / 2) <= play * (1 + 1e-6)


@pytest.mark.parametrize("load", [0.05, -0.05])
def test_a_load_turns_the_resting_wheel_to_the_end_of_its_play(load: float) -> None:
    """There an end of the arc rests on the disc: play in closed form, force by the lever of that end."""
    simulation = simulation_of(driver_speed_start=0.0, wheel_damping=1e-3)
    for name, value in (("drive_speed", 0.0), ("load_torque", load)):
        simulation.set_input(name, value)
    simulation.advance(1.0)
    found, play = simulation.read(), calculated()["rest_play"]
    assert found["wheel_angle"] - math.pi / 4 == pytest.approx(math.copysign(play, load), abs=1e-9)
    # the end of the arc of radius L around the driver, at 45 deg, turned by the play; the force is along its radius
    radius = ARM - 0.008 + 1e-4
    end = complex(0.1, 0.0) + radius * complex(-math.sqrt(0.5), math.sqrt(0.5))
    end *= complex(math.cos(play), -math.sin(play))
    out = (end - 0.1) / abs(end - 0.1)
    lever = abs(end.real * out.imag - end.imag * out.real)
    assert found["locking_force"] == pytest.approx(abs(load) / lever, rel=1e-8)


def test_without_play_it_is_the_drive_without() -> None:
    """The wheel is off `models.geneva` by no more than its play, which the clearances set: in proportion."""
    worst = {}
    for clearance in (1e-4, 1e-5):
        simulation = simulation_of(slot_clearance=clearance, locking_clearance=clearance, mouth_radius=1e-4, **STEADY)
        off = []
        for time in np.arange(1, 161) * 0.0123:
            simulation.advance(time)
            off.append(simulation.read()["wheel_angle"] - geneva.wheel(W * time, 4).angle)
        worst[clearance] = np.abs(off).max()
        assert worst[clearance] < 20.0 * clearance
    assert worst[1e-5] == pytest.approx(worst[1e-4] / 10, rel=0.1)


def test_the_ledger_adds_up() -> None:
    simulation = simulation_of(restitution=0.3, slot_friction=0.2, wheel_damping=1e-3)
    start = simulation.read()
    simulation.advance(2.5)
    found = simulation.read()
    assert found["impact_count"] > 10
    change = {name: found[name] - start[name] for name in ("kinetic_energy", "work_done", "energy_lost")}
    balance = change["kinetic_energy"] - change["work_done"] + change["energy_lost"]
    assert abs(balance) < 1e-8 * abs(found["energy_lost"])
