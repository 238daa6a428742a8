"""What reports on cams and profiles say to an engineer."""

import math
from dataclasses import replace

import numpy as np
import pytest

from mechanism_fmu.kinematics import KinematicsError, cam_report, profile_report
from mechanism_fmu.kinematics.profiles import radius_of
from mechanism_fmu.model import AngleDriver
from mechanism_fmu.model.curves import Curve, Piece, Term, constant
from mechanism_fmu.model.curves.motions import harmonic_motion
from mechanism_fmu.model.curves.profiles import circle, harmonic_profile, piecewise_profile, slot
from tests.slide_cam import EGG, SLIDE_CAM, cam_mechanism

SLIDES = profile_report(SLIDE_CAM)


def test_the_cam_of_the_slides():
    """Its curvature is -1.25 at the joins and 5/3 at the nose; 14.96 deg beside the joins it vanishes."""
    assert (SLIDES.least_rho, SLIDES.largest_rho) == pytest.approx((1.0, 1.5))
    assert SLIDES.hollow_radius == pytest.approx(0.8, rel=1e-12)
    assert SLIDES.tip_radius == pytest.approx(0.6, rel=1e-12)
    assert math.degrees(SLIDES.tip_alpha) == pytest.approx(60.0, abs=1e-4)
    assert np.degrees(SLIDES.hollows) == pytest.approx(np.array([[0.0, 14.96], [105.04, 120.0]]), abs=0.01)
    assert not SLIDES.convex
    assert [(jump.order, jump.before, jump.after) for jump in SLIDES.jumps] == [
        (2, pytest.approx(2.25), 0.0),
        (2, 0.0, pytest.approx(2.25)),
    ]


def test_problems_of_the_cam_of_the_slides():
    flat, jump, _ = SLIDES.problems(flat=True)
    assert flat.startswith("The profile is not convex (hollow at 0.00 to 14.96 deg, 105.04 to 120.00 deg): a flat face")
    assert jump.startswith("At 120.00 deg the bend of the profile jumps from 2.25 to 0 m: a jump in the follower's acc")
    large = SLIDES.problems(0.8)[0]
    assert large.startswith("A roller of radius 0.8 m does not fit into the hollow at 0.00 deg, whose radius is 0.8 m")
    assert len(SLIDES.problems(0.79)) == len(SLIDES.problems(0.0)) == len(SLIDES.problems()) == 2


def test_nothing_is_wrong_with_an_egg():
    report = profile_report(EGG)
    assert report.convex
    assert report.hollow_radius == math.inf
    assert report.problems(flat=True) == report.problems(1.0) == ()


def test_the_extremes_of_the_curvature_lie_between_the_samples():
    """rho = 1 + a cos(alpha - b): largest at alpha = b, where the curvature is (P^2 + P a) / P^3 with P = 1 + a."""
    a, b = 0.2, 0.123456
    report = profile_report(harmonic_profile(1.0, (a * math.cos(b),), (a * math.sin(b),)))
    alpha = np.linspace(0, 2 * math.pi, 2_000_001)
    rho, rate, bend = 1 + a * np.cos(alpha - b), -a * np.sin(alpha - b), -a * np.cos(alpha - b)
    curvature = (rho**2 + 2 * rate**2 - rho * bend) / (rho**2 + rate**2) ** 1.5
    assert report.tip_radius == pytest.approx(1 / curvature.max(), rel=1e-11)
    assert report.convex


def test_undercut_of_a_cam_cut_with_a_roller():
    """The smallest radius of a convex path of the roller's centre must be larger than the roller."""
    assert SLIDES.undercut(0.6)
    assert not SLIDES.undercut(0.59)
    assert profile_report(circle(0.3)).undercut(0.31)
    assert not profile_report(circle(0.3)).undercut(0.29)


def test_edges_and_jumps_of_the_speed():
    step = piecewise_profile((0.0, (constant(1.0),)), (2.0, (constant(1.1),)))
    assert [jump.order for jump in profile_report(step).jumps] == [0, 0]
    assert "the radius of the profile jumps from 1 to 1.1 m: an edge." in profile_report(step).problems()[0]
    ramp = Curve((Piece(0.0, (Term((1.0, 0.1)),)), Piece(1.0, (Term((1.1,)),))), 0.0, 2.0)
    assert [(jump.alpha, jump.order) for jump in profile_report(ramp).jumps] == [(1.0, 1)]
    assert "a jump in the follower's speed" in profile_report(ramp).problems()[0]


