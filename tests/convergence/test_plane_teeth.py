"""The paper's teeth as plates of finite elements: the method, its convergence, and the file that the study reads."""

import math
from dataclasses import astuple
from itertools import pairwise

import pytest
from scipy.integrate import quad

from benchmarks.plane_teeth import (
    REFINEMENTS,
    beam_frequency,
    beam_impact,
    beam_static,
    compare,
    file_text,
    order,
    shape,
)
from benchmarks.plane_tooth import solve, wedge_plate
from harness.papers.study.accuracy import FILE, plane_teeth
from harness.papers.study.wheels import SLOPE_ANGLES_DEG, TOOTH_COUNTS
from mechanism_fmu.stress import STEEL, Material, WedgeTooth, exact_wedge_frequencies

UNIT = Material(1.0, 1.0, 0.03)

#: (nt, beta_0): eq (15) over the first frequency of the plate, from an independent computation.
KNOWN = {(10, 85): 2.63, (10, 90): 2.91, (10, 105): 3.29, (25, 95): 2.56}
ROWS = {(row.tooth_count, row.slope_angle_deg): row for row in plane_teeth()}


def slender(slenderness):
    tooth = WedgeTooth(1.0, math.atan(1 / slenderness), 1.0)
    return tooth, solve(wedge_plate(tooth), 0, (0.3, 0.5, 0.7))


def test_a_slender_plate_is_a_beam():
    deficits = []
    for slenderness in (8, 16):
        tooth, plate = slender(slenderness)
        deficits.append(1 - plate.frequency / exact_wedge_frequencies(tooth, UNIT, 1)[0])
        for flank, sign in zip((0, 1), (1, -1), strict=True):
            assert sign * plate.static[flank] == pytest.approx(
                beam_static(tooth, (0.3, 0.5, 0.7)), rel=2 / slenderness**2
            )
            assert sign * plate.impact[flank] == pytest.approx(
                beam_impact(tooth, (0.3, 0.5, 0.7)), rel=4 / slenderness**2
            )
    # shear and rotary inertia, which the beam does not know, go with the square of height over length
    assert 0.0 < deficits[1] < 0.02
    assert math.log2(deficits[0] / deficits[1]) == pytest.approx(2.0, abs=0.15)


@pytest.mark.parametrize("place", [0.0, 0.4, 0.9])
def test_static_stress_of_the_beam_is_moment_over_section_modulus(place):
    tooth = WedgeTooth(1.7, 0.6, 1.0)
    slope, x = math.tan(tooth.apex_angle), place * tooth.length
    moment = quad(lambda s: (tooth.length - s) * slope * s / tooth.length * (s - x), x, tooth.length)[0]
    modulus = (slope * (tooth.length - x)) ** 2 / 6
    assert beam_static(tooth, (place,))[0] == pytest.approx(moment / modulus, rel=1e-12)


@pytest.mark.parametrize("case", KNOWN)
def test_whole_teeth_converge_to_the_ratios_of_the_file(case):
    row, of = ROWS[case], shape(*case)
    found = [solve(of.tooth, refinement, (0.4,)) for refinement in REFINEMENTS]
    coarse, middle, fine = (beam_frequency(of.beam) / solution.frequency for solution in found)
    # nested meshes: each has the motions of the one before, and its frequency is lower
    assert coarse < middle < fine
    assert order((coarse, middle, fine)) > 3.0
    assert fine / middle - 1 < 2e-6
    assert fine == pytest.approx(row.beam_to_tooth_frequency, abs=6e-6)
    assert fine == pytest.approx(KNOWN[case], rel=0.02)
    # the stress, too: a derivative of the displacements, at a place near no corner
    assert found[1].static == pytest.approx(found[2].static, rel=1e-3)


def test_frequencies_of_the_base_case_in_steel():
    row = ROWS[10, 90]
    chord = 0.2 * math.sin(math.pi / 10)
    unit = math.sqrt(STEEL.youngs_modulus / STEEL.density) / chord / (2 * math.pi) / 1e3
    beam = beam_frequency(shape(10, 90).beam) * unit
    assert beam == pytest.approx(109.1, abs=0.05)
    assert beam / row.beam_to_wedge_frequency == pytest.approx(40.1, abs=0.05)
    assert beam / row.beam_to_tooth_frequency == pytest.approx(37.45, abs=0.05)


def test_the_file_has_the_20_wheels_and_says_how_it_was_made():
    assert list(ROWS) == [(count, angle) for count in TOOTH_COUNTS for angle in SLOPE_ANGLES_DEG]
    assert file_text(plane_teeth()) == FILE.read_text(encoding="utf-8")


def assert_as_in_the_file(case, refinement, stress):
    found, row = astuple(compare(*case, refinement)), astuple(ROWS[case])
    # length over height is dimensionless: the chord is 1
    assert found[:3] == pytest.approx(row[:3], rel=1e-8)
    assert found[3:5] == pytest.approx(row[3:5], rel=2e-5)
    assert found[5:] == pytest.approx(row[5:], rel=stress)


@pytest.mark.parametrize("case", KNOWN)
def test_four_teeth_are_as_in_the_file(case):
    assert_as_in_the_file(case, 0, stress=1e-2)


@pytest.mark.slow
@pytest.mark.parametrize("case", ROWS)
def test_every_tooth_is_as_in_the_file(case):
    assert_as_in_the_file(case, 1, stress=2e-3)


def test_one_step_of_the_paper_s_table_turns_round_with_plates():
    # jump of the wheel's rate [rad/s], which depends on beta_0 alone, from an independent computation
    jumps = {85: 0.0234860726, 90: 0.0235183133, 95: 0.0234923430, 100: 0.0234152575, 105: 0.0232913312}
    beam = {case: jumps[case[1]] * shape(*case).beam.length * math.sin(math.pi / case[0]) for case in ROWS}
    plate = {case: beam[case] * ROWS[case].impact_tooth for case in ROWS}
    steps = [((count, a), (count, b)) for count in TOOTH_COUNTS for a, b in pairwise(SLOPE_ANGLES_DEG)]
    steps += [((b, angle), (a, angle)) for angle in SLOPE_ANGLES_DEG for a, b in pairwise(TOOTH_COUNTS)]
    assert len(steps) == 31
    assert all(beam[after] > beam[before] for before, after in steps)
    turned = [(before, after) for before, after in steps if plate[after] < plate[before]]
    assert turned == [((10, 100), (10, 105))]
    assert beam[10, 105] / beam[10, 100] - 1 == pytest.approx(0.02, abs=0.005)
    assert plate[10, 105] / plate[10, 100] - 1 == pytest.approx(-0.15, abs=0.005)
