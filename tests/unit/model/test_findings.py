import re

import pytest
from hypothesis import given, settings, strategies as st

import models
from mechanism_fmu.model import Finding, MechanismError
from mechanism_fmu.model.findings import at_most, either, first, messages, pieces, where
from models.ratchet.model import MODEL as RATCHET
from tests.parameter_sets import within_limits


def test_a_finding_says_its_text_with_its_numbers_where_it_applies():
    short = Finding(1e-300, "b = {:.6g} m of {:g} is {{100 %}} short.", (0.1234567, 3))
    assert messages([short, Finding(0.0, "No."), Finding(-1.0, "Nor this.")]) == [
        "b = 0.123457 m of 3 is {100 %} short."
    ]


def test_pieces_are_plain_text_and_the_format_behind_it():
    assert pieces("{:g} of {:.12g} m") == (("", "g"), (" of ", ".12g"), (" m", None))


@pytest.mark.parametrize(
    ("text", "numbers", "complaint"),
    [
        ("{:g} m", (), "1 fields for 0 numbers"),
        ("m", (1.0,), "0 fields for 1 numbers"),
        ("{} m", (1.0,), "neither {:g} nor like {:.6g}"),
        ("{0:g} m", (1.0,), "neither"),
        ("{name:g} m", (1.0,), "neither"),
        ("{!r:g} m", (1.0,), "neither"),
        ("{:.3f} m", (1.0,), "neither"),
        ("{:{}} m", (1.0,), "neither"),
        ("{:g m", (1.0,), "no template"),
        ("{:g}" * 9, (1.0,) * 9, "shows 9 numbers; 8 is the most"),
    ],
)
def test_texts_that_c_could_not_write_are_refused(text, numbers, complaint):
    with pytest.raises(MechanismError, match=re.escape(complaint)):
        Finding(1.0, text, numbers)


def test_only_the_first_finding_that_applies_is_said():
    findings = first(Finding(0.0, "a"), Finding(2.0, "b"), Finding(-1.0, "c"), Finding(1.0, "d"))
    assert messages(findings) == ["b"]
    assert messages(first(*findings[2:], Finding(3.0, "e"))) == ["e"]


@pytest.mark.parametrize(("condition", "said"), [(1.0, ["a"]), (0.0, []), (-1.0, [])])
def test_a_condition_restricts_findings(condition, said):
    assert messages(where(condition, Finding(1.0, "a"), Finding(0.0, "b"))) == said


@given(st.floats(-2, 2) | st.just(5e-324), st.floats(-2, 2) | st.just(0.0))
def test_conditions_are_those_of_plain_numbers(a, b):
    assert (at_most(a, b) > 0) == (a <= b)
    assert (either(a, b) > 0) == (a > 0 or b > 0)


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=() if name == "ratchet" else pytest.mark.slow) for name in models.available()],
)
@settings(deadline=None)
@given(st.data())
def test_findings_can_be_asked_for_any_values_within_the_limits(name, data):
    model = models.load(name).MODEL
    values = data.draw(within_limits(model))
    for message in (*model.refused(values), *model.warned(values)):
        assert message.endswith(".")
        assert "nan" not in message


def test_a_tooth_without_height_whose_face_has_no_length_is_refused_in_words():
    values = RATCHET.checked(
        vars(RATCHET.values()) | {"tooth_count": 3, "slope_ratio": 1.0, "tooth_slope_angle": 0.5235987755982989}
    )
    assert ["teeth without height" in message for message in RATCHET.refused(values)] == [True]
