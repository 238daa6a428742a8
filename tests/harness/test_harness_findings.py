import math
import subprocess
import sys
from dataclasses import replace

import pytest

from harness.papers.study.accuracy import PlaneTooth, accuracy_findings, plane_teeth
from harness.papers.study.wheels import Wheel
from harness.run.checks import Verdict, verdict_of
from mechanism_fmu.stress import STEEL, maximum_stress, ritz_modes

TEETH = plane_teeth()


def wheel(tooth: PlaneTooth) -> Wheel:
    alpha = math.atan(1 / tooth.slenderness)
    return Wheel(
        tooth.tooth_count, math.radians(tooth.slope_angle_deg), 0.9, 0.02, 1e-3, 1e4, 0.3956, 2e-6, 0.02, alpha
    )


WHEELS = [wheel(tooth) for tooth in TEETH]


@pytest.mark.parametrize(
    ("criteria", "verdict"),
    [
        ([True, True], Verdict.HOLDS),
        ([True, False], Verdict.HOLDS_IN_PART),
        ([False, False], Verdict.DOES_NOT_HOLD),
        ([True], Verdict.HOLDS),
        ([False], Verdict.DOES_NOT_HOLD),
    ],
)
def test_a_claim_holds_as_far_as_what_it_says(criteria: list[bool], verdict: Verdict) -> None:
    assert verdict_of(criteria) is verdict


def test_the_paper_s_claims_of_accuracy() -> None:
    wedge, beam, second = accuracy_findings(WHEELS)
    assert [finding.verdict for finding in (wedge, beam, second)] == [
        Verdict.HOLDS_IN_PART,
        Verdict.TAKEN_OVER,
        Verdict.HOLDS_IN_PART,
    ]
    left_out = [tooth.left_out for tooth in TEETH]
    assert f"first frequency {-max(left_out):+.1%} to {-min(left_out):+.1%};" in wedge.evidence
    assert 0.0 < min(left_out) < max(left_out) < 0.15
    assert "1.09 to 2.91 times the first frequency" in beam.evidence
    assert "1.20 to 3.29 times that of the whole tooth" in beam.evidence
    assert "below 1 for 17 of 20" in beam.evidence


def test_the_second_mode_is_computed_for_the_paper_s_two() -> None:
    finding = accuracy_findings(WHEELS)[-1]
    modes = ritz_modes(WHEELS[0].tooth, STEEL)
    one, two = (maximum_stress(WHEELS[0].tooth, STEEL, 1.0, modes[:number]) for number in (1, 2))
    # from an independent computation: C and place with one mode and with two
    assert (one.coefficient, one.position) == (pytest.approx(0.739447, rel=2e-6), pytest.approx(0.2851, abs=1e-4))
    assert (two.coefficient, two.position) == (pytest.approx(0.786452, rel=2e-6), pytest.approx(0.3956, abs=1e-4))
    assert "by +6.4%" in finding.evidence
    assert "from x/l = 0.285 to 0.396" in finding.evidence


def test_teeth_of_another_shape_are_not_those_of_the_finite_elements() -> None:
    others = [replace(wheel, tooth_apex_angle=wheel.tooth_apex_angle + 1e-3) for wheel in WHEELS]
    assert len(accuracy_findings(others)) == 1
    assert len(accuracy_findings([*others[:-1], WHEELS[-1]])) == 3
    assert "of the teeth of 1 wheels" in accuracy_findings(WHEELS[-1:])[0].evidence


def test_a_tooth_that_is_a_beam_costs_little() -> None:
    slender = [wheel for wheel in WHEELS if wheel.slenderness > 3]
    wedge, beam, _ = accuracy_findings(slender)
    assert wedge.verdict is Verdict.HOLDS
    assert "1.09 to 1.09 times the first frequency of the same wedge" in beam.evidence


@pytest.mark.parametrize(("small", "verdict"), [(0.05, Verdict.DOES_NOT_HOLD), (0.3, Verdict.HOLDS)])
def test_the_wedge_is_as_good_as_what_counts_as_small(small: float, verdict: Verdict) -> None:
    assert accuracy_findings(WHEELS, small)[0].verdict is verdict


def test_what_a_beam_costs_is_no_verdict_on_a_claim_that_nobody_makes() -> None:
    beam = accuracy_findings(WHEELS)[1]
    assert 'has been modelled as a cantilever beam", which "may not seem appropriate"' in beam.claim


def test_the_study_needs_no_finite_elements() -> None:
    program = (
        "import harness.app.commands.one_run, harness.papers.study.study, harness.papers.study.study_report, sys; "
        "assert 'skfem' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
