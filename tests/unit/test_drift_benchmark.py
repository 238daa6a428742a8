"""The benchmark of random designs, on some of them."""

from benchmarks.drift import designs, drift_of
from models.slider_crank.model import MODEL


def test_random_designs_keep_energy_joints_and_bits():
    found = [drift_of("slider_crank", values) for values in designs(MODEL, 5, seed=3)]
    assert len(found) == 5
    ran = [drift for drift in found if drift.ending == "ran"]
    assert len(ran) >= 3
    for drift in ran:
        assert 0.0 < drift.energy < 1e-6
        assert 0.0 < drift.joints < 1e-8
        assert drift.same
        assert drift.split == 0.0


def test_values_that_cannot_work_together_are_refused():
    assert drift_of("slider_crank", {"offset": 1.0}).ending == "refused"


def test_points_are_the_same_for_a_seed_and_within_limits():
    first, again = (list(designs(MODEL, 6, seed=1)) for _ in range(2))
    assert first == again
    assert len({tuple(values.items()) for values in first}) == 6
    limits = {p.name: (p.minimum, p.maximum, p.start) for p in MODEL.parameters}
    for values in first:
        for name, value in values.items():
            low, high, start = limits[name]
            assert low is None or value >= low
            assert high is None or value <= high
            assert abs(value - start) <= 0.3 * abs(start) * (1 + 1e-12)