def test_a_slot_has_ends_that_need_not_meet():
    assert profile_report(slot([(0.0, 1.0), (0.5, 1.2), (1.0, 1.5)])).jumps == ()


def test_a_profile_through_its_centre():
    assert "rho falls to -1 m" in profile_report(circle(-1.0)).problems()[0]


def test_radius_of_a_roller():
    assert radius_of(circle(0.3)) == 0.3
    assert radius_of(EGG) is None
    assert radius_of(SLIDE_CAM) is None


def test_a_report_says_what_is_wrong_with_pair_and_profile():
    report = cam_report(cam_mechanism("point"), "pair", "cam", 90)
    angle, *jumps = report.problems()
    assert angle.startswith("The pressure angle reaches 31.48 deg at cam angle ")
    assert len(jumps) == 2
    assert len(report.problems(math.radians(32))) == 2
    roller = cam_report(cam_mechanism("roller"), "pair", "cam", 36)
    assert roller.roller_radius == 0.25
    assert roller.problems()[0].startswith("At 120.00 deg the bend")
    egg = cam_report(cam_mechanism("flat", EGG, height=1.0), "pair", "cam", 36)
    assert egg.flat
    assert egg.problems() == ()


@pytest.mark.parametrize(
    ("kind", "options", "what"),
    [
        ("flat", {}, "The profile is not convex"),
        ("roller", {"roller": 0.9}, r"A roller of radius 0\.9 m does not fit into the hollow"),
    ],
)
def test_a_turn_that_is_not_possible_says_what_the_profile_has_to_do_with_it(kind, options, what):
    with pytest.raises(KinematicsError, match=f"'pair' does not run through a whole turn of 'cam'. {what}"):
        cam_report(cam_mechanism(kind, **options), "pair", "cam", 36)


def test_whatever_drove_the_cam_before_is_taken_away():
    mechanism = cam_mechanism("roller")
    driver = AngleDriver("motor", "cam", harmonic_motion(0.0, 0.1, 1.0))
    driven = replace(mechanism, joints=(*mechanism.joints, driver))
    found, expected = (cam_report(m, "pair", "cam", 12).motion.of("follower.y")[0] for m in (driven, mechanism))
    np.testing.assert_array_equal(found, expected)


def free_follower():
    mechanism = cam_mechanism("roller")
    return replace(mechanism, joints=mechanism.joints[:1])


@pytest.mark.parametrize(
    ("mechanism", "contact", "cam", "what"),
    [
        (cam_mechanism("roller"), "guide", "cam", "no pair of profiles 'guide'; there are: pair"),
        (cam_mechanism("roller"), "pair", "ground", "the cam given is 'ground'"),
        (cam_mechanism("roller"), "pair", "wheel", "the cam given is 'wheel'"),
        (cam_mechanism("point"), "pair", "follower", "'follower' has no profile in 'pair': the cam is the other body"),
        (cam_mechanism("roller", closed=False), "pair", "cam", "'pair' is open"),
        (free_follower(), "pair", "cam", "2 degrees of freedom are not driven"),
    ],
)
def test_refusals(mechanism, contact, cam, what):
    with pytest.raises(KinematicsError, match=what):
        cam_report(mechanism, contact, cam, 12)


def test_a_follower_on_the_ground_is_refused():
    mechanism = cam_mechanism("roller")
    fixed = replace(mechanism, contacts=(replace(mechanism.contacts[0], body_j="ground"),))
    with pytest.raises(KinematicsError, match="a follower that can move"):
        cam_report(fixed, "pair", "cam", 12)


def test_the_cam_may_be_body_i_or_body_j():
    """The same pair, named the other way round, has the same report."""
    mechanism = cam_mechanism("roller", EGG)
    pair = mechanism.contacts[0]
    swapped = replace(pair, body_i=pair.body_j, profile_i=pair.profile_j, body_j=pair.body_i, profile_j=pair.profile_i)
    first = cam_report(mechanism, "pair", "cam", 12)
    second = cam_report(replace(mechanism, contacts=(swapped,)), "pair", "cam", 12)
    np.testing.assert_allclose(first.pressure_angle, second.pressure_angle, atol=1e-8)
    np.testing.assert_allclose(first.relative_curvature, second.relative_curvature, rtol=1e-9)
    assert second.roller_radius == 0.25
