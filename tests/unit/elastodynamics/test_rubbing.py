"""Friction of one joint, by hand: against the slip, none by Coulomb at rest; and slip on a guide that turns."""

from types import SimpleNamespace

import numpy as np
import pytest

from mechanism_fmu.elastodynamics import reaction_forces
from mechanism_fmu.elastodynamics.reaction_forces import Rubbing, rubbing_joints
from mechanism_fmu.model import Translational

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


class Turning:
    """A link that turns about the origin with 2 rad/s, and a slider on it, at one time; the link's axis is along x."""

    time = np.zeros(1)
    bodies = ("link", "slider")
    velocity = np.array([[[0.0, 0.0, 2.0], [0.0, 0.0, 2.0]]])

    def __init__(self, speed: float) -> None:
        at_link, at_slider = (0.3, 0.1), (0.7, 0.1)
        self._places = {"link": np.array([at_link]), "slider": np.array([at_slider])}
        # w x r, and for the slider its speed along the guide
        self._velocities = {"link": np.array([[-0.2, 0.6, 2.0]]), "slider": np.array([[-0.2 + speed, 1.4, 2.0]])}

    def place(self, body: str, _point: object) -> np.ndarray:
        return self._places[body]

    def velocity_of(self, body: str, _point: object) -> np.ndarray:
        return self._velocities[body]

    def turned(self, _body: str, vector: object) -> np.ndarray:
        return np.array([vector], dtype=float)


@pytest.mark.parametrize("speed", [0.5, 0.0, -1.5])
def test_on_a_guide_that_turns_slip_is_what_the_slider_goes_along_it(
    speed: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reaction_forces, "rubbing_pins", lambda mechanism: ())
    monkeypatch.setattr(reaction_forces, "attachments", lambda mechanism, places, joint: (0, 1))
    guide = Translational("guide", "link", (0.3, 0.1), (2.0, 0.0), "slider", (0.0, 0.0), (1.0, 0.0), 0.1)
    freedoms = SimpleNamespace(places=())
    linkage = SimpleNamespace(mechanism=SimpleNamespace(joints=(guide,)), freedoms=freedoms)
    (rubbing,) = rubbing_joints(SimpleNamespace(linkage=linkage, pose=Turning(speed)))  # type: ignore[arg-type]
    assert rubbing.slip == pytest.approx([-speed], abs=1e-15)
    assert rubbing.direction.tolist() == [[1.0, 0.0, 0.0]]
    assert (rubbing.joint, rubbing.coulomb, rubbing.viscous, rubbing.rows) == ("guide", 0.1, 0.0, 1)
