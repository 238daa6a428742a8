"""What the benchmark of many designs compares agrees before it is timed; times are not judged here."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from benchmarks.many.compare import ACCURACY, PLAIN_TOLERANCE, Sweep, against_mujoco, against_plain
from benchmarks.many.mjcf import mjcf
from benchmarks.many.sweep import Found, plainly, processes
from benchmarks.ratchet import Parameters
from benchmarks.timing import DisagreementError


@pytest.fixture(scope="module")
def sweep(ratchet_fmu: Path) -> Sweep:
    return Sweep.of(ratchet_fmu, 3, 1.1, 2)


def test_the_fast_path_is_as_accurate_as_the_benchmark_says(sweep: Sweep) -> None:
    found = sweep.judge("fast path", sweep.run(), (ACCURACY,) * 3)
    assert 0 < found.time < ACCURACY
    with pytest.raises(DisagreementError, match=r"fast path to 1\.1 s is off by"):
        sweep.judge("fast path", sweep.run(), (1e-12,) * 3)


def test_the_plain_program_is_as_accurate(sweep: Sweep) -> None:
    plain = Found(*np.array([plainly((design, 1.1, PLAIN_TOLERANCE)) for design in sweep.designs]).T)
    sweep.judge("solve_ivp", plain, (ACCURACY,) * 3)


def test_a_design_without_an_impact_is_no_agreement(sweep: Sweep) -> None:
    early = Found(*np.array([plainly((design, 0.1, PLAIN_TOLERANCE)) for design in sweep.designs]).T)
    with pytest.raises(DisagreementError):
        sweep.judge("solve_ivp", early, (ACCURACY,) * 3)


@pytest.mark.slow
def test_the_pool_is_timed(sweep: Sweep) -> None:
    with processes(2) as pool:
        comparison, accuracies = against_plain(sweep, pool, 2, 1, 100.0)
    assert len(comparison.slow) == len(comparison.fast) == 1
    assert [accuracy.way for accuracy in accuracies] == ["solve_ivp"]


def test_mujoco_comes_near_and_is_timed(sweep: Sweep) -> None:
    pytest.importorskip("mujoco")
    comparison, (ours, theirs) = against_mujoco(sweep, 1, 15.0)
    assert comparison.least_ratio == 15.0
    assert ours.time < 1e-8 < 1e-5 < theirs.time < 1e-3
    assert theirs.speed_after < 2e-4


def test_mujoco_s_ratchet_has_the_masses_and_the_energy_of_the_paper_s() -> None:
    """The mass at the tip is taken from the pawl such that its centre and its inertia stay."""
    mujoco = pytest.importorskip("mujoco")
    p = replace(Parameters(), drive_torque=0.0)
    model = mujoco.MjModel.from_xml_string(mjcf(p, 1e-3))
    tip, pawl = model.body_mass[4], model.body_mass[2]
    assert pawl + tip == pytest.approx(p.pawl_mass, rel=1e-12)
    centre = model.body_ipos[2, 0]
    assert pawl * centre + tip * p.pawl_length == pytest.approx(p.pawl_mass * p.pawl_length / 2, rel=1e-12)
    about_pin = model.body_inertia[2].max() + pawl * centre**2 + tip * p.pawl_length**2
    assert about_pin == pytest.approx(p.pawl_inertia + p.pawl_mass * p.pawl_length**2 / 4, rel=1e-12)
    assert model.qpos_spring[2] == pytest.approx(p.spring_free_angle - p.wheel_angle_start)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert abs(data.efc_pos).max() < 1e-12  # the tip stands at the end of the pawl
