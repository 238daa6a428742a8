import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from benchmarks.path_generator import INCH, PathGenerator
from mechanism_fmu.elastodynamics import LinkageError, configurations, linkage, quasi_static
from mechanism_fmu.elastodynamics.synthesis import Judgement, judge_quasi_static, lightest, rigid_path
from mechanism_fmu.kinematics import analyse
from mechanism_fmu.model import Section

WIDTH, SAMPLES = 0.25 * INCH, 36
GROUPS = {"crank_bar": 0, "follower_bar": 0, "coupler_bar": 1, "arm": 1}


def cycle_of(mechanism, motion):
    return quasi_static(configurations(linkage(mechanism), motion))


def motion_of(mechanism, generator):
    return analyse(mechanism, np.linspace(0.0, 2 * math.pi / generator.speed, SAMPLES + 1))


def with_depths(mechanism, depths):
    members = [replace(m, section=Section.rectangle(WIDTH, depths[GROUPS[m.name]])) for m in mechanism.members]
    return replace(mechanism, members=tuple(members))


@pytest.fixture(scope="module")
def judge():
    mechanism = PathGenerator().mechanism()
    motion = motion_of(mechanism, PathGenerator())  # the depths do not change it
    return lambda depths: judge_quasi_static(cycle_of(with_depths(mechanism, depths), motion), "arm.end")


def test_the_lightest_path_generator_is_at_a_limit_and_no_grid_has_a_lighter_one(judge):
    start, lower, upper = [0.5 * INCH] * 2, [0.2 * INCH] * 2, [1.2 * INCH] * 2
    deviation, stress = 1e-3, 60e6
    found = lightest(judge, start, lower, upper, deviation, stress)
    assert found.before.deviation.max() > 1.8 * deviation  # 1.9 mm at 500 rpm
    after = found.after
    assert after.deviation.max() <= deviation
    assert after.stress.max() <= stress
    used = max(after.deviation.max() / deviation, after.stress.max() / stress)
    assert used == pytest.approx(1.0, abs=1e-5)
    assert after.mass == judge(found.design).mass
    grid = np.linspace(0.2 * INCH, 1.2 * INCH, 13)
    allowed = []
    for depths in itertools.product(grid, grid):
        judged = judge(np.array(depths))
        if judged.deviation.max() <= deviation and judged.stress.max() <= stress:
            allowed.append(judged.mass)
    # The grid's best lies above, by at most what one step of it weighs.
    step = judge(np.array([grid[1]] * 2)).mass - judge(np.array([grid[0]] * 2)).mass
    assert 0.0 <= min(allowed) - after.mass <= step


def test_a_tight_stress_is_the_limit_instead(judge):
    found = lightest(judge, [0.5 * INCH] * 2, [0.2 * INCH] * 2, [1.2 * INCH] * 2, 0.1, 50e6)
    assert found.after.stress.max() == pytest.approx(50e6, rel=1e-5)
    assert found.after.stress.max() <= 50e6


def with_arm(mechanism, ratio):
    """The arm `ratio` times as long, with its disk; the motion of the bodies stays what it is."""
    arm = mechanism.members[0]
    assert arm.name == "arm"
    tip = tuple(a + ratio * (b - a) for a, b in zip(arm.start, arm.end, strict=True))
    disks = [replace(disk, point=tip if disk.name == "path_disk" else disk.point) for disk in mechanism.lumped_masses]
    return replace(mechanism, members=(replace(arm, end=tip), *mechanism.members[1:]), lumped_masses=tuple(disks))


def test_a_length_that_makes_up_for_the_deflection_saves_mass(judge):
    mechanism = PathGenerator().mechanism()
    motion = motion_of(mechanism, PathGenerator())
    target = rigid_path(cycle_of(mechanism, motion), "arm.end")

    def judged(x):
        return judge_quasi_static(cycle_of(with_arm(with_depths(mechanism, x), x[2]), motion), "arm.end", target)

    depth, lower, upper = 0.5 * INCH, 0.2 * INCH, 1.2 * INCH
    free = lightest(judged, [depth, depth, 1.0], [lower, lower, 0.98], [upper, upper, 1.02], 1e-3, 60e6)
    fixed = lightest(judge, [depth] * 2, [lower] * 2, [upper] * 2, 1e-3, 60e6)
    assert free.after.deviation.max() <= 1e-3
    assert free.after.mass < 0.999 * fixed.after.mass


def disc(x):
    """Of mass x + y, allowed where sqrt 2 - |(x, y)| <= 0."""
    return Judgement(float(x.sum()), np.array([math.sqrt(2) / np.hypot(*x)]), np.array([[0.5]]))


def test_a_textbook_minimum_is_found_with_bounds_that_bind():
    # x + y on the circle of radius sqrt 2, x >= 1/4: at the left end of the arc.
    found = lightest(disc, [1.3, 1.9], [0.25, 0.5], [2.0, 2.0], 1.0, 1.0)
    np.testing.assert_allclose(found.design, [0.25, math.sqrt(2 - 0.25**2)], rtol=1e-5)
    assert found.before.mass == pytest.approx(3.2)
    assert found.evaluations < 100


def test_limits_out_of_reach_say_how_near_the_best_came():
    with pytest.raises(LinkageError, match=r"the best has 0\.5 m and 0\.5 Pa"):
        lightest(disc, [1.0, 1.0], [0.5, 0.5], [2.0, 2.0], 0.1, 1.0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"start": [3.0, 1.0]}, "lie between them"),
        ({"lower": [0.5]}, "as many numbers"),
        ({"lower": [2.0, 0.5], "start": [2.0, 1.0]}, "below upper"),
        ({"largest_deviation": 0.0}, "must be positive"),
        ({"largest_stress": math.nan}, "must be positive"),
    ],
)
def test_what_cannot_be_searched_is_refused(change, message):
    right = {"start": [1.0, 1.0], "lower": [0.5, 0.5], "upper": [2.0, 2.0]}
    right |= {"largest_deviation": 1.0, "largest_stress": 1.0}
    with pytest.raises(LinkageError, match=message):
        lightest(disc, **right | change)
