"""Communication steps, equal or not, and what they report of impacts."""

import random

import pytest

MOTION = ("wheel_angle", "crank_angle", "pawl_angle", "wheel_speed", "crank_speed", "pawl_speed", "contact_force")


def steps(size, stop_time):
    """Lengths of equal steps, or of uneven ones where size is None."""
    generator, time = random.Random(1), 0.0
    while time < stop_time - 1e-9:
        step = min(size or generator.uniform(1e-5, 5e-2), stop_time - time)
        time += step
        yield step


@pytest.mark.parametrize("size", [1e-4, 1e-3, 0.05, None])
@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_trajectory_does_not_depend_on_the_steps(instance, size, restitution):
    once = instance().begin({"restitution": restitution})
    once.step(1.5)
    often = instance().begin({"restitution": restitution})
    for step in steps(size, 1.5):
        often.step(step)

    assert often["impact_time"] == once["impact_time"]
    assert often.get(MOTION) == pytest.approx(once.get(MOTION), rel=1e-11, abs=1e-13)


def test_trajectory_does_not_depend_on_steps_between_changes_of_the_input(instance):
    found = []
    for size in (0.25, 0.05, 1e-3):
        one = instance().begin()
        for k in range(8):
            one.set({"drive_torque": 1e-3 * (1 + k % 3), "load_torque": 1e-5 * k})
            one.run(0.25 * (k + 1), size)
        found.append(one.get((*MOTION, "impact_time")))

    assert found[0] == pytest.approx(found[1], rel=1e-8, abs=1e-11)
    assert found[0] == pytest.approx(found[2], rel=1e-8, abs=1e-11)


def test_impact_is_reported_in_the_step_in_which_it_happens(instance):
    one = instance().begin()
    flags = {}
    for k in range(1, 101):
        one.step(0.01)
        if one["impact"]:
            flags[k] = one.get(("impacts_in_step", "impacts[1].time", "impact_time", "impact_count"))

    assert list(flags) == [94]
    assert flags[94]["impacts_in_step"] == 1
    assert flags[94]["impacts[1].time"] == flags[94]["impact_time"] == pytest.approx(0.9399211769, rel=1e-9)
    assert one["impact_count"] == 1
    assert one["impacts_in_step"] == 0
    assert one["impacts[1].time"] == -1


def test_several_impacts_of_a_step_are_all_reported_in_order(instance):
    short = instance().begin({"restitution": 0.5})
    collected = []
    for _ in range(6000):
        short.step(1e-3)
        collected += [short[f"impacts[{k + 1}].time"] for k in range(short["impacts_in_step"])]
    long = instance().begin({"restitution": 0.5})
    long.step(6.0)

    assert len(collected) == short["impact_count"] == long["impact_count"] > 8
    kept = [long[f"impacts[{k}].time"] for k in range(1, 9)]
    assert kept == collected[-8:]
    assert kept == sorted(kept)
    assert long["impacts_lost"] == len(collected) - 8
    assert short["impacts_lost"] == 0
    assert any("did not fit into impacts[1..8]" in message.text for message in long.log)
    assert long["impacts[8].velocity"] == long["impact_velocity"]


def test_bouncing_ends_and_the_contact_stays(instance):
    one = instance().begin({"restitution": 0.5})
    one.step(6.0)
    count = one["impact_count"]
    one.step(1.0)

    assert one["impact_count"] == count
    assert one["face_gap"] == 0
    assert one["contact_force"] > 0


def test_contact_force_answers_an_input_at_once(instance):
    one = instance().begin()
    one.step(2.0)
    before = one["contact_force"]
    one.set({"drive_torque": 2e-3})

    assert one["contact_force"] > 1.5 * before


def test_energy_ledger_closes_under_changing_inputs(instance):
    one = instance().begin({"restitution": 0.4})
    initial = one["kinetic_energy"] + one["spring_energy"]
    for k in range(600):
        one.set(
            {"drive_torque": 1e-3 + 5e-4 * (k % 7), "spring_preload": 1e-4 * (k % 3), "load_torque": 1e-4 * (k % 2)}
        )
        one.step(0.01)
        ledger = initial + one["work_done"] - one["energy_lost"]
        assert one["kinetic_energy"] + one["spring_energy"] == pytest.approx(ledger, abs=1e-10)


def test_any_start_time(instance):
    one = instance().begin(start_time=100.0)
    one.run(102.0, 0.01)

    assert one["impact_time"] == pytest.approx(100.9399211769, abs=1e-9)
