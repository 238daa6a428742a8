"""A contact whose force falls through zero opens once, and closes where its gap does: cams around their jump speed."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest
from cams_that_jump import BASE, TURN, Cam, motion, parabolas, random_cam

from mechanism_fmu.model import harmonic_profile

#: Two turns and a bit.
_TURNS = 2.05


@pytest.mark.parametrize("seed", range(28))
def test_events_are_those_of_formulas(seed: int) -> None:
    cam = random_cam(seed)
    until = _TURNS * TURN / cam.omega
    events, least_gap, _ = motion(cam, 1e-9, until)
    expected = cam.by_formulas(until)
    assert [name for name, _ in events] == [name for name, _ in expected]
    angles = [cam.omega * time for _, time in events]
    assert angles == pytest.approx([cam.omega * time for _, time in expected], rel=0.0, abs=2e-6)
    assert least_gap > -1e-9


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8, 1e-12])
@pytest.mark.parametrize("seed", [0, 1, 4, 5, 8, 12, 13])
def test_it_opens_once_and_closes_at_any_tolerance(seed: int, tolerance: float) -> None:
    cam = random_cam(seed)
    events, least_gap, _ = motion(cam, tolerance, _TURNS * TURN / cam.omega)
    names = [name for name, _ in events]
    assert ("force", "force") not in pairwise(names)
    assert set(names) <= {"force", "gap"}
    assert least_gap > -1e-9


#: A rise by parabolas of 0.01 m/rad2 up and down, then the way back, then a dwell.
_WAY = parabolas([0.01, -0.01, -0.01, 0.01, 0.0], [math.pi / 4] * 4 + [math.pi])
_PARABOLA = 0.2 * 0.01 * 100.0**2


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize("share", [1.0, 1.0 + 1e-13, 1.0 - 1e-13, 1.0 - 1e-10, 1.0 - 1e-8])
def test_no_force_along_a_whole_piece(tolerance: float, share: float) -> None:
    """The weight is what the nose needs, or hardly more or less: nothing chatters, and the follower stays."""
    cam = Cam(_WAY, 100.0, stiffness=0.0, weight=share * _PARABOLA)
    events, least_gap, lift = motion(cam, tolerance, _TURNS * TURN / cam.omega)
    assert len(events) < 60
    assert least_gap > -1e-9
    assert abs(lift) < 1e-9


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-9, 1e-12])
def test_a_dip_between_the_stages_of_a_step_is_seen(tolerance: float) -> None:
    """At 1e-6 above the jump speed, it pulls along 0.3 degrees of the turn, by 2e-6 of its force."""
    cam = Cam(harmonic_profile(BASE + 5e-3, [-5e-3]), math.sqrt(75_000.0) * (1.0 + 1e-6))
    events, _, _ = motion(cam, tolerance, 1.05 * TURN / cam.omega)
    opens = [math.degrees(cam.omega * time) for name, time in events if name == "force"]
    assert opens
    assert opens[-1] == pytest.approx(180.0 - math.degrees(math.sqrt(6e-6)), abs=1e-4)
