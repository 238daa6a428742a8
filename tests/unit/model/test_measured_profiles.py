"""Profiles within the noise of measured radii, and curves whose second derivative is noise."""

import math
import sys

import numpy as np
import pytest

from mechanism_fmu.model import MechanismError, spline_profile, table_motion
from mechanism_fmu.model.curves.measured import remark_on

ANGLES = 2.0 * math.pi * np.arange(360) / 360
#: Second derivative of the lift below, and of what presses the follower: spring [N/m], preload [m], mass [kg].
AMPLITUDE, SPRING, PRELOAD, MASS = 5e-3, 5e3, 5e-3, 0.2


def radii(noise, count=360, seed=2, digits=7):
    angles = 2.0 * math.pi * np.arange(count) / count
    lift = AMPLITUDE * (1.0 - np.cos(angles)) + np.random.default_rng(seed).normal(0.0, noise, count)
    return (0.025 + lift.round(digits)).tolist()


def jump_speed(profile):
    """The least speed [rad/s] at which the force on a follower falls to zero, by the pieces of the profile."""
    least = math.inf
    ends = [*(piece.start for piece in profile.pieces[1:]), profile.start + profile.span]
    for piece, end in zip(profile.pieces, ends, strict=True):
        polynomial = np.polynomial.Polynomial(piece.terms[0].polynomial)
        xi = np.linspace(0.0, end - piece.start, 50)
        radius, bend = polynomial(xi), polynomial.deriv(2)(xi)
        needed = SPRING * (radius[bend < 0.0] - 0.025 + PRELOAD) / (-MASS * bend[bend < 0.0])
        least = min([least, *needed.tolist()])
    return math.sqrt(least)


@pytest.mark.parametrize("noise", [1e-7, 1e-6, 1e-5])
@pytest.mark.parametrize("degree", [None, 3])
def test_a_follower_jumps_at_the_speed_of_the_true_cam(noise, degree):
    exact = math.sqrt(75_000.0)
    smooth = spline_profile(radii(noise), degree=degree, noise=math.hypot(noise, 3e-8))
    assert jump_speed(smooth) == pytest.approx(exact, rel=0.01 if degree is None else 0.03)
    if noise == 1e-6:
        assert jump_speed(spline_profile(radii(noise))) < 0.6 * exact


def test_a_smooth_profile_says_what_it_assumes():
    profile = spline_profile(radii(1e-6), noise="1 um")
    smoothing = profile.smoothing
    assert (smoothing.points, smoothing.degree, smoothing.pieces) == (360, 5, len(profile.pieces))
    assert smoothing.noise == 1e-6
    assert smoothing.rms == pytest.approx(1e-6, rel=1e-2)
    assert smoothing.scatter == pytest.approx(1e-6, rel=0.25)
    assert smoothing.rms < smoothing.largest < 5e-6
    assert smoothing.second_derivative_change > 2.0 * AMPLITUDE
    assert f"{smoothing.pieces} pieces of degree 5" in str(smoothing)
    assert profile == spline_profile(radii(1e-6), noise=1e-6)
    assert spline_profile(radii(1e-6)).smoothing is None


def test_it_closes_wherever_its_angles_begin():
    shifted = spline_profile(radii(1e-6), (ANGLES + 0.3).tolist(), noise="1 um")
    assert (shifted.start, shifted.pieces[0].start) == (0.3, 0.3)
    last = shifted.pieces[-1]
    end = np.polynomial.Polynomial(last.terms[0].polynomial)
    begin = np.polynomial.Polynomial(shifted.pieces[0].terms[0].polynomial)
    width = shifted.start + shifted.span - last.start
    for order in range(4):
        assert end.deriv(order)(width) == pytest.approx(begin.deriv(order)(0.0), abs=1e-9)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"noise": 0.0}, "standard deviation, above 0"),
        ({"noise": math.nan}, "standard deviation, above 0"),
        ({"noise": "1 s"}, "wants m"),
        ({"noise": "1 um", "degree": 4}, "degree 4"),
        ({"noise": "1 um", "angles": [0.0, 1.0]}, "2 places for 360 values"),
    ],
)
def test_what_is_no_noise_is_refused(arguments, says):
    with pytest.raises(MechanismError, match=says):
        spline_profile(radii(1e-6), **arguments)


def test_too_few_points_are_refused():
    with pytest.raises(MechanismError, match="more than 5 points"):
        spline_profile([0.02, 0.03, 0.025], noise="1 um")


def test_without_scipy_it_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy.interpolate", None)
    with pytest.raises(MechanismError, match=r"mechanism_fmu\[analysis\]"):
        spline_profile(radii(1e-6), noise="1 um")


@pytest.mark.parametrize(("noise", "count"), [(1e-7, 180), (1e-6, 180), (1e-6, 90), (1e-5, 72)])
@pytest.mark.parametrize("seed", range(2))
def test_curvature_that_is_noise_is_named_with_its_size(noise, count, seed):
    remark = remark_on(spline_profile(radii(noise, count, seed, 10)))
    assert remark is not None
    found = float(remark.partition("scatter by about ")[2].split()[0])
    assert found == pytest.approx(noise, rel=0.4)


def shapes(count):
    """Smooth lifts, and some with jumps of slope or curvature [m]."""
    angles = 2.0 * math.pi * np.arange(count) / count
    up, down = (np.clip((angles - begin) / math.radians(120.0), 0.0, 1.0) for begin in (0.0, math.pi))
    laws = (
        lambda u: u - np.sin(2.0 * np.pi * u) / (2.0 * np.pi),
        lambda u: 0.5 - 0.5 * np.cos(np.pi * u),
        lambda u: np.where(u < 0.5, 2.0 * u**2, 1.0 - 2.0 * (1.0 - u) ** 2),
        lambda u: u,
    )
    yield AMPLITUDE * (1.0 - np.cos(angles))
    yield 0.0 * angles
    for law in laws:
        yield 0.01 * (law(up) - law(down))


@pytest.mark.parametrize("count", [12, 24, 36, 72, 180])
@pytest.mark.parametrize("degree", [3, 5])
def test_shapes_are_not_taken_for_noise(count, degree):
    for lift in shapes(count):
        assert remark_on(spline_profile((0.025 + lift).tolist(), degree=degree)) is None


def test_noise_given_wrongly_is_named():
    assert "its points scatter by about" in remark_on(spline_profile(radii(1e-6), noise="10 um"))
    assert remark_on(spline_profile(radii(1e-6), noise="1 um")) is None


def test_a_table_of_a_motion_is_looked_at_too():
    assert remark_on(table_motion([(0.01 * k, math.sin(0.01 * k)) for k in range(100)])) is None
