"""The ratchet whose pawl has a nose: as a point on a wheel that is larger by it, and as the ratchet without one."""

import math

import numpy as np
import pytest
from linkage import assert_meets_reference

from benchmarks.ratchet import Parameters
from benchmarks.ratchet_free import offset
from mechanism_fmu import codes
from mechanism_fmu.model.case_values import case_values
from mechanism_fmu.simulation import Simulation
from models.ratchet.model import MODEL as RATCHET
from models.ratchet_free.model import MODEL
from models.ratchet_free.start import TOOTH_COUNT, pawl_angle
from tests.outlines_apart import Pose, nearest

LEDGER = ("kinetic_energy", "spring_energy", "work_done", "energy_lost")


def simulation_of(model=MODEL, **values):
    return Simulation(model.build(model.values(**values)))


def test_default_motion_is_the_reference_curve() -> None:
    """Slides down, strikes the face, and stands in the notch: calculated without the library."""
    assert_meets_reference(simulation_of(relative_tolerance=1e-12), "ratchet_free", 1e-11)
    assert_meets_reference(simulation_of(), "ratchet_free", 1e-9)


@pytest.mark.parametrize("degrees", [90, 95])
@pytest.mark.parametrize("radius", [0.2e-3, 1e-3, 2e-3])
def test_a_nose_strikes_as_a_point_does_on_a_wheel_that_is_larger_by_it(radius: float, degrees: float) -> None:
    """The guided one of `models.ratchet` on the offset wheel, where its slope pushes: instant, rates, impulses."""
    slope = math.radians(degrees)
    wheel, ahead = offset(Parameters(tooth_count=TOOTH_COUNT, tooth_slope_angle=slope), radius)
    names = ("tooth_slope_angle", "wheel_inner_radius", "slope_ratio", "wheel_angle_start", "spring_free_angle")
    values = {name: getattr(wheel, name) for name in names}
    given = {"tooth_slope_angle": slope, "nose_radius": radius}
    common = {"relative_tolerance": 1e-12, "restitution": 0.4}
    point = simulation_of(RATCHET, tooth_count=TOOTH_COUNT, **values, **common)
    nose = simulation_of(**given, **common, holding_pawl=0)
    for simulation in (point, nose):
        simulation.advance(0.97)
        assert simulation.impacts_in_step()
    one, other = nose.impacts_in_step()[0], point.impacts_in_step()[0]
    assert (one.contact, other.contact) == ("tooth_2", "face")
    assert one.time == pytest.approx(other.time, rel=1e-10)
    assert one.closing_speed == pytest.approx(other.closing_speed, rel=1e-9)
    assert one.impulse == pytest.approx(other.impulse, rel=1e-9)
    found, wanted = (simulation.field("last_impact") for simulation in (nose, point))
    assert found[codes.RECORD_TIME] == pytest.approx(wanted[codes.RECORD_TIME], rel=1e-9)
    seen = nose.read()
    assert seen["wheel_angle"] + ahead == pytest.approx(point.read()["wheel_angle"], abs=1e-10)
    assert seen["crank_speed"] == pytest.approx(point.read()["crank_speed"], abs=1e-9)


def indexed(model, restitution=0.0, **values):
    """Whenever the wheel has gone a tooth, and the simulation, over the four strokes of the case "indexing"."""
    (case,) = (one for one in model.cases if one.name == "indexing")
    given = case_values(model, case)
    parameters = {name: value for name, value in given.items() if name in {p.name for p in model.parameters}}
    simulation = simulation_of(model, **parameters, restitution=restitution, **values)
    for name in given.keys() - parameters.keys():
        simulation.set_input(name, given[name])
    clicks, step, initial = [], case.step_size, simulation.read()
    for k in range(round(case.stop_time / step)):
        for name, signal in case.signals.items():
            simulation.set_input(name, signal.at((k + 0.5) * step))
        simulation.advance((k + 1) * step)
        clicks += [event.time for event in simulation.events_in_step() if event.guard == "holding_pawl.click"]
    return clicks, simulation, initial


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_one_tooth_a_stroke_and_the_ledger_adds_up(restitution: float) -> None:
    clicks, simulation, initial = indexed(MODEL, restitution)
    found = simulation.read()
    assert [int(time // 8.0) for time in clicks] == [0, 1, 2, 3]
    assert found["clicks"] == 4
    assert math.degrees(found["latched_angle"]) == pytest.approx(75 + 4 * 360 / TOOTH_COUNT, abs=1e-11)
    kinetic, spring, work, lost = (found[name] - initial[name] for name in LEDGER)
    assert abs(kinetic + spring - work + lost) < 1e-8 * work


def test_without_roundings_it_indexes_as_the_point_on_lines_does() -> None:
    """Two models of the same: outlines, and lines in a pattern. The nearer, the smaller the roundings."""
    wanted, *_ = indexed(RATCHET)
    off = {}
    for radius in (1e-4, 1e-5):
        found, *_ = indexed(MODEL, nose_radius=radius, tooth_tip_radius=radius)
        off[radius] = np.abs(np.subtract(found, wanted)).max()
    assert off[1e-4] < 0.02
    assert off[1e-5] == pytest.approx(off[1e-4] / 10, rel=0.02)


def test_the_nose_rests_on_the_slope_at_the_start() -> None:
    for values in ({}, {"nose_radius": 4e-3}, {"wheel_angle_start": math.radians(74), "tooth_tip_radius": 2e-3}):
        found = simulation_of(**values).read()
        assert found["tooth_active"]
        assert found["pawl_angle"] == pawl_angle(MODEL.values(**values))


def test_a_pawl_that_comes_round_strikes_the_teeth_that_are_there() -> None:
    """Swung away from the wheel, around its pin and down on the other side: a distance of nothing, never less.

    The lines of `models.ratchet` belong to one tooth at a time, and go on where the tooth ends.
    """
    start = {"pawl_angle_start": math.radians(150), "pawl_spring_torque": -5e-3, "restitution": 0.3}
    mechanism = MODEL.build(MODEL.values(**start, drive_stiffness=50.0, drive_damping=1.0))
    contact = next(one for one in mechanism.contacts if one.name == "tooth")
    teeth = [contact.outline_j.moved(angle=2 * math.pi * k / TOOTH_COUNT) for k in range(TOOTH_COUNT)]
    simulation, struck = Simulation(mechanism), []
    for k in range(1, 61):
        simulation.advance(k * 0.02)
        struck += simulation.impacts_in_step()
        reads = simulation.read()
        q = simulation.field("y_at")
        pawl, wheel = Pose(*q[3:6]), Pose(*q[6:9])
        apart = min(nearest(contact.outline_i, pawl, tooth, wheel).distance for tooth in teeth)
        touches = reads["tooth_active"] or reads["tooth_2_active"]
        assert apart == pytest.approx(0.0 if touches else reads["tooth_gap"], abs=1e-9)
    assert reads["pawl_angle"] < math.radians(0)
    assert {one.contact for one in struck} <= {"tooth", "tooth_2", "holding_pawl"}
    assert struck
