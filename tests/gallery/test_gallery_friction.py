"""Stick and slip on a belt, against its closed form, piece by piece."""

import math
from collections.abc import Iterator

import numpy as np
import pytest
from gallery_examples import simulation

GRAVITY = 9.81


def changes(
    number: int, belt_speed: float, mass: float, stiffness: float, slipping: float, sticking: float
) -> Iterator[tuple[str, float, float]]:
    """What begins, when [s], and where the block is then [m].

    It is torn off at x_s = mu_s m g / k. Slipping, it swings about x_e = mu m g / k with the belt's speed v at first,
    x = x_e + d cos(w t) + v / w sin(w t) with d = x_s - x_e, and has the belt's speed again at x_e - d, where
    w t = 2 (pi - atan(w d / v)).
    """
    w = math.sqrt(stiffness / mass)
    torn, centre = (mu * mass * GRAVITY / stiffness for mu in (sticking, slipping))
    d = torn - centre
    time = torn / belt_speed
    for _ in range(number):
        yield "touch.slips", time, torn
        time += 2 * (math.pi - math.atan(w * d / belt_speed)) / w
        yield "touch.sticks", time, centre - d
        time += 2 * d / belt_speed


@pytest.mark.parametrize("tolerance", [1e-9, 1e-12])
@pytest.mark.parametrize(
    "values",
    [
        {"belt_speed": 0.1, "mass": 2.0, "stiffness": 50.0, "slipping": 0.3, "sticking": 0.5},
        {"belt_speed": 0.4, "mass": 0.7, "stiffness": 30.0, "slipping": 0.2, "sticking": 0.9},
    ],
)
def test_it_sticks_and_slips_when_the_closed_form_says(values: dict[str, float], tolerance: float) -> None:
    running = simulation("stick_slip", relative_tolerance=tolerance, **values)
    wanted = [*changes(5, **values)]
    found = []
    for _, time, _ in wanted:
        running.advance(time - 1e-3)
        assert not running.events_in_step()
        running.advance(time + 1e-3)
        (event,) = running.events_in_step()
        found.append((event.guard, event.time))
    assert [name for name, _ in found] == [name for name, _, _ in wanted]
    off = np.abs(np.array([time for _, time in found]) - [time for _, time, _ in wanted]).max()
    assert off < (1e-8 if tolerance > 1e-10 else 1e-11), off
    again = simulation("stick_slip", relative_tolerance=tolerance, **values)
    for _, time, place in wanted:
        again.advance(time)
        assert abs(again.read()["x"] - place) < (1e-8 if tolerance > 1e-10 else 1e-11), time


def test_the_belt_carries_it_without_slip() -> None:
    running = simulation("stick_slip")
    running.advance(1.9)
    found = running.read()
    assert (found["sticks"], found["slip"]) == (1.0, 0.0)
    np.testing.assert_allclose([found["x"], found["friction"]], [0.19, 50.0 * 0.19], rtol=1e-9)
