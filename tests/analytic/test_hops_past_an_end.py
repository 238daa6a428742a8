"""What hops on an outline and past the end of a feature strikes nothing there: no feature goes farther than its end."""

import math

import pytest

from mechanism_fmu.model import GROUND, Body, Mechanism, Outline, OutlineContact, Settings
from mechanism_fmu.simulation import simulate

SPEED, HEIGHT, BOUNCE, GRAVITY = 4.0, 1e-3, 0.8, 9.81
FALL = math.sqrt(2 * HEIGHT / GRAVITY)
#: When the hops would end on a floor without end [s].
REST = (1 + BOUNCE) / (1 - BOUNCE) * FALL
PLATES = {
    "sharp": Outline.polygon([(-1.0, -0.2), (0.0, -0.2), (0.0, 0.0), (-1.0, 0.0)]),
    "round": Outline(((-1.0, -0.2, 0.0), (0.2, -0.2, math.tan(math.pi / 8)), (0.0, 0.0, 0.0), (-1.0, 0.0, 0.0))),
    # behind its top it falls away by 45 deg, which no hop comes down to
    "roof": Outline.polygon([(-1.0, -0.2), (0.2, -0.2), (0.0, 0.0), (-1.0, 0.0)]),
}
TIPS = {
    "point": Outline.polygon([(0.0, 0.0), (0.01, 0.1), (-0.01, 0.1)]),
    "disc": Outline.circle(0.01, (0.0, 0.01)),
}


def hops(until: float) -> int:
    """Impacts of the hops on a floor without end until a time [s]: at FALL (1 + 2 e + 2 e^2 + ...)."""
    count, time = 0, FALL
    while time < until:
        count += 1
        time += 2 * FALL * BOUNCE**count
    return count


def made(plate: str, tip: str, tolerance: float, left: float) -> Mechanism:
    """It comes to the end of the flat, x = 0, a time `left` [s] before its hops would end there."""
    ball = Body("ball", 1.0, 1.0, (-SPEED * (REST - left), HEIGHT, 0.0), start_rate=(SPEED, 0.0, 0.0))
    contact = OutlineContact("c", ball, GROUND, outline_i=TIPS[tip], outline_j=PLATES[plate], restitution=BOUNCE)
    return Mechanism((ball,), contacts=(contact,), gravity=(0.0, -GRAVITY), settings=Settings(tolerance))


@pytest.mark.parametrize("tip", TIPS)
@pytest.mark.parametrize("plate", PLATES)
@pytest.mark.parametrize("tolerance", [1e-7, 1e-12])
@pytest.mark.parametrize("left", [3e-3, 1e-3, 6e-4, 2e-4])
def test_hops_end_where_the_flat_does(plate: str, tip: str, tolerance: float, left: float) -> None:
    times = [one.time for one in simulate(made(plate, tip, tolerance, left), REST + 3e-3, step=0.01).impacts]
    assert len(times) == hops(REST - left)
    assert times[-1] < REST - left


@pytest.mark.parametrize("plate", PLATES)
def test_any_communication_step_gives_the_same_bits(plate: str) -> None:
    coarse, fine = (
        [one.time for one in simulate(made(plate, "disc", 1e-9, 1e-3), REST + 3e-3, step=step).impacts]
        for step in (0.02, 3e-4)
    )
    assert coarse == fine
