"""Laws that every mechanism obeys, whatever it is: looked at from outside, at every communication point."""

from itertools import pairwise

ENERGIES = ("kinetic_energy", "spring_energy", "work_done", "energy_lost")
STEP = 0.05


def rough_run(subject, one):
    """Take the instance through the rough run, and stop at every communication point.

    From halfway on, all inputs are at the top of their ranges.
    """
    one.begin(subject.rough)
    yield one.time
    while one.time < subject.until - STEP / 2:
        if one.time > subject.until / 2:
            one.set({name: high for name, (_, high) in subject.inputs.items()})
        one.step(STEP)
        yield one.time


def test_the_energy_ledger_closes(subject, instance):
    """Kinetic and spring energy are what they were, plus the work done, minus what was lost; and lost is lost."""
    one = instance()
    ledger = [one.get(ENERGIES) for _ in rough_run(subject, one)]
    in_play = max(abs(energy) for entry in ledger for energy in entry.values())
    first = ledger[0]["kinetic_energy"] + ledger[0]["spring_energy"]
    for before, now in pairwise(ledger):
        expected = first + now["work_done"] - now["energy_lost"]
        assert abs(now["kinetic_energy"] + now["spring_energy"] - expected) < 3e-8 * in_play
        assert now["kinetic_energy"] >= 0.0
        assert now["energy_lost"] >= before["energy_lost"]


def test_impacts_push_and_belong_to_the_step_that_ends_at_or_after_them(subject, instance):
    """Each impact of a step from t0 to t1 lies in (t0, t1], and is told or counted as lost."""
    if not subject.impacts:
        return
    one = instance()
    told, begin = 0, 0.0
    for end in rough_run(subject, one):
        count = one["impacts_in_step"]
        told += count
        for slot in range(1, count + 1):
            assert begin < one[f"impacts[{slot}].time"] <= end
            assert one[f"impacts[{slot}].closing_speed"] > 0.0
            assert one[f"impacts[{slot}].impulse"] > 0.0
        begin = end
    assert told + one["impacts_lost"] == one["impact_count"] > 0
