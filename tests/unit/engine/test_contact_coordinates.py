"""Exact elimination of contact coordinates against the textbook: rows with alpha as coordinates without mass.

M is singular then, but K = [[M, -Phi_q^T], [Phi_q, 0]] is not: K (qdd, lambda) = (F, gamma).
"""

from dataclasses import replace

import numpy as np
import pytest
from textbook import evaluated_rows

from mechanism_fmu.model import (
    GROUND,
    Body,
    CamFollower,
    Force,
    Mechanism,
    Output,
    Revolute,
    Settings,
    Torque,
    Translational,
)
from mechanism_fmu.model.curves.profiles import circle, harmonic_profile
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.tables.layout import field_of
from mechanism_fmu.tables.sizes import sizes_of
from tests.parallel_cranks import parallel_cranks
from tests.slide_cam import EGG, SLIDE_CAM, cam_mechanism

ORIGIN, UP = (0.0, 0.0), (0.0, 1.0)
#: Without Baumgarte's terms, which the textbook's rows do not have.
EXACT = Settings(1e-9, 0.0, 0.0)


def two_cams(angle, speed):
    """Two cams on one shaft each lift a roller of the same beam, which can tilt and go up and down."""
    return Mechanism(
        bodies=(
            Body("cam", 1.0, 0.3, (0.0, 0.0, angle), (0.0, 0.0, speed)),
            Body("guide", 0.4, 0.1, (0.0, 1.7, 0.0)),
            Body("beam", 0.5, 0.2, (0.0, 1.7, 0.0)),
        ),
        joints=(
            Revolute("hinge", "cam", ORIGIN, GROUND, ORIGIN),
            Translational("slide", "guide", ORIGIN, UP, GROUND, ORIGIN, UP),
            Revolute("pin", "beam", ORIGIN, "guide", ORIGIN),
        ),
        contacts=(
            CamFollower("left", "cam", EGG, "beam", circle(0.2), (-0.4, 0.0), (-0.6, 0.0)),
            CamFollower("right", "cam", harmonic_profile(1.0, (0.0, 0.1)), "beam", circle(0.3), (0.4, 0.1), (0.6, 0.0)),
        ),
        forces=(Torque("drive", "cam", torque=0.7), Force("weight", "beam", (0.3, -5.0))),
        held=("cam.angle",),
        outputs=(Output("left", "left.force", ""), Output("right", "right.force", "")),
    )


def between_moving_bodies(angle, speed):
    """A cam on a sledge against an egg on a pendulum."""
    return Mechanism(
        bodies=(
            Body("sledge", 2.0, 1.0, (0.0, 0.0, 0.0), (0.4, 0.0, 0.0)),
            Body("cam", 1.0, 0.3, (0.0, 0.0, angle), (0.4, 0.0, speed)),
            Body("pendulum", 0.5, 0.1, (-1.5, 1.5, 0.0)),
        ),
        joints=(
            Translational("rail", "sledge", ORIGIN, (1.0, 0.0), GROUND, ORIGIN, (1.0, 0.0)),
            Revolute("axle", "cam", ORIGIN, "sledge", ORIGIN),
            Revolute("pivot", "pendulum", (-0.2, 0.1), GROUND, (-1.7, 1.6)),
        ),
        contacts=(
            CamFollower("pair", "cam", EGG, "pendulum", harmonic_profile(0.3, (0.02,)), (0.05, 0.02), (1.4, 0.0)),
        ),
        forces=(
            Torque("drive", "cam", torque=0.7),
            Force("push", "sledge", (1.3, 0.0)),
            Torque("t", "pendulum", torque=-2),
        ),
        held=("cam.angle", "sledge.x"),
        outputs=(Output("pair", "pair.force", ""),),
    )


def plain(kind, profile, **options):
    def build(angle, speed):
        return cam_mechanism(kind, profile, angle, speed, **options)

    return build


