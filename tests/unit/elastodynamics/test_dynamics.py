import math
from dataclasses import replace

import numpy as np
import pytest

from benchmarks.path_generator import INCH, PathGenerator
from mechanism_fmu.elastodynamics import LinkageError, configurations, linkage, quasi_static
from mechanism_fmu.elastodynamics.elastic_cycle import (
    MassModel,
    deflection_of,
    elastic_cycle,
    instantaneous_modes,
    stress_of,
)
from mechanism_fmu.elastodynamics.responses import periodic_response
from mechanism_fmu.elastodynamics.synthesis import judge_quasi_static, judge_steady_state, rigid_path
from mechanism_fmu.kinematics import analyse


def cycle_of(generator, samples=360, turns=1.0):
    mechanism = generator.mechanism()
    motion = analyse(mechanism, np.linspace(0.0, turns * 2 * math.pi / generator.speed, samples + 1))
    return quasi_static(configurations(linkage(mechanism), motion))


@pytest.fixture(scope="module")
def case_2():
    return cycle_of(PathGenerator())


@pytest.fixture(scope="module")
def case_3(case_2):
    return periodic_response(elastic_cycle(case_2, 0.02))


def test_periodic_deviation_of_the_path_generator_in_metres_is_that_of_the_oracle(case_2, case_3):
    c = case_2.configurations
    x, y = (c.coordinates.index(f"arm.end.{axis}") for axis in "xy")
    u = case_3.samples(3600)
    deviation = np.hypot(u[:, x], u[:, y]) / INCH
    assert deviation.argmax() == 96
    assert deviation.max() == pytest.approx(0.0939424332, abs=1e-10)
    judged = judge_steady_state(case_2, "arm.end", 0.02)
    np.testing.assert_allclose(judged.deviation[:-1], INCH * deviation[::10], atol=1e-12)
    assert judged.deviation[-1] == judged.deviation[0]


def test_frequencies_are_those_of_the_oracle(case_2):
    cycle = elastic_cycle(case_2, 0.02)
    hertz = instantaneous_modes(cycle.stiffness[60:61], cycle.mass[60:61]).hertz[0, :3]
    np.testing.assert_allclose(hertz, [78.22308, 242.84855, 1732.59658], atol=5e-6)


def test_quasi_static_displacements_give_back_the_stresses_of_their_forces(case_2):
    found = stress_of(case_2.configurations, case_2.displacement)
    np.testing.assert_allclose(found, case_2.stress, rtol=1e-7, atol=1e-7 * case_2.stress.max())
    deflection = deflection_of(case_2.configurations, case_2.displacement, "arm.end")
    np.testing.assert_array_equal(deflection, case_2.deflection("arm.end"))
    judged = judge_quasi_static(case_2, "arm.end")
    np.testing.assert_allclose(judged.deviation, case_2.deviation("arm.end"), rtol=1e-12)


def test_a_target_counts_what_is_off_it(case_2):
    path = rigid_path(case_2, "arm.end")
    np.testing.assert_allclose(path[60] / INCH, [5.301271477094675, 8.474251975608102], rtol=1e-9)
    shifted = judge_quasi_static(case_2, "arm.end", path + case_2.deflection("arm.end")[:, :2] + [3e-3, -4e-3])
    np.testing.assert_allclose(shifted.deviation, 5e-3, rtol=1e-9)


def test_mass_of_the_members_is_counted(case_2):
    volume = 28 * 0.125 * INCH**3
    assert judge_quasi_static(case_2, "arm.end").mass == pytest.approx(volume * PathGenerator().density, rel=1e-12)


def test_spread_masses_need_less_deflection_than_those_at_the_ends(case_2):
    def deviation(model):
        u = elastic_cycle(case_2, 0.02, model).static()
        return np.hypot(*deflection_of(case_2.configurations, np.vstack([u, u[:1]]), "arm.end")[:, :2].T).max()

    lumped, spread = map(deviation, MassModel)
    assert lumped == pytest.approx(case_2.deviation("arm.end").max(), rel=1e-9)
    assert 0.7 * lumped < spread < lumped


def test_a_cycle_that_does_not_close_is_refused():
    with pytest.raises(LinkageError, match="give one whole period"):
        elastic_cycle(cycle_of(PathGenerator(), 30, turns=0.9), 0.02)


def test_uneven_times_are_refused(case_2):
    pose = case_2.configurations.pose
    time = pose.time.copy()
    time[5] += 1e-5
    uneven = replace(case_2, configurations=replace(case_2.configurations, pose=replace(pose, time=time)))
    with pytest.raises(LinkageError, match="must be even"):
        elastic_cycle(uneven, 0.02)
