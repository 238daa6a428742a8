"""The ratchet's first impact through the engine."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from ratchet_table import PRINTED, TABLE

from benchmarks.ratchet import Parameters, build
from benchmarks.reference import STICK_SPEED, simulate
from mechanism_fmu import codes
from mechanism_fmu.simulation import Simulation
from models.ratchet.model import MODEL

PRECISE = 1e-12
SPEEDS = [f"impact_{body}_speed{when}" for when in ("_before", "") for body in ("crank", "pawl", "wheel")]


def ratchet(slope_angle=90, **values):
    return MODEL.mechanism(MODEL.values(tooth_slope_angle=math.radians(slope_angle), **values))


def at_first_impact(mechanism):
    """All outputs at the end of the communication step of 10 ms that holds the first impact."""
    simulation = Simulation(mechanism)
    for k in range(1, 200):
        simulation.advance(k / 100)
        if simulation.read()["impact_count"]:
            return simulation.read()
    raise AssertionError("no impact within 2 s")


@cache
def base_case(**values):
    return at_first_impact(ratchet(**values))


@pytest.mark.parametrize("slope_angle", TABLE)
@pytest.mark.parametrize(("tolerance", "within"), [(1e-9, 1e-9), (PRECISE, 1e-11)])
def test_impact_time_and_speeds(slope_angle, tolerance, within):
    found = at_first_impact(ratchet(slope_angle, relative_tolerance=tolerance))
    difference = np.subtract([found[name] for name in ("impact_time", *SPEEDS)], TABLE[slope_angle])
    assert np.all(np.abs(difference) <= PRINTED + within)


@pytest.mark.parametrize(
    "changes",
    [
        {"tooth_count": 20, "tooth_slope_angle": math.radians(97)},
        {"restitution": 0.4, "drive_torque": 4e-3, "load_torque": -2e-3, "spring_preload": 1e-3},
        {"pawl_length": 0.105, "pawl_mass": 0.2, "wheel_inertia": 1e-2, "spring_stiffness": 0.1},
    ],
)
def test_other_designs_agree_with_the_plain_implementation(changes):
    inputs = {name: changes[name] for name in ("drive_torque", "spring_preload", "load_torque") if name in changes}
    parameters = {name: value for name, value in changes.items() if name not in inputs}
    plain = simulate(build(Parameters(**changes)), 1.2, rtol=1e-11, atol=1e-13)
    mechanism = MODEL.mechanism(MODEL.values(relative_tolerance=PRECISE, **parameters))
    simulation = Simulation(mechanism, inputs=[inputs.get(port.name, port.start) for port in mechanism.inputs])
    hits = []
    for time in np.linspace(0, 1.2, 241):
        simulation.advance(time)
        hits += simulation.field("impacts")[: simulation.counters.item(codes.COUNT_IN_STEP)].tolist()
    last = len(plain.impacts)
    assert len(hits) >= last >= 1
    if len(hits) > last:  # hops that begin where the plain one takes it for resting
        last -= 1
        assert plain.impacts[last].sticks
        for hit in hits[last:]:
            assert parameters["restitution"] * hit[codes.RECORD_CLOSING_SPEED] < STICK_SPEED
    for found, expected in zip(hits[:last], plain.impacts[:last], strict=True):
        assert found[codes.RECORD_TIME] == pytest.approx(expected.time, abs=1e-9)
        assert found[codes.RECORD_CLOSING_SPEED] == pytest.approx(expected.closing_speed, abs=1e-10)
        impulses = found[codes.RECORD_CONTACT_IMPULSES :][:3]
        assert impulses == pytest.approx([expected.slope_impulse, expected.face_impulse, 0.0], abs=1e-11)
        assert impulses[2] == 0.0  # the holding pawl is a part of the free ratchet only
        rates = found[codes.RECORD_CONTACT_IMPULSES + 3 :]
        np.testing.assert_allclose(rates, [*expected.before, *expected.after], rtol=0, atol=1e-9)
        jump = expected.after[-1] - expected.before[-1]
        assert found[codes.RECORD_VELOCITY] == pytest.approx(simulation.read()["tooth_length"] * jump, abs=1e-10)


def test_motion_does_not_depend_on_the_number_of_teeth_but_impulses_do():
    ten, twenty = base_case(relative_tolerance=PRECISE), base_case(relative_tolerance=PRECISE, tooth_count=20)
    assert [twenty[name] for name in SPEEDS] == pytest.approx([ten[name] for name in SPEEDS], abs=1e-11)
    assert twenty["impact_impulse"] > 1.01 * ten["impact_impulse"]


def test_impulses_of_the_base_case():
    hit = base_case(relative_tolerance=PRECISE)
    assert hit["impact_impulse"] == pytest.approx(7.7895902699e-3, rel=1e-10)
    assert hit["impact_slope_impulse"] == pytest.approx(1.1321724809e-3, rel=1e-9)


def test_energies_of_the_base_case():
    hit = base_case(relative_tolerance=PRECISE)
    simulation = Simulation(ratchet(relative_tolerance=PRECISE))
    simulation.advance(hit["impact_time"])
    just_after = simulation.read()
    after = just_after["kinetic_energy"] + just_after["spring_energy"]
    assert after == pytest.approx(8.78293469e-6, rel=1e-9)
    assert after + just_after["energy_lost"] == pytest.approx(2.71981107e-4, rel=2e-9)


def test_energy_before_the_impact_is_the_work_done():
    simulation = Simulation(ratchet(relative_tolerance=PRECISE))
    for time in np.linspace(0, 0.93, 94):
        simulation.advance(time)
        found = simulation.read()
        balance = found["kinetic_energy"] + found["spring_energy"] - found["work_done"]
        assert abs(balance) < 1e-17


def test_restitution_one_half():
    hit = base_case(relative_tolerance=PRECISE, restitution=0.5)
    assert hit["impact_crank_speed"] == pytest.approx(-0.258313975, abs=6e-10)
    assert hit["impact_wheel_speed"] == pytest.approx(0.0344980141, abs=6e-11)
    assert hit["impact_impulse"] == pytest.approx(0.0116843854, abs=6e-11)


@pytest.mark.parametrize("restitution", [0.0, 0.3, 0.5, 0.8, 1.0])
def test_energy_lost_is_the_impulse_times_the_mean_closing_speed(restitution):
    """Nothing at all, up to rounding, when e = 1."""
    hit = base_case(restitution=restitution, relative_tolerance=PRECISE)
    expected = hit["impact_impulse"] * hit["impact_closing_speed"] * (1 - restitution) / 2
    assert hit["energy_lost"] == pytest.approx(expected, abs=1e-17)


@pytest.mark.parametrize("copies", [2, 3])
def test_duplicated_joint_rows_change_nothing(copies):
    mechanism = ratchet(relative_tolerance=PRECISE)
    again = tuple(replace(joint, name=f"{joint.name}{k}") for k in range(copies - 1) for joint in mechanism.joints)
    # How a bar bends on hinges that share its force is refused: these outputs are left out.
    outputs = tuple(output for output in mechanism.outputs if not output.source.startswith("pawl_beam."))
    found = at_first_impact(replace(mechanism, joints=mechanism.joints + again, outputs=outputs))
    single = base_case(relative_tolerance=PRECISE)
    assert single.keys() - found.keys() == {"pawl_tip_deflection", "pawl_bending_stress"}
    assert found == pytest.approx({name: single[name] for name in found}, rel=1e-10, abs=1e-11)