CASES = {
    "roller on the slides' cam": plain("roller", SLIDE_CAM),
    "roller on an egg": plain("roller", EGG, x=0.1),
    "flat face": plain("flat", EGG, centre=(0.1, 0.05), height=1.1),
    "point on the slides' cam": plain("point", SLIDE_CAM),
    "point on an egg": plain("point", EGG, x=0.2, centre=(0.1, 0.0)),
    "two cams on one follower": two_cams,
    "cam between moving bodies": between_moving_bodies,
}


def kkt(simulation):
    """Accelerations of the bodies and multipliers of all rows, by the textbook."""
    block = simulation._block
    n = sizes_of(block)["coordinates"]
    y, dy = simulation.field("y_end").copy(), simulation.field("dy_end").copy()
    alphas = y[2 * n + 2 :]
    q, qd = np.concatenate([y[:n], alphas]), np.concatenate([y[n : 2 * n], dy[2 * n + 2 :]])
    loads = np.concatenate([field_of(block, "force")[:n].copy(), np.zeros(len(alphas))])
    masses = np.concatenate([1 / field_of(block, "inverse_mass")[:n], np.zeros(len(alphas))])
    rows = evaluated_rows(block, q, qd, simulation.time)
    np.testing.assert_allclose(rows.phi, 0.0, atol=1e-11)
    np.testing.assert_allclose(rows.jacobian @ qd, rows.nu, rtol=0, atol=1e-10)
    zero = np.zeros((len(rows.phi), len(rows.phi)))
    matrix = np.block([[np.diag(masses), -rows.jacobian.T], [rows.jacobian, zero]])
    solution = np.linalg.solve(matrix, np.concatenate([loads, rows.gamma]))
    return solution[:n], solution[len(q) :], dy[n : 2 * n]


@pytest.mark.parametrize("name", CASES)
def test_accelerations_and_contact_forces_are_those_of_the_textbook(name):
    """The force on the bodies is that of the multipliers: the tangency rows give none, the others the contact force."""
    build = CASES[name]
    random = np.random.default_rng(3)
    for angle, speed in zip(random.uniform(0.0, 6.0, 12), random.uniform(-4.0, 4.0, 12), strict=True):
        mechanism = replace(build(angle, speed), settings=EXACT)
        simulation = Simulation(mechanism)
        forces = simulation.read()
        expected, multipliers, found = kkt(simulation)
        assert np.abs(found - expected).max() < 1e-10 * np.abs(expected).max(), angle
        scale = np.abs(multipliers).max()
        outputs = {o.source.partition(".")[0]: o.name for o in mechanism.outputs if o.source.endswith(".force")}
        first = sum(joint.rows for joint in mechanism.joints)
        for contact in mechanism.contacts:
            size = np.hypot(*multipliers[first : first + 2])
            if contact.rows == 2 and contact.profiles[1] is None:  # the flat face has one row with force
                size = abs(multipliers[first])
            assert abs(forces[outputs[contact.name]]) == pytest.approx(size, rel=1e-9, abs=1e-10 * scale)
            first += contact.rows


@pytest.mark.parametrize("cranks", [2, 3, 4])
def test_accelerations_of_redundant_cranks_are_exact(cranks):
    """Eq (3), with rank 11 of 12 rows: all cranks turn with T / J, the coupler goes as their pins."""
    base = parallel_cranks(cranks)
    torque, arm = 0.4, 0.5
    mechanism = Mechanism(base.bodies, base.joints, (Torque("drive", "crank0", torque=torque),), settings=EXACT)
    simulation = Simulation(mechanism)
    turn = torque / (cranks * (0.02 + 0.3 * arm**2 / 4) + 1.2 * arm**2)
    c, s = np.cos(0.4), np.sin(0.4)
    expected = [turn * v for _ in range(cranks) for v in (-arm / 2 * s, arm / 2 * c, 1.0)]
    expected += [-turn * arm * s, turn * arm * c, 0.0]
    n = len(expected)
    np.testing.assert_allclose(simulation.field("dy_end")[n : 2 * n], expected, rtol=0, atol=1e-9)
