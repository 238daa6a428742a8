"""Friction of one joint, by hand: against the slip, none by Coulomb at rest."""

import numpy as np
import pytest

from mechanism_fmu.elastodynamics.friction import Rubbing

SLIP = np.array([-2.0, -1e-12, -0.0, 0.0, 1e-12, 0.5])
CARRIED = np.array([10.0, 10.0, 10.0, 20.0, 20.0, 40.0])


def effort(coulomb: float, viscous: float) -> list[float]:
    direction = np.broadcast_to([0.0, 0.0, 1.0], (len(SLIP), 3))
    return Rubbing("pin", (0, 1), SLIP, direction, coulomb, viscous, 2).effort(CARRIED).tolist()


def test_at_slip_zero_coulomb_s_friction_is_none_and_just_beside_it_is_whole() -> None:
    assert effort(0.1, 0.0) == [1.0, 1.0, 0.0, 0.0, -2.0, -4.0]


def test_viscous_friction_grows_with_slip() -> None:
    assert effort(0.0, 3.0) == pytest.approx([6.0, 3e-12, 0.0, 0.0, -3e-12, -1.5], rel=1e-15)


def test_both_add_up_and_never_push() -> None:
    both = np.array(effort(0.1, 3.0))
    np.testing.assert_allclose(both, np.array(effort(0.1, 0.0)) + np.array(effort(0.0, 3.0)))
    assert np.all(both * SLIP <= 0.0)
