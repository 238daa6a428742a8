"""Linkages of the gallery against circles that meet, and points on straight lines."""

import math

import numpy as np
import pytest
from circles import angle, meet
from gallery_examples import run

TIMES = np.linspace(0.0, 2.0, 81)
#: Of the integration, by default: between steps, what loops close with is as accurate as that.
TOLERANCE = 1e-9


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
    assert off(found["rocker"], angle(c - d) - angle(c - d)[0]) < TOLERANCE
    assert off(found["lever"], angle(f - g)) < TOLERANCE
    assert np.ptp(found["lever"]) > 0.5


def test_the_stephenson_six_bar_closes_both_loops() -> None:
    found = run("stephenson", TIMES)
    b = 0.1 * np.exp(1j * (math.pi / 2 + 2 * math.pi * TIMES))
    d, g = 0.4 + 0j, 0.15 - 0.2j
    c = meet(b, d, 0.35, 0.3)
    e = meet(b, c, 0.2, 0.25)
    f = meet(e, g, 0.45, 0.25)
    assert off(found["rocker"], angle(c - d)) < TOLERANCE
    assert off(found["lever"], angle(f - g)) < TOLERANCE
    assert np.ptp(found["lever"]) > 0.4


def test_peaucelliers_point_stays_on_its_straight_line() -> None:
    found = run("peaucellier", TIMES)
    line = (0.25**2 - 0.1**2) / 0.2
    assert off(found["x"], np.full(len(TIMES), line)) < 1e-10
    assert off(found["y"], line * np.tan(np.sin(6.0 * TIMES) / 2)) < 1e-10  # O sees P at half the crank's angle
    assert off(found["turn"], np.sin(6.0 * TIMES)) < 1e-10


def test_the_quick_return_has_its_closed_form() -> None:
    """The lever points at the pin of the crank; the ram is the rod's length away from the lever's far end."""
    found = run("whitworth", TIMES)
    lever = angle(0.05j + 0.1 * np.exp(2j * math.pi * TIMES))
    assert off(found["lever"], lever) < 2e-9
    assert off(found["ram"], -0.08 * np.cos(lever) + np.sqrt(0.4**2 - (0.08 * np.sin(lever)) ** 2)) < 2e-10


def test_the_pen_of_the_pantograph_draws_the_figure_as_large_as_it_should() -> None:
    for scale in (2.0, 1.5):
        found = run("pantograph", TIMES, scale=scale)
        assert off(found["x"], scale * (0.2 + 0.1 * np.cos(2.0 * TIMES))) < 1e-9
        assert off(found["y"], scale * (0.15 + 0.05 * np.cos(3.0 * TIMES))) < 1e-9


def apart(half: complex, length: float) -> complex:
    """The middle between the moving pins of two cranks of equal length, above the frame.

    One crank ends at middle - half, as seen from its fixed pin, and the other at middle + half; so the middle is
    across `half`, and both lengths together give its distance.
    """
    return np.asarray(1j * half / np.abs(half) * np.sqrt(length**2 - np.abs(half) ** 2))


def test_chebyshevs_point_is_where_its_closed_form_says() -> None:
    found = run("chebyshev", np.linspace(0.0, 4.0, 81))
    middle = apart(0.2 - 0.1 * np.exp(1j * found["angle"]), 0.5)
    assert off(found["x"], 0.2 * np.cos(3.0 * np.linspace(0.0, 4.0, 81))) < 1e-9
    assert off(found["x"], middle.real) < 1e-9
    assert off(found["y"], middle.imag) < 1e-9
    assert found["y"][0] == pytest.approx(0.4, abs=1e-14)
    assert 0.4 - 1e-9 < found["y"].min() < found["y"].max() < 0.4 * 1.003


def test_roberts_point_is_where_its_closed_form_says() -> None:
    found = run("roberts", TIMES)
    turn = np.exp(1j * found["angle"])
    rise = 1j * math.sqrt(0.24**2 - 0.1**2)
    apex = apart(0.2 - 0.1 * turn, 0.24) - rise * turn
    assert off(found["x"], apex.real) < 1e-9
    assert off(found["off"], apex.imag) < 1e-9
    assert np.ptp(found["x"]) > 0.25
    assert 0.002 < np.abs(found["off"]).max() < 0.003


def test_the_ram_of_the_toggle_press_is_where_circles_meet() -> None:
    times = np.linspace(0.0, 4.0, 81)
    found = run("toggle_press", times)
    ram = press(2 * math.pi * times / 2)
    assert off(found["ram"], ram) < TOLERANCE
    np.testing.assert_allclose(found["die_force"], np.minimum(2e7 * (ram + 0.595), 0.0), rtol=1e-7, atol=0)
    assert found["die_force"].min() < -6e4


def press(turned: np.ndarray | float) -> np.ndarray:
    """Place of the ram for angles of the crank."""
    pin = -0.5 - 0.25j + 0.08 * np.exp(1j * np.asarray(turned))
    return np.asarray(2 * meet(0j, pin, 0.3, 0.4).imag)


def test_the_toggle_press_multiplies_force_as_its_speeds_say() -> None:
    """At a creeping speed, the drive's torque holds the die's force by virtual work."""
    found = run("toggle_press", [0.0], speed=1e-4)
    step = 1e-4
    slope = (8 * (press(step) - press(-step)) - (press(2 * step) - press(-2 * step))) / (12 * step)
    assert found["torque"][0] == pytest.approx(found["die_force"][0] * slope, rel=1e-8)
    assert abs(found["die_force"][0] * 0.08 / found["torque"][0]) > 10.0


def test_lifts_of_a_hundred_bars_are_as_high_as_their_feet_say_and_as_heavy_as_virtual_work() -> None:
    """All follows from the place of a foot, and the force on it from T, V and Lagrange's equation."""
    stages, length, mass, gravity = 10, 0.5, 0.2, 9.81
    times = np.linspace(0.0, 4.0, 81)
    found = run("scissors", times)
    foot, speed, change = 0.25 + 0.1 * np.sin(2 * times), 0.2 * np.cos(2 * times), -0.4 * np.sin(2 * times)
    turned = np.arccos(foot / length)
    sine, cosine = np.sin(turned), np.cos(turned)
    assert off(found["height"], stages * length * sine) < 1e-10
    beside = np.arccos((0.25 + 0.1 * np.sin(2 * times + math.tau / 5)) / length)
    assert off(found["next_height"], stages * length * np.sin(beside)) < 1e-10
    rate = -speed / (length * sine)
    bend = -(change + length * cosine * rate**2) / (length * sine)
    heights = np.arange(stages) + 0.5
    # of two bars a stage: T = (1/2) inertia rate^2
    inertia = 2 * mass * length**2 * (stages / 12 + stages / 4 * sine**2 + (heights**2).sum() * cosine**2)
    slope = 4 * mass * length**2 * sine * cosine * (stages / 4 - (heights**2).sum())
    moment = inertia * bend + 0.5 * slope * rate**2 + 2 * mass * gravity * length * cosine * heights.sum()
    force = -moment / (length * sine)
    assert off(found["force"], force) < 1e-9 * float(np.abs(force).max())
