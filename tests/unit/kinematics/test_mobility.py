"""Degrees of freedom and dependent rows, in usual and in singular configurations."""

import math
from dataclasses import replace

import numpy as np
import pytest

from mechanism_fmu.kinematics import Dependency, KinematicsError, mobility
from mechanism_fmu.kinematics.mobility import free_directions, independence
from mechanism_fmu.model import GROUND, Body, CamFollower, Mechanism, Revolute, Translational
from tests.parallel_cranks import parallel_cranks, turning
from tests.slide_cam import cam_mechanism

OUT_OF_LINE = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.5)]


def driven(mechanism, *drivers):
    return replace(mechanism, joints=(*mechanism.joints, *drivers))


@pytest.mark.parametrize("size", [1.0, 1e-4, 1e3])
@pytest.mark.parametrize("cranks", [2, 3, 4])
def test_equal_cranks_have_one_degree_of_freedom(cranks, size):
    found = mobility(parallel_cranks(cranks, size=size))
    assert (found.coordinates, found.rows) == (3 * cranks + 3, 4 * cranks)
    assert found.rank == found.nearby_rank == 3 * cranks + 2
    assert found.degrees_of_freedom == 1
    assert not found.singular
    assert len(found.redundant) == cranks - 2
    assert "coupler.x" in found.moving
    assert "coupler.angle" not in found.moving


def test_the_row_that_depends_is_named_with_those_it_follows_from():
    (found,) = mobility(parallel_cranks(3)).redundant
    assert found.row == "crank2_pin[2]"
    joints = {f"crank{k}_{pin}" for k in range(3) for pin in ("hinge", "pin")}
    assert {row.partition("[")[0] for row in found.follows_from} == joints
    assert str(found).startswith("crank2_pin[2] follows from crank0_hinge[1], ")


@pytest.mark.parametrize("size", [1.0, 1e-4])
@pytest.mark.parametrize("cranks", [2, 3, 4])
@pytest.mark.parametrize("angle", [0.0, math.pi])
def test_cranks_that_lie_flat_are_singular(cranks, angle, size):
    found = mobility(parallel_cranks(cranks, angle, size=size))
    assert found.singular
    assert found.rank == 3 * cranks + 1
    assert found.nearby_rank == 3 * cranks + 2
    assert found.degrees_of_freedom == 1
    assert len(found.redundant) == cranks - 2
    assert "singular configuration" in str(found)


def test_cranks_that_lie_flat_and_are_driven_are_singular_too():
    found = mobility(driven(parallel_cranks(3, 0.0), turning("drive", "crank0", 0.0, 1.0)))
    assert (found.rank, found.nearby_rank, found.degrees_of_freedom) == (11, 12, 0)


def test_a_crank_out_of_line_leads_through_the_flat_position():
    assert not mobility(parallel_cranks(3, 0.0, OUT_OF_LINE)).singular


def test_a_slider_moves_though_it_rests_in_its_dead_position():
    mechanism = Mechanism(
        bodies=(Body("crank", 1.0, 1.0), Body("rod", 1.0, 1.0, (1.0, 0.0, 0.0)), Body("slider", 1.0, 1.0, (3.0, 0, 0))),
        joints=(
            Revolute("hinge", "crank", (0.0, 0.0), GROUND, (0.0, 0.0)),
            Revolute("pin", "crank", (1.0, 0.0), "rod", (0.0, 0.0)),
            Revolute("end", "rod", (2.0, 0.0), "slider", (0.0, 0.0)),
            Translational("guide", "slider", (0.0, 0.0), (1.0, 0.0), GROUND, (0.0, 0.0), (1.0, 0.0)),
        ),
    )
    found = mobility(mechanism)
    assert found.degrees_of_freedom == 1
    assert set(found.moving) == {"crank.angle", "rod.x", "rod.y", "rod.angle", "slider.x"}


def test_a_redundant_driver_is_named():
    first, second = turning("drive", "crank0", 0.4, 1.0), turning("second", "crank1", 0.4, 1.0)
    found = mobility(driven(parallel_cranks(2), first, second))
    assert found.degrees_of_freedom == 0
    (dependency,) = found.redundant
    assert dependency.row == "second"
    assert "drive" in dependency.follows_from
    assert "10 constraint rows, rank 9: 0 degrees of freedom" in str(found)


def test_contact_coordinates_count():
    found = mobility(cam_mechanism("roller"))
    assert (found.coordinates, found.rows, found.degrees_of_freedom) == (8, 7, 1)
    assert "pair.alpha_i" in found.moving
    assert isinstance(cam_mechanism("roller").contacts[0], CamFollower)


def test_free_bodies():
    found = mobility(Mechanism(bodies=(Body("a", 1.0, 1.0), Body("b", 1.0, 1.0))))
    assert (found.rows, found.rank, found.degrees_of_freedom) == (0, 0, 6)
    assert len(found.moving) == 6


def test_what_cannot_be_assembled_says_which_rows_stay_open():
    first, second = turning("drive", "crank0", 0.4), turning("second", "crank0", 0.5)
    with pytest.raises(KinematicsError, match=r"cannot be assembled at t = 0 s.*drive by 0\.05.*contradict"):
        mobility(driven(parallel_cranks(2), first, second))


def test_a_row_of_zeros_is_said_to_be_zero():
    assert str(Dependency("rod", ())) == "rod is zero"


def test_weights_say_how_a_row_is_combined():
    random = np.random.default_rng(2)
    rows = random.normal(size=(4, 7))
    rows /= np.linalg.norm(rows, axis=1)[:, None]
    mixed = 0.3 * rows[0] - 0.9 * rows[2]
    found = independence(np.vstack([rows[:3], mixed, rows[3]]))
    assert (found.independent, found.dependent) == ([0, 1, 2, 4], [3])
    np.testing.assert_allclose(found.weights, [[0.3, 0.0, -0.9, 0.0]], atol=1e-12)
    free = free_directions(np.vstack([rows, mixed]))
    assert free.shape == (7, 3)
    np.testing.assert_allclose(rows @ free, 0.0, atol=1e-12)
