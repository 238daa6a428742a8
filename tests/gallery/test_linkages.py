"""Linkages of the gallery against circles that meet, and points on straight lines."""

import math

import numpy as np
from circles import angle, meet
from gallery_examples import run

TIMES = np.linspace(0.0, 2.0, 81)


def off(found: np.ndarray, wanted: np.ndarray) -> float:
    """The largest difference."""
    return float(np.abs(found - wanted).max())


def test_the_watt_six_bar_closes_both_loops() -> None:
    found = run("watt", TIMES)
    b = 0.1 * np.exp(1j * (math.pi / 3 + 2 * math.pi * TIMES))
    d, g = 0.4 + 0j, 0.65 + 0.1j
    c = meet(b, d, 0.35, 0.3)
    e = meet(d, c, 0.25, 0.15, left=False)
    f = meet(e, g, 0.3, 0.25)
    assert off(found["rocker"], angle(c - d) - angle(c - d)[0]) < 1e-10
    assert off(found["lever"], angle(f - g)) < 1e-10
    assert np.ptp(found["lever"]) > 0.5


def test_the_stephenson_six_bar_closes_both_loops() -> None:
    found = run("stephenson", TIMES)
    b = 0.1 * np.exp(1j * (math.pi / 2 + 2 * math.pi * TIMES))
    d, g = 0.4 + 0j, 0.15 - 0.2j
    c = meet(b, d, 0.35, 0.3)
    e = meet(b, c, 0.2, 0.25)
    f = meet(e, g, 0.45, 0.25)
    assert off(found["rocker"], angle(c - d)) < 1e-10
    assert off(found["lever"], angle(f - g)) < 1e-10
    assert np.ptp(found["lever"]) > 0.4


def test_peaucelliers_point_stays_on_its_straight_line() -> None:
    found = run("peaucellier", TIMES)
    assert off(found["off"], np.zeros(len(TIMES))) < 1e-10
    assert off(found["turn"], np.sin(6.0 * TIMES)) < 1e-10


def test_the_quick_return_has_its_closed_form() -> None:
    """The lever points at the pin of the crank; the ram is the rod's length away from the lever's far end."""
    found = run("whitworth", TIMES)
    lever = angle(0.05j + 0.1 * np.exp(2j * math.pi * TIMES))
    assert off(found["lever"], lever) < 2e-9
    assert off(found["ram"], -0.08 * np.cos(lever) + np.sqrt(0.4**2 - (0.08 * np.sin(lever)) ** 2)) < 2e-10
