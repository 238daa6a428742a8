"""The free ratchet through the built FMU: four strokes, states, buffers, steps."""

import math

import pytest

from mechanism_fmu import codes
from tests.fmu.conformance.host import Instance

PERIOD = 8.0
CYCLE = {
    "guided": False,
    "tooth_count": 20,
    "tooth_slope_angle": math.radians(95),
    "drive_stiffness": 2.0,
    "drive_damping": 0.1,
    "pawl_spring_torque": 5e-3,
    "wheel_damping": 0.1,
    "spring_preload": 3e-3,
    "drive_torque": 0.0,
}
LEDGER = ("kinetic_energy", "spring_energy", "work_done", "energy_lost")


def drive(one: Instance, time: float) -> None:
    turn = 2 * math.pi / PERIOD
    one.set(
        {
            "drive_angle": math.radians(84.3 - 10.4 * math.cos(turn * time)),
            "drive_speed": math.radians(10.4 * turn * math.sin(turn * time)),
        }
    )


def stroke(one: Instance, until: float, hold: float = 0.02, cuts: int = 1) -> None:
    """Go on with inputs that are held over `hold` [s], each stretch in `cuts` communication steps."""
    while one.time < until - 1e-9:
        drive(one, one.time + hold / 2)
        for _ in range(cuts):
            one.step(hold / cuts)


@pytest.mark.parametrize("restitution", [0.0, 0.3, 0.5])
def test_four_strokes_four_clicks(instance, restitution):
    one = instance().begin(CYCLE | {"restitution": restitution})
    initial = one.get(LEDGER)
    for k in range(1, 5):
        stroke(one, k * PERIOD)
        assert one["clicks"] == k
        assert one["latched_angle"] == pytest.approx(math.radians(75 + 18 * k), abs=1e-12)
        assert one["wheel_angle"] >= one["latched_angle"] - 1e-9
    stroke(one, 34.0)
    found = one.get((*LEDGER, "clicks", "tooth_index"))
    assert found["clicks"] == 4
    assert found["tooth_index"] == 5  # the pawl starts one valley behind root 0's, and has gone over four tips
    kinetic, spring, work, lost = (found[name] - initial[name] for name in LEDGER)
    assert abs(kinetic + spring - work + lost) <= 1e-8 * abs(work)


def test_modes_indices_and_buffers_are_all_in_the_saved_state(instance):
    """Saved in mid-flight over the second tooth; the replay in another instance is bit-equal."""
    one = instance().begin(CYCLE | {"restitution": 0.5})
    stroke(one, 15.5)
    saved, time = one.slave.serializeFMUstate(one.slave.getFMUstate()), one.time
    assert not one["slope_active"]
    stroke(one, 19.0)
    names = one.fmu.named("output")
    expected = one.get(names)

    other = instance("other").begin()
    other.slave.setFMUstate(other.slave.deSerializeFMUstate(saved))
    other.time = time
    stroke(other, 19.0)
    assert other.get(names) == expected


def clicks_of(one: Instance) -> list[float]:
    """Times of the clicks in the last communication step."""
    events = range(1, one["events_in_step"] + 1)
    return [one[f"events[{k}].time"] for k in events if one[f"events[{k}].guard"] == codes.GUARD_CLICK]


def test_latch_times_do_not_depend_on_the_communication_step(instance):
    found = {}
    for cuts in (1, 5, 20):
        one = instance().begin(CYCLE | {"restitution": 0.3})
        times = []
        while one.time < 2 * PERIOD - 1e-9:
            drive(one, one.time + 0.01)
            for _ in range(cuts):
                one.step(0.02 / cuts)
                times += clicks_of(one)
        assert len(times) == one["clicks"] == 2
        found[cuts] = times, one.get(("wheel_angle", "wheel_speed", "crank_angle"))
    for times, end in found.values():
        assert times == pytest.approx(found[1][0], rel=0, abs=1e-6)
        assert end == pytest.approx(found[1][1], rel=0, abs=1e-7)


def test_several_impacts_of_one_step_fill_the_buffer_in_order(instance):
    """A pawl dropped on the slope with e = 0.6 bounces out within the step."""
    one = instance().begin(CYCLE | {"restitution": 0.6})
    stroke(one, 7.4)
    while one["impacts_in_step"] < 3:
        stroke(one, one.time + 0.1, hold=0.1)
    count = one["impacts_in_step"]
    times = [one[f"impacts[{k}].time"] for k in range(1, count + 1)]
    assert times == sorted(times)
    assert {one[f"impacts[{k}].contact"] for k in range(1, count + 1)} <= {0, 1, 2}
    assert one["impact_time"] == times[-1]


def test_active_contacts_agree_with_forces_and_gaps(instance):
    one = instance().begin(CYCLE)
    seen = set()
    for _ in range(200):
        stroke(one, one.time + 0.05, hold=0.05)
        found = one.get(
            (
                "slope_active",
                "face_active",
                "holding_pawl_active",
                "slope_force",
                "contact_force",
                "slope_gap",
                "face_gap",
                "holding_pawl_torque",
            )
        )
        for contact, force, gap in (("slope", "slope_force", "slope_gap"), ("face", "contact_force", "face_gap")):
            if found[f"{contact}_active"]:
                assert found[force] >= -1e-8
                assert found[gap] == 0
            else:
                assert found[force] == 0
                assert found[gap] >= -1e-9
        assert (found["holding_pawl_torque"] > 0) <= found["holding_pawl_active"]
        seen.add((found["slope_active"], found["face_active"], found["holding_pawl_active"]))
    assert {(True, False, True), (True, True, False)} <= seen


def test_the_pawl_starts_on_the_profile_or_where_it_is_told(instance):
    for count in (12, 15, 20, 25):
        one = instance().begin(CYCLE | {"tooth_count": count})
        assert one["slope_active"]
        assert one["slope_gap"] == 0
        assert one["face_gap"] > 0
    one = instance().begin(CYCLE | {"pawl_angle_start": math.radians(180)})
    assert one["pawl_angle"] == math.radians(180)
    assert not one["slope_active"]
    assert one["slope_gap"] > 0
